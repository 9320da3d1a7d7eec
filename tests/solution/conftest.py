"""Solutions that several tests look at, each built once."""

import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from solution import own_systems


@pytest.fixture(scope="session")
def solved():
    """The solution of a system of the catalogue or of these tests, by its name and a route."""
    kept = {}

    def solution_of(name, route=""):
        if (name, route) not in kept:
            build = PROBLEM_SET[name].build if name in PROBLEM_SET else getattr(own_systems, name)
            kept[name, route] = ph.solution(build(), route)
        return kept[name, route]

    return solution_of

import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE, numbers_of
from polhode.simulate import simulate


@pytest.fixture(scope="session")
def run_of():
    """The default run of a system of the catalogue, computed once."""
    known = {}

    def run(name):
        if name not in known:
            entry = CATALOGUE[name]
            equations = ph.derive(entry.build())
            numbers = numbers_of(entry, equations)
            known[name] = simulate(
                equations,
                numbers.parameters,
                numbers.start,
                numbers.duration,
                forcing=numbers.forcing,
            )
        return known[name]

    return run

"""Every catalogue system against Lagrange's equations, exactly, and the balance of its power."""

import pytest

from catalogue.systems import numeric
from derive.lagrange import lagrange, rolling_lagrange
from polhode.catalogue import PROBLEM_SET

HOLONOMIC = [
    "spinning-coin",
    "gyrocompass",
    "gyrocompass/motor",
    "tennis-racquet",
    "gyroscope",
    "gyroscope/upright",
    "gyroscope/held",
    "gyroscope/vertical-plane",
]


@pytest.mark.parametrize("name", HOLONOMIC)
def test_lagranges_equations_are_the_rows(name: str) -> None:
    equations = numeric(name).equations
    assert equations.rows == lagrange(equations)


def test_lagranges_equations_of_the_rolling_constraint_put_in_too_early_are_wrong() -> None:
    equations = numeric("rolling-disk").equations
    assert equations.rows != lagrange(equations)


def test_rolling_disk_obeys_lagranges_equations_with_its_reactions_for_multipliers() -> None:
    assert not any(rolling_lagrange(numeric("rolling-disk").equations))


@pytest.mark.parametrize("name", PROBLEM_SET)
def test_energy_changes_by_the_power_supplied(name: str) -> None:
    equations = numeric(name).equations
    assert equations.rate(equations.energy) == equations.on_shell(equations.power)


@pytest.mark.parametrize("name", ["spinning-coin", "rolling-disk", "tennis-racquet", "gyroscope"])
def test_supports_at_rest_supply_no_power(name: str) -> None:
    assert numeric(name).equations.power.is_zero

"""Several bodies, loops and an ellipsoid against the numeric oracles, reactions included."""

from collections.abc import Callable
from functools import cache
from math import cos, sin

import pytest

from derive import linkages as declared
from derive.states import Numeric, agree, draw, value
from oracles import extras
from oracles import linkages as oracle
from oracles.draws import ELLIPSOID, FOUR_BAR, GIMBALS, PENDULUM, WHEELS
from oracles.draws import draw as draw_between
from polhode.derive import Equations

seeds = pytest.mark.parametrize("seed", range(6))
ENERGIES = ["T_dot", "V_dot"]


@cache
def numeric(declaration: Callable[[], Equations]) -> Numeric:
    """A declaration as functions of numbers, compiled once."""
    return Numeric(declaration())


@seeds
def test_double_pendulum(seed: int) -> None:
    state = draw(PENDULUM, seed)
    expected = oracle.double_pendulum(**state)
    found = numeric(declared.double_pendulum).at(**state)
    agree(found, expected, ["theta_1_ddot", "theta_2_ddot"])
    agree(found, expected, [f"{f}_{i}" for f in ("F", "Fjoint") for i in "xyz"])
    agree(found, expected, ENERGIES)


@seeds
@pytest.mark.parametrize("branch", [1.0, -1.0])
def test_four_bar_linkage(seed: int, branch: float) -> None:
    state = draw_between(FOUR_BAR, seed, branch=branch)
    expected = oracle.four_bar(**state)
    linkage = numeric(declared.four_bar)
    closed = state | {angle: expected[angle] for angle in ("theta_2", "theta_3")}
    found = linkage.at(**closed)
    # Where coupler and rocker come into line the linkage locks, and digits are lost.
    near = sin(expected["theta_2"] - expected["theta_3"]) ** 4
    tolerance = max(1e-12, 4e-15 / near)
    agree(found, expected, [f"theta_{i}_dot" for i in (1, 2, 3)], tolerance)
    agree(found, expected, [f"theta_{i}_ddot" for i in (1, 2, 3)], tolerance)
    agree(found, expected, ["F_x", "F_z", "Fprime_x", "Fprime_z"], tolerance)
    agree(found, expected, ENERGIES, tolerance)
    for gap in linkage.equations.closures:
        assert value(gap, closed) == pytest.approx(0, abs=1e-14)


@seeds
def test_two_wheels_on_an_axle(seed: int) -> None:
    state = draw(WHEELS, seed)
    expected = extras.wheels_on_axle(**state)
    found = numeric(declared.wheels_on_axle).at(**state, psi_1=0.3, psi_2=-0.2, x_1=0.4, y_1=0.1)
    for wheel in ("1", "2"):
        found[f"N_{wheel}"] = found[f"F_z_{wheel}"]
        along = (sin(state["phi"]), -cos(state["phi"]))
        found[f"P_{wheel}"] = found[f"F_x_{wheel}"] * along[0] + found[f"F_y_{wheel}"] * along[1]
    agree(found, expected, ["psi_1_ddot", "psi_2_ddot", "phi_ddot"])
    agree(found, expected, ["phi_dot"])
    agree(found, expected, ["N_1", "N_2", "P_1", "P_2"])
    agree(found, expected, ENERGIES)


def test_how_the_wheels_share_the_force_along_the_axle_is_left_open() -> None:
    contacts = {f"F_{i}_{wheel}" for i in "xyz" for wheel in "12"}
    open_ = set(declared.wheels_on_axle().undetermined) & contacts
    assert open_ == {"F_x_1", "F_y_1", "F_x_2", "F_y_2"}


@seeds
def test_gyroscope_in_gimbals(seed: int) -> None:
    state = draw(GIMBALS, seed)
    expected = extras.gimballed_gyroscope(**state)
    found = numeric(declared.gimballed_gyroscope).at(**state, mu=0.0)
    agree(found, expected, ["theta_ddot", "phi_ddot", "omega_3_dot"])
    agree(found, expected, ["F_x", "F_y", "F_z"])
    agree(found, expected, ENERGIES)


@seeds
def test_rolling_ellipsoid(seed: int) -> None:
    state = draw(ELLIPSOID, seed)
    expected = extras.rolling_ellipsoid(**state)
    found = numeric(declared.rolling_ellipsoid).at(**state)
    agree(found, expected, ["omega_1_dot", "omega_2_dot", "omega_3_dot"])
    agree(found, expected, ["F_x", "F_y", "F_z"])
    agree(found, expected, ENERGIES)

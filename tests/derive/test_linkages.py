"""Several bodies, loops and an ellipsoid against the numeric oracles, reactions included."""

from __future__ import annotations

from math import cos, sin

import numpy as np
import pytest

from derive import linkages as declared
from derive.numeric import agree, motion_at, state_of, values
from oracles import extras
from oracles import linkages as oracle
from oracles.draws import ELLIPSOID, FOUR_BAR, GIMBALS, PENDULUM, WHEELS, draw

seeds = pytest.mark.parametrize("seed", range(6))


@seeds
def test_double_pendulum(seed):
    numbers = draw(PENDULUM, seed)
    found = motion_at(declared.double_pendulum(), numbers)
    names = "theta_1_ddot theta_2_ddot F_x F_y F_z Fjoint_x Fjoint_y Fjoint_z"
    agree(found, oracle.double_pendulum(**numbers), names)


@seeds
@pytest.mark.parametrize("branch", [1.0, -1.0])
def test_four_bar_linkage(seed, branch):
    numbers = draw(FOUR_BAR, seed, branch=branch)
    expected = oracle.four_bar(**numbers)
    linkage = declared.four_bar()
    found = motion_at(linkage, numbers | expected)
    agree(found, expected, "theta_1_ddot F_x F_z Fprime_x Fprime_z")
    gaps = values(linkage.closures, state_of(linkage, numbers | expected))
    assert np.abs(gaps).max() < 1e-14


@seeds
def test_two_wheels_on_an_axle(seed):
    numbers = draw(WHEELS, seed)
    expected = extras.wheels_on_axle(**numbers)
    axle = declared.wheels_on_axle()
    found = motion_at(axle, numbers | {"psi_1": 0.3, "psi_2": -0.2})
    forward = (sin(numbers["phi"]), -cos(numbers["phi"]))
    for wheel in ("1", "2"):
        found[f"N_{wheel}"] = found[f"F_z_{wheel}"]
        sideways = (found[f"F_x_{wheel}"], found[f"F_y_{wheel}"])
        found[f"P_{wheel}"] = float(np.dot(sideways, forward))
    agree(found, expected, "psi_1_ddot psi_2_ddot N_1 N_2 P_1 P_2")
    assert {"F_x_1", "F_x_2"} <= set(axle.undetermined)
    assert not {"F_z_1", "F_z_2"} & set(axle.undetermined)


@seeds
def test_gyroscope_in_gimbals(seed):
    numbers = draw(GIMBALS, seed)
    weightless = numbers | {"mu": 0.0}
    found = motion_at(declared.gimballed_gyroscope(), weightless)
    expected = extras.gimballed_gyroscope(**numbers)
    agree(found, expected, "theta_ddot phi_ddot omega_3_dot F_x F_y F_z")


@seeds
def test_rolling_ellipsoid(seed):
    numbers = draw(ELLIPSOID, seed)
    found = motion_at(declared.rolling_ellipsoid(), numbers)
    expected = extras.rolling_ellipsoid(**numbers)
    agree(found, expected, "omega_1_dot omega_2_dot omega_3_dot F_x F_y F_z")

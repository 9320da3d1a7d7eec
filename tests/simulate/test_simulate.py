"""Declared systems, derived and simulated."""

import numpy as np
import pytest

from polhode.algebra import coordinates, sin, symbols, time
from polhode.base import DeclarationError, UnitError
from polhode.catalogue._ball_on_paper import BALL_ON_PAPER
from polhode.catalogue._disks import ROLLING_DISK
from polhode.model import Body, Frame, Pivot, System
from polhode.simulate import simulate

COIN = {"m": "0.2 kg", "a": "30 mm", "g": "9.81 m/s^2"}


def test_a_rolling_disk_obeys_newton_and_keeps_its_energy(integrator):
    start = {"theta": "80 deg", "phi_dot": "1 rad/s", "omega_3": "40 rad/s"}
    run = simulate(ROLLING_DISK.build(), COIN, start, "4 s")
    for force, rate in (("F_x", "v_x_dot"), ("F_y", "v_y_dot")):
        assert run[force] == pytest.approx(0.2 * run[rate], abs=1e-11)
    step = 1e-4
    ahead, behind = (run.evaluate("v_x", run.t[5:-5] + s * step) for s in (1, -1))
    assert run["F_x"][5:-5] == pytest.approx(0.2 * (ahead - behind) / (2 * step), abs=1e-4)
    assert run.drift.energy < 1e-13
    assert set(run.assumed) == {"phi", "psi", "x", "y", "theta_dot"}


def test_a_disk_set_up_by_its_path_has_its_spin_worked_out():
    run = simulate(ROLLING_DISK.build(), COIN, {"theta": "90 deg", "v_x": "1.2 m/s"}, 1)
    assert abs(run.final["omega_3"]) == pytest.approx(1.2 / 0.03)
    assert run["x"] == pytest.approx(1.2 * run.t, abs=1e-12)


def test_the_ball_on_moved_paper_ends_as_it_began(integrator):
    away = {"X": sin(time * 3.141592653589793) ** 3 / 10, "Y": sin(time) * 0, "chi": time * 0}
    ball = {"m": "50 g", "r": "20 mm", "k": "2/5", "g": 9.81}
    run = simulate(BALL_ON_PAPER.build(), ball, {"v_x": "0.2 m/s"}, 2, forcing=away)
    assert run.final["v_x"] == pytest.approx(0.2, abs=1e-12)
    assert np.ptp(run["v_x"]) > 0.05
    assert run.drift.energy < 1e-13


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ({"I_1": 1, "I_2": 1, "I_3": 3, "M": 1}, "triangle inequality"),
        ({"I_1": 1, "I_2": 1, "I_3": -1, "M": 1}, "I_3|negative"),
        ({"I_1": 1, "I_2": 2, "I_3": 2, "M": -1}, "mass of body"),
    ],
)
def test_numbers_that_no_body_can_have_are_refused(numbers, message):
    mass, *moments = symbols("M I_1 I_2 I_3")
    phi, theta, psi = coordinates("phi theta psi")
    axes = Frame("lab").rotated(phi, "z").rotated(theta, "x").rotated(psi, "z")
    racquet = Body("racquet", mass=mass, inertia=moments, axes=axes)
    with pytest.raises(DeclarationError, match=message):
        simulate(System(racquet, Pivot(racquet)), numbers, {"theta": 1}, 1)


def test_a_rate_has_the_dimension_of_its_order():
    disk = ROLLING_DISK.build()
    numbers = {"m": 0.2, "a": 0.03, "g": 9.81}
    with pytest.raises(UnitError, match="phi_dot"):
        simulate(disk, numbers, {"phi_dot": "3 kg"}, 1)
    run = simulate(disk, numbers, {"theta": "80 deg", "phi_dot": "60 rpm", "omega_3": 40}, 0.1)
    assert run["phi_dot"][0] == pytest.approx(2 * 3.141592653589793)

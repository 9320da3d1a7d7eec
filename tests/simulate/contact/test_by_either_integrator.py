"""Motions with friction by either integrator."""

from math import cos, hypot, sin, sqrt

import numpy as np
import pytest

import polhode as ph
from simulate.contact import balls, disks

DURATION, LATE = 2.8, 2.7
CLOSE = 1e-13


@pytest.fixture(autouse=True)
def by_either(integrator):
    """Each test is of both."""


def kinds(run):
    return [event.kind for event in run.events]


@pytest.mark.parametrize("across", [0.05, 0.5, 2.0, -1.0])
def test_a_ball_slips_across_a_slope_along_a_curve_and_rolls(across):
    """With friction's rate α and gravity's β, α |s| + β s·e falls at the rate α² − β²."""
    numbers = {"m": 0.05, "a": 0.02, "k": 0.4, "g": 9.81, "mu": 0.3, "alpha": 0.3}
    start = {"v_x": 0.7, "v_y": across, "omega_x": 0.0, "omega_y": 0.0}
    run = ph.simulate(balls.on_slope(), numbers, start, 1.5, samples=2)
    friction, weight = 3.5 * 0.3 * 9.81 * cos(0.3), 9.81 * sin(0.3)
    ends = (friction * hypot(0.7, across) - weight * across) / (friction**2 - weight**2)
    assert kinds(run) == ["start", "sticks", "end"]
    assert abs(run.events[1].time - ends) < CLOSE


def test_a_disk_sticks_where_the_integrator_has_no_shorter_step():
    """Late slips are short compared with the time, to whose rounding their last steps shrink."""
    numbers, start = disks.numbers(0.1), {"theta": 1.4, "phi_dot": 1.0, "omega_3": 30.0}
    run = ph.simulate(disks.with_friction(), numbers, start, DURATION, samples=2)
    assert kinds(run) == ["start", "sticks", "slips", "end"]
    # Begun anew shortly before, the same motion has more digits in its time.
    names = ("theta", "phi", "phi_dot", "theta_dot", "omega_3", "v_x", "v_y")
    begin = {name: run.evaluate(name, LATE) for name in names}
    anew = ph.simulate(disks.with_friction(), numbers, begin, DURATION - LATE, samples=2)
    assert kinds(anew) == kinds(run)
    for one, other in zip(run.events[1:], anew.events[1:], strict=True):
        assert abs(one.time - LATE - other.time) < 1e-9
    for name in names[:1] + names[2:]:
        assert abs(run.final[name] - anew.final[name]) < 1e-7
    assert run.drift.energy < CLOSE


def test_a_ball_that_bounces_rolls_in_the_end():
    numbers = {"m": 0.05, "a": 0.02, "k": 0.4, "g": 9.81, "mu": 0.3, "mu_s": 0.3, "e": 0.5}
    start = {"z": 0.02 + 0.05, "v_x": 1.0, "omega_y": 0.0}
    run = ph.simulate(balls.on_table(), numbers, start, 1.0, samples=2)
    falls = sqrt(2 * 0.05 / 9.81)
    landed = [event.time for event in run.events if event.kind == "bounces"]
    assert np.allclose(landed[:3], [falls, 2 * falls, 2.5 * falls], atol=CLOSE)
    assert run.mode == "rolling"
    assert abs(run.final["v_x"] - 5 / 7) < CLOSE


def test_a_disk_thrown_upright_without_spin_rolls_in_the_end():
    """Friction slows it and spins it up: it keeps 2/3 of its speed."""
    numbers = {"m": 0.2, "a": 0.03, "g": 9.81, "mu": 0.1, "mu_s": 0.1, "e": 0}
    start = {"theta": np.pi / 2, "v_x": 0.6, "omega_3": 0.0}
    run = ph.simulate(disks.with_friction(), numbers, start, 0.5, samples=2)
    assert kinds(run) == ["start", "sticks", "end"]
    assert abs(run.events[1].time - 0.6 / (3 * 0.1 * 9.81)) < CLOSE
    assert abs(run.final["v_x"] - 0.4) < CLOSE

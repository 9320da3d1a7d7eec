"""Painlevé's rod: friction so strong that rigid bodies have no, or no unique, forces.

A rod of half-length L at the angle θ to a rough table, sliding ahead of its tip: the friction
turns it into the table, and the normal force per acceleration away from it vanishes where
1 + 3 cos θ (cos θ − μ sin θ) = 0, at μ = 4/3 at least (Painlevé 1895; Génot and Brogliato 1999).
"""

from functools import cache
from math import cos, sin

import numpy as np
import pytest

import polhode as ph
from polhode.derive import Automaton, automaton
from polhode.simulate.contact._impact import Roughness, coulomb_impact

LENGTH = 0.5


@cache
def rod() -> Automaton:
    m, length, thick, g = ph.symbols("m L r g", positive=True)
    mu, e = ph.symbols("mu e")
    lab = ph.Frame("lab")
    axes = lab.rotated(ph.coordinate("theta"), "y", labels="1 2 3", name="rod")
    across = m * length**2 / 3
    shape = ph.Ellipsoidal((length, thick, thick))
    body = ph.Body("rod", mass=m, inertia=(across, across, across), axes=axes, surface=shape)
    touch = ph.Coulomb(body, on=ph.Plane(lab), mu=mu, restitution=e, name="floor")
    return automaton(ph.System(touch, ph.Hinge(body, axis="2"), ph.Gravity(g)))


def run(
    mu: float, duration: float = 1.0, e: float = 0.0, thick: float = 1e-6, **start: float
) -> ph.Trajectory:
    numbers = {"m": 1.0, "L": LENGTH, "r": thick, "g": 9.81, "mu": mu, "e": e}
    return ph.simulate(rod(), numbers, start, duration, samples=2)


def reserve(mu: float, theta: float) -> float:
    return 1 + 3 * cos(theta) * (cos(theta) - mu * sin(theta))


@pytest.mark.parametrize("theta", [0.9, 1.1, 1.25])
@pytest.mark.parametrize("mu", [1.3, 1.4, 1.7, 3.0])
def test_a_start_in_the_region_is_refused(mu: float, theta: float) -> None:
    start = {"theta": theta, "v_x": 1.0, "theta_dot": 0.0}
    if reserve(mu, theta) > 0:
        assert run(mu, 1e-3, **start).segments[0].mode == "sliding"
        return
    with pytest.raises(ph.NumericError, match=r"sliding at floor jams at t = 0 s \(Painlev"):
        run(mu, 1e-3, **start)


def test_sliding_the_other_way_there_is_none() -> None:
    assert run(3.0, 1e-2, theta=1.1, v_x=-5.0, theta_dot=0.0).segments[0].mode == "sliding"


@pytest.mark.parametrize(("theta", "rate"), [(0.6, 1.0), (0.6, 3.0), (0.7, 0.5)])
def test_a_motion_into_it_is_named_with_its_instant(theta: float, rate: float) -> None:
    """The normal force grows beyond all bounds where the reserve vanishes, and nowhere before."""
    start = {"theta": theta, "theta_dot": rate, "v_x": 10.0}
    with pytest.raises(ph.NumericError, match=r"jams at t = [\d.]+ s \(Painlev") as caught:
        run(1.7, **start)
    instant = float(str(caught.value).split("t = ")[1].split(" s")[0])
    before = run(1.7, instant * (1 - 1e-7), **start)
    assert before.drift.energy < 1e-12
    assert 0 < reserve(1.7, before.final["theta"]) < 1e-2
    assert before.final["F_z"] > 50 * 9.81


def test_slip_that_could_begin_both_ways_is_refused() -> None:
    """Released at rest it rolls over its tip until friction gives way."""
    with pytest.raises(ph.NumericError, match=r"slip can begin at floor in several directions"):
        run(3.0, theta=1.3, thick=0.01)


def test_below_the_least_friction_of_the_paradox_it_is_followed() -> None:
    found = run(1.3, 0.5, thick=0.01, theta=-1.1, v_x=1.0, theta_dot=0.0)
    assert "sticks" in [event.kind for event in found.events]
    assert found.drift.energy < 1e-13


@pytest.mark.parametrize("mu", [1.3, 1.7, 3.0])
@pytest.mark.parametrize("e", [0.0, 0.5])
def test_shocks_go_on_until_the_slip_is_over(mu: float, e: float) -> None:
    """A rod that lands has a unique motion all the same: friction stops its tip first (Routh)."""
    found = run(mu, 0.25, e, theta=1.1, z=0.6, v_x=1.0)
    landing = found.events[1]
    assert landing.kind == ("bounces" if e else "touches down")
    assert found.drift.energy < 1e-12


@pytest.mark.parametrize("size", [1e-12, 1e-6, 1.0, 1e6])
def test_shocks_of_any_strength_are_alike(size: float) -> None:
    theta = 1.1
    arm = 3 / LENGTH**2 * np.outer(*[np.array([LENGTH * sin(theta), 0.0, LENGTH * cos(theta)])] * 2)
    felt = np.eye(3) + arm
    velocity = np.array([0.4, 0.0, -1.0])
    rough = Roughness(0.3, 0.3, 0.5)
    unit, scaled = (coulomb_impact(felt, s * velocity, rough) for s in (1.0, size))
    assert np.abs(scaled.velocity / size - unit.velocity).max() < 1e-12

"""A ball on a floor, tied by a rope to a point above it: it goes round in a circle.

The rope leaves one of v_x and v_y independent: v_y where x is not zero, v_x where y is not.
"""

from itertools import pairwise
from math import cos, sin, sqrt

import numpy as np
import pytest
from mpmath import mp
from scipy.integrate import solve_ivp

import polhode as ph

LAB = ph.Frame("lab")
m, R, h, g, mu = ph.symbols("m R h g mu", positive=True)
BALL = ph.sphere("ball", mass=m, radius=R, axes=LAB)
NUMBERS = {m: 1, R: 0.1, h: 0.5, g: 9.81}
RISE = 0.4  # of the rope, m
LENGTH = sqrt(1 + RISE**2)  # tied to the centre at a distance of 1 m from the axis


def tethered(kind, **law):
    rope = ph.Rope([BALL.point(), LAB["z"] * h])
    return ph.System(kind(BALL, on=ph.Plane(LAB), **law), rope, ph.Gravity(g))


@pytest.mark.parametrize("angle", [0.0, np.pi / 2, 2.0])
@pytest.mark.parametrize("kind", [ph.Smooth, ph.Rolling])
def test_goes_round_uniformly(kind, angle):
    """Also from places with x = 0 or y = 0. Tension, and with it the friction of rolling."""
    x, y = round(cos(angle), 15), round(sin(angle), 15)
    run = ph.simulate(tethered(kind), NUMBERS, {"x": x, "y": y, "v_x": -y, "v_y": x}, 4)
    after = angle + 4
    assert [run.final["x"], run.final["y"]] == pytest.approx([cos(after), sin(after)], abs=1e-11)
    # rolling, the ball turns about a horizontal axis that turns with it: 7/5 of the central force
    central = 1.4 if kind is ph.Rolling else 1.0
    assert run.final["S"] == pytest.approx(central * LENGTH, rel=1e-11)
    assert run.final["F_z"] == pytest.approx(9.81 - central * RISE, rel=1e-11)
    assert run.drift.energy < 1e-13


def by_newton(start, duration):
    """The motion with slip, and tension and normal force at its end, by Newton's and Euler's laws.

    States: x, y, v_x, v_y, ω_x, ω_y. The friction force f is −0.02 N along the slip v + ω × (−R ẑ).
    """

    def laws(state):
        place, velocity, turning = np.split(state, 3)
        slip = velocity + 0.1 * np.array([-turning[1], turning[0]])
        along = slip / np.linalg.norm(slip)
        # N + S RISE/L = m g; with r · a = −v², f and the pull of the rope give S
        leaning = 0.02 * (along @ place)
        tension = velocity @ velocity - leaning * 9.81
        tension /= (1 - leaning * RISE) / LENGTH
        normal = 9.81 - tension * RISE / LENGTH
        friction = -0.02 * normal * along
        spinning = 0.1 * np.array([friction[1], -friction[0]]) / (0.4 * 0.1**2)
        rates = np.concatenate([velocity, friction - tension * place / LENGTH, spinning])
        return rates, (tension, normal)

    found = solve_ivp(
        lambda t, state: laws(state)[0],
        (0, duration),
        start,
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
    ).y[:, -1]
    return found, laws(found)[1]


NAMES = ("x", "y", "v_x", "v_y", "omega_x", "omega_y")
SLIPPING = {"x": 1, "y": 0, "v_y": 3, "omega_x": 5, "omega_y": 2}


@pytest.mark.parametrize("duration", [0.45, 0.6, 1.2, 3.0])
def test_slips_through_the_places_where_other_speeds_are_independent(duration):
    run = ph.simulate(tethered(ph.Coulomb, mu=0.02), NUMBERS, SLIPPING, duration)
    state, (tension, normal) = by_newton([1, 0, 0, 3, 5, 2], duration)
    assert [run.final[name] for name in NAMES] == pytest.approx(state, abs=1e-10)
    assert [run.final["S"], run.final["F_z"]] == pytest.approx([tension, normal], abs=1e-9)
    assert run.drift.energy < 1e-13
    speeds = [segment.dynamics.equations.speeds for segment in run.segments]
    assert all(before != after for before, after in pairwise(speeds))


def test_sticks_and_is_saved(tmp_path):
    """Until it rolls; the file keeps the independent speeds of every segment."""
    run = ph.simulate(tethered(ph.Coulomb, mu=0.3), NUMBERS, SLIPPING, 3)
    assert [event.kind for event in run.events] == ["start", "sticks", "end"]
    assert len(run.segments) > 2
    run.save(tmp_path / "run.polhode")
    again = ph.load(tmp_path / "run.polhode")
    for name in ("x", "v_x", "S", "F_z"):
        read, kept = (motion.evaluate(name, run.t) for motion in (again, run))
        assert read == pytest.approx(kept, abs=1e-11)
    assert again.drift.energy < 1e-13


@pytest.mark.parametrize("kind", [ph.Smooth, ph.Rolling])
def test_goes_round_in_more_digits(kind):
    numbers = {m: 1, R: "0.1", h: "0.5", g: "9.81"}
    start = {"x": 1, "y": 0, "v_x": 0, "v_y": 1}
    run = ph.simulate(tethered(kind), numbers, start, 4, precision=40, samples=2)
    assert len(run.segments) > 2
    with mp.workdps(50):
        assert abs(run.final["x"] - mp.cos(4)) < mp.mpf(10) ** -38
        assert abs(run.final["y"] - mp.sin(4)) < mp.mpf(10) ** -38


def test_slips_in_more_digits_as_in_doubles():
    start = {"x": 1, "y": 0, "v_x": 0, "v_y": 1}
    numbers = NUMBERS | {mu: 0.02}
    rough, fine = (
        ph.simulate(tethered(ph.Coulomb, mu=mu), numbers, start, 3, precision=p, samples=2)
        for p in (None, "quadruple")
    )
    assert len(fine.segments) == len(rough.segments) > 1
    assert fine.drift.energy < 1e-27
    for name in ("x", "y", "v_x", "omega_x", "S"):
        assert float(fine.final[name]) == pytest.approx(rough.final[name], abs=1e-12)

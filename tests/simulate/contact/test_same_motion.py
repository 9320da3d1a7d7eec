"""A declared body in contact, seen in other ways: its motion must be the same.

The world is turned, the origin is moved, the units are changed, the floor moves steadily with the
observer, a slope is a level floor with the weight aside, and time runs back. The body is a ball
whose centre of mass is off its centre: it bounces, slides, rolls and falls over.
"""

from dataclasses import dataclass, replace
from functools import cache
from math import cos, sin, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polhode as ph
from polhode.derive import automaton

LAB = ph.Frame("lab")
UNITS = {"m": (1, 0, 0), "r": (0, 1, 0), "h": (0, 1, 0), "A": (1, 2, 0), "C": (1, 2, 0)}
UNITS |= {"g": (0, 1, -2), "mu": (0, 0, 0), "e": (0, 0, 0)}
BODY = {"m": 0.4, "r": 0.05, "h": 0.012, "A": 3e-4, "C": 4e-4, "g": 9.81}
DURATION = 0.25


@cache
def loaded_ball(kind="level"):
    """On a level floor with or without friction, on one that moves, on a slope, or beside one."""
    m, r, h, A, C, g = ph.symbols("m r h A C g", positive=True)
    mu, e, lean, pace = ph.symbols("mu e lean pace")
    plane, up = ph.Plane(LAB), LAB["z"]
    if kind == "moving":
        plane = ph.Sheet(LAB, motion=(pace * ph.time, 0))
    elif kind == "slope":
        plane = ph.Plane(LAB, tilt=lean)
    elif kind == "weight aside":
        up = up * ph.cos(lean) + LAB["y"] * ph.sin(lean)
    axes = plane.axes.rotated(ph.coordinate("phi"), "z").rotated(ph.coordinate("theta"), "x")
    shape = ph.Round(r, "z", h)
    ball = ph.Body("ball", mass=m, inertia=(A, A, C), axes=axes, spin_about="z", surface=shape)
    touch = ph.Coulomb(ball, on=plane, mu=mu, restitution=e)
    if kind == "smooth":
        touch = ph.Smooth(ball, on=plane, restitution=e)
    return automaton(ph.System(touch, ph.Gravity(g, up=up)))


@dataclass(frozen=True)
class Throw:
    """A start: angles and their rates, place and velocity, and the numbers of the contact."""

    theta: float
    phi: float
    rates: tuple[float, float, float]
    place: tuple[float, float, float]
    velocity: tuple[float, float, float]
    mu: float
    e: float

    @property
    def numbers(self):
        return BODY | {"mu": self.mu, "e": self.e}

    @property
    def start(self):
        values = {"theta": self.theta, "phi": self.phi}
        values |= zip(("phi_dot", "theta_dot", "omega_z"), self.rates, strict=True)
        values |= zip("xyz", self.place, strict=True)
        return values | dict(zip(("v_x", "v_y", "v_z"), self.velocity, strict=True))


def thrown(theta, spins, velocity, drop, mu, e):
    height = BODY["r"] + BODY["h"] + drop
    return Throw(theta, 0.4, spins, (0.1, -0.2, height), velocity, mu, e)


def reals(low, high):
    return st.floats(low, high, allow_nan=False).map(lambda x: round(x, 3))


throws = st.builds(
    thrown,
    reals(0.5, 2.6),
    st.tuples(reals(-6, 6), reals(-6, 6), reals(-30, 30)),
    st.tuples(reals(-1, 1), reals(-1, 1), reals(-1.5, 0)),
    reals(0, 0.04),
    reals(0.05, 0.5),
    reals(0, 0.8),
)
few = settings(max_examples=2)


def followed(system, numbers, start, duration=DURATION):
    """The motion; None where rigid bodies with dry friction have no unique one."""
    try:
        return ph.simulate(system, numbers, start, duration, samples=2)
    except ph.NumericError:
        return None


def same(one, other, expected, scale=1.0, tolerance=1e-8):
    """Whether the events are the same, at times in proportion, and the final values as expected."""
    if one is None or other is None:
        assert one is other
        return
    assert [event.kind for event in one.events] == [event.kind for event in other.events]
    times = [float(event.time) * scale for event in one.events]
    assert [float(event.time) for event in other.events] == pytest.approx(times, abs=1e-8 * scale)
    for name, value in expected(one.final).items():
        assert other.final[name] == pytest.approx(value, rel=tolerance, abs=tolerance)


NAMES = ("theta", "phi", "x", "y", "v_x", "v_y", "theta_dot", "phi_dot")


@few
@given(throws, reals(-3, 3), reals(-50, 50))
def test_turned_about_the_vertical_and_moved(throw, angle, shift):
    def turned(x, y):
        return x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)

    x, y, z = throw.place
    place = (*np.add(turned(x, y), (shift, -shift)).tolist(), z)
    velocity = (*turned(*throw.velocity[:2]), throw.velocity[2])
    other = replace(throw, phi=throw.phi + angle, place=place, velocity=velocity)

    def expected(final):
        x, y = turned(final["x"], final["y"])
        v_x, v_y = turned(final["v_x"], final["v_y"])
        turns = {"theta": final["theta"], "phi": final["phi"] + angle, "omega_z": final["omega_z"]}
        return turns | {"x": x + shift, "y": y - shift, "v_x": v_x, "v_y": v_y}

    system = loaded_ball()
    one, again = (followed(system, t.numbers, t.start) for t in (throw, other))
    same(one, again, expected)


@few
@given(throws, st.sampled_from([(1e3, 1.0, 1.0), (1.0, 1e-3, 1.0), (0.25, 4.0, 1e3)]))
def test_in_other_units(throw, sizes):
    def written(value, powers):
        return value * float(np.prod([s**p for s, p in zip(sizes, powers, strict=True)]))

    numbers = {name: written(v, UNITS[name]) for name, v in throw.numbers.items()}
    rate, speed = (0, 0, -1), (0, 1, -1)
    other = replace(
        throw,
        rates=tuple(written(w, rate) for w in throw.rates),
        place=tuple(written(x, (0, 1, 0)) for x in throw.place),
        velocity=tuple(written(v, speed) for v in throw.velocity),
    )
    one = followed(loaded_ball(), throw.numbers, throw.start)
    again = followed(loaded_ball(), numbers, other.start, DURATION * sizes[2])

    def expected(final):
        turns = {n: final[n] for n in ("theta", "phi")}
        places = {n: written(final[n], (0, 1, 0)) for n in ("x", "y")}
        return turns | places | {"v_x": written(final["v_x"], speed)}

    same(one, again, expected, sizes[2])


@few
@given(throws, reals(-5, 5))
def test_on_a_floor_that_moves_with_the_observer(throw, pace):
    along, *rest = throw.velocity
    moving = replace(throw, velocity=(along + pace, *rest))
    one = followed(loaded_ball(), throw.numbers, throw.start)
    numbers = throw.numbers | {"pace": pace}
    other = followed(loaded_ball("moving"), numbers, moving.start)

    def expected(final):
        shifted = {"x": final["x"] + pace * DURATION, "v_x": final["v_x"] + pace}
        return {n: final[n] for n in NAMES} | shifted

    same(one, other, expected)


@few
@given(throws, reals(0.1, 0.8))
def test_a_slope_is_a_level_floor_with_the_weight_aside(throw, lean):
    numbers = throw.numbers | {"lean": lean}
    runs = (
        followed(s, numbers, throw.start)
        for s in (loaded_ball("slope"), loaded_ball("weight aside"))
    )
    same(*runs, lambda final: {n: final[n] for n in NAMES})


@few
@given(throws)
def test_run_back_in_time(throw):
    """Without friction and with full restitution."""
    system, numbers = loaded_ball("smooth"), throw.numbers | {"e": 1}
    del numbers["mu"]
    there = ph.simulate(system, numbers, throw.start, DURATION, samples=2)
    speeds = ("phi_dot", "theta_dot", "omega_z", "v_x", "v_y", "v_z")
    turned = {n: -there.final[n] for n in speeds}
    turned |= {n: there.final[n] for n in ("theta", "phi", "x", "y", "z")}
    back = ph.simulate(system, numbers, turned, DURATION, samples=2)
    start = throw.start
    assert len(there.events) == len(back.events)
    for name in ("theta", "phi", "x", "y", "z"):
        assert back.final[name] == pytest.approx(start[name], abs=1e-9)
    for name in speeds:
        assert -back.final[name] == pytest.approx(start[name], abs=1e-8 * sqrt(1e3))

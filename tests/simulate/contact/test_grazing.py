"""Contacts that hardly touch: starts at height zero, closest approaches of zero."""

from functools import cache
from math import acos, atan2, cos, hypot, sin, sqrt

import numpy as np
import pytest

import polhode as ph
from polhode.derive import Automaton, automaton
from simulate.contact.balls import on_table

A, G = 0.02, 9.81
NUMBERS = {"m": 0.05, "a": A, "k": 0.4, "g": G, "mu": 0.1, "mu_s": 0.1, "e": 0.5}
CLOSEST, WHEN = 1.0, 0.5  # m/s² and s


def start(**given: float) -> ph.Trajectory:
    return ph.simulate(on_table(), NUMBERS, given, 0.5, samples=2)


@pytest.mark.parametrize("above", [0.0, 1e-17, 1e-16])
def test_a_height_of_nothing_is_contact(above: float) -> None:
    run = start(z=A + above, v_z=0.0)
    assert [event.kind for event in run.events] == ["start", "end"]
    assert run.mode == "rolling"


def test_a_height_of_nothing_with_slip_slides() -> None:
    run = start(z=A, v_z=0.0, v_x=1.0, omega_y=0.0)
    assert [event.after for event in run.events[:2]] == ["sliding", "rolling"]


@pytest.mark.parametrize("rise", [1.0, 1e-9, 1e-15])
def test_thrown_up_from_the_support_it_flies_the_whole_arc(rise: float) -> None:
    run = start(z=A, v_z=rise)
    first = run.events[1]
    assert first.kind == "bounces"
    assert abs(first.time - 2 * rise / G) < 1e-14 * first.time


def test_thrown_onto_the_support_it_bounces_at_once() -> None:
    run = start(z=A, v_z=-1.0)
    assert (run.events[1].kind, run.events[1].time) == ("bounces", 0.0)
    assert abs(run.events[2].time - 1.0 / G) < 1e-14


@cache
def beside_a_plane_that_tilts() -> Automaton:
    m, a, k, g = ph.symbols("m a k g", positive=True)
    mu, e = ph.symbols("mu e")
    (beta,) = ph.functions("beta")
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=a, inertia=k * m * a**2, axes=lab)
    touch = ph.Coulomb(ball, on=ph.Plane(lab, tilt=beta), mu=mu, restitution=e)
    return automaton(ph.System(touch, ph.Gravity(g, up=lab["z"])))


def grazing(least: float, restitution: float) -> ph.Trajectory:
    """A ball in flight beside a plane that is tilted up to a distance of least + c (t − t₁)²."""
    height, rise, aside = 1.0, 5.0, 0.4

    def tilt(t: float) -> float:
        above = height + rise * t - G * t * t / 2
        gap = least + CLOSEST * (t - WHEN) ** 2
        return acos((A + gap) / hypot(above, aside)) - atan2(aside, above)

    far = hypot(height, aside)
    q = (A + least + CLOSEST * WHEN**2) / far
    q_dot = -2 * CLOSEST * WHEN / far - q * height * rise / far**2
    turning = -q_dot / sqrt(1 - q * q) + aside * rise / far**2
    c, s = cos(tilt(0.0)), sin(tilt(0.0))
    y, z = aside * c + height * s, height * c - aside * s
    begin = {"y": y, "z": z, "v_y": rise * s + turning * z, "v_z": rise * c - turning * y}
    numbers = {"m": 0.05, "a": A, "k": 0.4, "g": G, "mu": 0.1, "e": restitution}
    return ph.simulate(
        beside_a_plane_that_tilts(), numbers, begin, 1.0, forcing={"beta": tilt}, samples=2
    )


@pytest.mark.parametrize("restitution", [0.0, 0.5])
@pytest.mark.parametrize("least", [1e-3, 1e-12, 1e-15, 0.0, -1e-15, -1e-12, -1e-9])
def test_it_passes_closely_or_is_touched_once(least: float, restitution: float) -> None:
    run = grazing(least, restitution)
    touched = run.events[1:-1]
    assert len(touched) <= 1
    assert run.mode == "flight"
    assert run.drift.energy < 1e-13
    if abs(least) > 1e-14:
        assert bool(touched) == (least < 0)
    for event in touched:
        early = np.sqrt(max(-least, 0.0) / CLOSEST)
        assert abs(event.time - (WHEN - early)) < 1e-6

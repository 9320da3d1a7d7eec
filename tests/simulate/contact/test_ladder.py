"""A rod that touches with its ends: ladders and falling rods against their closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

import polhode as ph

M, L, G, MU = ph.symbols("m l g mu")
ALPHA = ph.coordinate("alpha")
LAB = ph.Frame("N")
AXES = LAB.rotated(ALPHA, "y")  # the rod is along x, with its foot at +l/2, at α below the level
ROD = ph.rod("rod", mass=M, length=L, axes=AXES)
FOOT, HEAD = AXES["x"] * (L / 2), AXES["x"] * (-L / 2)
NUMBERS = {M: 1.0, L: 2.0, G: 9.81}


def ladder(floor) -> ph.System:
    wall = ph.Smooth(ROD, on=ph.Plane(LAB, normal="x"), at=HEAD, name="wall", force="W")
    return ph.System(ROD, floor, wall, ph.Hinge(ROD, axis="y"), ph.Gravity(G))


def rough(mu=MU):
    return ph.Coulomb(ROD, on=ph.Plane(LAB), at=FOOT, name="floor", force="N", mu=mu)


@pytest.mark.parametrize("start", [0.6, 1.0, 1.4])
def test_a_smooth_ladder_leaves_the_wall_at_two_thirds_of_its_height(start):
    floor = ph.Smooth(ROD, on=ph.Plane(LAB), at=FOOT, name="floor", force="N")
    run = ph.simulate(ladder(floor), NUMBERS, {ALPHA: start}, "3 s")
    leaves = next(event.time for event in run.events if event.kind == "lifts off")
    height = np.sin(run.evaluate(ALPHA, leaves))
    assert height == pytest.approx(2 / 3 * np.sin(start), rel=1e-13)
    assert run.drift.energy < 1e-13


@pytest.mark.parametrize(("share", "holds"), [(0.999, False), (1.001, True)])
def test_a_ladder_on_a_rough_floor_stands_up_to_its_angle(share, holds):
    """μ ≥ cot(α)/2 at the floor, with a smooth wall."""
    numbers = {**NUMBERS, MU: share / (2 * np.tan(1.0))}
    run = ph.simulate(ladder(rough()), numbers, {ALPHA: 1.0}, "1 s")
    assert (run.mode == "floor rolling, wall frictionless") == holds
    assert (run.evaluate(ALPHA, 1.0) == 1.0) == holds


@pytest.mark.parametrize("mu", [0.2, 0.36, 0.5])
def test_a_falling_rod_slips_where_its_foot_needs_more_friction(mu):
    """F/N of a rod that turns about its foot from rest at θ₀, by energy and Newton's law."""
    lean = 0.05
    falling = ph.System(ROD, rough(), ph.Hinge(ROD, axis="y"), ph.Gravity(G))
    run = ph.simulate(falling, {**NUMBERS, MU: mu}, {ALPHA: np.pi / 2 - lean}, "5 s")
    slips = next(event.time for event in run.events if event.kind == "slips")

    def reserve(theta: float) -> float:
        c, s = np.cos(theta), np.sin(theta)
        square, change = 3 * (np.cos(lean) - c), 1.5 * s  # ω² l/g and its rate of change l/g
        across = 0.5 * (change * c - square * s)
        pressed = 1 - 0.5 * (change * s + square * c)
        return mu * pressed - abs(across)

    grid = np.linspace(lean, 1.2, 2000)
    first = next(k for k, theta in enumerate(grid) if reserve(theta) < 0)
    wanted = brentq(reserve, grid[first - 1], grid[first], xtol=1e-15)
    assert np.pi / 2 - run.evaluate(ALPHA, slips) == pytest.approx(wanted, rel=1e-11)


def test_what_touches_is_a_point_of_the_body():
    turning = ph.disk("disk", mass=M, radius=L, axes=LAB)
    with pytest.raises(ph.DeclarationError, match="the point of contact 'contact'"):
        ph.Smooth(turning, on=ph.Plane(LAB), at=LAB["x"] * L)
    bare = ph.Body("plate", mass=M, inertia=(L, L, L), axes=LAB)
    with pytest.raises(ph.DeclarationError, match="say which point touches"):
        ph.Smooth(bare, on=ph.Plane(LAB))

"""Where contacts open along a level of the energy: closed forms, and simulations."""

from __future__ import annotations

import numpy as np
import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE

M, A, R, G, I, L, U0, W = ph.symbols("m a R g I l u_0 w", positive=True)
LAB = ph.Frame("N")
U = ph.coordinate("u")


def on(support, contact=ph.Rolling, inertia=None) -> ph.Equations:
    ball = ph.sphere("ball", mass=M, radius=A, axes=support.axes, inertia=inertia)
    return ph.derive(ph.System(contact(ball, on=support), ph.Gravity(G)))


def place(equations, start):
    (opening,) = ph.leaves(equations, start)
    ((function, value),) = opening.places
    return opening, function, value


def test_a_ball_rolls_off_a_sphere():
    """cos θ = 2 cos θ₀/(3 + k) with k = I/(m a²): design sheet on surfaces."""
    _, function, value = place(on(ph.Sphere(LAB, radius=R), inertia=I), {U: U0})
    assert function == ph.cos(U)
    assert (value - 2 * ph.cos(U0) / (3 + I / (M * A**2))).is_zero
    _, _, solid = place(on(ph.Sphere(LAB, radius=R)), {})
    assert solid == ph.symbol("x") * 0 + 10 / ph.sqrt(17) ** 2


def test_a_ball_slides_off_a_sphere():
    opening, _, value = place(on(ph.Sphere(LAB, radius=R), ph.Smooth), {U: U0})
    assert (value - 2 * ph.cos(U0) / 3).is_zero
    assert opening.friction is None


def test_the_least_speed_for_a_loop():
    """A ball that rolls around the inside: N vanishes at the top for w² = 27 g/(7 (R − a))."""
    bowl = ph.Sphere(LAB, radius=R, inside=True)
    _, function, value = place(on(bowl), {U.dt(): W})
    assert function == ph.cos(U)
    square = 27 * G / (7 * (R - A))
    assert (value.subs({W: ph.sqrt(square)}) + 1).is_zero


def test_a_ladder_leaves_the_wall():
    alpha = ph.coordinate("alpha")
    axes = LAB.rotated(alpha, "y")
    rod = ph.rod("rod", mass=M, length=L, axes=axes)
    system = ph.System(
        ph.Smooth(rod, on=ph.Plane(LAB), at=axes["x"] * (L / 2), name="floor", force="N"),
        ph.Smooth(
            rod, on=ph.Plane(LAB, normal="x"), at=axes["x"] * (-L / 2), name="wall", force="W"
        ),
        ph.Hinge(rod, axis="y"),
        ph.Gravity(G),
    )
    (wall,) = ph.leaves(ph.derive(system), {alpha: U0}, contacts=["wall"])
    assert (ph.sin(alpha), 2 * ph.sin(U0) / 3) in wall.places


@pytest.mark.parametrize("start", [0.2, 0.7])
def test_friction_that_is_needed_agrees_with_a_simulation(start):
    sphere = ph.Sphere(LAB, radius=R)
    (opening,) = ph.leaves(on(sphere), {U: U0})
    ball = ph.sphere("ball", mass=M, radius=A, axes=sphere.axes)
    system = ph.System(ph.Coulomb(ball, on=sphere, mu=0.4), ph.Gravity(G))
    run = ph.simulate(system, {M: 0.1, A: 0.02, R: 0.2, G: 9.81}, {U: start}, "1 s")
    slips = next(event for event in run.events if event.kind == "slips")
    there = slips.state_before["u"]
    # 2 sin u/(17 cos u − 10 cos u₀), the friction needed where it slips
    wanted = 2 * np.sin(there) / (17 * np.cos(there) - 10 * np.cos(start))
    assert wanted == pytest.approx(0.4, rel=1e-9)
    formula = 2 * ph.sin(U) / (17 * ph.cos(U) - 10 * ph.cos(U0))
    assert (opening.friction**2 - formula**2).is_zero


def test_what_is_refused():
    bowl = ph.Sphere(LAB, radius=R, inside=True)
    with pytest.raises(ph.DeclarationError, match="more than one coordinate"):
        ph.leaves(on(bowl), {U.dt(): W, ph.coordinate("v"): U0})
    with pytest.raises(ph.DeclarationError, match="a start for q"):
        ph.leaves(on(bowl), {ph.coordinate("q"): W})
    pendulum = ph.Body("bob", mass=M, inertia=(I, I, I), axes=LAB.rotated(U, "x"))
    swing = ph.System(ph.Pivot(pendulum), ph.Hinge(pendulum, axis="x"), ph.Gravity(G))
    with pytest.raises(ph.DeclarationError, match="a system with a contact"):
        ph.leaves(ph.derive(swing), {})
    phi, theta = ph.coordinates("phi theta")
    coin = LAB.rotated(phi, "z").rotated(theta, "x")
    disk = ph.disk("disk", mass=M, radius=A, axes=coin)
    falling = ph.derive(ph.System(ph.Rolling(disk, on=ph.Plane(LAB)), ph.Gravity(G)))
    with pytest.raises(ph.DeclarationError, match="a start at which"):
        ph.leaves(falling, {})
    assert ph.leaves(falling, {theta: U0})


def test_a_start_that_the_energy_does_not_follow_is_refused() -> None:
    """A tippe top at rest upright: its energy is the same whatever the precession."""
    system = CATALOGUE["tippe-top"].build()
    phi = ph.coordinate("phi")
    with pytest.raises(ph.DeclarationError, match="does not depend on phi_dot"):
        ph.leaves(ph.derive(system), {phi: ph.symbol("phi_0")})

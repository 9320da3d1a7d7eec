"""Systems of mechanics texts whose letters have several meanings."""

from __future__ import annotations

from functools import cache

import polhode as ph
from polhode.derive import Equations

m, l, g, M, h, k, R = ph.symbols("m l g M h k R", positive=True)


@cache
def pendulum() -> Equations:
    """A bob on a string; θ from the downward vertical, force declared along the string."""
    turned = ph.Frame("lab").rotated(-ph.coordinate("theta"), "y")
    bob = ph.point_mass("bob", mass=m, axes=turned)
    string = ph.Pivot(bob, at=turned["z"] * l, name="string", along=turned)
    return ph.derive(ph.System(string, ph.Gravity(g), name="pendulum"))


@cache
def physical_pendulum() -> Equations:
    """A body with radius of gyration k, swinging about a point at h from its centre of mass."""
    turned = ph.Frame("lab").rotated(-ph.coordinate("theta"), "y")
    body = ph.Body("body", mass=M, inertia=(M * k**2,) * 3, axes=turned)
    pivot = ph.Pivot(body, at=turned["z"] * h, name="pivot")
    hinge = ph.Hinge(body, axis="y")
    return ph.derive(ph.System(pivot, hinge, ph.Gravity(g), name="physical pendulum"))


@cache
def spherical_pendulum() -> Equations:
    """A bob on a string that swings in space."""
    phi, theta = ph.coordinates("phi theta")
    turned = ph.Frame("lab").rotated(phi, "z").rotated(-theta, "y")
    bob = ph.point_mass("bob", mass=m, axes=turned)
    string = ph.Pivot(bob, at=turned["z"] * l, name="string", along=turned)
    return ph.derive(ph.System(string, ph.Gravity(g), name="spherical pendulum"))


@cache
def heavy_top() -> Equations:
    """The symmetric top with I_1 about the fixed point, as in Goldstein, § 5.7."""
    I_1, I_3 = ph.symbols("I_1 I_3", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    inertia = (I_1 - M * l**2, I_1 - M * l**2, I_3)
    body = ph.Body("top", mass=M, inertia=inertia, axes=axes)
    return ph.derive(ph.System(ph.Pivot(body, at=axes["3"] * -l), ph.Gravity(g), name="top"))


@cache
def beads() -> Equations:
    """Two pendulums on one another."""
    m_1, m_2, l_1, l_2 = ph.symbols("m_1 m_2 l_1 l_2", positive=True)
    angles = ph.coordinates("theta_1 theta_2")
    one, two = (ph.Frame("lab").rotated(-angle, "y") for angle in angles)
    upper = ph.point_mass("upper", mass=m_1, axes=one, tag="1")
    lower = ph.point_mass("lower", mass=m_2, axes=two, tag="2")
    return ph.derive(
        ph.System(
            ph.Pivot(upper, at=one["z"] * l_1, name="shoulder"),
            ph.Pivot(lower, at=two["z"] * l_2, to=upper.point(), name="elbow"),
            ph.Gravity(g),
            name="double pendulum",
        )
    )


@cache
def ball_on_a_slope() -> Equations:
    """A solid ball that rolls down a plane."""
    slope = ph.Plane(ph.Frame("lab"), tilt=-ph.symbol("alpha"))
    ball = ph.sphere("ball", mass=M, radius=R, axes=slope.axes)
    return ph.derive(ph.System(ph.Rolling(ball, on=slope), ph.Gravity(g), name="ball on a slope"))


@cache
def sliding_ball() -> Equations:
    """A ball that slides on a level table."""
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=M, radius=R, axes=lab)
    cloth = ph.Coulomb(ball, on=ph.Plane(lab), mu=ph.symbol("mu", positive=True), name="cloth")
    return ph.derive(ph.System(cloth, ph.Gravity(g), name="billiard ball"))


@cache
def free_body() -> Equations:
    """A body with three moments of inertia, held at its centre of mass, by components of ω."""
    moments = ph.symbols("I_1 I_2 I_3", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    body = ph.Body("body", mass=m, inertia=moments, axes=axes, spin=ph.Components())
    return ph.derive(ph.System(ph.Pivot(body, name="cm"), name="free body"))

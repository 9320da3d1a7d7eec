"""Systems of several bodies, and a body that is not round, as a user would declare them."""

from __future__ import annotations

from functools import cache

import polhode as ph
from polhode.derive import Equations


@cache
def double_pendulum() -> Equations:
    m_1, m_2, l_1, l_2, g = ph.symbols("m_1 m_2 l_1 l_2 g", positive=True)
    first, second = ph.coordinates("theta_1 theta_2")
    lab = ph.Frame("lab")
    upper_axes, lower_axes = lab.rotated(-first, "y"), lab.rotated(-second, "y")
    upper = ph.rod("upper", mass=m_1, length=l_1, axes=upper_axes, axis="z")
    lower = ph.rod("lower", mass=m_2, length=l_2, axes=lower_axes, axis="z")
    knee = upper.point(upper_axes["z"] * (-l_1 / 2))
    return ph.derive(
        ph.System(
            ph.Pivot(upper, at=upper_axes["z"] * (l_1 / 2)),
            ph.Pivot(lower, at=lower_axes["z"] * (l_2 / 2), to=knee, name="knee", force="Fjoint"),
            ph.Gravity(g),
        )
    )


@cache
def four_bar() -> Equations:
    masses, lengths = ph.symbols("m_1 m_2 m_3", positive=True), ph.symbols("l_1 l_2 l_3")
    d, g = ph.symbols("d g", positive=True)
    angles = ph.coordinates("theta_1 theta_2 theta_3")
    lab = ph.Frame("lab")
    crank, coupler, rocker = (
        ph.rod(name, mass=m, length=length, axes=lab.rotated(-angle, "y"))
        for name, m, length, angle in zip(
            ("crank", "coupler", "rocker"), masses, lengths, angles, strict=True
        )
    )
    half = {
        b: b.axes["x"] * (n / 2) for b, n in zip((crank, coupler, rocker), lengths, strict=True)
    }
    joints = (
        ph.Pivot(crank, at=-half[crank]),
        ph.Pivot(
            coupler, at=-half[coupler], to=crank.point(half[crank]), name="knee", force="Knee"
        ),
        ph.Pivot(rocker, at=-half[rocker], to=lab["x"] * d, name="far", force="Fprime"),
        ph.Pivot(
            rocker, at=half[rocker], to=coupler.point(half[coupler]), name="loop", force="Loop"
        ),
    )
    return ph.derive(ph.System(*joints, ph.Gravity(g), independent=(angles[0].dt(),)))


@cache
def wheels_on_axle() -> Equations:
    m, first, third, a, b, mass, across, g = ph.symbols("m I_1 I_3 a b M J g", positive=True)
    alpha, c = ph.symbols("alpha c")
    phi, turn_1, turn_2 = ph.coordinates("phi psi_1 psi_2")
    ground = ph.Frame("ground")
    along = ground.rotated(phi, "z")
    axle = ph.Body("axle", mass=mass, inertia=(across,) * 3, axes=along, tag="0")
    wheels = [
        ph.Body(
            f"wheel {number}",
            mass=m,
            inertia=(third, first, first),
            axes=along.rotated(turn, "x"),
            surface=ph.Rim(a, "x"),
            tag=str(number),
        )
        for number, turn in ((1, turn_1), (2, turn_2))
    ]
    plane, e = ph.Plane(ground), along["x"]
    up = ground.vector(ph.sin(alpha), 0, ph.cos(alpha))
    return ph.derive(
        ph.System(
            ph.Rolling(wheels[0], on=plane, name="contact 1"),
            ph.Pivot(axle, at=e * (b - c), to=wheels[0].point(ground.zero), name="1", force="B"),
            ph.Hinge(wheels[0], axis="x", to=axle, name="bearing 1"),
            ph.Pivot(wheels[1], to=axle.point(e * (-b - c)), name="2", force="B"),
            ph.Hinge(wheels[1], axis="x", to=axle, name="bearing 2"),
            ph.Rolling(wheels[1], on=plane, name="contact 2"),
            ph.Gravity(g, up=up),
            independent=(turn_1.dt(), turn_2.dt()),
        )
    )


@cache
def gimballed_gyroscope() -> Equations:
    m, a, g, first, third = ph.symbols("m a g I_1 I_3", positive=True)
    light, outer_moment, *inner_moments = ph.symbols("mu C_o A_i B_i C_i", positive=True)
    theta, phi = ph.coordinates("theta phi")
    lab = ph.Frame("lab")
    outer_axes = lab.rotated(phi, "z")
    axes = outer_axes.rotated(theta, "x", labels="1 2 3")
    outer = ph.Body("outer", mass=light, inertia=(outer_moment,) * 3, axes=outer_axes)
    inner = ph.Body("inner", mass=light, inertia=inner_moments, axes=axes, tag="i")
    moments = (first, first, third)
    rotor = ph.Body("rotor", mass=m, inertia=moments, axes=axes, spin=ph.About("3"))
    zero = lab.zero
    return ph.derive(
        ph.System(
            ph.Pivot(outer, name="ground"),
            ph.Hinge(outer, axis="z", name="ground bearing"),
            ph.Pivot(inner, to=outer.point(zero), name="trunnion"),
            ph.Hinge(inner, axis="1", to=outer, name="trunnion bearing"),
            ph.Pivot(rotor, at=axes["3"] * -a, to=inner.point(zero), name="axle", force="Axle"),
            ph.Hinge(rotor, axis="3", to=inner, name="bearing", torque="taur"),
            ph.Gravity(g),
        )
    )


@cache
def rolling_ellipsoid() -> Equations:
    m, g, *moments = ph.symbols("m g I_1 I_2 I_3", positive=True)
    b_1, b_2, b_3 = ph.symbols("b_1 b_2 b_3", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    lab = ph.Frame("lab")
    axes = lab.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    body = ph.Body(
        "ellipsoid",
        mass=m,
        inertia=moments,
        axes=axes,
        spin=ph.Components(),
        surface=ph.Ellipsoidal((b_1, b_2, b_3)),
    )
    return ph.derive(ph.System(ph.Rolling(body, on=ph.Plane(lab)), ph.Gravity(g)))

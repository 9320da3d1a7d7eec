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


@cache
def rod_pendulum() -> Equations:
    """A uniform rod of length L, hung at its end."""
    turned = ph.Frame("lab").rotated(-ph.coordinate("theta"), "y")
    length = ph.symbol("L", positive=True)
    rod = ph.rod("rod", mass=M, length=length, axes=turned, axis="z")
    pivot = ph.Pivot(rod, at=turned["z"] * (length / 2), name="pivot")
    return ph.derive(ph.System(pivot, ph.Hinge(rod, axis="y"), ph.Gravity(g), name="rod"))


@cache
def compound_pendulum() -> Equations:
    """A body with the moment I about its axis, at l from its centre of mass."""
    turned = ph.Frame("lab").rotated(-ph.coordinate("theta"), "y")
    moment = ph.symbol("I", positive=True)
    body = ph.Body("body", mass=M, inertia=(moment, moment - M * l**2, moment), axes=turned)
    pivot = ph.Pivot(body, at=turned["z"] * l, name="pivot")
    return ph.derive(ph.System(pivot, ph.Hinge(body, axis="y"), ph.Gravity(g), name="compound"))


@cache
def cylinder_on_a_slope() -> Equations:
    """A disk or solid cylinder of radius R that rolls down a plane."""
    slope = ph.Plane(ph.Frame("lab"), tilt=-ph.symbol("alpha", positive=True))
    spin = ph.About("x", "theta")
    disk = ph.disk("cylinder", mass=M, radius=R, axes=slope.axes, axis="x", spin=spin)
    rolling = ph.Rolling(disk, on=slope, name="ground")
    return ph.derive(ph.System(rolling, ph.Hinge(disk, axis="x"), ph.Gravity(g), name="cylinder"))


@cache
def turning_hoop() -> Equations:
    """A bead on a hoop that is kept turning at ω; θ from the bottom."""
    turning = ph.earth(ph.symbol("omega", positive=True), colatitude=0)
    turned = turning.rotated(-ph.coordinate("theta"), "y")
    bead = ph.point_mass("bead", mass=m, axes=turned)
    wire = ph.Pivot(bead, at=turned["z"] * R, name="wire", along=turned)
    return ph.derive(ph.System(wire, ph.Hinge(bead, axis="y"), ph.Gravity(g), name="bead"))


@cache
def pulley() -> Equations:
    """Atwood's machine with a pulley of radius R and moment of inertia I."""
    lab, moment = ph.Frame("lab"), ph.symbol("I", positive=True)
    m_1, m_2 = ph.symbols("m_1 m_2", positive=True)
    turned, x, z = lab.rotated(ph.coordinate("alpha"), "y"), lab["x"], lab["z"]
    wheel = ph.Body("pulley", mass=M, inertia=(moment, moment, moment), axes=turned, tag="p")
    left = ph.point_mass("left", mass=m_1, axes=lab, tag="1")
    right = ph.point_mass("right", mass=m_2, axes=lab, tag="2")
    return ph.derive(
        ph.System(
            ph.Pivot(wheel, name="axle"),
            ph.Hinge(wheel, axis="y"),
            ph.Rope([left.point(), wheel.point(x * -R)], directions=[z], name="left rope"),
            ph.Rope([right.point(), wheel.point(x * R)], directions=[z], name="right rope"),
            ph.Pivot(left, to=x * -R, only="x y", name="left guide"),
            ph.Pivot(right, to=x * R, only="x y", name="right guide"),
            ph.Gravity(g),
            name="Atwood",
        )
    )


@cache
def ladder() -> Equations:
    """A uniform rod of length 2l on a smooth floor and wall; θ from the vertical."""
    turned = ph.Frame("lab").rotated(-ph.coordinate("theta"), "y")
    rod = ph.rod("ladder", mass=m, length=2 * l, axes=turned, axis="z")
    supports = (
        ph.Pivot(rod, at=turned["z"] * l, only="x", name="wall"),
        ph.Pivot(rod, at=turned["z"] * -l, only="z", name="floor"),
        ph.Pivot(rod, only="y", name="plane"),
        ph.Hinge(rod, axis="y"),
    )
    return ph.derive(ph.System(*supports, ph.Gravity(g), name="ladder"))


@cache
def falling_stick() -> Equations:
    """A uniform rod of length l with one end on a smooth table; θ from the vertical."""
    turned = ph.Frame("lab").rotated(-ph.coordinate("theta"), "y")
    rod = ph.rod("stick", mass=M, length=l, axes=turned, axis="z")
    supports = (
        ph.Pivot(rod, at=turned["z"] * (-l / 2), only="z", name="table", force="N"),
        ph.Pivot(rod, only="y", name="plane"),
        ph.Hinge(rod, axis="y"),
    )
    return ph.derive(ph.System(*supports, ph.Gravity(g), name="stick"))


@cache
def yo_yo() -> Equations:
    """A body of moment I that unwinds a vertical string from radius b."""
    lab, b = ph.Frame("lab"), ph.symbol("b", positive=True)
    moment = ph.symbol("I", positive=True)
    turned = lab.rotated(ph.coordinate("theta"), "y")
    body = ph.Body("yo-yo", mass=M, inertia=(moment, moment, moment), axes=turned)
    string = ph.Rope([body.point(lab["x"] * b), lab["x"] * b], directions=[lab["z"]], name="string")
    guide = ph.Pivot(body, only="x y", name="guide")
    hinge = ph.Hinge(body, axis="y")
    return ph.derive(ph.System(guide, hinge, string, ph.Gravity(g), name="yo-yo"))


@cache
def yo_yo_by_an_equation() -> Equations:
    """The same, its string declared as an equation between lengths."""
    b, moment = ph.symbols("b I", positive=True)
    turned = ph.Frame("lab").rotated(ph.coordinate("theta"), "y")
    body = ph.Body("yo-yo", mass=M, inertia=(moment, moment, moment), axes=turned)
    string = ph.Constraint("z = -b*theta", on=(body,), where={"b": b}, name="string")
    guide = ph.Pivot(body, only="x y", name="guide")
    hinge = ph.Hinge(body, axis="y")
    return ph.derive(ph.System(guide, hinge, string, ph.Gravity(g), name="yo-yo"))


@cache
def spinning_top() -> Equations:
    """The heavy top by its spin ω_3, with I_1 about the fixed point O."""
    I_1, I_3 = ph.symbols("I_1 I_3", positive=True)
    phi, theta = ph.coordinates("phi theta")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    inertia = (I_1 - M * l**2, I_1 - M * l**2, I_3)
    body = ph.Body("top", mass=M, inertia=inertia, axes=axes, spin=ph.About("3", "psi"))
    return ph.derive(ph.System(ph.Pivot(body, at=axes["3"] * -l, name="O"), ph.Gravity(g)))


@cache
def symmetric_body() -> Equations:
    """A free body with I_1 = I_2, by components of ω."""
    I_1, I_3 = ph.symbols("I_1 I_3", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    body = ph.Body("body", mass=m, inertia=(I_1, I_1, I_3), axes=axes, spin=ph.Components())
    return ph.derive(ph.System(ph.Pivot(body, name="cm"), name="symmetric body"))


@cache
def shaken_pendulum() -> Equations:
    """A pendulum whose support is at -a cos γt on the vertical."""
    lab, turned = ph.Frame("lab"), ph.Frame("lab").rotated(-ph.coordinate("phi"), "y")
    a, gamma = ph.symbols("a gamma", positive=True)
    bob = ph.point_mass("bob", mass=m, axes=turned)
    moved = lab["z"] * (-a * ph.cos(gamma * ph.time))
    support = ph.Pivot(bob, at=turned["z"] * l, to=moved, name="support")
    return ph.derive(ph.System(support, ph.Gravity(g), name="shaken pendulum"))


@cache
def cart() -> Equations:
    """A pendulum of mass m_2 below m_1, which slides along x."""
    lab, turned = ph.Frame("lab"), ph.Frame("lab").rotated(-ph.coordinate("phi"), "y")
    m_1, m_2 = ph.symbols("m_1 m_2", positive=True)
    slider = ph.point_mass("cart", mass=m_1, axes=lab)
    bob = ph.point_mass("bob", mass=m_2, axes=turned, tag="2")
    rail = ph.Pivot(slider, only="y z", name="rail")
    hinge = ph.Pivot(bob, at=turned["z"] * l, to=slider.point(), name="hinge")
    return ph.derive(ph.System(rail, hinge, ph.Gravity(g), name="cart"))


@cache
def skew_dumbbell() -> Equations:
    """Two particles on a light rod of length 2l, at α to the plane in which it turns."""
    axes, alpha = ph.Frame("lab").rotated(ph.coordinate("phi"), "z"), ph.symbol("alpha")
    link = ph.Body("link", mass=0, axes=axes, tag="l")
    along = axes["x"] * (l * ph.cos(alpha)) + axes["z"] * (l * ph.sin(alpha))
    ends = (ph.point_mass(name, mass=m, axes=axes, tag=name) for name in ("1", "2"))
    held = (
        ph.Pivot(end, to=link.point(along * sign), name=f"end {end.name}")
        for end, sign in zip(ends, (1, -1), strict=True)
    )
    shaft = (ph.Pivot(link, name="bearing"), ph.Hinge(link, axis="z"))
    return ph.derive(ph.System(*shaft, *held, name="skew dumbbell"))


@cache
def rocking_cylinder() -> Equations:
    """A cylinder of radius R that rolls, its centre of mass at a from its axis."""
    turned, moment = (
        ph.Frame("lab").rotated(ph.coordinate("phi"), "y"),
        ph.symbol("I", positive=True),
    )
    a = ph.symbol("a", positive=True)
    body = ph.Body("cylinder", mass=m, inertia=(moment,) * 3, axes=turned)
    height = ph.Pivot(body, at=turned["z"] * a, only="z", to=ph.Frame("lab")["z"] * R, name="floor")
    rolls = ph.Constraint("x + a*sin(phi) - R*phi = 0", on=body, where={"a": a, "R": R})
    guide = (ph.Pivot(body, only="y", name="guide"), ph.Hinge(body, axis="y"))
    return ph.derive(ph.System(height, *guide, rolls, ph.Gravity(g), name="rocking cylinder"))


@cache
def cylinder_in_a_cylinder() -> Equations:
    """A cylinder of radius k that rolls in one of radius R, held at R - k by a light arm."""
    lab = ph.Frame("lab")
    theta, phi = ph.coordinates("theta phi")
    moment = ph.symbol("I", positive=True)
    arm = ph.Body("arm", mass=0, axes=lab.rotated(-theta, "y"), tag="arm")
    body = ph.Body("cylinder", mass=m, inertia=(moment,) * 3, axes=lab.rotated(phi, "y"), tag="c")
    rolls = ph.Constraint("k*phi - (R-k)*theta = 0", on=(body, arm), where={"k": k, "R": R})
    centre, axle = arm.point(arm.axes["z"] * (k - R)), ph.Hinge(body, axis="y")
    parts = (ph.Pivot(arm, name="centre"), ph.Hinge(arm, axis="y"))
    held = ph.Pivot(body, to=centre, name="axle")
    return ph.derive(ph.System(*parts, held, axle, rolls, ph.Gravity(g), name="bowl"))


@cache
def gimbals() -> Equations:
    """A rotor A, C in a ring A', B', C' that turns in one of moment J about the vertical."""
    J, A, C, A_1, B_1, C_1 = ph.symbols("J A C A_1 B_1 C_1", positive=True)
    psi, theta = ph.coordinates("psi theta")
    upright = ph.Frame("lab").rotated(psi, "z")
    tilted = upright.rotated(theta, "x")
    outer = ph.Body("outer ring", mass=M, inertia=(J, J, J), axes=upright, tag="o")
    inner = ph.Body("inner ring", mass=M, inertia=(A_1, B_1, C_1), axes=tilted, tag="i")
    spin = ph.About("z", "phi")
    rotor = ph.Body("rotor", mass=m, inertia=(A, A, C), axes=tilted, spin=spin)
    return ph.derive(
        ph.System(
            ph.Pivot(outer, name="foot"),
            ph.Hinge(outer, axis="z"),
            ph.Pivot(inner, name="centre"),
            ph.Hinge(inner, axis="x", to=outer),
            ph.Pivot(rotor, to=inner.point(), name="bearing"),
            ph.Hinge(rotor, axis="z", to=inner),
            name="gyroscope in gimbals",
        )
    )


@cache
def leaning_ladder() -> Equations:
    """A uniform rod of length 2l; R is declared at the wall, S at the floor."""
    turned = ph.Frame("lab").rotated(-ph.coordinate("theta"), "y")
    rod = ph.rod("ladder", mass=m, length=2 * l, axes=turned, axis="z")
    supports = (
        ph.Pivot(rod, at=turned["z"] * l, only="x", name="wall", force="R"),
        ph.Pivot(rod, at=turned["z"] * -l, only="z", name="floor", force="S"),
        ph.Pivot(rod, only="y", name="plane"),
        ph.Hinge(rod, axis="y"),
    )
    return ph.derive(ph.System(*supports, ph.Gravity(g), name="ladder"))


@cache
def tilting_top() -> Equations:
    """The heavy top with θ about the second axis, as in Taylor, § 10.10."""
    lambda_1, lambda_3 = ph.symbols("lambda_1 lambda_3", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "y").rotated(psi, "z", labels="1 2 3")
    inertia = (lambda_1 - M * R**2, lambda_1 - M * R**2, lambda_3)
    body = ph.Body("top", mass=M, inertia=inertia, axes=axes)
    pivot = ph.Pivot(body, at=axes["3"] * -R, name="O")
    return ph.derive(ph.System(pivot, ph.Gravity(g), name="top"))


@cache
def torsion_pendulum() -> Equations:
    """A disk on a torsion wire."""
    theta, moment = ph.coordinate("theta"), ph.symbol("I", positive=True)
    disk = ph.Body("disk", mass=m, inertia=(moment,) * 3, axes=ph.Frame("lab").rotated(theta, "z"))
    wire = ph.TorsionSpring(theta, stiffness=ph.symbol("kappa", positive=True), on=disk)
    held = (ph.Pivot(disk, name="centre"), ph.Hinge(disk, axis="z"))
    return ph.derive(ph.System(*held, wire, name="torsion pendulum"))


@cache
def wedge() -> Equations:
    """A block that slides by s_b down a wedge of angle α, which slides by X_w along the floor."""
    lab, alpha = ph.Frame("lab"), ph.symbol("alpha", positive=True)
    support = ph.Body("wedge", mass=M, inertia=(M * h**2,) * 3, axes=lab, tag="w")
    block = ph.point_mass("block", mass=m, axes=lab.rotated(alpha, "y"), tag="b")
    floor = ph.Slider(support, axis="x", distance="X", name="floor", force="R")
    face = ph.Slider(block, axis="x", along=block.axes, to=support.point(), name="face", force="N")
    return ph.derive(ph.System(floor, face, ph.Gravity(g), name="block on a wedge"))


@cache
def falling_rod() -> Equations:
    """A uniform rod of length 2b on its end; θ below the horizontal."""
    b, down = ph.symbol("b", positive=True), ph.Frame("lab").rotated(ph.coordinate("theta"), "y")
    rod = ph.rod("rod", mass=m, length=2 * b, axes=down, axis="x")
    end = ph.Pivot(rod, at=down["x"] * -b, along=down, name="O")
    return ph.derive(ph.System(end, ph.Hinge(rod, axis="y"), ph.Gravity(g), name="falling rod"))


def _turned_about_the_vertical(name: str) -> tuple[ph.Body, tuple[ph.Pivot, ph.Hinge]]:
    """A massless link that turns by φ."""
    link = ph.Body(name, mass=0, axes=ph.Frame("lab").rotated(ph.coordinate("phi"), "z"), tag="l")
    return link, (ph.Pivot(link, name=f"foot of {name}"), ph.Hinge(link, axis="z"))


@cache
def string_through_a_hole() -> Equations:
    """A particle on a smooth table, and one that hangs from it by a string through a hole."""
    link, held = _turned_about_the_vertical("link")
    particle = ph.point_mass("particle", mass=m, axes=link.axes)
    weight = ph.point_mass("weight", mass=M, axes=ph.Frame("lab"), tag="w")
    z, hole = ph.Frame("lab")["z"], ph.Frame("lab").zero
    string = ph.Rope(
        [particle.point(), hole, weight.point()], directions=[-link.axes["x"], -z], tension="T"
    )
    table = ph.Slider(particle, axis="x", to=link.point(), distance="r", name="table", force="N")
    guide = ph.Pivot(weight, only="x y", name="guide")
    return ph.derive(ph.System(*held, table, guide, string, ph.Gravity(g), name="string"))


@cache
def particle_in_a_cone() -> Equations:
    """A particle on a generator, at α to the vertical, that turns freely."""
    link, held = _turned_about_the_vertical("carrier")
    generator = link.axes.rotated(ph.symbol("alpha", positive=True), "y")
    particle = ph.point_mass("particle", mass=m, axes=generator)
    cone = ph.Slider(particle, axis="z", along=generator, to=link.point(), name="cone", force="N")
    return ph.derive(ph.System(*held, cone, ph.Gravity(g), name="particle in a cone"))


@cache
def planet() -> Equations:
    """A particle in the potential -k/r."""
    link, held = _turned_about_the_vertical("arm")
    particle = ph.point_mass("planet", mass=m, axes=link.axes)
    arm = ph.Slider(particle, axis="x", to=link.point(), distance="r", name="arm", force="N")
    attraction = ph.Potential(-k / ph.coordinate("r"), on=particle)
    return ph.derive(ph.System(*held, arm, attraction, name="planet"))


@cache
def whirling_rod() -> Equations:
    """A bead on a straight rod that is kept turning at ω in the horizontal plane."""
    turning = ph.earth(ph.symbol("omega", positive=True), colatitude=0)
    bead = ph.point_mass("bead", mass=m, axes=turning)
    rod = ph.Slider(bead, axis="x", distance="r", name="rod", force="N")
    return ph.derive(ph.System(rod, name="whirling rod"))


@cache
def spool() -> Equations:
    """A spool that a string on its inner radius b pulls with a force P at β above the level."""
    b, kappa, beta, P = ph.symbols("b kappa beta P", positive=True)
    x, z = (ph.Frame("lab")[label] for label in "xz")
    turned = ph.Frame("lab").rotated(ph.coordinate("theta"), "y")
    body = ph.Body("spool", mass=m, inertia=(m * kappa**2,) * 3, axes=turned)
    at = x * (b * ph.sin(beta)) - z * (b * ph.cos(beta))
    pull = ph.Force(body.point(at), (x * ph.cos(beta) + z * ph.sin(beta)) * P, name="pull")
    floor = ph.Pivot(body, only="y z", name="floor", force="N")
    friction = ph.Rack(body, at=z * -R, along=x, name="friction", force="f")
    parts = (floor, ph.Hinge(body, axis="y"), friction, pull, ph.Gravity(g))
    return ph.derive(ph.System(*parts, name="spool"))


@cache
def metronome() -> Equations:
    """An inverted pendulum with a torsion spring; θ from the upward vertical."""
    theta = ph.coordinate("theta")
    turned = ph.Frame("lab").rotated(theta, "y")
    bob = ph.point_mass("bob", mass=m, axes=turned)
    spring = ph.TorsionSpring(theta, stiffness=k, on=bob)
    held = (ph.Pivot(bob, at=turned["z"] * -l, name="foot"), ph.Hinge(bob, axis="y", name="pin"))
    return ph.derive(ph.System(*held, spring, ph.Gravity(g), name="metronome"))


@cache
def pendulum_in_a_car() -> Equations:
    """A pendulum whose support has the acceleration a."""
    lab, turned = ph.Frame("lab"), ph.Frame("lab").rotated(-ph.coordinate("theta"), "y")
    bob = ph.point_mass("bob", mass=m, axes=turned)
    moved = lab["x"] * (ph.symbol("a", positive=True) * ph.time**2 / 2)
    hook = ph.Pivot(bob, at=turned["z"] * l, to=moved, name="hook")
    return ph.derive(ph.System(hook, ph.Gravity(g), name="pendulum in a car"))


@cache
def winch() -> Equations:
    """A mass that unwinds a rope from a drum of radius R and moment J."""
    lab, J = ph.Frame("lab"), ph.symbol("J", positive=True)
    turned, x, z = lab.rotated(ph.coordinate("theta"), "y"), lab["x"], lab["z"]
    drum = ph.Body("drum", mass=M, inertia=(J,) * 3, axes=turned, tag="d")
    load = ph.point_mass("load", mass=m, axes=lab, tag="m")
    rope = ph.Rope([load.point(), drum.point(x * R)], directions=[z], name="rope", tension="T")
    guide = ph.Pivot(load, to=x * R, only="x y", name="guide")
    axle = (ph.Pivot(drum, name="axle"), ph.Hinge(drum, axis="y"))
    return ph.derive(ph.System(*axle, guide, rope, ph.Gravity(g), name="winch"))


@cache
def wheel_on_a_slope() -> Equations:
    """A wheel of radius of gyration κ that rolls down a slope of angle β."""
    a, kappa, beta = ph.symbols("a kappa beta", positive=True)
    slope = ph.Plane(ph.Frame("lab"), tilt=-beta)
    spin, rim = ph.About("x", "theta"), ph.Rim(a, "x")
    inertia = (m * kappa**2,) * 3
    wheel = ph.Body("wheel", mass=m, inertia=inertia, axes=slope.axes, spin=spin, surface=rim)
    rolling = ph.Rolling(wheel, on=slope, name="slope")
    return ph.derive(ph.System(rolling, ph.Hinge(wheel, axis="x"), ph.Gravity(g), name="wheel"))


@cache
def two_gears() -> Equations:
    """Two wheels in mesh, a torque Γ on the first."""
    a, b, I_1, I_2, Gamma = ph.symbols("a b I_1 I_2 Gamma", positive=True)
    lab = ph.Frame("lab")
    z = lab["z"]
    angles = zip(("1", "2"), ("phi", "psi"), (I_1, I_2), strict=True)
    first, second = (
        ph.Body(n, mass=m, inertia=(i,) * 3, axes=lab.rotated(ph.coordinate(q), "z"), tag=n)
        for n, q, i in angles
    )
    mesh = ph.Gear(first, radius=a, to=second, other_radius=b, axis=z, name="mesh")
    axles = (ph.Pivot(first, name="axle"), ph.Pivot(second, to=lab["x"] * (a + b), name="other"))
    hinges = (ph.Hinge(first, axis="z"), ph.Hinge(second, axis="z"))
    return ph.derive(ph.System(*axles, *hinges, mesh, ph.Torque(first, z * Gamma), name="gears"))


@cache
def spun_body() -> Equations:
    """A symmetric body A, A, C with a torque Γ about its axis, by components of ω."""
    A, C, Gamma = ph.symbols("A C Gamma", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    body = ph.Body("body", mass=m, inertia=(A, A, C), axes=axes, spin=ph.Components())
    torque = ph.Torque(body, axes["3"] * Gamma)
    return ph.derive(ph.System(ph.Pivot(body, name="cm"), torque, name="spun body"))


@cache
def body_by_angles() -> Equations:
    """A free body A, B, C by Euler's angles."""
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    inertia = ph.symbols("A B C", positive=True)
    body = ph.Body("body", mass=m, inertia=inertia, axes=axes)
    return ph.derive(ph.System(ph.Pivot(body, name="cm"), name="body by Euler's angles"))


@cache
def symmetric_body_by_angles() -> Equations:
    """A free body A, A, C by Euler's angles z, y, z."""
    A, C = ph.symbols("A C", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "y").rotated(psi, "z", labels="1 2 3")
    body = ph.Body("body", mass=m, inertia=(A, A, C), axes=axes)
    return ph.derive(ph.System(ph.Pivot(body, name="cm"), name="symmetric body"))


@cache
def coupled_carts() -> Equations:
    """Two carts between three springs, as in Taylor, § 11.1."""
    x_1, x_2 = ph.coordinates("x_1 x_2")
    m_1, m_2, k_1, k_2, k_3 = ph.symbols("m_1 m_2 k_1 k_2 k_3", positive=True)
    masses = {"1": m_1, "2": m_2}
    carts = [ph.point_mass(n, mass=m, axes=ph.Frame("lab"), tag=n) for n, m in masses.items()]
    rails = (ph.Slider(c, axis="x", distance="x", name=f"rail {c.name}") for c in carts)
    stored = (k_1 * x_1**2 + k_2 * (x_2 - x_1) ** 2 + k_3 * x_2**2) / 2
    return ph.derive(ph.System(*rails, ph.Potential(stored, on=carts), name="carts"))


@cache
def needle() -> Equations:
    """A magnet of moment μ on a vertical pin in a horizontal field B."""
    turned, moment = ph.Frame("lab").rotated(ph.coordinate("theta"), "z"), ph.symbol("I")
    mu, B = ph.symbols("mu B", positive=True)
    magnet = ph.Body("needle", mass=m, inertia=(moment,) * 3, axes=turned)
    field = ph.MagneticMoment(magnet, turned["x"] * mu, ph.Frame("lab")["x"] * B)
    pin = (ph.Pivot(magnet, name="pin"), ph.Hinge(magnet, axis="z"))
    return ph.derive(ph.System(*pin, field, name="needle"))


@cache
def coupled_pendulums() -> Equations:
    """Two equal pendulums with a weak spring between the bobs, as in Taylor, problem 11.14."""
    angles = dict(zip("12", ph.coordinates("theta_1 theta_2"), strict=True))
    bobs, strings = [], []
    for i, angle in angles.items():
        axes = ph.Frame("lab").rotated(-angle, "y")
        bobs.append(ph.point_mass(f"bob {i}", mass=m, axes=axes, tag=i))
        strings.append(ph.Pivot(bobs[-1], at=axes["z"] * l, name=f"string {i}"))
    apart = l * (ph.sin(angles["1"]) - ph.sin(angles["2"]))
    spring = ph.Potential(k * apart**2 / 2, on=bobs)
    return ph.derive(ph.System(*strings, spring, ph.Gravity(g), name="coupled pendulums"))


@cache
def governor() -> Equations:
    """A ball on an arm that is hinged to a shaft of moment I, which turns freely."""
    phi, theta = ph.coordinates("phi theta")
    upright, moment = ph.Frame("lab").rotated(phi, "z"), ph.symbol("I", positive=True)
    shaft = ph.Body("shaft", mass=M, inertia=(moment,) * 3, axes=upright, tag="s")
    arm = upright.rotated(-theta, "y")
    ball = ph.point_mass("ball", mass=m, axes=arm, tag="b")
    held = (ph.Pivot(shaft, name="foot"), ph.Hinge(shaft, axis="z"))
    joint = ph.Pivot(ball, at=arm["z"] * l, to=shaft.point(), name="arm")
    pin = ph.Hinge(ball, axis="y", to=shaft, name="pin")
    return ph.derive(ph.System(*held, joint, pin, ph.Gravity(g), name="governor"))


@cache
def thrown_plate() -> Equations:
    """A thin disk thrown into the air: I_3 = 2 I_1."""
    phi, theta = ph.coordinates("phi theta")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    I_1 = ph.symbol("I_1", positive=True)
    plate = ph.Body("plate", mass=m, inertia=(I_1, I_1, 2 * I_1), axes=axes, spin_about="3")
    return ph.derive(ph.System(ph.Pivot(plate, name="cm"), name="thrown plate"))


@cache
def particle_on_a_sphere() -> Equations:
    """A particle that slides off a smooth sphere; θ from the top."""
    radial = ph.Frame("lab").rotated(ph.coordinate("theta"), "y")
    particle = ph.point_mass("particle", mass=m, axes=radial)
    sphere = ph.Pivot(particle, at=radial["z"] * -R, name="sphere", along=radial)
    return ph.derive(ph.System(sphere, ph.Gravity(g), name="particle on a sphere"))

"""Loads that store energy, against other loads, closed forms and conservation laws."""

from math import pi

import numpy as np
import pytest

import polhode as ph
from polhode.base import DeclarationError

LAB = ph.Frame("lab")
X, Y, Z = LAB["x"], LAB["y"], LAB["z"]
m, J, K, k, c, l, g = ph.symbols("m J K k c l g", positive=True)
ALPHA, BETA = ph.coordinates("alpha beta")


def _disk(name, axes, tag, moment=J):
    return ph.Body(name, mass=m, inertia=(moment,) * 3, axes=axes, tag=tag)


UPPER = _disk("upper", LAB.rotated(ALPHA, "z"), "1")
LOWER = _disk("lower", UPPER.axes.rotated(BETA, "z"), "2", K)
HELD = [
    part
    for disk in (UPPER, LOWER)
    for part in (ph.Pivot(disk, name=f"p {disk.name}"), ph.Hinge(disk, axis="z"))
]


def test_two_disks_on_a_torsion_wire():
    """The wire pulls both disks: their relative motion has ω² = k (1/J + 1/K)."""
    wire = ph.TorsionSpring(BETA, stiffness=k, on=(UPPER, LOWER))
    equations = ph.derive(ph.System(*HELD, wire))
    relative = equations.on_shell(BETA.dt().dt())
    assert (relative + k * (1 / J + 1 / K) * BETA).is_zero
    assert equations.on_shell(equations.rate(equations.energy)).is_zero
    momentum = equations.angular_momentum().dot(Z)
    assert equations.on_shell(equations.rate(momentum)).is_zero
    assert ph.check(r"E = \text{const}", equations).answer.value == "holds"


def test_damper_between_two_disks_takes_what_the_energy_loses():
    damper = ph.TorsionDamper(BETA, damping=c, on=(UPPER, LOWER))
    equations = ph.derive(ph.System(*HELD, damper))
    assert (equations.on_shell(equations.power) + c * BETA.dt() ** 2).is_zero
    assert (equations.rate(equations.energy) - equations.power).is_zero or (
        equations.on_shell(equations.rate(equations.energy) - equations.power).is_zero
    )
    assert (equations.on_shell(BETA.dt().dt()) + c * (1 / J + 1 / K) * BETA.dt()).is_zero


def test_damper_on_a_wheel_whose_rate_is_eliminated():
    a, b = ph.symbols("a b", positive=True)
    first, second = (_disk(n, LAB.rotated(q, "z"), n) for n, q in (("f", ALPHA), ("s", BETA)))
    parts = [
        ph.Pivot(first, name="1"),
        ph.Hinge(first, axis="z"),
        ph.Pivot(second, to=X * (a + b), name="2"),
        ph.Hinge(second, axis="z"),
        ph.Gear(first, radius=a, to=second, other_radius=b, axis=Z),
        ph.TorsionDamper(BETA, damping=c, on=second),
        ph.TorsionDamper(ALPHA, damping=c, on=first, name="other damper"),
    ]
    equations = ph.derive(ph.System(*parts))
    ratio = (a / b) ** 2
    rate = equations.kinetics.on_speeds(ALPHA.dt())
    found = equations.on_shell(equations.rate(rate))
    assert (found * J * (1 + ratio) + c * (1 + ratio) * rate).is_zero


def test_potential_of_a_pendulum_is_that_of_gravity():
    axes = LAB.rotated(ALPHA, "x")
    rod = ph.rod("rod", mass=m, length=l, axes=axes, axis="z")
    pivot = ph.Pivot(rod, at=axes["z"] * (l / 2))
    hinge = ph.Hinge(rod, axis="x")
    stored = ph.Potential(-m * g * l / 2 * ph.cos(ALPHA), on=rod)
    ours, usual = (ph.derive(ph.System(pivot, hinge, load)) for load in (stored, ph.Gravity(g)))
    assert ours.motion == usual.motion
    assert ours.energy == usual.energy


def test_potential_of_a_position_is_a_spring():
    ball = ph.point_mass("ball", mass=m, axes=LAB)
    x, y, z = ph.coordinates("x y z")
    stored = ph.Potential(k * (x**2 + y**2 + z**2) / 2, on=ball)
    spring = ph.Spring(ball.point(), Z * 0, stiffness=k)
    ours, usual = (ph.derive(ph.System(ball, load)) for load in (stored, spring))
    assert ours.motion == usual.motion
    assert ours.energy == usual.energy


def test_kepler_orbit_closes():
    r = ph.symbol("r", positive=True)
    planet = ph.point_mass("planet", mass=m, axes=LAB)
    sun = ph.CentralForce(planet.point(), Z * 0, energy=-k / r, distance=r)
    system = ph.System(ph.Pivot(planet, only="z"), sun)
    # vis viva with k/m = 1: 1/a = 2/r - v² = 1.36
    year = 2 * pi / 1.36**1.5
    run = ph.simulate(system, {"m": 2, "k": 2}, {"x": 1, "v_y": 0.8}, year)
    assert abs(run.final["x"] - 1) < 1e-12
    assert abs(run.final["y"]) < 1e-12
    assert run.drift.energy < 1e-13


def test_two_bodies_keep_their_centre_of_mass():
    r = ph.symbol("r", positive=True)
    one = ph.point_mass("one", mass=m, axes=LAB, tag="1")
    two = ph.point_mass("two", mass=2 * m, axes=LAB, tag="2")
    pull = ph.CentralForce(one.point(), two.point(), energy=-k / r, distance=r)
    equations = ph.derive(ph.System(pull))
    assert equations.on_shell(equations.linear_momentum.dot(X).dt()).is_zero
    assert equations.on_shell(equations.rate(equations.energy)).is_zero
    about = equations.angular_momentum()
    assert all(equations.on_shell(equations.rate(about.dot(e))).is_zero for e in (X, Y, Z))


def test_compass_needle():
    """Small oscillations with ω² = M B/J."""
    M, B = ph.symbols("M B", positive=True)
    needle = _disk("needle", LAB.rotated(ALPHA, "z"), "")
    field = ph.MagneticMoment(needle, needle.axes["x"] * M, X * B)
    parts = (ph.Pivot(needle), ph.Hinge(needle, axis="z"), field)
    equations = ph.derive(ph.System(*parts))
    assert (equations.on_shell(ALPHA.dt().dt()) * J + M * B * ph.sin(ALPHA)).is_zero
    assert equations.on_shell(equations.rate(equations.energy)).is_zero
    families = ph.steady(equations)
    answers = {str(f): str(ph.stability(f)) for f in families}
    assert answers == {"alpha = 0": "stable", "alpha = pi": "unstable"}


def test_torsion_pendulum_swings_in_time():
    disk = _disk("disk", LAB.rotated(ALPHA, "z"), "")
    wire = ph.TorsionSpring(ALPHA, stiffness=k, rest=0.1, on=disk)
    system = ph.System(ph.Pivot(disk), ph.Hinge(disk, axis="z"), wire)
    period = 2 * pi * (0.02 / 0.5) ** 0.5
    run = ph.simulate(system, {"J": 0.02, "k": 0.5}, {"alpha": 0.4}, period)
    expected = 0.1 + 0.3 * np.cos(2 * pi * run.t / period)
    assert abs(run["alpha"] - expected).max() < 1e-12


def test_mistakes_are_refused():
    disk = _disk("disk", LAB.rotated(ALPHA, "z"), "")
    r = ph.symbol("r")
    with pytest.raises(DeclarationError, match="coordinates"):
        ph.Potential(k, on=disk)
    with pytest.raises(DeclarationError, match="alpha_dot"):
        ph.Potential(ALPHA.dt() ** 2, on=disk)
    with pytest.raises(DeclarationError, match="angle"):
        ph.TorsionSpring(k, stiffness=1, on=disk)
    with pytest.raises(DeclarationError, match="torsion spring"):
        ph.TorsionSpring(ALPHA, stiffness=ALPHA, on=disk)
    with pytest.raises(DeclarationError, match="expression of r"):
        ph.CentralForce(disk.point(), Z * 0, energy=k, distance=r)
    with pytest.raises(DeclarationError, match="fixed in body"):
        ph.MagneticMoment(disk, X * k, Z * k)
    with pytest.raises(DeclarationError, match="no body"):
        ph.Potential(ALPHA, on=())
    with pytest.raises(DeclarationError, match="expected a Body"):
        ph.TorsionDamper(ALPHA, damping=k, on=3)
    with pytest.raises(DeclarationError, match="expected a Vector"):
        ph.MagneticMoment(disk, 3, Z * k)
    with pytest.raises(DeclarationError, match="no body moves"):
        ph.derive(ph.System(disk, ph.Potential(k * ph.coordinate("chi") ** 2, on=disk)))


def test_angles_measured_from_what_turns_with_time():
    (turn,) = ph.functions("f")
    base = LAB.rotated(turn, "z")
    disk = _disk("disk", base.rotated(ALPHA, "z"), "")
    held = (ph.Pivot(disk), ph.Hinge(disk, axis="z"))
    spring = ph.TorsionSpring(ALPHA, stiffness=k, on=disk)
    damper = ph.TorsionDamper(ALPHA, damping=c, on=disk)
    magnet = ph.MagneticMoment(disk, disk.axes["x"] * l, base["x"] * g)
    equations = ph.derive(ph.System(*held, spring, damper, magnet))
    found = equations.on_shell(ALPHA.dt().dt())
    couple = -k * ALPHA - c * ALPHA.dt() - l * g * ph.sin(ALPHA)
    assert (J * (found + turn.dt().dt()) - couple).is_zero
    assert equations.on_shell(equations.rate(equations.energy) - equations.power).is_zero


def test_damper_whose_other_end_turns_with_time():
    (turn,) = ph.functions("f")
    disk = _disk("disk", LAB.rotated(ALPHA, "z"), "")
    damper = ph.TorsionDamper(ALPHA - turn, damping=c, on=disk)
    equations = ph.derive(ph.System(ph.Pivot(disk), ph.Hinge(disk, axis="z"), damper))
    couple = equations.on_shell(ALPHA.dt().dt()) * J
    assert (couple + c * (ALPHA.dt() - turn.dt())).is_zero


def test_central_forces_act_at_points_of_bodies():
    disk = _disk("disk", LAB.rotated(ALPHA, "z"), "")
    r = ph.symbol("r")
    with pytest.raises(DeclarationError, match="fixed in the body"):
        ph.CentralForce(disk.point(X * l), Z * 0, energy=-k / r, distance=r)

"""The Earth as a root that turns, and as a frame turned by time about the same axis: one physics.

The first has its angular velocity given, the second gets it by differentiating rotations, so that
every constraint of the ground is taken at the ground's own velocity in both or in neither.
"""

from collections.abc import Callable

import pytest

import polhode as ph
from derive import declarations as declared
from derive.declarations import I_1, I_2, I_3, LAB, a, g, m, phi, theta
from polhode.derive import Equations

OMEGA, LATITUDE = ph.symbols("Omega_E lambda_", positive=True)
EARTH = ph.earth(OMEGA, colatitude=LATITUDE)
SKEW = (0, ph.sin(LATITUDE), ph.cos(LATITUDE))
TURNED = LAB.rotated(OMEGA * ph.time, SKEW)


def held_in_a_plane(ground: ph.Frame) -> Equations:
    """A guide of the axle, and a motor that keeps its rate against the ground."""
    axes = declared.following(ground)
    rotor = ph.Body("rotor", mass=m, inertia=(I_1, I_1, I_3), axes=axes, spin_about="3")
    guide = ph.Guide(rotor, axis="3", normal=ground["x"], label="q")
    motor = ph.Motor(rotor, axis="3", rate=ph.symbol("n"), relative_to=ground, torque="sigma")
    return ph.derive(ph.System(ph.Pivot(rotor, along=ground), guide, motor))


def slotted(ground: ph.Frame) -> Equations:
    """A slab whose slot slides over a pin of the ground."""
    axes = ground.rotated(phi, "z")
    slab = ph.Body("slab", mass=m, inertia=(I_1, I_2, I_3), axes=axes, surface=ph.Round(a))
    pin = ph.Pivot(slab, at=axes["y"] * a, along=axes, only="y", name="pin", force="P")
    level = [
        ph.Guide(slab, axis=label, normal=ground["z"], label=label, name=f"level {label}")
        for label in "xy"
    ]
    floor = ph.Smooth(slab, on=ph.Plane(ground))
    return ph.derive(ph.System(floor, *level, pin, declared.gravity(ground)))


def railed(ground: ph.Frame) -> Equations:
    """A ball on a floor, a point of which a straight rail of the ground guides."""
    ball = ph.sphere("ball", mass=m, radius=a, axes=ground, inertia=I_1)
    floor = ph.Smooth(ball, on=ph.Plane(ground), name="floor")
    rail = ph.Pivot(ball, to=ground["x"] * a, along=ground, only="y", name="rail", force="R")
    return ph.derive(ph.System(floor, rail, declared.gravity(ground)))


def skidding(ground: ph.Frame) -> Equations:
    """A ball that slides on a turntable of the ground, with friction."""
    table = ph.Turntable(ground, ph.symbol("n"))
    ball = ph.sphere("ball", mass=m, radius=a, axes=ground, inertia=I_1)
    contact = ph.Coulomb(ball, on=table, mu=ph.symbol("mu"))
    return ph.derive(ph.System(contact, declared.gravity(ground)))


def shaken(ground: ph.Frame) -> Equations:
    """A top on a pivot that goes along a path over the ground."""
    X, Y = ph.functions("X Y")
    return declared.top(ground, ground.vector(X, Y, 0))


SYSTEMS = [
    declared.rolling,
    skidding,
    declared.marble,
    declared.top,
    held_in_a_plane,
    slotted,
    railed,
    shaken,
]


@pytest.mark.parametrize("build", SYSTEMS)
def test_the_ground_turns_alike(build: Callable[[ph.Frame], Equations]) -> None:
    on_earth, turned = build(EARTH), build(TURNED)
    assert on_earth.speeds == turned.speeds
    assert on_earth.dependent == turned.dependent
    assert on_earth.rows == turned.rows
    assert on_earth.components == turned.components
    assert on_earth.energy == turned.energy


@pytest.mark.parametrize("build", SYSTEMS)
def test_a_ground_that_stops_turning_is_at_rest(build: Callable[[ph.Frame], Equations]) -> None:
    on_earth, rest = build(EARTH), build(LAB)
    still = {OMEGA: 0}
    assert [row.subs(still) for row in on_earth.rows] == list(rest.rows)
    assert {n: f.subs(still) for n, f in on_earth.components.items()} == rest.components


def test_a_hinge_of_the_turning_ground_holds_as_two_guides_do() -> None:
    """The couples are those about the two directions across the axle."""

    def turned(*joints: Callable[[ph.Body], ph.Hinge | ph.Guide], ground: ph.Frame) -> Equations:
        axes = ground.rotated(theta, "x")
        body = ph.Body("rotor", mass=m, inertia=(I_1, I_2, I_3), axes=axes)
        return ph.derive(ph.System(ph.Pivot(body), *(joint(body) for joint in joints)))

    hinged = turned(lambda body: ph.Hinge(body, axis="x"), ground=EARTH)
    guided = turned(
        lambda body: ph.Guide(body, axis="y", normal=TURNED["x"], label="y", name="y"),
        lambda body: ph.Guide(body, axis="z", normal=TURNED["x"], label="z", name="z"),
        ground=TURNED,
    )
    assert hinged.rows == guided.rows
    assert hinged.components["tau_y"] == guided.components["tau_z"]
    assert hinged.components["tau_z"] == -guided.components["tau_y"]


@pytest.mark.parametrize("build", [slotted, railed])
def test_what_closes_stays_closed(build: Callable[[ph.Frame], Equations]) -> None:
    """The rate of a gap vanishes along the motion where the gap does."""
    equations = build(EARTH)
    (gap,) = equations.closures
    y = ph.coordinate("y")
    shut = {y: ph.Expr.of(0)} if build is railed else {y: _shut(gap, y)}
    assert equations.rate(gap).subs(shut).is_zero


def _shut(gap: ph.Expr, y: ph.Expr) -> ph.Expr:
    """The value of one coordinate that closes a gap that is linear in it."""
    return -gap.subs({y: 0}) / gap.diff(y)


def test_gravity_does_the_same_work_over_the_turning_ground() -> None:
    for build in (declared.top, shaken, railed):
        equations = build(EARTH)
        assert equations.rate(equations.energy) == equations.on_shell(equations.power)
    assert g in [ph.Expr.generator(s) for s in declared.top(EARTH).parameters]

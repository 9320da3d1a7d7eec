"""Supports that other bodies carry, what must not vary, second spins: refused in words."""

from collections.abc import Callable

import pytest

import polhode as ph
from model.refusals import (
    AXES,
    DECLARATION,
    FLOOR,
    LAB,
    Refusal,
    a,
    body,
    g,
    is_refused,
    m,
    mu,
    phi,
    system,
    tilting,
    wheel,
)

s, x = ph.coordinates("s x")
TURNED = LAB.rotated(phi, "z")
SPUN = AXES.rotated(ph.coordinate("psi"), "3")
SPUN_OTHERWISE = AXES.rotated(s, "3")


def bob(tag: str = "b", axes: ph.Frame = LAB) -> ph.Body:
    return ph.point_mass(f"bob {tag}", mass=m, axes=axes, tag=tag)


def rod(tag: str) -> ph.Body:
    return ph.rod(f"rod {tag}", mass=m, length=a, axes=TURNED, tag=tag)


def turning(*parts: object) -> Callable[[], object]:
    """A flywheel that turns about the vertical, and what is declared with it."""
    rotor = flywheel()
    return system(rotor, ph.Pivot(rotor, name="axle"), ph.Hinge(rotor, axis="z"), *parts)


def flywheel() -> ph.Body:
    return ph.Body("flywheel", mass=m, inertia=(mu, mu, mu), axes=TURNED, tag="f")


def on_flywheel(contact: type[ph.Rolling], **more: object) -> Callable[[], object]:
    ball = ph.sphere("ball", mass=m, radius=a, axes=LAB, tag="b")
    return turning(contact(ball, on=ph.Turntable(LAB, phi.dt()), **more))


REFUSALS: dict[str, Refusal] = {
    # -- supports that other bodies carry
    "a load on the string of a windlass": (
        turning(ph.Pivot(bob(), to=LAB["z"] * (a * phi), name="string")),
        DECLARATION,
        ("'string'", "moves with phi_dot", "flywheel would not feel", "to=body.point(offset)"),
    ),
    "a load on the string of a motor": (
        turning(
            ph.Motor(flywheel(), axis="z", rate=1, relative_to=LAB, torque="sigma"),
            ph.Pivot(bob(), to=LAB["z"] * (a * phi), name="string"),
        ),
        DECLARATION,
        ("'string'", "flywheel would not feel"),
    ),
    "two rods that nothing keeps parallel": (
        system(
            ph.Pivot(rod("1"), to=TURNED["x"] * s, name="left"),
            ph.Pivot(rod("2"), to=TURNED["x"] * -s, name="right"),
        ),
        DECLARATION,
        ("'left'", "moves with", "cannot keep the body"),
    ),
    "a bead at a place along a body's axis": (
        turning(ph.Pivot(bob(), to=TURNED["x"] * s, name="bead")),
        DECLARATION,
        ("'bead'", "moves with phi_dot", "flywheel would not feel", "a body"),
    ),
    "a nut on a screw": (
        system(
            ph.Pivot(flywheel(), to=LAB["z"] * (a * phi)),
            ph.Hinge(flywheel(), axis="z"),
            ph.Gravity(g),
        ),
        DECLARATION,
        ("'pivot_f'", "moves with phi_dot", "cannot keep the body"),
    ),
    "a body on a light arm that nothing turns with it": (
        system(ph.Pivot(flywheel(), to=TURNED["x"] * a), ph.Gravity(g, up=LAB["x"])),
        DECLARATION,
        ("'pivot_f'", "moves with phi_dot", "cannot keep the body"),
    ),
    "a motor on axes that precess": (
        system(ph.Pivot(wheel(), at=AXES["3"] * a), ph.Motor(wheel(), axis="3", rate=1)),
        DECLARATION,
        ("'motor'", "moves with phi_dot", "cannot keep", "to=body"),
    ),
    "a gear by a motor": (
        turning(
            ph.Pivot(tilting("pinion", "x"), name="at"),
            ph.Motor(tilting("pinion", "x"), axis="3", rate=-2 * phi.dt(), relative_to=LAB),
        ),
        DECLARATION,
        ("'motor'", "moves with phi_dot", "flywheel would not feel", "a Rope or a Gear"),
    ),
    "a ball rolling on what another body turns": (
        on_flywheel(ph.Rolling),
        DECLARATION,
        (
            "'contact_b'",
            "moves with phi_dot",
            "flywheel would not feel",
            "give the body itself",
        ),
    ),
    "a ball sliding on what another body turns": (
        on_flywheel(ph.Coulomb, mu=mu),
        DECLARATION,
        ("'contact_b'", "moves with phi_dot", "flywheel would not feel"),
    ),
    "a spring wound up by a body": (
        turning(ph.Spring(bob().point(), LAB["z"] * (a * phi), stiffness=1)),
        DECLARATION,
        ("'spring'", "moves with phi_dot", "flywheel would not feel"),
    ),
    "a damper dragged by a body": (
        turning(ph.Damper(bob().point(), LAB["z"] * (a * phi), damping=1)),
        DECLARATION,
        ("'damper'", "moves with phi_dot", "flywheel would not feel"),
    ),
    "a spring whose end its own body draws along": (
        system(ph.Spring(bob().point(), LAB["x"] * (ph.coordinate("x_b") / 2), stiffness=1)),
        DECLARATION,
        ("'spring'", "moves with v_x_b", "bob b would not feel"),
    ),
    "a coordinate that moves nothing": (
        system(ph.Pivot(bob(), only="z", to=LAB["z"] * s)),
        DECLARATION,
        ("coordinate s", "no body's position or attitude", "functions(...)"),
    ),
    "a force by a coordinate that moves nothing": (
        system(ph.Force(bob().point(), LAB["z"] * (s * x))),
        DECLARATION,
        ("coordinate s, x", "no body's position or attitude"),
    ),
    # -- what must not vary
    "a place by a speed": (
        lambda: ph.Pivot(bob(), to=LAB["z"] * x.dt()),
        DECLARATION,
        ("place of 'pivot_b'", "x_dot", "coordinates, parameters and time"),
    ),
    "a spring to a place by a speed": (
        lambda: ph.Spring(bob().point(), LAB["z"] * x.dt(), stiffness=1),
        DECLARATION,
        ("end of 'spring'", "x_dot"),
    ),
    "axes turned by a speed": (
        lambda: LAB.rotated(phi.dt(), "z"),
        DECLARATION,
        ("rotation of 'lab'", "phi_dot"),
    ),
    "gravity by a coordinate": (
        lambda: ph.Gravity(g * x),
        DECLARATION,
        ("g of 'gravity'", "depends on x", "Force"),
    ),
    "gravity along axes that turn freely": (
        lambda: ph.Gravity(g, up=TURNED["x"]),
        DECLARATION,
        ("up of 'gravity'", "depends on phi"),
    ),
    "a spring that stiffens with a coordinate": (
        lambda: ph.Spring(bob().point(), LAB.zero, stiffness=1 + x),
        DECLARATION,
        ("stiffness of 'spring'", "depends on x", "Force"),
    ),
    "a ball that swells": (lambda: ph.Round(a * x), DECLARATION, ("radius", "varies with x")),
    "a rim that shifts": (
        lambda: ph.Rim(a, "3", a * ph.time),
        DECLARATION,
        ("offset of a rim", "varies with t"),
    ),
    "a face that sinks": (lambda: ph.Face(x), DECLARATION, ("height above", "varies with x")),
    "an ellipsoid that swells": (
        lambda: ph.Ellipsoidal((a, a, x)),
        DECLARATION,
        ("half-axis", "varies with x"),
    ),
    "a mass that leaks": (lambda: body(mass=m * ph.time), DECLARATION, ("varies with t", "rigid")),
    "a pivot that creeps along its body": (
        lambda: ph.Pivot(body(), at=AXES["1"] * ph.time),
        DECLARATION,
        ("point of 'pivot'", "fixed in the body"),
    ),
    "a cross arm that a body spins past": (
        lambda: ph.Universal(wheel(), arm=AXES["1"], other_arm=LAB["z"]),
        DECLARATION,
        ("arm of 'universal'", "fixed in body 'wheel'"),
    ),
    "a guide of an axis that a body spins past": (
        lambda: ph.Guide(wheel(), axis="1", normal=LAB["z"], label="q"),
        DECLARATION,
        ("axis '1' of 'guide'", "'wheel'", "fixed in the body"),
    ),
    # -- a second spin
    "a disk with axes that spin with it": (
        lambda: wheel(axes=SPUN),
        DECLARATION,
        ("body 'wheel'", "spin angle psi", "spin=WithAxes()", "another angle"),
    ),
    "a hoop with axes that spin with it": (
        lambda: ph.hoop("hoop", mass=m, radius=a, axes=SPUN, spin=ph.Relative("3")),
        DECLARATION,
        ("body 'hoop'", "spin angle psi", "spin=WithAxes()"),
    ),
    "a cylinder with axes that spin with it by another angle": (
        system(
            ph.Pivot(ph.cylinder("can", mass=m, radius=a, height=a, axes=SPUN_OTHERWISE)),
        ),
        DECLARATION,
        ("body 'can'", "spins about 3", "about the same axis with s", "spin=WithAxes()"),
    ),
    "the same by its spin relative to them": (
        system(ph.Pivot(wheel(axes=SPUN_OTHERWISE, spin=ph.Relative("3")))),
        DECLARATION,
        ("body 'wheel'", "about the same axis with s", "leave out that rotation"),
    ),
    "a ball with axes that turn for nothing": (
        system(ph.Rolling(ph.sphere("ball", mass=m, radius=a, axes=TURNED), on=FLOOR)),
        DECLARATION,
        ("body 'ball'", "about x, y, z", "about the same axis with phi"),
    ),
}


@pytest.mark.parametrize("name", REFUSALS)
def test_it_is_refused_in_words(name: str) -> None:
    is_refused(REFUSALS[name])

"""Declarations that make no sense: each is refused in words that say what and what instead."""

from collections.abc import Callable
from math import inf, nan

import pytest

import polhode as ph
from model.refusals import (
    AXES,
    CONSTRAINT,
    DECLARATION,
    FLOOR,
    LAB,
    NUMERIC,
    UNIT,
    Refusal,
    a,
    body,
    g,
    is_refused,
    m,
    mu,
    system,
    theta,
    tilting,
    wheel,
)

OTHER = ph.Frame("elsewhere")


def driven(first: int, second: int) -> Callable[[], object]:
    """A rolling wheel on two motors."""
    w = wheel()
    motors = (
        ph.Motor(w, axis="3", rate=first, name="slow", torque="tau"),
        ph.Motor(w, axis="3", rate=second, name="fast", torque="sigma"),
    )
    return system(ph.Rolling(w, on=FLOOR), *motors)


def rod_between(distance: ph.Expr) -> Callable[[], object]:
    """A rod of length two that does not turn, held at both ends, which are this far apart."""
    rod = ph.rod("rod", mass=m, length=2, axes=LAB)
    ends = (
        ph.Pivot(rod, at=-LAB["x"]),
        ph.Pivot(rod, at=LAB["x"], to=LAB["x"] * distance, name="far", force="G"),
    )
    return system(*ends)


def unheld() -> ph.Body:
    """A brick declared to turn about an axis that is not a principal one."""
    skew = (0, ph.Expr.of(3) / 5, ph.Expr.of(4) / 5)
    return body(axes=LAB.rotated(theta, skew))


def rolling_by_hand(*equations: tuple[str, str]) -> list[object]:
    """A wheel along a line, with equations between its place and its angle."""
    rolling = ph.Body("roller", mass=m, inertia=(m, m, m), axes=LAB.rotated(theta, "y"))
    constraints = [
        ph.Constraint(text, on=rolling, where={"a": a}, name=name, force=f"Q_{name}")
        for text, name in equations
    ]
    return [ph.Pivot(rolling, only="y z"), ph.Hinge(rolling, axis="y"), *constraints]


REFUSALS: dict[str, Refusal] = {
    # -- mass and inertia
    "mass negative": (
        lambda: body(mass=-1),
        DECLARATION,
        ("mass of body 'brick'", "-1", "positive mass in kg"),
    ),
    "mass zero, with moments of inertia": (
        lambda: body(mass=0),
        DECLARATION,
        ("mass of body 'brick'", "positive", "mass=0 and without moments"),
    ),
    "mass a negative symbol": (lambda: body(mass=-m), DECLARATION, ("-m", "positive mass")),
    "mass NaN": (lambda: body(mass=nan), DECLARATION, ("mass of body 'brick'", "nan", "finite")),
    "mass infinite": (lambda: body(mass=inf), DECLARATION, ("mass of body 'brick'", "inf")),
    "mass in words": (
        lambda: body(mass="2 kg"),
        DECLARATION,
        ("mass of body 'brick'", "'2 kg'", "a number, a symbol"),
    ),
    "mass that varies": (
        lambda: body(mass=m + theta),
        DECLARATION,
        ("mass of body 'brick'", "varies with theta", "rigid"),
    ),
    "moment NaN": (lambda: body(inertia=(1, 1, nan)), DECLARATION, ("inertia of body", "nan")),
    "moment negative": (
        lambda: body(inertia=(1, 1, -1)),
        DECLARATION,
        ("[1, 1, -1]", "'brick'", "negative"),
    ),
    "moments in no triangle": (
        lambda: body(inertia=(1, 1, 3)),
        DECLARATION,
        ("[1, 1, 3]", "triangle inequality", "no body"),
    ),
    "moments in no triangle, as symbols": (
        lambda: body(inertia=(m, m, 3 * m)),
        DECLARATION,
        ("3*m", "triangle inequality"),
    ),
    "matrix whose principal moments are in no triangle": (
        lambda: body(inertia=((1, 0.9, 0), (0.9, 1, 0), (0, 0, 1))),
        DECLARATION,
        ("9/10", "triangle inequality"),
    ),
    "matrix not symmetric": (
        lambda: body(inertia=((1, 0.1, 0), (0, 1, 0), (0, 0, 1))),
        DECLARATION,
        ("inertia of body 'brick'", "symmetric 3 by 3 matrix"),
    ),
    "two moments": (lambda: body(inertia=(1, 2)), DECLARATION, ("three principal moments",)),
    "one moment": (lambda: body(inertia=3), DECLARATION, ("three principal moments",)),
    # -- axes and spin
    "no axes": (lambda: body(axes=None), DECLARATION, ("axes of body 'brick'", "Frame")),
    "spin as a word": (lambda: body(spin="3"), DECLARATION, ("spin of body", "spin_about='3'")),
    "spin about no axis": (lambda: body(spin_about="7"), DECLARATION, ("'7'", "one of 1, 2, 3")),
    "lopsided body with axes that only follow it": (
        lambda: body(spin_about="3"),
        DECLARATION,
        ("'brick'", "about 3", "inertia to be symmetric"),
    ),
    "elliptic body with axes that only follow it": (
        lambda: body(inertia=(3, 3, 4), spin_about="3", surface=ph.Ellipsoidal((a, 2 * a, a))),
        DECLARATION,
        ("'brick'", "surface to be symmetric"),
    ),
    "brick by axes that do not follow it": (
        lambda: body(spin=ph.Free()),
        DECLARATION,
        ("'brick'", "symmetric"),
    ),
    "components along axes that cannot turn freely": (
        system(body(spin=ph.Components())),
        DECLARATION,
        ("components", "axes", "turn with phi, theta", "three angles"),
    ),
    "components by angles of another body": (
        system(body(spin=ph.Components(("phi", "theta", "psi_2")))),
        DECLARATION,
        ("angles=phi, theta, psi_2", "turn with phi, theta", "full names"),
    ),
    "components along axes at rest": (
        system(body(axes=LAB, spin=ph.Components())),
        DECLARATION,
        ("components", "'lab', which turn with no coordinate"),
    ),
    "an ellipsoid with two half-axes": (
        lambda: ph.Ellipsoidal((a, a)),
        DECLARATION,
        ("half-axes of an ellipsoid", "three lengths"),
    ),
    "an ellipsoid whose offset is one length": (
        lambda: ph.Ellipsoidal((a, a, a), offset=a),
        DECLARATION,
        ("offset of an ellipsoid", "three lengths"),
    ),
    "labels alike": (lambda: LAB.rotated(theta, "z", labels="1 1 2"), DECLARATION, ("three diff",)),
    "turn about a longer vector": (
        lambda: LAB.rotated(theta, (1, 1, 0)),
        DECLARATION,
        ("unit vector", "divide"),
    ),
    "turn about nothing": (lambda: LAB.rotated(theta, "q"), DECLARATION, ("'q'", "x, y, z")),
    "left-handed directions": (
        lambda: ph.earth(1, colatitude=1, directions="east up north"),
        DECLARATION,
        ("'east up north'", "right-handed"),
    ),
    # -- names and points
    "two unnamed torques on one body": (
        system(body(), *(ph.Torque(body(), LAB["x"] * moment) for moment in (m, a))),
        DECLARATION,
        ("two of the class Torque named 'torque'", "Torque(..., name='torque 2')"),
    ),
    "a torque and a force of one name": (
        system(
            ph.Torque(body(), LAB["x"], name="push"),
            ph.Force(body().point(), LAB["x"], name="push"),
        ),
        DECLARATION,
        ("a Torque and a Force named 'push'", "Force(..., name='push 2')"),
    ),
    "one load twice": (
        system(*(2 * [ph.Torque(body(), LAB["x"], name="drive")])),
        DECLARATION,
        ("'drive' twice in one system", "every load once"),
    ),
    "a pivot at a point that moves in the other body with time": (
        lambda: ph.Pivot(
            tilting("hook", "psi", tag="2"),
            to=body().point(AXES["3"] * ph.functions("L")[0]),
        ),
        DECLARATION,
        ("(0, 0, L)", "'brick'", "moves in it with L", "Slider(trolley", "Constraint(s - L"),
    ),
    "a pivot at a point given along the axes of the laboratory": (
        lambda: ph.Pivot(tilting("hook", "psi", tag="2"), to=body().point(LAB["z"] * a)),
        DECLARATION,
        ("fixed in the body", "along the axes of the body"),
    ),
    # -- surfaces and contacts
    "rim without a spin axis": (lambda: body(rim=1), DECLARATION, ("rim", "spin_about='3'")),
    "rod of negative length": (
        lambda: ph.rod("bar", mass=1, length=-1, axes=LAB),
        DECLARATION,
        ("length of 'bar'", "-1", "positive"),
    ),
    "cylinder without height": (
        lambda: ph.cylinder("can", mass=1, radius=1, height=0, axes=LAB, axis="z"),
        DECLARATION,
        ("height of 'can'", "0", "positive"),
    ),
    "radius negative": (
        lambda: ph.sphere("ball", mass=1, radius=-1, axes=LAB),
        DECLARATION,
        ("radius", "-1", "positive"),
    ),
    "no support": (
        lambda: ph.Rolling(wheel()),
        DECLARATION,
        ("contact 'contact'", "'wheel' with nothing", "Plane, Turntable, Sheet, Sphere"),
    ),
    "a frame for a support": (
        lambda: ph.Rolling(wheel(), on=LAB),
        DECLARATION,
        ("with a Frame", "give on=Plane(lab)"),
    ),
    "no surface": (
        lambda: ph.Rolling(body(), on=FLOOR),
        DECLARATION,
        ("'brick', which has no surface", "rim= or surface="),
    ),
    "a contact of no body": (
        lambda: ph.Rolling("wheel", on=FLOOR),
        DECLARATION,
        ("'wheel'", "Body"),
    ),
    "friction negative": (
        lambda: ph.Coulomb(wheel(), on=FLOOR, mu=-0.1),
        DECLARATION,
        ("friction coefficient of contact 'contact'", "-1/10", "zero or more"),
    ),
    "friction NaN": (
        lambda: ph.Coulomb(wheel(), on=FLOOR, mu=nan),
        DECLARATION,
        ("friction coefficient", "nan"),
    ),
    "friction where nothing slips": (
        system(
            ph.Rolling(wheel(), on=FLOOR, name="grip", force="G"),
            ph.Coulomb(wheel(), on=FLOOR, mu=mu),
        ),
        CONSTRAINT,
        ("friction at F_z", "cannot slip", "Rolling"),
    ),
    "turntable without a rate": (lambda: ph.Turntable(LAB, None), DECLARATION, ("Omega", "None")),
    "motion along one direction": (
        lambda: ph.Sheet(LAB, motion=(1,)),
        DECLARATION,
        ("motion of the sheet", "two directions"),
    ),
    # -- joints and loads
    "joint to itself": (
        lambda: ph.Pivot(wheel(), to=wheel().point(AXES.zero)),
        DECLARATION,
        ("joins body 'wheel' to itself", "another body"),
    ),
    "hinge to itself": (
        lambda: ph.Hinge(wheel(), axis="3", to=wheel()),
        DECLARATION,
        ("joins body 'wheel' to itself",),
    ),
    "hinge about nothing": (lambda: ph.Hinge(wheel(), axis="q"), DECLARATION, ("'q'", "1, 2, 3")),
    "pivot at a point that spins": (
        lambda: ph.Pivot(wheel(), at=AXES["1"] * a),
        DECLARATION,
        ("point of 'pivot'", "body 'wheel'", "fixed in the body"),
    ),
    "spring to a point that spins": (
        lambda: ph.Spring(wheel().point(AXES["1"] * a), LAB.zero, stiffness=1),
        DECLARATION,
        ("end of 'spring'", "fixed in the body"),
    ),
    "up that is no unit vector": (
        lambda: ph.Gravity(g, up=LAB["z"] * 2),
        DECLARATION,
        ("up of 'gravity'", "unit vector"),
    ),
    "gravity NaN": (lambda: ph.Gravity(nan), DECLARATION, ("g of 'gravity'", "nan")),
    # -- systems
    "nothing": (lambda: ph.System(), DECLARATION, ("without a body", "at least one Body")),
    "gravity alone": (lambda: ph.System(ph.Gravity(g)), DECLARATION, ("without a body",)),
    "a support in a system": (
        lambda: ph.System(wheel(), FLOOR),
        DECLARATION,
        ("a Plane in a system", "Rolling(body, on=Plane(lab))"),
    ),
    "two bodies alike": (
        lambda: ph.System(wheel(), wheel(tag="2")),
        DECLARATION,
        ("named 'wheel'", "every body"),
    ),
    "two contacts alike": (
        lambda: ph.System(ph.Smooth(wheel(), on=FLOOR), ph.Pivot(wheel(), name="contact")),
        DECLARATION,
        ("named 'contact'", "every contact or joint"),
    ),
    "two loads alike": (
        lambda: ph.System(wheel(), ph.Gravity(g), ph.Gravity(g)),
        DECLARATION,
        ("named 'gravity'", "every load"),
    ),
    "bodies from two roots": (
        lambda: ph.System(wheel(), ph.point_mass("moon", mass=1, axes=OTHER)),
        DECLARATION,
        ("different frames", "elsewhere, lab", "one root"),
    ),
    "support from another root": (
        system(ph.Smooth(wheel(), on=ph.Plane(OTHER))),
        DECLARATION,
        ("'elsewhere'", "one root"),
    ),
    "no such speed to keep": (
        system(wheel(), independent=(ph.symbol("q"),)),
        DECLARATION,
        ("independent=q", "one of the speeds", "omega_3"),
    ),
    "no such load": (
        lambda: ph.derive(ph.System(wheel(), ph.Gravity(g))).load_power("weight"),
        DECLARATION,
        ("'weight' is no load", "one of gravity"),
    ),
    "no such body": (lambda: ph.System(wheel()).body("ball"), DECLARATION, ("'ball'", "wheel")),
    "no such contact": (
        lambda: ph.System(wheel()).element("table"),
        DECLARATION,
        ("'table'", "no contact or joint"),
    ),
    # -- names
    "coordinates of two bodies": (
        system(ph.Smooth(wheel(), on=FLOOR), ph.Smooth(wheel("coin"), on=FLOOR, name="second")),
        DECLARATION,
        ("coordinate x of both 'wheel' and 'coin'", "tag='2'"),
    ),
    "speeds of two bodies": (
        system(
            ph.Pivot(tilting("first", "theta")),
            ph.Pivot(tilting("second", "phi"), name="other", force="G"),
        ),
        DECLARATION,
        ("speed omega_3 of both 'first' and 'second'", "tag"),
    ),
    "reactions of one name": (
        system(ph.Pivot(body()), ph.Hold(body(), at=AXES["3"], force="F")),
        DECLARATION,
        ("F_x", "'pivot' and 'hold'", "force='G'"),
    ),
    "a force called as a reaction": (
        system(
            ph.Smooth(wheel(), on=FLOOR),
            ph.Force(wheel().point(AXES.zero), LAB["z"] * ph.symbol("F_z")),
        ),
        DECLARATION,
        ("F_z", "'contact'", "symbol", "another letter"),
    ),
    "a parameter called as a speed": (
        system(wheel(), ph.Gravity(ph.symbol("omega_3"))),
        DECLARATION,
        ("both called 'omega_3'", "one meaning"),
    ),
    "a bare number for a mass": (
        lambda: (
            ph.derive(
                ph.System(
                    ph.Pivot(ph.rod("bar", mass=2, length=a, axes=AXES, axis="3"), at=AXES["3"] * a)
                )
            ).dimensions
        ),
        UNIT,
        ("bare number as mass of bar", "a symbol", "kg", "give its value at run time"),
    ),
    # -- constraints
    "two motors at odds": (
        driven(1, 2),
        CONSTRAINT,
        ("contradict one another", "tau_3, sigma_3", "remove one"),
    ),
    "a loop that never closes": (
        rod_between(ph.Expr.of(3)),
        CONSTRAINT,
        ("'far', which never closes", "check lengths"),
    ),
    "axes that nothing holds": (
        lambda: ph.derive(ph.System(ph.Pivot(unheld()), ph.Gravity(g))).components,
        CONSTRAINT,
        ("nothing supplies the couple", "brick", "Hinge, Guide, Universal or Motor"),
    ),
    "a spring that begins at a place": (
        lambda: ph.Spring(LAB.zero, wheel().point(), stiffness=1),
        DECLARATION,
        ("start of 'spring'", "a BodyPoint", "body.point()"),
    ),
    "a damper that ends at a body": (
        lambda: ph.Damper(wheel().point(), wheel("other"), damping=1),
        DECLARATION,
        ("end of 'damper'", "a BodyPoint", "a place from the origin"),
    ),
    "a force on a body, at no point of it": (
        lambda: ph.Force(wheel(), LAB["x"]),
        DECLARATION,
        ("point of 'force'", "a BodyPoint"),
    ),
    "a couple without direction": (
        lambda: ph.Torque(wheel(), m),
        DECLARATION,
        ("'torque'", "a Vector", "along a frame"),
    ),
    "a body to be derived": (
        lambda: ph.derive(wheel()),
        DECLARATION,
        ("derive of", "a System"),
    ),
    "an equation that holds already": (
        system(*rolling_by_hand(("x - a*theta = 0", "c"), ("2*x = 2*a*theta", "again"))),
        CONSTRAINT,
        ("whose rate of change is zero by the other", "leave it out"),
    ),
    "equations at odds by a constant": (
        system(*rolling_by_hand(("x - a*theta = 0", "c"), ("x = a*theta + a", "again"))),
        CONSTRAINT,
        ("whose rate of change is zero by the other", "contradicts them"),
    ),
    "an equation that a joint keeps": (
        system(*rolling_by_hand(("z = 0", "c"))),
        CONSTRAINT,
        ("'c', whose rate of change is zero",),
    ),
    "rates at odds": (
        system(
            *rolling_by_hand(
                ("x_dot = a*theta_dot", "c"),
                ("x_dot = 2*a*theta_dot + a", "again"),
                ("x_dot = a", "third"),
            )
        ),
        CONSTRAINT,
        ("contradict one another",),
    ),
    "two equals signs": (
        lambda: ph.Constraint("x = z = 0", on=body()),
        DECLARATION,
        ("x = z = 0", "one equation", "for each equation"),
    ),
    "an inequality": (
        lambda: ph.Constraint("x > 0", on=body()),
        DECLARATION,
        ("x > 0", "one equation"),
    ),
    "a letter without a meaning": (
        lambda: ph.Constraint("x - R*theta = 0", on=body(), name="roll"),
        ph.ParseError,
        ("'roll'", "'R' is not known", "where={'R': R}"),
    ),
    "an equation that is always true": (
        lambda: ph.Constraint("x - x = 0", on=body()),
        DECLARATION,
        ("0 = 0", "an equation in coordinates"),
    ),
    "a class in a system": (
        lambda: ph.System(body(), ph.Gravity),
        DECLARATION,
        ("the class Gravity", "Gravity(...)"),
    ),
    "a list of parts": (
        lambda: ph.System([body(), ph.Gravity(g)]),
        DECLARATION,
        ("a list in a system", "System(*parts)"),
    ),
    "a pivot on a body, at no point of it": (
        lambda: ph.Pivot(wheel(), to=body()),
        DECLARATION,
        ("to= of 'pivot'", "body.point(offset)"),
    ),
    "a pivot at a number": (lambda: ph.Pivot(wheel(), to=3), DECLARATION, ("3", "a Vector")),
    "a pivot at three numbers": (
        lambda: ph.Pivot(wheel(), at=(0, 0, 1)),
        DECLARATION,
        ("at= of 'pivot'", "a Vector"),
    ),
    "a pivot of a name": (lambda: ph.Pivot("wheel"), DECLARATION, ("'wheel'", "a Body")),
    "a slider to a word": (
        lambda: ph.Slider(body(), axis="x", to="origin"),
        DECLARATION,
        ("to= of 'slider'", "a Vector"),
    ),
    "a point at a number": (lambda: body().point(2), DECLARATION, ("point of body", "a Vector")),
    "motion that nothing resists": (
        system(ph.Pivot(ph.point_mass("p", mass=m, axes=AXES))),
        NUMERIC,
        ("p, whose motion with phi_dot, theta_dot no mass or inertia resists",),
    ),
    "a thin rod that may spin": (
        system(ph.Pivot(ph.rod("bar", mass=m, length=a, axes=AXES, axis="1"), at=AXES["1"] * a)),
        NUMERIC,
        ("bar, whose motion with theta_dot", "leave out an angle"),
    ),
    "a massless body alone": (
        system(ph.point_mass("link", mass=0, axes=LAB), ph.Gravity(g)),
        NUMERIC,
        ("link, whose motion with v_x, v_y, v_z no mass", "give the body a mass"),
    ),
    "a massless body that only its own joint holds": (
        system(
            ph.Pivot(ph.Body("link", mass=0, axes=LAB.rotated(ph.coordinate("beta"), "x"))), wheel()
        ),
        NUMERIC,
        ("link, whose motion with beta_dot", "hold it with one more joint"),
    ),
}


@pytest.mark.parametrize("name", REFUSALS)
def test_it_is_refused_in_words(name: str) -> None:
    is_refused(REFUSALS[name])

"""Balls on curved supports: on a sphere, in a bowl, in a standing cylinder, in a cone."""

import polhode as ph
from polhode.catalogue._entry import GRAVITY, CatalogueEntry, Parameter
from polhode.model import Support

_BALL = (
    Parameter("m", "kg", "50 g", "mass of the ball"),
    Parameter("a", "m", "20 mm", "radius of the ball"),
    GRAVITY,
)


def _rolling(name: str, support: Support) -> ph.System:
    """A uniform ball, with axes along the triad u, v, n of the support that it rolls on."""
    m, a, g = ph.symbols("m a g", positive=True)
    ball = ph.sphere("ball", mass=m, radius=a, axes=support.axes)
    called = name.rpartition("-")[2]
    return ph.System(ph.Rolling(ball, on=support, name=called), ph.Gravity(g), name=name)


def _on_sphere() -> ph.System:
    return _rolling("ball-on-sphere", ph.Sphere(ph.Frame("lab"), radius=ph.symbol("R")))


def _in_bowl() -> ph.System:
    bowl = ph.Sphere(ph.Frame("lab"), radius=ph.symbol("R"), inside=True)
    return _rolling("ball-in-bowl", bowl)


def _in_cylinder() -> ph.System:
    drum = ph.Cylinder(ph.Frame("lab"), radius=ph.symbol("R"), inside=True, axis="z")
    return _rolling("ball-in-cylinder", drum)


def _in_cone() -> ph.System:
    cone = ph.Cone(ph.Frame("lab"), half_angle=ph.symbol("alpha"), inside=True)
    return _rolling("ball-in-cone", cone)


ON_SPHERE = CatalogueEntry(
    name="ball-on-sphere",
    title="Ball on a sphere",
    about=(
        "A ball rolls off a fixed sphere, displaced a little from the top, and leaves it where "
        "the sphere would have to pull. u and v are longitude and latitude of the point of "
        "contact, zero at the top."
    ),
    whatever_touches="A ball on a fixed sphere, displaced a little from the top.",
    build=_on_sphere,
    parameters=(*_BALL, Parameter("R", "m", "0.2 m", "radius of the sphere")),
    start={"u": "3 deg"},
    duration="0.8 s",
    plots=(("u",), ("F_u", "F_n")),
)

IN_BOWL = CatalogueEntry(
    name="ball-in-bowl",
    title="Ball in a bowl",
    about=(
        "A ball rolls in a spherical bowl. Near the bottom it oscillates with the frequency "
        "given by 5g/(7(R - a)). u and v are longitude and latitude of the point of contact, zero "
        "at the bottom."
    ),
    whatever_touches="A ball in a spherical bowl.",
    build=_in_bowl,
    parameters=(*_BALL, Parameter("R", "m", "0.2 m", "radius of the bowl")),
    start={"u": "40 deg", "v_dot": "2 rad/s", "omega_n": "20 rad/s"},
    duration="5 s",
    plots=(("u", "v"), ("F_u", "F_v", "F_n")),
)

IN_CYLINDER = CatalogueEntry(
    name="ball-in-cylinder",
    title="Ball in a standing cylinder",
    about=(
        "A ball rolls around in a cylinder that stands upright. It neither falls nor escapes: it "
        "oscillates up and down, sqrt(2/7) times for each turn. u is the angle about the axis, v "
        "the height of the point of contact."
    ),
    whatever_touches="A ball in a cylinder that stands upright.",
    build=_in_cylinder,
    parameters=(*_BALL, Parameter("R", "m", "0.1 m", "radius of the cylinder")),
    start={"u_dot": "20 rad/s"},
    duration="3 s",
    plots=(("v",), ("omega_n",), ("F_u", "F_v", "F_n")),
)

IN_CONE = CatalogueEntry(
    name="ball-in-cone",
    title="Ball in a cone",
    about=(
        "A ball rolls around in a cone with a vertical axis, and swings between two heights. u is "
        "the angle about the axis, v the distance of the point of contact from the apex."
    ),
    whatever_touches="A ball in a cone with a vertical axis.",
    build=_in_cone,
    parameters=(*_BALL, Parameter("alpha", "", "40 deg", "angle of the cone to its axis")),
    start={"v": "0.3 m", "u_dot": "5 rad/s"},
    duration="5 s",
    plots=(("v",), ("u_dot",), ("F_u", "F_v", "F_n")),
)

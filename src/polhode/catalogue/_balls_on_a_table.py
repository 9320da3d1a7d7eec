"""Balls on a table: one that is struck, one that bounces, and two that collide."""

import polhode as ph
from polhode.catalogue._entry import GRAVITY, CatalogueEntry, Parameter


def _cue_ball() -> ph.System:
    m, a, mu, g = ph.symbols("m a mu g", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    cloth = ph.Coulomb(ball, on=ph.Plane(lab), mu=mu, name="cloth")
    return ph.System(cloth, ph.Gravity(g), name="cue-ball")


def _superball() -> ph.System:
    m, a, g = ph.symbols("m a g", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    floor = ph.Rolling(ball, on=ph.Plane(lab), restitution=(1, 1), name="floor")
    return ph.System(floor, ph.Gravity(g), name="superball")


def _two_balls() -> ph.System:
    m, M, a, R, e = ph.symbols("m M a R e", positive=True)
    lab = ph.Frame("lab")
    one = ph.sphere("one", mass=M, radius=R, axes=lab, tag="1")
    other = ph.sphere("other", mass=m, radius=a, axes=lab)
    contact = ph.Smooth(other, on=ph.Sphere(one, radius=R), restitution=e)
    return ph.System(one, other, contact, name="two-balls")


CUE_BALL = CatalogueEntry(
    name="cue-ball",
    title="Cue ball",
    about=(
        "A billiard ball, struck with spin, slides on the cloth along a parabola until it rolls, "
        "and then goes straight."
    ),
    whatever_touches="A billiard ball, struck with spin.",
    build=_cue_ball,
    parameters=(
        Parameter("m", "kg", "170 g", "mass of the ball"),
        Parameter("a", "m", "28.5 mm", "radius of the ball"),
        Parameter("mu", "", "0.2", "coefficient of friction of ball and cloth"),
        GRAVITY,
    ),
    start={"v_x": "2 m/s", "omega_x": "60 rad/s", "omega_y": "-30 rad/s"},
    duration="2 s",
    plots=(("v_x", "v_y"), ("omega_x", "omega_y"), ("F_x", "F_y")),
)

SUPERBALL = CatalogueEntry(
    name="superball",
    title="Superball",
    about=(
        "A perfectly elastic rough ball bounces on a floor. Each bounce reverses the velocity of "
        "its lowest point along the floor, so that it hops to and fro."
    ),
    whatever_touches="A ball bounces on a floor.",
    build=_superball,
    parameters=(
        Parameter("m", "kg", "50 g", "mass of the ball"),
        Parameter("a", "m", "40 mm", "radius of the ball"),
        GRAVITY,
    ),
    start={"z": "0.25 m", "v_x": "0.4 m/s", "omega_y": "-25 rad/s"},
    duration="3 s",
    plots=(("z",), ("v_x", "omega_y")),
)

TWO_BALLS = CatalogueEntry(
    name="two-balls",
    title="Two balls that collide",
    about=(
        "A ball hits another one off centre, without friction and without gravity. Where they "
        "touch is described by u and v, longitude and latitude on the one that is hit, and their "
        "distance by gap. With friction they also exchange spin."
    ),
    whatever_touches="A ball hits another one off centre, without gravity.",
    build=_two_balls,
    parameters=(
        Parameter("m", "kg", "0.1 kg", "mass of the ball that moves"),
        Parameter("M", "kg", "0.3 kg", "mass of the ball that is hit"),
        Parameter("a", "m", "30 mm", "radius of the ball that moves"),
        Parameter("R", "m", "50 mm", "radius of the ball that is hit"),
        Parameter("e", "", "0.9", "coefficient of restitution"),
    ),
    start={
        "gap": "5 cm",
        "u": "0.4 rad",
        "gap_dot": "-1 m/s",
        "u_dot": "2 rad/s",
        "omega_z": "7 rad/s",
    },
    duration="0.3 s",
    plots=(("gap",), ("omega_x", "omega_y", "omega_z")),
)

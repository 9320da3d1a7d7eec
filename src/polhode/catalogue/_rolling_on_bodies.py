"""Bodies that roll on bodies which are free to move: on a wedge, in a pipe."""

import polhode as ph
from polhode.catalogue._entry import GRAVITY, CatalogueEntry, Parameter


def _on_wedge() -> ph.System:
    m, M, a, h, alpha, inertia, g = ph.symbols("m M a h alpha I g", positive=True)
    lab = ph.Frame("lab")
    moments = (inertia, inertia, inertia)
    wedge = ph.Body("wedge", mass=M, inertia=moments, axes=lab, surface=ph.Face(h), tag="w")
    about = ph.About("x", "phi")
    roller = ph.cylinder("cylinder", mass=m, radius=a, height=2 * a, axes=lab, axis="x", spin=about)
    return ph.System(
        ph.Smooth(wedge, on=ph.Plane(lab), name="table"),
        ph.Rolling(roller, on=ph.Plane(wedge, tilt=alpha), name="slope"),
        ph.Gravity(g),
        name="cylinder-on-wedge",
    )


def _in_pipe() -> ph.System:
    m, M, a, R, g = ph.symbols("m M a R g", positive=True)
    lab = ph.Frame("lab")
    pipe = ph.cylinder(
        "pipe",
        mass=M,
        radius=R,
        height=2 * a,
        inertia=(M * R**2, M * R**2, M * R**2),
        axes=lab,
        axis="x",
        spin=ph.About("x", "theta"),
        tag="p",
    )
    inside = ph.Cylinder(pipe, radius=R, inside=True, axis="x")
    about = ph.About("v", "phi")
    roller = ph.cylinder(
        "cylinder", mass=m, radius=a, height=2 * a, axes=inside.axes, axis="v", spin=about
    )
    return ph.System(
        ph.Rolling(pipe, on=ph.Plane(lab), name="floor"),
        ph.Rolling(roller, on=inside, name="wall"),
        ph.Hinge(pipe, axis="x", name="guide"),
        ph.Hinge(roller, axis="v", name="inner guide"),
        ph.Gravity(g),
        name="cylinder-in-pipe",
    )


ON_WEDGE = CatalogueEntry(
    name="cylinder-on-wedge",
    title="Cylinder on a free wedge",
    about=(
        "A uniform cylinder rolls down a wedge that is free to slide on a smooth table. The wedge "
        "is pushed back, and the momentum of both along the table stays zero."
    ),
    build=_on_wedge,
    parameters=(
        Parameter("m", "kg", "0.5 kg", "mass of the cylinder"),
        Parameter("M", "kg", "1 kg", "mass of the wedge"),
        Parameter("a", "m", "30 mm", "radius of the cylinder"),
        Parameter("alpha", "", "25 deg", "slope of the wedge"),
        Parameter("h", "m", "60 mm", "height of the wedge's centre of mass over the table"),
        GRAVITY,
    ),
    start={"y": "0.1 m"},
    duration="0.4 s",
    plots=(("y", "y_w"), ("omega_x", "v_y_w")),
)

IN_PIPE = CatalogueEntry(
    name="cylinder-in-pipe",
    title="Cylinder in a pipe",
    about=(
        "A thin pipe rolls on a floor, and a uniform cylinder rolls in it. Both rock against each "
        "other; u is the angle of the point of contact from the lowest line of the pipe."
    ),
    whatever_touches="A thin pipe on a floor, and a uniform cylinder in it.",
    build=_in_pipe,
    parameters=(
        Parameter("m", "kg", "0.5 kg", "mass of the cylinder"),
        Parameter("M", "kg", "0.5 kg", "mass of the pipe"),
        Parameter("a", "m", "30 mm", "radius of the cylinder"),
        Parameter("R", "m", "0.1 m", "radius of the pipe"),
        GRAVITY,
    ),
    start={"u": "60 deg"},
    duration="4 s",
    plots=(("u",), ("v_y_p", "omega_v"), ("F_z_p", "F_n")),
)

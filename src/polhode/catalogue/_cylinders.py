"""Cylinders that roll: on a wedge that is free to move, and in a fixed cylinder."""

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


def _in_cylinder() -> ph.System:
    m, a, R, g = ph.symbols("m a R g", positive=True)
    trough = ph.Cylinder(ph.Frame("lab"), radius=R, inside=True, axis="x")
    about = ph.About("v", "phi")
    roller = ph.cylinder(
        "cylinder", mass=m, radius=a, height=2 * a, axes=trough.axes, axis="v", spin=about
    )
    return ph.System(
        ph.Rolling(roller, on=trough, name="trough"),
        ph.Hinge(roller, axis="v", name="guide"),
        ph.Gravity(g),
        name="cylinder-in-cylinder",
    )


ON_WEDGE = CatalogueEntry(
    name="cylinder-on-wedge",
    title="Cylinder on a free wedge",
    about=(
        "A uniform cylinder rolls down a wedge that is free to slide on a smooth table. The wedge "
        "is pushed back, and the momentum of both along the table stays zero."
    ),
    whatever_touches="A uniform cylinder on a wedge that is free to slide.",
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

IN_CYLINDER = CatalogueEntry(
    name="cylinder-in-cylinder",
    title="Cylinder in a cylinder",
    about=(
        "A uniform cylinder rolls to and fro in a hollow one, near the bottom with the frequency "
        "given by 2g/(3(R - a)). u is the angle of the point of contact from the lowest line."
    ),
    whatever_touches="A uniform cylinder in a hollow one.",
    build=_in_cylinder,
    parameters=(
        Parameter("m", "kg", "0.5 kg", "mass of the cylinder"),
        Parameter("a", "m", "30 mm", "radius of the cylinder"),
        Parameter("R", "m", "0.15 m", "radius of the hollow cylinder"),
        GRAVITY,
    ),
    start={"u": "70 deg"},
    duration="4 s",
    plots=(("u",), ("omega_v",), ("F_u", "F_n")),
)

"""A cone that rolls on its side around its apex."""

import polhode as ph
from polhode.catalogue._entry import GRAVITY, CatalogueEntry, Parameter


def _rolling_cone() -> ph.System:
    m, h, alpha, g = ph.symbols("m h alpha g", positive=True)
    lab = ph.Frame("lab")
    # axis 3 from the base to the apex, which is down: the lowest line of its side is level
    axes = lab.rotated(ph.coordinate("phi"), "z").rotated(ph.pi / 2 + alpha, "y", labels="1 2 3")
    cone = ph.cone(
        "cone", mass=m, radius=h * ph.tan(alpha), height=h, axes=axes, spin=ph.Relative("3")
    )
    apex = axes["3"] * (3 * h / 4)
    return ph.System(
        ph.Pivot(cone, at=apex, name="apex"),
        ph.Rolling(cone, on=ph.Plane(lab), name="edge", force="N"),
        ph.Gravity(g),
        name="rolling-cone",
    )


ROLLING_CONE = CatalogueEntry(
    name="rolling-cone",
    title="Rolling cone",
    about=(
        "A uniform cone rolls on its side around its apex. The table presses on it along a line, "
        "of which the ends are the apex (F) and the edge of the base (N). Too fast, it tips about "
        "the edge: the apex would have to be held down."
    ),
    whatever_touches="A uniform cone rolls on its side around its apex.",
    build=_rolling_cone,
    parameters=(
        Parameter("m", "kg", "0.3 kg", "mass of the cone"),
        Parameter("h", "m", "0.12 m", "its height"),
        Parameter("alpha", "rad", "25 deg", "half of the angle at its apex"),
        GRAVITY,
    ),
    start={"phi_dot": "4 rad/s"},
    duration="6 s",
    plots=(("phi_dot",), ("F_z", "N_z")),
)

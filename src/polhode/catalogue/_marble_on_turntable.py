"""Problem 3: a marble that rolls on a turntable, level or tilted."""

import polhode as ph
from polhode.catalogue._entry import GRAVITY, CatalogueEntry, Parameter


def _level() -> ph.System:
    m, a, inertia, g = ph.symbols("m a I g", positive=True)
    lab = ph.Frame("lab")
    marble = ph.sphere("marble", mass=m, radius=a, inertia=inertia, axes=lab)
    table = ph.Rolling(marble, on=ph.Turntable(lab, ph.symbol("Omega")), name="table")
    return ph.System(table, ph.Gravity(g), name="marble-on-turntable")


def _tilted() -> ph.System:
    m, a, inertia, g = ph.symbols("m a I g", positive=True)
    lab = ph.Frame("lab")
    slope = ph.upright(lab).rotated(-ph.symbol("alpha"), "3", name="slope")
    marble = ph.sphere("marble", mass=m, radius=a, inertia=inertia, axes=slope)
    turntable = ph.Turntable(slope, ph.symbol("Omega"), normal="1")
    table = ph.Rolling(marble, on=turntable, name="table")
    return ph.System(table, ph.Gravity(g), name="marble-on-turntable/tilted")


_PARAMETERS = (
    Parameter("m", "kg", "5 g", "mass of the marble"),
    Parameter("a", "m", "8 mm", "radius of the marble"),
    Parameter("I", "kg m^2", "2*m*a**2/5", "moment of inertia of the marble about its centre"),
    GRAVITY,
    Parameter("Omega", "rad/s", "33 rpm", "angular velocity of the turntable"),
)

MARBLE_ON_TURNTABLE = CatalogueEntry(
    name="marble-on-turntable",
    title="Marble on a turntable",
    about=(
        "A marble rolls without slipping on a level turntable that turns at a constant rate. "
        "Seen from the laboratory its centre runs round a circle at constant speed, at two "
        "sevenths of the turntable's rate if it is uniform."
    ),
    whatever_touches="A marble on a level turntable that turns at a constant rate.",
    build=_level,
    parameters=_PARAMETERS,
    start={"x": "0.1 m", "v_y": "0.05 m/s"},
    duration="10 s",
    plots=(("x", "y"), ("v_x", "v_y"), ("F_x", "F_y", "F_z")),
)

TILTED = CatalogueEntry(
    name="marble-on-turntable/tilted",
    title="Marble on a tilted turntable",
    about=(
        "The turntable is tilted by α. Axis 1 is its normal, 2 points up the slope, 3 = 1 × 2 is "
        "horizontal. A steady horizontal drift is superposed on the circle."
    ),
    whatever_touches=(
        "A marble on a turntable that is tilted by α. Axis 1 is its normal, 2 points up the "
        "slope, 3 = 1 × 2 is horizontal."
    ),
    build=_tilted,
    parameters=(*_PARAMETERS, Parameter("alpha", "", "2 deg", "tilt of the turntable")),
    start={"x_2": "0.1 m", "v_3": "0.05 m/s"},
    duration="20 s",
    plots=(("x_2", "x_3"), ("v_2", "v_3"), ("F_1", "F_2", "F_3")),
)

"""A ball whose centre of mass is off its centre, and which turns over as it spins."""

import polhode as ph
from polhode.catalogue._entry import GRAVITY, CatalogueEntry, Parameter


def _tippe_top() -> ph.System:
    m, R, h, across, along, g = ph.symbols("m R h A C g", positive=True)
    theta, phi = ph.coordinates("theta phi")
    lab = ph.Frame("lab")
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3", name="axes")
    moments = (across, across, along)
    round_ = ph.Round(R, "3", h)
    top = ph.Body("top", mass=m, inertia=moments, axes=axes, spin_about="3", surface=round_)
    table = ph.Rolling(top, on=ph.Plane(lab), name="table")
    return ph.System(table, ph.Gravity(g), name="tippe-top")


TIPPE_TOP = CatalogueEntry(
    name="tippe-top",
    title="Tippe top",
    about=(
        "A ball whose centre of mass is below its centre is spun on a table. Where it rolls it has "
        "two integrals besides the energy, Jellett's and Routh's. Where it slides, with friction, "
        "it keeps Jellett's and turns over, so that the centre of mass rises."
    ),
    whatever_touches="A ball whose centre of mass is below its centre is spun on a table.",
    build=_tippe_top,
    parameters=(
        Parameter("m", "kg", "6 g", "mass"),
        Parameter("R", "m", "15 mm", "radius"),
        Parameter("h", "m", "3 mm", "distance of the centre of mass from the centre"),
        Parameter("A", "kg m^2", "8e-7 kg m^2", "moment of inertia across axis 3"),
        Parameter("C", "kg m^2", "7e-7 kg m^2", "moment of inertia about axis 3"),
        GRAVITY,
    ),
    start={"theta": "0.1 rad", "phi_dot": "200 rad/s", "omega_3": "199 rad/s"},
    duration="2 s",
    plots=(("theta",), ("phi_dot", "omega_3"), ("F_z",)),
)

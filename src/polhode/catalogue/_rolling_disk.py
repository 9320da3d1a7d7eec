"""Problem 2: a disk that rolls without slipping."""

import polhode as ph
from polhode.catalogue._entry import GRAVITY, CatalogueEntry, Parameter
from polhode.catalogue._text_axes import following_axes


def _disk() -> ph.System:
    m, a, g = ph.symbols("m a g", positive=True)
    lab = ph.Frame("lab")
    disk = ph.disk("disk", mass=m, radius=a, axes=following_axes(lab))
    ground = ph.Rolling(disk, on=ph.Plane(lab), name="ground")
    return ph.System(ground, ph.Gravity(g), name="rolling-disk")


ROLLING_DISK = CatalogueEntry(
    name="rolling-disk",
    title="Rolling disk",
    about=(
        "A thin uniform disk rolls without slipping on a horizontal plane, leaning and steering "
        "as it likes. The plane supplies whatever force that takes."
    ),
    whatever_touches=(
        "A thin uniform disk on a horizontal plane, leaning and steering as it likes."
    ),
    build=_disk,
    parameters=(
        Parameter("m", "kg", "0.2 kg", "mass of the disk"),
        Parameter("a", "m", "30 mm", "radius of the disk"),
        GRAVITY,
    ),
    start={"theta": "80 deg", "phi_dot": "1 rad/s", "omega_3": "40 rad/s"},
    duration="10 s",
    plots=(("theta",), ("phi_dot", "omega_3"), ("F_x", "F_y", "F_z")),
)

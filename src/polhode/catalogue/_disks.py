"""Problems 1 and 2, a coin that spins and a disk that rolls, and Euler's disk."""

import polhode as ph
from polhode.catalogue._entry import GRAVITY, CatalogueEntry, Parameter


def _following_axes(ground: ph.Frame) -> ph.Frame:
    """Axes 1, 2, 3 that follow a disk but do not spin with it.

    1 is horizontal, 2 points up the steepest diameter, 3 is the symmetry axis at θ to the
    vertical; φ turns them about the vertical (problem 2).
    """
    theta, phi = ph.coordinates("theta phi")
    return ground.rotated(phi, "z").rotated(theta, "x", labels="1 2 3", name="axes")


def _coin() -> ph.System:
    m, a, g = ph.symbols("m a g", positive=True)
    lab = ph.Frame("lab")
    coin = ph.disk("coin", mass=m, radius=a, axes=_following_axes(lab))
    table = ph.Smooth(coin, on=ph.Plane(lab), name="table")
    return ph.System(table, ph.Gravity(g), name="spinning-coin")


SPINNING_COIN = CatalogueEntry(
    name="spinning-coin",
    title="Spinning coin",
    about=(
        "A thin uniform disk spins on a frictionless horizontal table. Its centre rises and falls "
        "with its tilt; the table pushes only upwards. Stood on edge it keeps spinning if it "
        "turns fast enough, and otherwise falls over."
    ),
    whatever_touches="A thin uniform disk spins on a horizontal table.",
    build=_coin,
    parameters=(
        Parameter("m", "kg", "7.5 g", "mass of the coin"),
        Parameter("a", "m", "12 mm", "radius of the coin"),
        GRAVITY,
    ),
    start={"theta": "70 deg", "phi_dot": "45 rad/s", "omega_3": "2 rad/s"},
    duration="1 s",
    plots=(("theta",), ("phi_dot", "omega_3"), ("F_z",)),
)


def _disk() -> ph.System:
    m, a, g = ph.symbols("m a g", positive=True)
    lab = ph.Frame("lab")
    disk = ph.disk("disk", mass=m, radius=a, axes=_following_axes(lab))
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


def _eulers_disk() -> ph.System:
    m, a, g, mu = ph.symbols("m a g mu", positive=True)
    lab = ph.Frame("lab")
    disk = ph.disk("disk", mass=m, radius=a, axes=_following_axes(lab))
    ground = ph.Rolling(disk, on=ph.Plane(lab), name="ground")
    resistance = ph.RollingResistance(ground, mu=mu)
    return ph.System(ground, resistance, ph.Gravity(g), name="eulers-disk")


EULERS_DISK = CatalogueEntry(
    name="eulers-disk",
    title="Euler's disk",
    about=(
        "A disk whirls on a table ever flatter and ever faster, and stops at a finite time. "
        "Resistance acts along its rim, in proportion to the normal force."
    ),
    whatever_touches="A disk whirls on a table ever flatter and ever faster.",
    build=_eulers_disk,
    parameters=(
        Parameter("m", "kg", "0.44 kg", "mass of the disk"),
        Parameter("a", "m", "38 mm", "radius of the disk"),
        Parameter("mu", "", "0.0005", "coefficient of rolling resistance"),
        GRAVITY,
    ),
    start={"theta": "15 deg", "phi_dot": "63 rad/s"},
    duration="10 s",
    plots=(("theta",), ("phi_dot", "omega_3"), ("F_z", "R")),
)

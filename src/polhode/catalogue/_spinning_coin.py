"""Problem 1: a coin spinning on a frictionless table."""

import polhode as ph
from polhode.catalogue._entry import GRAVITY, CatalogueEntry, Parameter
from polhode.catalogue._text_axes import following_axes


def _coin() -> ph.System:
    m, a, g = ph.symbols("m a g", positive=True)
    lab = ph.Frame("lab")
    coin = ph.disk("coin", mass=m, radius=a, axes=following_axes(lab))
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

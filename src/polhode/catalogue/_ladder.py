"""A ladder that slides down a wall and leaves it."""

import polhode as ph
from polhode.catalogue._entry import GRAVITY, CatalogueEntry, Parameter


def _ladder() -> ph.System:
    m, length, g = ph.symbols("m l g", positive=True)
    lab = ph.Frame("lab")
    axes = lab.rotated(ph.coordinate("alpha"), "y")
    rod = ph.rod("ladder", mass=m, length=length, axes=axes)
    foot, top = axes["x"] * (length / 2), axes["x"] * (-length / 2)
    return ph.System(
        ph.Smooth(rod, on=ph.Plane(lab), at=foot, name="floor", force="N"),
        ph.Smooth(rod, on=ph.Plane(lab, normal="x"), at=top, name="wall", force="W"),
        ph.Hinge(rod, axis="y"),
        ph.Gravity(g),
        name="ladder",
    )


LADDER = CatalogueEntry(
    name="ladder",
    title="Ladder on a wall",
    about=(
        "A uniform ladder slides down between a smooth wall and a smooth floor. Its top leaves the "
        "wall at two thirds of its first height. alpha is its angle to the floor."
    ),
    whatever_touches="A uniform ladder slides down between a wall and a floor.",
    build=_ladder,
    parameters=(
        Parameter("m", "kg", "10 kg", "mass of the ladder"),
        Parameter("l", "m", "3 m", "length of the ladder"),
        GRAVITY,
    ),
    start={"alpha": "75 deg"},
    duration="1.2 s",
    plots=(("alpha",), ("N_z", "W_x")),
)

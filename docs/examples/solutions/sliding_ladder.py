"""A uniform ladder that slides down a smooth wall onto a smooth floor."""

import polhode as ph

m, l, g = ph.symbols("m l g", positive=True)
theta = ph.coordinate("theta")
lab = ph.Frame("lab")
axes = lab.rotated(theta, "y", labels="1 2 3")
ladder = ph.rod("ladder", mass=m, length=2 * l, axes=axes, axis="3")
sliding_ladder = ph.System(
    ph.Pivot(ladder, at=axes["3"] * -l, only="y z", name="floor", force="N"),
    ph.Pivot(ladder, at=axes["3"] * l, only="x", name="wall", force="W"),
    ph.Gravity(g),
    name="sliding ladder",
)

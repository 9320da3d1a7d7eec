"""A bead that slides without friction on a hoop, which turns about its vertical diameter."""

import polhode as ph

m, a, g, Omega = ph.symbols("m a g Omega", positive=True)
theta = ph.coordinate("theta")
hoop = ph.Frame("lab").rotated(Omega * ph.time, "z", labels="r n z", name="hoop")
axes = hoop.rotated(theta, "n", labels="1 2 3")
bead = ph.point_mass("bead", mass=m, axes=axes)
bead_on_hoop = ph.System(
    ph.Pivot(bead, at=axes["3"] * a, name="hoop"),
    ph.Motor(bead, axis="1", rate=0, relative_to=hoop, name="drive"),
    ph.Motor(bead, axis="3", rate=0, relative_to=hoop, name="axle", torque="sigma"),
    ph.Gravity(g),
    name="bead on a rotating hoop",
)

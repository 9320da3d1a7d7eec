"""A solid cylinder that rolls down a slope."""

import polhode as ph

m, a, g = ph.symbols("m a g", positive=True)
slope = ph.Plane(ph.Frame("lab"), tilt=-ph.symbol("alpha"))  # x points down the slope
cylinder = ph.cylinder(
    "cylinder", mass=m, radius=a, length=4 * a, axes=slope.axes, axis="y", spin=ph.About("y", "beta")
)
system = ph.System(
    ph.Rolling(cylinder, on=slope, name="ground"),
    ph.Hinge(cylinder, axis="y"),
    ph.Gravity(g),
    name="cylinder on a slope",
)

"""A solid cylinder that rolls down a slope."""

import polhode as ph

m, a, g = ph.symbols("m a g", positive=True)
slope = ph.Plane(ph.Frame("lab"), tilt=-ph.symbol("alpha"))  # y points up the slope
cylinder = ph.cylinder(
    "cylinder",
    mass=m,
    radius=a,
    height=4 * a,
    axes=slope.axes,
    axis="x",
    spin=ph.About("x", "beta"),
)
system = ph.System(
    ph.Rolling(cylinder, on=slope, name="ground"),
    ph.Hinge(cylinder, axis="x"),
    ph.Gravity(g),
    name="cylinder on a slope",
)

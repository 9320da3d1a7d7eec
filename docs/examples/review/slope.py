"""A solid cylinder that rolls down a slope."""

import polhode as ph

m, a, g = ph.symbols("m a g", positive=True)
slope = ph.Plane(ph.Frame("lab"), tilt=-ph.symbol("alpha"))  # y points up the slope
cylinder = ph.Body(
    "cylinder",
    mass=m,
    inertia=(m * a**2 / 2, m * a**2, m * a**2),  # its height is 3a
    axes=slope.axes,
    spin=ph.About("x", "beta"),
    rim=a,
)
system = ph.System(
    ph.Rolling(cylinder, on=slope, name="ground"),
    ph.Hinge(cylinder, axis="x"),
    ph.Gravity(g),
    name="cylinder on a slope",
)

"""Two equal wheels that roll on a plane, each free to turn about a common axle."""

import polhode as ph

m, M, a, b, g = ph.symbols("m M a b g", positive=True)
phi = ph.coordinate("phi")
lab = ph.Frame("lab")
heading = lab.rotated(phi, "z", labels="1 2 3")
axle = ph.rod("axle", mass=M, length=2 * b, axes=heading, axis="2", tag="a")
left = ph.disk("left wheel", mass=m, radius=a, axes=heading, axis="2", tag="l")
right = ph.disk("right wheel", mass=m, radius=a, axes=heading, axis="2", tag="r")
two_wheeled_axle = ph.System(
    ph.Rolling(left, on=ph.Plane(lab)),
    ph.Pivot(axle, to=left.point(heading["2"] * -b), name="left bearing", force="P"),
    ph.Hinge(left, axis="2", to=axle, name="left axle"),
    ph.Pivot(right, to=axle.point(heading["2"] * -b), name="right bearing", force="Q"),
    ph.Hinge(right, axis="2", to=axle, name="right axle"),
    ph.Rolling(right, on=ph.Plane(lab)),
    ph.Gravity(g),
    name="two-wheeled axle",
)

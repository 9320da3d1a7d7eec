"""Two equal wheels that roll on a plane, each free to turn about a common axle that stays level."""

import polhode as ph

m, M, a, b, g = ph.symbols("m M a b g", positive=True)
phi = ph.coordinate("phi")
heading = ph.Frame("lab").rotated(phi, "z", labels="1 2 3")
axle = ph.rod("axle", mass=M, length=2 * b, axes=heading, axis="2", tag="a")
left = ph.disk("left wheel", mass=m, radius=a, axes=heading, axis="2", tag="l")
right = ph.disk("right wheel", mass=m, radius=a, axes=heading, axis="2", tag="r")
lowest = heading["3"] * -a
two_wheeled_axle = ph.System(
    ph.Pivot(axle, only="z", name="height", force="N"),
    ph.Hinge(axle, axis="3", name="level"),
    ph.Pivot(left, to=axle.point(heading["2"] * b), name="left bearing", force="P"),
    ph.Hinge(left, axis="2", to=axle, name="left axle"),
    ph.Pivot(right, to=axle.point(heading["2"] * -b), name="right bearing", force="Q"),
    ph.Hinge(right, axis="2", to=axle, name="right axle"),
    ph.Hold(left, at=lowest, along=heading, only="1 2", name="left contact", force="F"),
    ph.Hold(right, at=lowest, along=heading, only="1", name="right contact", force="F"),
    ph.Gravity(g),
    name="two-wheeled axle",
)

"""Two equal wheels that roll on a plane, each free to turn about a common axle."""

import polhode as ph

m, M, a, b, g = ph.symbols("m M a b g", positive=True)
lab = ph.Frame("lab")
heading = lab.rotated(ph.coordinate("phi"), "z", labels="1 2 3")
left = ph.disk("left wheel", mass=m, radius=a, axes=heading, axis="2", tag="L")
right = ph.disk("right wheel", mass=m, radius=a, axes=heading, axis="2", tag="R")
axle = ph.rod("axle", mass=M, length=2 * b, axes=heading, axis="2", tag="A")
ground = ph.Plane(lab)
two_wheeled_axle = ph.System(
    ph.Rolling(left, on=ground, name="left contact"),
    ph.Pivot(axle, at=heading["2"] * b, to=left.point(), name="left bearing", force="P"),
    ph.Hinge(left, axis="2", to=axle, name="left axle"),
    ph.Pivot(
        right,
        to=axle.point(heading["2"] * -b),
        along=heading,
        only="1 3",
        name="right bearing",
        force="Q",
    ),
    ph.Hinge(right, axis="2", to=axle, name="right axle"),
    ph.Rolling(right, on=ground, name="right contact"),
    ph.Gravity(g),
    name="two-wheeled axle",
)

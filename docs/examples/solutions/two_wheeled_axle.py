"""Two equal wheels that roll on a plane, each free to turn about a common axle that stays level."""

import polhode as ph

m, M, a, b, g = ph.symbols("m M a b g", positive=True)
phi, x, y = ph.coordinates("phi x_A y_A")
heading = ph.Frame("lab").rotated(phi, "z", labels="1 2 3")
axle = ph.rod("axle", mass=M, length=2 * b, axes=heading, axis="2", tag="A")
left = ph.disk("left wheel", mass=m, radius=a, axes=heading, axis="2", tag="L")
right = ph.disk("right wheel", mass=m, radius=a, axes=heading, axis="2", tag="R")
forward = x.dt() * ph.cos(phi) + y.dt() * ph.sin(phi)
turn, both = b * phi.dt(), (left, right, axle)
two_wheeled_axle = ph.System(
    ph.Pivot(axle, only="z", name="floor", force="N"),
    ph.Hinge(axle, axis="3", name="level"),
    ph.KnifeEdge(axle, across="2", name="no sideways slip", force="S"),
    ph.Pivot(left, to=axle.point(heading["2"] * b), name="left bearing", force="P"),
    ph.Hinge(left, axis="2", to=axle, name="left axle"),
    ph.Pivot(right, to=axle.point(heading["2"] * -b), name="right bearing", force="Q"),
    ph.Hinge(right, axis="2", to=axle, name="right axle"),
    ph.Constraint(
        forward - turn - a * ph.speed("omega_2_L"), on=both, name="left rolling", force="T_L"
    ),
    ph.Constraint(
        forward + turn - a * ph.speed("omega_2_R"), on=both, name="right rolling", force="T_R"
    ),
    ph.Gravity(g),
    name="two-wheeled axle",
)

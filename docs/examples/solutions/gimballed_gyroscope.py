"""A rotor in two gimbals: the outer one turns about the vertical, the inner one within it."""

import polhode as ph

A, B, C, I_1, I_3, J, m = ph.symbols("A B C I_1 I_3 J m", positive=True)
phi, theta = ph.coordinates("phi theta")
turned = ph.Frame("lab").rotated(phi, "z")
tilted = turned.rotated(theta, "x", labels="1 2 3")
outer = ph.Body("outer gimbal", mass=m, inertia=(J, J, J), axes=turned, tag="o")
inner = ph.Body("inner gimbal", mass=m, inertia=(A, B, C), axes=tilted, tag="i")
rotor = ph.Body("rotor", mass=m, inertia=(I_1, I_1, I_3), axes=tilted, spin_about="3", tag="r")
gimballed_gyroscope = ph.System(
    ph.Pivot(outer, name="stand"),
    ph.Hinge(outer, axis="z", name="outer axle"),
    ph.Pivot(inner, to=outer.point(), name="inner bearings", force="G"),
    ph.Hinge(inner, axis="1", to=outer, name="inner axle"),
    ph.Pivot(rotor, to=inner.point(), name="rotor bearings", force="H"),
    ph.Hinge(rotor, axis="3", to=inner, name="rotor axle"),
    name="gimballed gyroscope",
)

"""A body on ice with a blade behind its centre of mass, which cannot move sideways."""

import polhode as ph

m, a, I = ph.symbols("m a I", positive=True)
phi, x, y = ph.coordinates("phi x y")
axes = ph.Frame("lab").rotated(phi, "z", labels="1 2 3")
sleigh = ph.Body("sleigh", mass=m, inertia=(I, I, I), axes=axes)
chaplygin_sleigh = ph.System(
    ph.Pivot(sleigh, only="z", name="ice"),
    ph.Hinge(sleigh, axis="3", name="level"),
    ph.KnifeEdge(sleigh, across="2", at=axes["1"] * -a, name="blade"),
    speeds={"v": x.dt() * ph.cos(phi) + y.dt() * ph.sin(phi), "omega": phi.dt()},
    name="Chaplygin sleigh",
)

"""Two particles on light rods, one hung from the other, in a vertical plane."""

import polhode as ph

m_1, m_2, l_1, l_2, g = ph.symbols("m_1 m_2 l_1 l_2 g", positive=True)
alpha, beta = ph.coordinates("alpha beta")
lab = ph.Frame("lab")
one, two = lab.rotated(alpha, "y"), lab.rotated(beta, "y")
upper = ph.point_mass("upper bob", mass=m_1, axes=one, tag="1")
lower = ph.point_mass("lower bob", mass=m_2, axes=two, tag="2")
double_pendulum = ph.System(
    ph.Pivot(upper, at=one["z"] * l_1, name="nail"),
    ph.Pivot(lower, at=two["z"] * l_2, to=upper.point(), name="joint", force="G"),
    ph.Gravity(g),
    name="double pendulum",
)

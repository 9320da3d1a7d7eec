"""A particle on a light rod on the turning Earth: x to the east, y to the north, z upwards."""

import polhode as ph

m, l, g, Omega = ph.symbols("m l g Omega", positive=True)
alpha, beta = ph.coordinates("alpha beta")
ground = ph.earth(Omega, colatitude=ph.symbol("lambda_"))
axes = ground.rotated(alpha, "x").rotated(beta, "y", labels="1 2 3")
bob = ph.point_mass("bob", mass=m, axes=axes)
foucault_pendulum = ph.System(
    ph.Pivot(bob, at=axes["3"] * l), ph.Gravity(g), name="Foucault pendulum"
)

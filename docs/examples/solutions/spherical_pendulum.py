"""A particle on a light rod that can swing in every direction."""

import polhode as ph

m, l, g = ph.symbols("m l g", positive=True)
theta, phi = ph.coordinates("theta phi")
axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "y", labels="1 2 3")
bob = ph.point_mass("bob", mass=m, axes=axes)
spherical_pendulum = ph.System(
    ph.Pivot(bob, at=axes["3"] * -l), ph.Gravity(g), name="spherical pendulum"
)

"""A heavy symmetric top on a fixed point, by Euler's angles."""

import polhode as ph

mu, l, g, I_1, I_3 = ph.symbols("mu l g I_1 I_3", positive=True)
phi, theta, psi = ph.coordinates("phi theta psi")
axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
body = ph.Body("top", mass=mu, inertia=(I_1, I_1, I_3), axes=axes)
top = ph.System(ph.Pivot(body, at=axes["3"] * -l), ph.Gravity(g), name="heavy top")

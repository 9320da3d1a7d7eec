"""A body that swings about a horizontal axis through one of its points."""

import polhode as ph

m, l, g, I_1, I_2, I_3 = ph.symbols("m l g I_1 I_2 I_3", positive=True)
theta = ph.coordinate("theta")
axes = ph.Frame("lab").rotated(theta, "y", labels="1 2 3")
body = ph.Body("pendulum", mass=m, inertia=(I_1, I_2, I_3), axes=axes)
physical_pendulum = ph.System(
    ph.Pivot(body, at=axes["3"] * l, name="pivot"),
    ph.Hinge(body, axis="2", name="bearing"),
    ph.Gravity(g),
    name="physical pendulum",
)

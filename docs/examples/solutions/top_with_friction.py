"""A top whose rounded tip stands on a rough table and rolls there."""

import polhode as ph

m, l, r, g, I_1, I_3 = ph.symbols("m l r g I_1 I_3", positive=True)
theta, phi = ph.coordinates("theta phi")
lab = ph.Frame("lab")
axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
tip = ph.Round(r, "3", -l)
body = ph.Body("top", mass=m, inertia=(I_1, I_1, I_3), axes=axes, spin_about="3", surface=tip)
top_with_friction = ph.System(
    ph.Rolling(body, on=ph.Plane(lab), name="table"), ph.Gravity(g), name="top on a rough table"
)

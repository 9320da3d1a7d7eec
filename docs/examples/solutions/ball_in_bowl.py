"""A ball that rolls in a spherical bowl; a massless arm from its middle presses the ball to it."""

import polhode as ph

m, a, R, g = ph.symbols("m a R g", positive=True)
theta, phi = ph.coordinates("theta phi")
lab = ph.Frame("lab")
axes = lab.rotated(phi, "z").rotated(theta, "y", labels="1 2 3")
ball = ph.sphere("ball", mass=m, radius=a, axes=axes)
arm = ph.Body("arm", mass=0, axes=axes.parent.rotated(theta, "y", name="arm"), tag="arm")
ball_in_bowl = ph.System(
    ph.Pivot(arm, name="middle of the bowl", force="P"),
    ph.Universal(arm, arm=axes["2"], other_arm=lab["z"], name="joint"),
    ph.Pivot(ball, to=arm.point(axes["3"] * (a - R)), name="arm", force="N"),
    ph.Hold(ball, at=axes["3"] * -a, along=axes, only="1 2", name="rolling", force="F"),
    ph.Gravity(g),
    name="ball in a bowl",
)

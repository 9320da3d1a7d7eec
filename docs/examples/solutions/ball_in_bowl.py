"""A ball that rolls in a spherical bowl; a massless arm keeps it at the same distance."""

import polhode as ph

m, a, R, g = ph.symbols("m a R g", positive=True)
theta, phi = ph.coordinates("theta phi")
axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "y", labels="1 2 3")
ball = ph.sphere("ball", mass=m, radius=a, axes=axes)
arm = ph.Body("arm", mass=0, axes=axes, tag="arm")
down, round_ = (a - R) * theta.dt(), (a - R) * phi.dt() * ph.sin(theta)
ball_in_bowl = ph.System(
    ph.Pivot(arm, name="middle of the bowl"),
    ph.Universal(arm, arm=axes["2"], other_arm=axes.root["z"], name="joint"),
    ph.Pivot(ball, to=arm.point(axes["3"] * (a - R)), name="arm", force="N"),
    ph.Constraint(down - a * ph.speed("omega_2"), on=ball, name="rolling downwards", force="F"),
    ph.Constraint(round_ + a * ph.speed("omega_1"), on=ball, name="rolling round", force="H"),
    ph.Gravity(g),
    name="ball in a bowl",
)

"""A bicycle: two rolling wheels, a rear frame with its rider, and a front frame that steers."""

import polhode as ph

psi, phi, theta, delta = ph.coordinates("psi phi theta delta")  # yaw, lean, pitch, steer
tilt, w, c, g = ph.symbols("lambda_ w c g", positive=True)  # steering axis, wheelbase, trail
r_R, r_F, m_R, m_B, m_H, m_F = ph.symbols("r_R r_F m_R m_B m_H m_F", positive=True)
A_R, C_R, A_F, C_F = ph.symbols("A_R C_R A_F C_F", positive=True)  # of the wheels: across, along
x_B, z_B, x_H, z_H = ph.symbols("x_B z_B x_H z_H")  # centres of mass, from the rear contact


def inertia(body):
    xx, yy, zz, xz = ph.symbols(f"I_{body}xx I_{body}yy I_{body}zz I_{body}xz")
    return ph.Matrix.of([[xx, 0, xz], [0, yy, 0], [xz, 0, zz]])


lab = ph.Frame("lab")
lean = lab.rotated(psi, "z").rotated(phi, "x")
rear = lean.rotated(theta, "y")
steer = rear.rotated(-tilt, "y").rotated(delta, "z")
fork = steer.rotated(tilt, "y")
turned = fork.rotation_to(steer)  # the front frame's inertia is given along the upright fork


def wheel(tag, mass, across, along, radius, axes):
    return ph.Body(
        f"wheel {tag}",
        mass=mass,
        inertia=(across, along, across),
        axes=axes,
        spin=ph.About("y", "chi"),
        surface=ph.Rim(radius, "y"),
        tag=tag,
    )


R = wheel("R", m_R, A_R, C_R, r_R, lean)
F = wheel("F", m_F, A_F, C_F, r_F, steer)
B = ph.Body("rear frame", mass=m_B, inertia=inertia("B"), axes=rear, tag="B")
H = ph.Body("front frame", mass=m_H, inertia=turned @ inertia("H") @ turned.T, axes=steer, tag="H")
ground = ph.Plane(lab)
head = B.point(rear.vector(w + c - x_B, 0, -z_B))
bicycle = ph.System(
    ph.Rolling(R, on=ground, name="rear contact"),
    ph.Pivot(B, at=rear.vector(-x_B, 0, r_R - z_B), to=R.point(), name="rear hub", force="P"),
    ph.Hinge(R, axis="y", to=B, name="rear axle"),
    ph.Pivot(H, at=fork.vector(w + c - x_H, 0, -z_H), to=head, name="head", force="Q"),
    ph.Hinge(H, axis="z", to=B, name="steering"),
    ph.Pivot(F, to=H.point(fork.vector(w - x_H, 0, r_F - z_H)), name="front hub", force="S"),
    ph.Hinge(F, axis="y", to=H, name="front axle"),
    ph.Rolling(F, on=ground, name="front contact"),
    ph.Gravity(g),
    name="bicycle",
    independent=(phi.dt(), delta.dt(), ph.speed("omega_y_R")),
)

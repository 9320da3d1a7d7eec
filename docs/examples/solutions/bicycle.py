"""A bicycle that nobody steers: two rolling wheels, a rear frame with its rider, a front frame."""

from math import pi

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
lean = lab.rotated(psi, "z", labels="h k z").rotated(phi, "h", labels="h l n")
rear = lean.rotated(theta, "l", labels="1 l 3")
steer = rear.rotated(-tilt, "l", labels="p l s").rotated(-delta, "s", labels="i j s")
fork = steer.rotated(tilt, "j", labels="u j w")
turned = fork.rotation_to(steer)


def wheel(tag, name, mass, across, along, radius, axes, axis):
    return ph.Body(
        name,
        mass=mass,
        inertia=(across, along, across),
        axes=axes,
        spin=ph.About(axis, "chi"),
        surface=ph.Rim(radius, axis),
        tag=tag,
    )


R = wheel("R", "rear wheel", m_R, A_R, C_R, r_R, lean, "l")
F = wheel("F", "front wheel", m_F, A_F, C_F, r_F, steer, "j")
B = ph.Body("rear frame", mass=m_B, inertia=inertia("B"), axes=rear, tag="B")
H = ph.Body("front frame", mass=m_H, inertia=turned @ inertia("H") @ turned.T, axes=steer, tag="H")
ground = ph.Plane(lab)
head = B.point(rear.vector(w + c - x_B, 0, -z_B))
bicycle = ph.System(
    ph.Rolling(R, on=ground, name="rear contact"),
    ph.Pivot(B, at=rear.vector(-x_B, 0, r_R - z_B), to=R.point(), name="rear hub", force="P"),
    ph.Hinge(R, axis="l", to=B, name="rear axle"),
    ph.Pivot(H, at=fork.vector(w + c - x_H, 0, -z_H), to=head, name="head", force="Q"),
    ph.Hinge(H, axis="s", to=B, name="steering"),
    ph.Pivot(F, to=H.point(fork.vector(w - x_H, 0, r_F - z_H)), name="front hub", force="S"),
    ph.Hinge(F, axis="j", to=H, name="front axle"),
    ph.Rolling(F, on=ground, name="front contact"),
    ph.Gravity(g),
    name="bicycle",
    independent=(phi.dt(), delta.dt(), ph.speed("v")),
    speeds={"v": r_R * ph.speed("omega_l_R")},
)

# The benchmark of Meijaard, Papadopoulos, Ruina and Schwab (Proc. R. Soc. A 463, 2007), SI
numbers = {
    "lambda_": pi / 10,
    "w": 1.02,
    "c": 0.08,
    "g": 9.81,
    "r_R": 0.3,
    "r_F": 0.35,
    "m_R": 2,
    "A_R": 0.0603,
    "C_R": 0.12,
    "m_F": 3,
    "A_F": 0.1405,
    "C_F": 0.28,
    "m_B": 85,
    "x_B": 0.3,
    "z_B": 0.9,
    "m_H": 4,
    "x_H": 0.9,
    "z_H": 0.7,
    "I_Bxx": 9.2,
    "I_Byy": 11,
    "I_Bzz": 2.8,
    "I_Bxz": -2.4,
    "I_Hxx": 0.05892,
    "I_Hyy": 0.06,
    "I_Hzz": 0.00708,
    "I_Hxz": 0.00756,
}
start = {"v": 5, "phi_dot": 0.2}
duration = 3

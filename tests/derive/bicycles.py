"""The bicycle of Meijaard, Papadopoulos, Ruina and Schwab, with its wheels and frames as bodies.

Their axes have z down and y to the right; here z is up and y to the left, so that products of
inertia change sign. Lean phi and steer delta are positive to the other side, which changes nothing.
"""

from __future__ import annotations

from functools import cache
from math import pi

import polhode as ph
from polhode.derive import Equations

#: Table 1 of the paper, SI.
BENCHMARK = {
    "w": 1.02,
    "c": 0.08,
    "lambda_": pi / 10,
    "g": 9.81,
    "r_R": 0.3,
    "m_R": 2.0,
    "I_Rxx": 0.0603,
    "I_Ryy": 0.12,
    "x_B": 0.3,
    "z_B": 0.9,
    "m_B": 85.0,
    "I_Bxx": 9.2,
    "I_Byy": 11.0,
    "I_Bzz": 2.8,
    "I_Bxz": -2.4,
    "x_H": 0.9,
    "z_H": 0.7,
    "m_H": 4.0,
    "I_Hxx": 0.05892,
    "I_Hyy": 0.06,
    "I_Hzz": 0.00708,
    "I_Hxz": 0.00756,
    "r_F": 0.35,
    "m_F": 3.0,
    "I_Fxx": 0.1405,
    "I_Fyy": 0.28,
}


def _inertia(body: str) -> ph.Matrix:
    xx, yy, zz, xz = ph.symbols(" ".join(f"I_{body}{axes}" for axes in ("xx", "yy", "zz", "xz")))
    return ph.Matrix.of([[xx, 0, xz], [0, yy, 0], [xz, 0, zz]])


def declared() -> ph.System:
    """Rear and front wheel R and F, rear frame B with its rider, front frame H."""
    psi, phi, theta, delta = ph.coordinates("psi phi theta delta")
    tilt, w, c, g = ph.symbols("lambda_ w c g", positive=True)
    r_R, r_F, m_R, m_B, m_H, m_F = ph.symbols("r_R r_F m_R m_B m_H m_F", positive=True)
    moments = ph.symbols("I_Rxx I_Ryy I_Fxx I_Fyy", positive=True)
    x_B, z_B, x_H, z_H = ph.symbols("x_B z_B x_H z_H")

    lab = ph.Frame("lab")
    lean = lab.rotated(psi, "z").rotated(phi, "x")
    rear = lean.rotated(theta, "y")
    steer = rear.rotated(-tilt, "y").rotated(delta, "z")
    fork = steer.rotated(tilt, "y")
    turned = fork.rotation_to(steer)

    def wheel(
        tag: str, mass: ph.Expr, across: ph.Expr, along: ph.Expr, radius: ph.Expr, axes: ph.Frame
    ) -> ph.Body:
        return ph.Body(
            f"wheel {tag}",
            mass=mass,
            inertia=(across, along, across),
            axes=axes,
            spin=ph.About("y", "chi"),
            surface=ph.Rim(radius, "y"),
            tag=tag,
        )

    R = wheel("R", m_R, moments[0], moments[1], r_R, lean)
    F = wheel("F", m_F, moments[2], moments[3], r_F, steer)
    B = ph.Body("rear frame", mass=m_B, inertia=_inertia("B"), axes=rear, tag="B")
    H = ph.Body(
        "front frame", mass=m_H, inertia=turned @ _inertia("H") @ turned.T, axes=steer, tag="H"
    )
    ground = ph.Plane(lab)
    head = B.point(rear.vector(w + c - x_B, 0, -z_B))
    return ph.System(
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


@cache
def bicycle() -> Equations:
    return ph.derive(declared())

"""Peer: a gyroscope with a fixed point and the force of its pivot, by SymPy's KanesMethod.

Axis 1 is the axle, at theta from the vertical; the pivot force is resolved along rho, phi and z.
"""

from __future__ import annotations

import sympy as sm
import sympy.physics.mechanics as me
from kane import Kane, report, resultant


def gyroscope() -> Kane:
    M, a, g, I_1, I_2 = sm.symbols("M a g I_1 I_2", positive=True)
    coordinates = theta, phi, psi = me.dynamicsymbols("theta phi psi")
    speeds = theta_dot, phi_dot, omega_1 = me.dynamicsymbols("theta_dot phi_dot omega_1")
    slip = me.dynamicsymbols("v_rho v_phi v_z")
    force = me.dynamicsymbols("F_rho F_phi F_z")
    t = me.dynamicsymbols._t

    lab = me.ReferenceFrame("N")
    cylindrical = lab.orientnew("Y", "Axis", [phi, lab.z])
    axes = cylindrical.orientnew("L", "Axis", [theta, cylindrical.y])
    spun = axes.orientnew("R", "Axis", [psi, axes.z])
    spun.set_ang_vel(lab, -phi_dot * sm.sin(theta) * axes.x + theta_dot * axes.y + omega_1 * axes.z)
    kinematics = [
        theta.diff(t) - theta_dot,
        phi.diff(t) - phi_dot,
        psi.diff(t) + phi.diff(t) * sm.cos(theta) - omega_1,
    ]

    pivot = me.Point("P")
    pivot.set_vel(lab, resultant(slip, list(cylindrical)))
    centre = pivot.locatenew("O", a * axes.z)
    centre.v2pt_theory(pivot, lab, spun)
    inertia = me.inertia(axes, I_2, I_2, I_1)
    body = me.RigidBody("gyroscope", centre, spun, M, (inertia, centre))
    loads = [(centre, -M * g * lab.z), (pivot, resultant(force, list(cylindrical)))]

    method = me.KanesMethod(lab, coordinates, speeds, kinematics, u_auxiliary=slip)
    method.kanes_equations([body], loads)
    return Kane(method, force)


if __name__ == "__main__":
    report(
        gyroscope,
        names=("theta_ddot", "phi_ddot", "omega_1_dot", "F_rho", "F_phi", "F_z"),
        state={
            "M": 0.5,
            "a": 0.07,
            "g": 9.81,
            "I_1": 4e-4,
            "I_2": 3e-4,
            "theta": 1.1,
            "theta_dot": 0.7,
            "phi_dot": -1.3,
            "omega_1": 120,
        },
    )

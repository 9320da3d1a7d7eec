"""Peer: a thin disk rolling on a plane and its contact force, by SymPy's KanesMethod.

Axes: lab turned by phi about z, then by theta about x; the disk spins about the third. The contact
force is resolved along 1 (horizontal, the line of travel), across it (z × 1) and z.
"""

from __future__ import annotations

import sympy as sm
import sympy.physics.mechanics as me
from kane import Kane, report, resultant


def rolling_disk() -> Kane:
    m, a, g = sm.symbols("m a g", positive=True)
    coordinates = theta, phi, psi = me.dynamicsymbols("theta phi psi")
    speeds = theta_dot, phi_dot, omega_3 = me.dynamicsymbols("theta_dot phi_dot omega_3")
    slip = me.dynamicsymbols("v_1 v_across v_z")
    force = me.dynamicsymbols("F_1 F_across F_z")
    t = me.dynamicsymbols._t

    lab = me.ReferenceFrame("N")
    heading = lab.orientnew("Y", "Axis", [phi, lab.z])
    axes = heading.orientnew("L", "Axis", [theta, heading.x])
    spun = axes.orientnew("R", "Axis", [psi, axes.z])
    spun.set_ang_vel(lab, theta_dot * axes.x + phi_dot * sm.sin(theta) * axes.y + omega_3 * axes.z)
    kinematics = [
        theta.diff(t) - theta_dot,
        phi.diff(t) - phi_dot,
        psi.diff(t) + phi.diff(t) * sm.cos(theta) - omega_3,
    ]

    contact = me.Point("C")
    contact.set_vel(lab, resultant(slip, list(heading)))
    centre = contact.locatenew("O", a * axes.y)
    centre.v2pt_theory(contact, lab, spun)
    inertia = me.inertia(axes, m * a**2 / 4, m * a**2 / 4, m * a**2 / 2)
    disk = me.RigidBody("disk", centre, spun, m, (inertia, centre))
    loads = [(centre, -m * g * lab.z), (contact, resultant(force, list(heading)))]

    method = me.KanesMethod(lab, coordinates, speeds, kinematics, u_auxiliary=slip)
    method.kanes_equations([disk], loads)
    return Kane(method, force)


if __name__ == "__main__":
    report(
        rolling_disk,
        names=("theta_ddot", "phi_ddot", "omega_3_dot", "F_1", "F_across", "F_z"),
        state={
            "m": 0.2,
            "a": 0.03,
            "g": 9.81,
            "theta": 1.1,
            "theta_dot": 0.7,
            "phi_dot": -1.3,
            "omega_3": 12,
        },
    )

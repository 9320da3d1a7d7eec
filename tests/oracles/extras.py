"""Two wheels on an axle, a gyroscope in gimbals, a rolling ellipsoid. Lab z is up."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from . import disks
from .constraints import Ellipsoid, Held, Parts, hinge
from .parts import LAB, Array, Body, X, Y, Z, turn_x, turn_z, vector, zero
from .scenario import Numbers, Scenario, lab_force, numbers


def wheels_on_axle(**given: float) -> dict[str, float]:
    """psi_1_ddot, psi_2_ddot, phi_dot, phi_ddot; normal forces N_i, tractions P_i on the wheels.

    Wheels m, I_1, I_3, radius a, at +b and -b along an axle of mass M and moment J across, about
    its centre of mass at c; they roll on a plane rising by alpha along lab x, z normal to it. phi
    turns the axle from x about z; psi_i turns wheel i about the axle's direction e; both roll along
    e x z, the sense of P_i.
    """
    state = numbers(
        given,
        needs="m I_1 I_3 a b M J g alpha phi psi_1_dot psi_2_dot",
        zero="c psi_1 psi_2 x y",
    )

    def place(q: Numbers) -> Parts:
        axle_axes = turn_z(q.phi) @ np.column_stack([Y, Z, X])  # third axis along the axle
        along = axle_axes[:, 2]
        forward = np.cross(along, Z)
        turning = q.a * (q.psi_2_dot - q.psi_1_dot) / (2 * q.b) * Z
        centre = vector(q.x, q.y, q.a)
        velocity = q.a * (q.psi_1_dot + q.psi_2_dot) / 2 * forward
        axle = Body(
            mass=q.M,
            moments=q.J * np.ones(3),
            position=centre + q.c * along,
            velocity=velocity + np.cross(turning, q.c * along),
            rotation=axle_axes,
            omega=turning,
        )

        def wheel(offset: Array, psi: Any, psi_dot: Any) -> Body:
            return Body(
                mass=q.m,
                moments=vector(q.I_1, q.I_1, q.I_3),
                position=centre + offset,
                velocity=velocity + np.cross(turning, offset),
                rotation=axle_axes @ turn_z(psi),
                omega=turning + psi_dot * along,
            )

        return {
            "lab": LAB,
            "axle": axle,
            "wheel_1": wheel(q.b * along, q.psi_1, q.psi_1_dot),
            "wheel_2": wheel(-q.b * along, q.psi_2, q.psi_2_dot),
        }

    def rates(q: Numbers, parts: Parts) -> dict[str, Any]:
        v_x, v_y, _ = (parts["wheel_1"].velocity + parts["wheel_2"].velocity) / 2
        spins = {"psi_1": q.psi_1_dot, "psi_2": q.psi_2_dot}
        return spins | {"x": v_x, "y": v_y, "phi": parts["axle"].omega[2]}

    rim = Ellipsoid((state.a, state.a, 0))
    answer = Scenario(
        place=place,
        state=state,
        rates=rates,
        speeds="psi_1_dot psi_2_dot",
        constraints={
            "bearing_1": hinge("wheel_1", "axle", zero(), Z, Z),
            "bearing_2": hinge("wheel_2", "axle", zero(), Z, Z),
            "contact_1": Held("wheel_1", "lab", rim),
            "contact_2": Held("wheel_2", "lab", rim),
        },
        gravity=-state.g * vector(np.sin(state.alpha), 0, np.cos(state.alpha)),
    ).answer()
    forward = vector(np.sin(state.phi), -np.cos(state.phi), 0)
    contacts = {i: answer.reaction(f"contact_{i}", f"wheel_{i}").force for i in (1, 2)}
    return answer.report(
        {"phi_dot": float(answer.parts["axle"].omega[2])},
        {"phi_ddot": float(answer.motion.angular["axle"][2])},
        {f"N_{i}": float(force @ Z) for i, force in contacts.items()},
        {f"P_{i}": float(force @ forward) for i, force in contacts.items()},
    )


def gimballed_gyroscope(**given: float) -> dict[str, float]:
    """theta_ddot, phi_ddot, omega_3_dot; force F of the ground on the outer gimbal.

    Angles and axes as for the disks; the outer gimbal (C_o about z) turns by phi, the inner (A_i,
    B_i, C_i about 1, 2, 3) by theta in it; the rotor m, I_1, I_3 spins about 3, its centre at a
    along 3. The gimbals weigh nothing and are centred on the fixed point.
    """
    state = numbers(
        given,
        needs="m a g I_1 I_3 C_o A_i B_i C_i theta theta_dot phi_dot omega_3",
        zero="phi psi",
    )

    def place(q: Numbers) -> Parts:
        outer = Body(
            mass=0.0,
            moments=q.C_o * np.ones(3),
            rotation=turn_z(q.phi),
            omega=q.phi_dot * Z,
        )
        inner = Body(
            mass=0.0,
            moments=vector(q.A_i, q.B_i, q.C_i),
            rotation=disks.triad(q),
            omega=outer.omega + q.theta_dot * outer.rotation[:, 0],
        )
        axle = inner.rotation[:, 2]
        rotor = Body(
            mass=q.m,
            moments=vector(q.I_1, q.I_1, q.I_3),
            position=q.a * axle,
            velocity=q.a * np.cross(disks.omega(q), axle),
            rotation=inner.rotation @ turn_z(q.psi),
            omega=disks.omega(q),
        )
        return {"lab": LAB, "outer": outer, "inner": inner, "rotor": rotor}

    def rates(q: Numbers, parts: Parts) -> dict[str, Any]:
        psi_dot = q.omega_3 - q.phi_dot * np.cos(q.theta)
        return {"theta": q.theta_dot, "phi": q.phi_dot, "psi": psi_dot}

    answer = Scenario(
        place=place,
        state=state,
        rates=rates,
        speeds=disks.SPEEDS,
        constraints={
            "ground": hinge("outer", "lab", zero(), Z, Z),
            "trunnion": hinge("inner", "outer", zero(), X, X),
            "bearing": hinge("rotor", "inner", -state.a * Z, Z, Z),
        },
        gravity=-state.g * Z,
    ).answer()
    return answer.report(lab_force(answer, "F", "ground", "outer"))


def rolling_ellipsoid(**given: float) -> dict[str, float]:
    """omega_i_dot on the body's own axes; contact force F in the lab.

    Semi-axes b_1, b_2, b_3 along principal axes I_1, I_2, I_3; the body's axes are the lab's
    turned by Euler angles phi, theta, psi (z, x, z).
    """
    state = numbers(
        given,
        needs="m g b_1 b_2 b_3 I_1 I_2 I_3 theta omega_1 omega_2 omega_3",
        zero="phi psi x y",
    )
    state.attitude = turn_z(state.phi) @ turn_x(state.theta) @ turn_z(state.psi)
    surface = Ellipsoid((state.b_1, state.b_2, state.b_3))

    def place(q: Numbers) -> Parts:
        omega = q.attitude @ vector(q.omega_1, q.omega_2, q.omega_3)
        aloft = Body(
            mass=q.m, moments=vector(q.I_1, q.I_2, q.I_3), rotation=q.attitude, omega=omega
        )
        to_contact, _ = surface.point(aloft, Z, zero())
        position = vector(q.x, q.y, -to_contact[2])
        velocity = np.cross(to_contact, omega)
        return {"lab": LAB, "body": replace(aloft, position=position, velocity=velocity)}

    def rates(q: Numbers, parts: Parts) -> dict[str, Any]:
        v_x, v_y, _ = parts["body"].velocity
        return {"x": v_x, "y": v_y, "attitude": parts["body"].rotation_rate}

    answer = Scenario(
        place=place,
        state=state,
        rates=rates,
        speeds="omega_1 omega_2 omega_3",
        constraints={"contact": Held("body", "lab", surface)},
        gravity=-state.g * Z,
    ).answer()
    return answer.report(lab_force(answer, "F", "contact", "body"))

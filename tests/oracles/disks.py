"""Coin spinning on a frictionless table, disk rolling on a rough one.

Lab z is up. Axes (1, 2, 3): the lab turned by phi about z, then by theta about the new x; the body
turns by psi about 3. omega_3 = psi_dot + phi_dot cos(theta). Centre at height a sin(theta).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .constraints import Ellipsoid, Held, Parts, Smooth
from .parts import LAB, Array, Body, Z, turn_x, turn_z, vector
from .scenario import LAB_AXES, TRIAD, Numbers, Scenario, components, numbers

NEEDS = "m a g I_1 I_3 theta theta_dot phi_dot omega_3"
SPEEDS = "theta_dot phi_dot omega_3"


def spinning_coin(**given: float) -> dict[str, float]:
    """theta_ddot, phi_ddot, omega_3_dot, v_x_dot, v_y_dot and F_z."""
    state = numbers(given, needs=NEEDS, zero="v_x v_y phi psi x y")
    rim = Ellipsoid((state.a, state.a, 0))

    def place(q: Numbers) -> Parts:
        return {
            "lab": LAB,
            "disk": disk(q, vector(q.v_x, q.v_y, q.a * q.theta_dot * np.cos(q.theta))),
        }

    answer = Scenario(
        place=place,
        state=state,
        rates=rates,
        speeds=SPEEDS + " v_x v_y",
        constraints={"contact": Smooth("disk", "lab", rim)},
        gravity=-state.g * Z,
    ).answer()
    return answer.report({"F_z": float(answer.reaction("contact", "disk").force @ Z)})


def rolling_disk(**given: float) -> dict[str, float]:
    """theta_ddot, phi_ddot, omega_3_dot; contact force F_x, F_y, F_z and F_1, F_2, F_3."""
    state = numbers(given, needs=NEEDS, zero="phi psi x y")
    rim = Ellipsoid((state.a, state.a, 0))

    def place(q: Numbers) -> Parts:
        return {"lab": LAB, "disk": disk(q, q.a * np.cross(omega(q), triad(q)[:, 1]))}

    answer = Scenario(
        place=place,
        state=state,
        rates=rates,
        speeds=SPEEDS,
        constraints={"contact": Held("disk", "lab", rim)},
        gravity=-state.g * Z,
    ).answer()
    force = answer.reaction("contact", "disk").force
    return answer.report(
        components("F", force, LAB_AXES, np.eye(3)),
        components("F", force, TRIAD, triad(state)),
    )


def disk(q: Numbers, velocity: Array) -> Body:
    return Body(
        mass=q.m,
        moments=vector(q.I_1, q.I_1, q.I_3),
        position=vector(q.x, q.y, q.a * np.sin(q.theta)),
        velocity=velocity,
        rotation=triad(q) @ turn_z(q.psi),
        omega=omega(q),
    )


def triad(q: Numbers) -> Array:
    """Axes (1, 2, 3) as columns in the lab."""
    return turn_z(q.phi) @ turn_x(q.theta)


def omega(q: Numbers) -> Array:
    return triad(q) @ vector(q.theta_dot, q.phi_dot * np.sin(q.theta), q.omega_3)


def rates(q: Numbers, parts: Parts) -> dict[str, Any]:
    v_x, v_y, _ = parts["disk"].velocity
    psi_dot = q.omega_3 - q.phi_dot * np.cos(q.theta)
    return {"theta": q.theta_dot, "phi": q.phi_dot, "psi": psi_dot, "x": v_x, "y": v_y}

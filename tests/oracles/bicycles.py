"""A bicycle: two wheels that roll, a rear frame with its rider, a front frame that steers.

Lab z is up. Yaw psi about it, lean phi about the heading, pitch theta of the rear frame about the
axle, steer delta about the steering axis, which is tilted back by lambda_. Frames are described as
they stand upright: x forward and z up from the rear contact.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.optimize import brentq

from .constraints import Ellipsoid, Held, Parts, hinge
from .parts import LAB, Array, Body, X, Y, Z, turn_x, turn_y, turn_z, vector
from .scenario import Numbers, Scenario, lab_force, numbers

NEEDS = """
    w c lambda_ g r_R r_F m_R m_B m_H m_F x_B z_B x_H z_H I_Rxx I_Ryy I_Fxx I_Fyy
    I_Bxx I_Byy I_Bzz I_Bxz I_Hxx I_Hyy I_Hzz I_Hxz psi phi delta phi_dot delta_dot omega_y_R
"""
RAW = "psi_dot theta_dot omega_y_F v_x v_y"


def bicycle(**given: float) -> dict[str, float]:
    """theta, and phi_ddot, delta_ddot, omega_y_R_dot; forces F_R and F_F of the ground."""
    state = numbers(given, needs=NEEDS, zero="theta x y chi_R chi_F")
    state.theta = brentq(lambda theta: _height(Numbers(**{**vars(state), "theta": theta})), -1, 1)
    turned_B, turned_H = _principal(state, "B")[1], _principal(state, "H")[1]
    up = turn_y(-state.lambda_) @ Z

    def place(q: Numbers) -> Parts:
        return {"lab": LAB, **_placed(q, _dependent(q))}

    def rates(q: Numbers, parts: Parts) -> dict[str, Any]:
        raw = _dependent(q)
        spins = _spins(q, raw)
        v_x, v_y, _ = parts["R"].velocity
        known = {"psi": raw["psi_dot"], "phi": q.phi_dot, "theta": raw["theta_dot"]}
        return known | {"delta": q.delta_dot, **spins, "x": v_x, "y": v_y}

    answer = Scenario(
        place=place,
        state=state,
        rates=rates,
        speeds="phi_dot delta_dot omega_y_R",
        constraints={
            "rear": Held("R", "lab", Ellipsoid((state.r_R, 0, state.r_R))),
            "front": Held("F", "lab", Ellipsoid((state.r_F, 0, state.r_F))),
            "axle": hinge("B", "R", turned_B.T @ _rear_hub(state), turned_B.T @ Y, Y),
            "head": hinge("H", "B", turned_H.T @ _head(state), turned_H.T @ up, turned_B.T @ up),
            "hub": hinge("F", "H", 0 * X, Y, turned_H.T @ Y),
        },
        gravity=-state.g * Z,
    ).answer()
    forces = [
        {f"{name}_{wheel}": force for name, force in lab_force(answer, "F", contact, wheel).items()}
        for wheel, contact in (("R", "rear"), ("F", "front"))
    ]
    return answer.report({"theta": state.theta}, *forces)


def _rear_hub(q: Numbers) -> Array:
    """From the middle of the rear frame."""
    return vector(-q.x_B, 0, q.r_R - q.z_B)


def _head(q: Numbers) -> Array:
    """From the middle of the front frame to where the steering axis meets the upright ground."""
    return vector(q.w + q.c - q.x_H, 0, -q.z_H)


def _turns(q: Numbers) -> dict[str, Array]:
    """Axes of the leaning plane, of both frames and of the steering head, as columns."""
    lean = turn_z(q.psi) @ turn_x(q.phi)
    rear = lean @ turn_y(q.theta)
    steer = rear @ turn_y(-q.lambda_) @ turn_z(q.delta)
    return {"lean": lean, "rear": rear, "steer": steer, "fork": steer @ turn_y(q.lambda_)}


def _middles(q: Numbers) -> dict[str, Array]:
    turns = _turns(q)
    hub = vector(q.x, q.y, q.r_R * np.cos(q.phi))
    rear = hub - turns["rear"] @ _rear_hub(q)
    head = rear + turns["rear"] @ vector(q.w + q.c - q.x_B, 0, -q.z_B)
    front = head - turns["fork"] @ _head(q)
    wheel = front + turns["fork"] @ vector(q.w - q.x_H, 0, q.r_F - q.z_H)
    return {"R": hub, "B": rear, "H": front, "F": wheel}


def _lowest(axis: Array, radius: Any) -> Array:
    """From the middle of a wheel with this axis to the point that touches the ground."""
    steepest = Z - axis * axis[2]
    return -radius * steepest / np.sqrt(steepest @ steepest)


def _height(q: Numbers) -> float:
    """Of the front wheel's lowest point."""
    return float((_middles(q)["F"] + _lowest(_turns(q)["fork"][:, 1], q.r_F))[2])


def _angular(q: Numbers, raw: dict[str, Any]) -> dict[str, Array]:
    turns = _turns(q)
    lean = raw["psi_dot"] * Z + q.phi_dot * turns["lean"][:, 0]
    rear = lean + raw["theta_dot"] * turns["lean"][:, 1]
    front = rear + q.delta_dot * turns["steer"][:, 2]
    axles = turns["lean"][:, 1], turns["fork"][:, 1]
    return {
        "R": lean + (q.omega_y_R - lean @ axles[0]) * axles[0],
        "B": rear,
        "H": front,
        "F": front + (raw["omega_y_F"] - front @ axles[1]) * axles[1],
    }


def _spins(q: Numbers, raw: dict[str, Any]) -> dict[str, Any]:
    """Rates of the angles of the wheels against the axes that they spin in."""
    turns, angular = _turns(q), _angular(q, raw)
    lean = raw["psi_dot"] * Z + q.phi_dot * turns["lean"][:, 0]
    return {
        "chi_R": (angular["R"] - lean) @ turns["lean"][:, 1],
        "chi_F": (angular["F"] - angular["H"]) @ turns["fork"][:, 1],
    }


def _velocities(q: Numbers, raw: dict[str, Any]) -> dict[str, Array]:
    middles, angular = _middles(q), _angular(q, raw)
    head = middles["H"] + _turns(q)["fork"] @ _head(q)
    hub = vector(raw["v_x"], raw["v_y"], -q.r_R * np.sin(q.phi) * q.phi_dot)
    rear = hub + np.cross(angular["B"], middles["B"] - middles["R"])
    at_head = rear + np.cross(angular["B"], head - middles["B"])
    front = at_head + np.cross(angular["H"], middles["H"] - head)
    wheel = front + np.cross(angular["H"], middles["F"] - middles["H"])
    return {"R": hub, "B": rear, "H": front, "F": wheel}


def _slips(q: Numbers, raw: dict[str, Any]) -> Array:
    """Velocities at the contacts that are not zero by themselves."""
    turns, angular, velocities = _turns(q), _angular(q, raw), _velocities(q, raw)
    rear = velocities["R"] + np.cross(angular["R"], _lowest(turns["lean"][:, 1], q.r_R))
    front = velocities["F"] + np.cross(angular["F"], _lowest(turns["fork"][:, 1], q.r_F))
    return np.concatenate([rear[:2], front])


def _dependent(q: Numbers) -> dict[str, Any]:
    """The speeds that rolling leaves no choice of."""
    names = RAW.split()
    still = dict.fromkeys(names, 0.0)
    constant = _slips(q, still)
    columns = [_slips(q, {**still, name: 1.0}) - constant for name in names]
    return dict(zip(names, np.linalg.solve(np.transpose(columns), -constant), strict=True))


def _principal(q: Numbers, body: str) -> tuple[Array, Array]:
    """Principal moments of a frame, and its principal axes as columns."""
    xx, yy, zz, xz = (getattr(q, f"I_{body}{axes}") for axes in ("xx", "yy", "zz", "xz"))
    moments, axes = np.linalg.eigh(np.array([[xx, 0, xz], [0, yy, 0], [xz, 0, zz]]))
    return moments, axes * np.linalg.det(axes)


def _placed(q: Numbers, raw: dict[str, Any]) -> Parts:
    turns, middles = _turns(q), _middles(q)
    velocities, angular = _velocities(q, raw), _angular(q, raw)
    shapes = {
        "R": (vector(q.I_Rxx, q.I_Ryy, q.I_Rxx), turns["lean"] @ turn_y(q.chi_R)),
        "B": (_principal(q, "B")[0], turns["rear"] @ _principal(q, "B")[1]),
        "H": (_principal(q, "H")[0], turns["fork"] @ _principal(q, "H")[1]),
        "F": (vector(q.I_Fxx, q.I_Fyy, q.I_Fxx), turns["fork"] @ turn_y(q.chi_F)),
    }
    return {
        name: Body(
            mass=getattr(q, f"m_{name}"),
            moments=moments,
            position=middles[name],
            velocity=velocities[name],
            rotation=rotation,
            omega=angular[name],
        )
        for name, (moments, rotation) in shapes.items()
    }

"""Marble rolling on a turntable, ball rolling or sliding on a moving sheet of paper."""

from __future__ import annotations

from typing import Any

import numpy as np

from .constraints import Constraint, Ellipsoid, Held, Parts, Sliding
from .parts import Array, Body, Driven, Z, turn_z, vector
from .scenario import LAB_AXES, TRIAD, Answer, Numbers, Scenario, components, numbers

SHEET = "X Y angle X_dot Y_dot angle_dot X_ddot Y_ddot angle_ddot"


def tilted_turntable(**given: float) -> dict[str, float]:
    """v_2_dot, v_3_dot; omega_i, omega_i_dot and contact force F_i on the axes (1, 2, 3).

    1 is normal to the table, 2 up the slope, 3 horizontal; vertical = cos(alpha) 1 + sin(alpha) 2.
    """
    state = numbers(
        given,
        needs="m a I g alpha Omega x_2 x_3 v_2 v_3 omega_1",
        zero="Omega_dot",
        turn=0.0,
        attitude=np.eye(3),
    )
    axes = slope(state.alpha)
    normal, plane = axes[:, 0], axes[:, 1:]

    def place(q: Numbers) -> Parts:
        table = Driven(
            rotation=axes[:, [1, 2, 0]] @ turn_z(q.turn),  # its own third axis is the normal
            omega=q.Omega * normal,
            alpha=q.Omega_dot * normal,
        )
        radius, velocity = plane @ vector(q.x_2, q.x_3), plane @ vector(q.v_2, q.v_3)
        slip = velocity - np.cross(table.omega, radius)
        ball = Body(
            mass=q.m,
            moments=q.I * np.ones(3),
            position=radius + q.a * normal,
            velocity=velocity,
            rotation=q.attitude,
            omega=q.omega_1 * normal + rolling_spin(slip, normal, q.a),
        )
        return {"support": table, "ball": ball}

    def rates(q: Numbers, parts: Parts) -> dict[str, Any]:
        table = {"turn": q.Omega, "Omega": q.Omega_dot}
        return table | {"x_2": q.v_2, "x_3": q.v_3, "attitude": parts["ball"].rotation_rate}

    answer = Scenario(
        place=place,
        state=state,
        rates=rates,
        speeds="v_2 v_3 omega_1",
        constraints={"contact": Held("ball", "support", sphere(state))},
        gravity=-state.g * Z,
    ).answer()
    return answer.report(spin_and_contact(answer, TRIAD, axes))


def level_turntable(
    *, x: float, y: float, v_x: float, v_y: float, omega_z: float, **parameters: float
) -> dict[str, float]:
    """The same on a level table, in lab axes; parameters m, a, I, g, Omega and Omega_dot."""
    tilted = tilted_turntable(
        alpha=0.0, x_2=x, x_3=y, v_2=v_x, v_3=v_y, omega_1=omega_z, **parameters
    )
    lab_axis = dict(zip(TRIAD, ("z", "x", "y"), strict=True))
    return {
        "_".join(lab_axis.get(word, word) for word in name.split("_")): value
        for name, value in tilted.items()
    }


def rolling_on_paper(**given: float) -> dict[str, float]:
    """v_x_dot, v_y_dot; omega_i, omega_i_dot, contact force F_i and torque tau_i in the lab.

    I = k m a². X, Y, angle place the sheet; they and their _dot and _ddot are zero unless given.
    """
    state = numbers(given, needs="m a k g x y v_x v_y omega_z", zero=SHEET, attitude=np.eye(3))

    def place(q: Numbers) -> Parts:
        sheet = paper(q)
        contact, velocity = vector(q.x, q.y, 0), vector(q.v_x, q.v_y, 0)
        slip = velocity - sheet.velocity - np.cross(sheet.omega, contact - sheet.position)
        return {
            "support": sheet,
            "ball": ball_on_paper(q, rolling_spin(slip, Z, q.a) + q.omega_z * Z),
        }

    answer = Scenario(
        place=place,
        state=state,
        rates=paper_rates,
        speeds="v_x v_y omega_z",
        constraints={"contact": Held("ball", "support", sphere(state))},
        gravity=-state.g * Z,
    ).answer()
    return answer.report(spin_and_contact(answer, LAB_AXES, np.eye(3)))


def sliding_on_paper(**given: float) -> dict[str, float]:
    """As `rolling_on_paper`, slipping with friction mu: omega_x, omega_y, omega_z are free."""
    state = numbers(
        given,
        needs="m a k g mu x y v_x v_y omega_x omega_y omega_z",
        zero=SHEET,
        attitude=np.eye(3),
    )

    def place(q: Numbers) -> Parts:
        return {
            "support": paper(q),
            "ball": ball_on_paper(q, vector(q.omega_x, q.omega_y, q.omega_z)),
        }

    friction: Constraint = Sliding("ball", "support", sphere(state), state.mu)
    answer = Scenario(
        place=place,
        state=state,
        rates=paper_rates,
        speeds="v_x v_y omega_x omega_y omega_z",
        constraints={"contact": friction},
        gravity=-state.g * Z,
    ).answer()
    return answer.report(spin_and_contact(answer, LAB_AXES, np.eye(3)))


def slope(alpha: float) -> Array:
    """Axes (1, 2, 3) of a table tilted by alpha, as columns; at alpha = 0 they are (z, x, y)."""
    s, c = np.sin(alpha), np.cos(alpha)
    return np.array([[-s, c, 0], [0, 0, 1], [c, s, 0]])


def sphere(q: Numbers) -> Ellipsoid:
    return Ellipsoid((q.a, q.a, q.a))


def rolling_spin(slip: Array, normal: Array, radius: float) -> Array:
    """Angular velocity along the plane of a ball whose centre moves so relative to the plane."""
    return np.cross(normal, slip) / radius


def paper(q: Numbers) -> Driven:
    return Driven(
        position=vector(q.X, q.Y, 0),
        velocity=vector(q.X_dot, q.Y_dot, 0),
        acceleration=vector(q.X_ddot, q.Y_ddot, 0),
        rotation=turn_z(q.angle),
        omega=q.angle_dot * Z,
        alpha=q.angle_ddot * Z,
    )


def ball_on_paper(q: Numbers, omega: Array) -> Body:
    return Body(
        mass=q.m,
        moments=q.k * q.m * q.a**2 * np.ones(3),
        position=vector(q.x, q.y, q.a),
        velocity=vector(q.v_x, q.v_y, 0),
        rotation=q.attitude,
        omega=omega,
    )


def paper_rates(q: Numbers, parts: Parts) -> dict[str, Any]:
    sheet = {name: getattr(q, f"{name}_dot") for name in ("X", "Y", "angle")}
    sheet |= {f"{name}_dot": getattr(q, f"{name}_ddot") for name in ("X", "Y", "angle")}
    return sheet | {"x": q.v_x, "y": q.v_y, "attitude": parts["ball"].rotation_rate}


def spin_and_contact(answer: Answer, labels: tuple[str, ...], axes: Array) -> dict[str, float]:
    ball, contact = answer.parts["ball"], answer.reaction("contact", "ball")
    spin = components("omega", ball.omega, labels, axes)
    alpha = components("omega", answer.motion.angular["ball"], labels, axes)
    return (
        spin
        | {f"{name}_dot": value for name, value in alpha.items()}
        | components("F", contact.force, labels, axes)
        | components("tau", contact.torque, labels, axes)
    )

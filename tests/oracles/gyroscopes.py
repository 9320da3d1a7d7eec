"""Gyrocompass, free body, gyroscope with one point of its axle fixed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from .constraints import Constraint, Held, Parts, Perpendicular, Smooth, SpinRate, Spot
from .newton_euler import bodies_of
from .parts import LAB, Array, Body, Driven, X, Z, turn_x, turn_y, turn_z, vector, zero
from .scenario import LAB_AXES, TRIAD, Answer, Numbers, Scenario, components, numbers

EARTH_RADIUS = 2.0  # any number: the path of the compass must not matter
CYLINDER = ("rho", "phi", "z")


def free_rotor_compass(**given: float) -> dict[str, float]:
    """theta_ddot, omega_dot; guide torque tau_1, tau_2, tau_3 on the rotor.

    Inertial axes are (up, east, north) at this instant; the Earth turns with Omega about an axis at
    colatitude lambda_ from up. Axes (1, 2, 3) are those turned by -theta about up; the rotor turns
    with omega about 3 relative to them.
    """
    answer = _compass(given, {})
    return answer.report(_torque(answer, "tau", "guide", given["theta"]))


def motor_driven_compass(**given: float) -> dict[str, float]:
    """The same with omega kept constant by a motor of torque tau_motor_1, _2, _3 on the rotor."""
    motor = SpinRate("rotor", "earth", Z, given["omega"])
    answer = _compass(given, {"motor": motor})
    return answer.report(
        _torque(answer, "tau", "guide", given["theta"]),
        _torque(answer, "tau_motor", "motor", given["theta"]),
    )


def _compass(given: dict[str, float], motor: dict[str, Constraint]) -> Answer:
    state = numbers(given, needs="I_1 I_3 Omega lambda_ theta theta_dot omega", zero="psi", day=0.0)
    up, to_pole = X, turn_y(-state.lambda_)
    pole = to_pole @ up

    def place(q: Numbers) -> Parts:
        today = to_pole @ turn_x(q.day) @ to_pole.T
        earth = Driven(rotation=today, omega=q.Omega * pole)
        axes = today @ turn_x(-q.theta)
        centre = EARTH_RADIUS * (today @ up)
        rotor = Body(
            mass=1.0,
            moments=vector(q.I_1, q.I_1, q.I_3),
            position=centre,
            velocity=np.cross(earth.omega, centre),
            rotation=axes @ turn_z(q.psi),
            omega=earth.omega + axes @ vector(-q.theta_dot, 0, q.omega),
        )
        return {"earth": earth, "rotor": rotor}

    return Scenario(
        place=place,
        state=state,
        rates=lambda q, parts: {"day": q.Omega, "theta": q.theta_dot, "psi": q.omega},
        speeds="theta_dot omega",
        constraints={
            "centre": Held("rotor", "earth", Spot(zero())),
            "guide": Perpendicular("rotor", "earth", Z, up),
            **motor,
        },
    ).answer()


def _torque(answer: Answer, symbol: str, constraint: str, theta: float) -> dict[str, float]:
    return components(symbol, answer.reaction(constraint, "rotor").torque, TRIAD, turn_x(-theta))


def free_body(**given: float) -> dict[str, float]:
    """omega_i_dot on the body's axes; lab components of the angular momentum L and of its rate.

    The body's axes are the lab's turned by Euler angles phi, theta, psi (z, x, z).
    """
    state = numbers(given, needs="I_1 I_2 I_3 omega_1 omega_2 omega_3", zero="phi theta psi")
    state.attitude = turn_z(state.phi) @ turn_x(state.theta) @ turn_z(state.psi)

    def place(q: Numbers) -> Parts:
        body = Body(
            mass=1.0,
            moments=vector(q.I_1, q.I_2, q.I_3),
            rotation=q.attitude,
            omega=q.attitude @ vector(q.omega_1, q.omega_2, q.omega_3),
        )
        return {"body": body}

    answer = Scenario(
        place=place,
        state=state,
        rates=lambda q, parts: {"attitude": parts["body"].rotation_rate},
        speeds="omega_1 omega_2 omega_3",
        constraints={},
    ).answer()
    body = bodies_of(answer.parts)["body"]
    momentum_rate = body.inertia @ answer.motion.angular["body"] - body.gyroscopic_torque
    change = components("L", momentum_rate, LAB_AXES, np.eye(3))
    return answer.report(
        components("L", body.inertia @ body.omega, LAB_AXES, np.eye(3)),
        {f"{name}_dot": value for name, value in change.items()},
    )


GYROSCOPE = "M a g I_1 I_2 theta omega_1"


def gyroscope(**given: float) -> dict[str, float]:
    """theta_ddot, phi_ddot, omega_1_dot; pivot force F_rho, F_phi, F_z.

    Eqs. (90)-(100): 1 along the axle away from the pivot, 2 along phi-hat, 3 = 1 x 2; centre of
    mass at a along 1; omega_1 = psi_dot + phi_dot cos(theta).
    """
    state = numbers(given, needs=GYROSCOPE + " theta_dot phi_dot", zero="phi psi")
    answer = _gyroscope(state, {}, "theta_dot phi_dot omega_1")
    return answer.report(_force(answer, "F", "pivot", state))


def held_gyroscope(**given: float) -> dict[str, float]:
    """At rest but for its spin, by forces F at the pivot and Fprime at 2a: the least such pair."""
    state = numbers(given, needs=GYROSCOPE, zero="phi psi", theta_dot=0.0, phi_dot=0.0)
    far_end = {"hand": Held("rotor", "lab", Spot(state.a * X))}
    answer = _gyroscope(state, far_end, "omega_1")
    return answer.report(
        _force(answer, "F", "pivot", state), _force(answer, "Fprime", "hand", state)
    )


def gyroscope_in_vertical_plane(**given: float) -> dict[str, float]:
    """phi constant by a force along phi-hat at 2a: theta_ddot, omega_1_dot, F_i, Fprime_i."""
    state = numbers(given, needs=GYROSCOPE + " theta_dot", zero="phi psi", phi_dot=0.0)
    across = cylinder(state)[:, 1]
    guide = {"guide": Smooth("rotor", "lab", Spot(state.a * X), normal=across)}
    answer = _gyroscope(state, guide, "theta_dot omega_1")
    return answer.report(
        _force(answer, "F", "pivot", state), _force(answer, "Fprime", "guide", state)
    )


def _gyroscope(state: Numbers, held: Mapping[str, Constraint], speeds: str) -> Answer:
    def place(q: Numbers) -> Parts:
        axes = axle_triad(q)
        omega = axes @ vector(q.omega_1, q.theta_dot, q.phi_dot * np.sin(q.theta))
        rotor = Body(
            mass=q.M,
            moments=vector(q.I_1, q.I_2, q.I_2),
            position=q.a * axes[:, 0],
            velocity=q.a * np.cross(omega, axes[:, 0]),
            rotation=axes @ turn_x(q.psi),
            omega=omega,
        )
        return {"lab": LAB, "rotor": rotor}

    def rates(q: Numbers, parts: Parts) -> dict[str, Any]:
        psi_dot = q.omega_1 - q.phi_dot * np.cos(q.theta)
        return {"theta": q.theta_dot, "phi": q.phi_dot, "psi": psi_dot}

    return Scenario(
        place=place,
        state=state,
        rates=rates,
        speeds=speeds,
        constraints={"pivot": Held("rotor", "lab", Spot(-state.a * X)), **held},
        gravity=-state.g * Z,
    ).answer()


def cylinder(q: Numbers) -> Array:
    """(rho, phi, z) as columns."""
    return turn_z(q.phi)


def axle_triad(q: Numbers) -> Array:
    """(1, 2, 3) as columns, from their components on (rho, phi, z): eq. (90)."""
    s, c = np.sin(q.theta), np.cos(q.theta)
    on_cylinder: Array = np.array([[s, 0, -c], [0, 1, 0], [c, 0, s]])
    return cylinder(q) @ on_cylinder


def _force(answer: Answer, symbol: str, constraint: str, q: Numbers) -> dict[str, float]:
    return components(symbol, answer.reaction(constraint, "rotor").force, CYLINDER, cylinder(q))

"""Planar linkages of thin uniform rods, in the x-z plane; z is up."""

from __future__ import annotations

from typing import Any

import numpy as np

from .constraints import Parts, hinge
from .parts import LAB, Array, Body, X, Y, Z, vector, zero
from .scenario import Answer, Numbers, Scenario, lab_force, numbers


def double_pendulum(**given: float) -> dict[str, float]:
    """theta_1_ddot, theta_2_ddot; force F of the pivot, Fjoint of the upper rod on the lower.

    Rods m_1, l_1 and m_2, l_2; angles from the downward vertical, towards x.
    """
    state = numbers(given, needs="m_1 m_2 l_1 l_2 g theta_1 theta_2 theta_1_dot theta_2_dot")

    def place(q: Numbers) -> Parts:
        down_1, down_2 = (vector(np.sin(t), 0, -np.cos(t)) for t in (q.theta_1, q.theta_2))
        upper = _rod(q.m_1, q.l_1, zero(), zero(), down_1, q.theta_1_dot)
        knee, knee_velocity = 2 * upper.position, 2 * upper.velocity
        lower = _rod(q.m_2, q.l_2, knee, knee_velocity, down_2, q.theta_2_dot)
        return {"lab": LAB, "upper": upper, "lower": lower}

    answer = Scenario(
        place=place,
        state=state,
        rates=lambda q, parts: {"theta_1": q.theta_1_dot, "theta_2": q.theta_2_dot},
        speeds="theta_1_dot theta_2_dot",
        constraints={
            "pivot": hinge("upper", "lab", -state.l_1 / 2 * X, Y, Y),
            "knee": hinge("lower", "upper", -state.l_2 / 2 * X, Y, Y),
        },
        gravity=-state.g * Z,
    ).answer()
    return answer.report(
        lab_force(answer, "F", "pivot", "upper"), lab_force(answer, "Fjoint", "knee", "lower")
    )


def four_bar(**given: float) -> dict[str, float]:
    """theta_i, theta_i_dot, theta_i_ddot of all links; forces F and Fprime of the two pivots.

    Crank l_1 from the origin, rocker l_3 from (d, 0, 0), coupler l_2 from the crank's end to the
    rocker's; angles from x towards z, crank and rocker from their pivots. `branch` is 1 where the
    coupler's end lies left of the line from the crank's end to the rocker's pivot (x to the right,
    z up), -1 where it lies right.
    """
    state = numbers(given, needs="m_1 m_2 m_3 l_1 l_2 l_3 d g branch theta_1 theta_1_dot")

    def place(q: Numbers) -> Parts:
        directions = _four_bar_directions(q)
        rates = _four_bar_rates(q, directions)
        along_1, along_2, along_3 = directions
        crank = _rod(q.m_1, q.l_1, zero(), zero(), along_1, rates[0])
        coupler = _rod(q.m_2, q.l_2, 2 * crank.position, 2 * crank.velocity, along_2, rates[1])
        rocker = _rod(q.m_3, q.l_3, q.d * X, zero(), along_3, rates[2])
        return {"lab": LAB, "link_1": crank, "link_2": coupler, "link_3": rocker}

    answer = Scenario(
        place=place,
        state=state,
        rates=lambda q, parts: {"theta_1": q.theta_1_dot},
        speeds="theta_1_dot",
        constraints={
            "pivot_1": hinge("link_1", "lab", -state.l_1 / 2 * X, Y, Y),
            "joint_12": hinge("link_2", "link_1", -state.l_2 / 2 * X, Y, Y),
            "joint_23": hinge("link_2", "link_3", state.l_2 / 2 * X, Y, Y),
            "pivot_3": hinge("link_3", "lab", -state.l_3 / 2 * X, Y, Y),
        },
        gravity=-state.g * Z,
    ).answer()
    return answer.report(
        *(_link_angle(answer, number) for number in (1, 2, 3)),
        lab_force(answer, "F", "pivot_1", "link_1"),
        lab_force(answer, "Fprime", "pivot_3", "link_3"),
    )


def _rod(
    mass: float, length: float, end: Array, end_velocity: Array, along: Array, rate: Any
) -> Body:
    """A rod from `end` along a direction of the x-z plane that turns at `rate` (x towards z)."""
    omega = -rate * Y
    return Body(
        mass=mass,
        moments=mass * length**2 / 12 * np.ones(3),  # that about the rod itself cannot matter
        position=end + length / 2 * along,
        velocity=end_velocity + length / 2 * np.cross(omega, along),
        rotation=np.column_stack([along, Y, np.cross(along, Y)]),
        omega=omega,
    )


def _four_bar_directions(q: Numbers) -> tuple[Array, Array, Array]:
    """The coupler's end lies on two circles: about the crank's end and about the rocker's pivot."""
    along = vector(np.cos(q.theta_1), 0, np.sin(q.theta_1))
    chord = q.d * X - q.l_1 * along
    square = chord @ chord
    forth = (q.l_2**2 - q.l_3**2 + square) / (2 * square)
    aside = q.branch * np.sqrt(q.l_2**2 / square - forth**2)
    coupler = forth * chord + aside * np.cross(chord, Y)
    return along, coupler / q.l_2, (coupler - chord) / q.l_3


def _four_bar_rates(q: Numbers, directions: tuple[Array, Array, Array]) -> Array:
    """The chain stays closed: l_1 crank + l_2 coupler = l_3 rocker, differentiated."""
    lengths = (q.l_1, q.l_2, -q.l_3)
    sides = [
        length * np.cross(along, Y)[[0, 2]]
        for length, along in zip(lengths, directions, strict=True)
    ]
    others = np.linalg.solve(np.column_stack(sides[1:]), -q.theta_1_dot * sides[0])
    return np.array([q.theta_1_dot, *others])


def _link_angle(answer: Answer, number: int) -> dict[str, float]:
    link, alpha = answer.parts[f"link_{number}"], answer.motion.angular[f"link_{number}"]
    along = link.rotation[:, 0]
    return {
        f"theta_{number}": float(np.arctan2(along[2], along[0])),
        f"theta_{number}_dot": float(-link.omega[1]),
        f"theta_{number}_ddot": float(-alpha[1]),
    }

"""Velocity constraints between two parts, each with its own analytic time derivative.

Either part may be a free body or a driven support: a constraint does not know which. A contact is a
point of part a (fixed in it, or the touching point of its surface) and the matter of part b there.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from .parts import Array, Placed, X, Y, Z, skew

Parts = Mapping[str, Placed]
Pair = dict[str, Array]


@dataclass(frozen=True)
class Rows:
    """k scalar constraints: d(residual)/dt = Σ jacobian[part] @ twist_rate[part] + bias.

    `wrenches` holds, row by row, the force and torque on each part per unit multiplier.
    """

    residual: Array
    jacobian: Pair
    bias: Array
    wrenches: Pair


class Constraint(Protocol):
    def rows(self, parts: Parts) -> Rows: ...


class Surface(Protocol):
    def point(self, body: Placed, normal: Array, normal_rate: Array) -> tuple[Array, Array]:
        """Vector from the body's origin to the touching point, and its rate, in the lab."""
        ...


@dataclass(frozen=True)
class Spot:
    """A point fixed in the body, in the body's own axes."""

    at: Array

    def point(self, body: Placed, normal: Array, normal_rate: Array) -> tuple[Array, Array]:
        arm = body.rotation @ self.at
        return arm, np.cross(body.omega, arm)


@dataclass(frozen=True)
class Ellipsoid:
    """A surface with these semi-axes: (a, a, a) is a sphere, (a, a, 0) the rim of a thin disk."""

    semi_axes: tuple[float, float, float]

    def point(self, body: Placed, normal: Array, normal_rate: Array) -> tuple[Array, Array]:
        shape = body.rotation @ np.diag(np.square(self.semi_axes)) @ body.rotation.T
        turning = skew(body.omega)
        support = shape @ normal
        support_rate = (turning @ shape - shape @ turning) @ normal + shape @ normal_rate
        height = np.sqrt(normal @ support)
        height_rate = (normal_rate @ support + normal @ support_rate) / (2 * height)
        return -support / height, (support * height_rate / height - support_rate) / height


def _touching(parts: Parts, a: str, b: str, surface: Surface, axis: Array) -> tuple[Rows, Array]:
    """Relative velocity of the two material points at the contact, as three rows; the normal."""
    body, base = parts[a], parts[b]
    normal = base.rotation @ axis
    arm, arm_rate = surface.point(body, normal, np.cross(base.omega, normal))
    reach = body.position + arm - base.position
    reach_rate = body.velocity + arm_rate - base.velocity
    on_body = np.hstack([np.eye(3), -skew(arm)])
    on_base = np.hstack([-np.eye(3), skew(reach)])
    slip = on_body @ body.twist + on_base @ base.twist
    bias = np.cross(body.omega, arm_rate) - np.cross(base.omega, reach_rate)
    jacobian = {a: on_body, b: on_base}
    return Rows(slip, jacobian, bias, jacobian), normal


def _combined(rows: Rows, weights: Array, weights_rate: Array, forces: Array) -> Rows:
    """One row: `weights` · rows, with the reaction acting along `forces`."""
    return Rows(
        residual=np.array([weights @ rows.residual]),
        jacobian={name: (weights @ block)[None] for name, block in rows.jacobian.items()},
        bias=np.array([weights @ rows.bias + weights_rate @ rows.residual]),
        wrenches={name: (forces @ block)[None] for name, block in rows.jacobian.items()},
    )


@dataclass(frozen=True)
class Held:
    """No relative velocity at the contact: a pivot for a `Spot`, rolling for an `Ellipsoid`."""

    a: str
    b: str
    surface: Surface
    normal: Array = field(default_factory=lambda: Z)

    def rows(self, parts: Parts) -> Rows:
        return _touching(parts, self.a, self.b, self.surface, self.normal)[0]


@dataclass(frozen=True)
class Smooth:
    """The contact neither parts nor sinks along the normal, fixed in part b; no friction."""

    a: str
    b: str
    surface: Surface
    normal: Array = field(default_factory=lambda: Z)

    def rows(self, parts: Parts) -> Rows:
        rows, normal = _touching(parts, self.a, self.b, self.surface, self.normal)
        return _combined(rows, normal, np.cross(parts[self.b].omega, normal), normal)


@dataclass(frozen=True)
class Sliding:
    """`Smooth`, with Coulomb friction against the slip: the reaction leans back by mu."""

    a: str
    b: str
    surface: Surface
    mu: float
    normal: Array = field(default_factory=lambda: Z)

    def rows(self, parts: Parts) -> Rows:
        rows, normal = _touching(parts, self.a, self.b, self.surface, self.normal)
        slip = rows.residual - normal * (normal @ rows.residual)
        reaction = normal - self.mu * slip / np.sqrt(slip @ slip)
        return _combined(rows, normal, np.cross(parts[self.b].omega, normal), reaction)


def _turning(parts: Parts, a: str, b: str, axis: Array, axis_rate: Array) -> Rows:
    """Relative angular velocity of a against b along a moving lab vector."""
    relative = parts[a].omega - parts[b].omega
    row = np.concatenate([np.zeros(3), axis])[None]
    jacobian = {a: row, b: -row}
    return Rows(np.array([relative @ axis]), jacobian, np.array([relative @ axis_rate]), jacobian)


@dataclass(frozen=True)
class Perpendicular:
    """A direction of a kept perpendicular to a direction of b (a guide)."""

    a: str
    b: str
    axis_a: Array
    axis_b: Array

    def rows(self, parts: Parts) -> Rows:
        body, base = parts[self.a], parts[self.b]
        u, w = body.rotation @ self.axis_a, base.rotation @ self.axis_b
        u_rate, w_rate = np.cross(body.omega, u), np.cross(base.omega, w)
        axis_rate = np.cross(u_rate, w) + np.cross(u, w_rate)
        return _turning(parts, self.a, self.b, np.cross(u, w), axis_rate)


@dataclass(frozen=True)
class SpinRate:
    """A motor: a turns about its own axis at a given rate relative to b."""

    a: str
    b: str
    axis_a: Array
    rate: float
    rate_dot: float = 0.0

    def rows(self, parts: Parts) -> Rows:
        axis = parts[self.a].rotation @ self.axis_a
        rows = _turning(parts, self.a, self.b, axis, np.cross(parts[self.a].omega, axis))
        return Rows(
            rows.residual - self.rate, rows.jacobian, rows.bias - self.rate_dot, rows.wrenches
        )


@dataclass(frozen=True)
class Joint:
    """Several constraints between the same two parts, acting as one."""

    members: tuple[Constraint, ...]

    def rows(self, parts: Parts) -> Rows:
        every = [member.rows(parts) for member in self.members]

        def stacked(pairs: list[Pair]) -> Pair:
            return {name: np.vstack([pair[name] for pair in pairs]) for name in pairs[0]}

        return Rows(
            np.concatenate([rows.residual for rows in every]),
            stacked([rows.jacobian for rows in every]),
            np.concatenate([rows.bias for rows in every]),
            stacked([rows.wrenches for rows in every]),
        )


def parallel(a: str, b: str, axis_a: Array, axis_b: Array) -> Joint:
    """A direction of a kept along a direction of b."""
    seed = min((X, Y, Z), key=lambda e: abs(e @ axis_b))
    across = np.cross(axis_b, seed)
    return Joint(
        tuple(Perpendicular(a, b, axis_a, side) for side in (across, np.cross(axis_b, across)))
    )


def hinge(a: str, b: str, at: Array, axis_a: Array, axis_b: Array) -> Joint:
    """A common point (`at`, in a's axes) and a common axis."""
    return Joint((Held(a, b, Spot(at)), parallel(a, b, axis_a, axis_b)))


def universal(a: str, b: str, at: Array, axis_a: Array, axis_b: Array) -> Joint:
    """A common point (`at`, in a's axes) and the two arms of the cross, kept perpendicular."""
    return Joint((Held(a, b, Spot(at)), Perpendicular(a, b, axis_a, axis_b)))

"""What moves: free bodies and driven supports, placed in one inertial frame. SI units.

Arrays may be complex: tests and charts differentiate along the motion by a complex step.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
X, Y, Z = np.eye(3)


def zero() -> Array:
    return np.zeros(3)


def vector(*components: Any) -> Array:
    return np.array(components)


def skew(u: Array) -> Array:
    """The matrix whose product with v is u × v."""
    return np.array([[0, -u[2], u[1]], [u[2], 0, -u[0]], [-u[1], u[0], 0]])


def turn_x(angle: Any) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


def turn_z(angle: Any) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def turn_y(angle: Any) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


@dataclass(frozen=True, kw_only=True)
class Placed:
    """Position of the origin, rotation (columns: own axes in the lab), and their velocities."""

    position: Array = field(default_factory=zero)
    rotation: Array
    velocity: Array = field(default_factory=zero)
    omega: Array

    @property
    def twist(self) -> Array:
        return np.concatenate([self.velocity, self.omega])

    @property
    def rotation_rate(self) -> Array:
        return skew(self.omega) @ self.rotation


@dataclass(frozen=True, kw_only=True)
class Body(Placed):
    """A free rigid body: origin at its centre of mass, own axes principal."""

    mass: float
    moments: Array

    @property
    def inertia(self) -> Array:
        return (self.rotation * self.moments) @ self.rotation.T

    @property
    def mass_matrix(self) -> Array:
        matrix = np.zeros((6, 6))
        matrix[:3, :3] = self.mass * np.eye(3)
        matrix[3:, 3:] = self.inertia
        return matrix

    @property
    def gyroscopic_torque(self) -> Array:
        return -np.cross(self.omega, self.inertia @ self.omega)


@dataclass(frozen=True, kw_only=True)
class Driven(Placed):
    """A support whose whole motion is given, accelerations included."""

    acceleration: Array = field(default_factory=zero)
    alpha: Array = field(default_factory=zero)

    @property
    def twist_rate(self) -> Array:
        return np.concatenate([self.acceleration, self.alpha])


LAB = Driven(rotation=np.eye(3), omega=zero())

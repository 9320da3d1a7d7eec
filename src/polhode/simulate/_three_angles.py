"""Three successive rotations in numbers: axes from angles, angles from axes, and their rates.

With the axes a, b, e of the rotations at zero angles, where b is perpendicular to a and to e, and
c = a × b, the last axis is e = cos λ a + sin λ c. The first rotation leaves a, the first two turn e
into the third axis n of rotation, and all three turn b into w: n and w describe the attitude.

    d = sin q₁ b − cos q₁ c        second axis = cos q₁ b + sin q₁ c
    n = cos μ a + sin μ d          with μ = q₂ − λ, singular where sin μ = 0
    w = cos q₃ second axis + sin q₃ n × second axis
    ω = q̇₁ a + q̇₂ second axis + q̇₃ n

Turned by a right angle about b, the axes from which the angles are counted lead from c to a.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos, sin, sqrt

import numpy as np

from polhode.simulate.integrate._arrays import Array

#: Sine of the second angle that is rounding: only the sum of the other two is then determined.
AT_POLE = 1e-14


@dataclass(frozen=True)
class PoleChoice:
    """What describes an attitude where its angles leave a choice.

    Attributes:
        side: sign of the sine of the second angle.
        first: the first angle while the third axis coincides with the first, at a time; it goes
            on at a steady rate.
    """

    side: float = 1.0
    first: float = 0.0
    rate: float = 0.0
    time: float = 0.0


@dataclass(frozen=True)
class AttitudeAxes:
    """An attitude, as vectors along the axes from which its angles are counted, shape (3, ...).

    Attributes:
        third: axis of the last rotation.
        mark: the second axis at zero angles, after all rotations.
    """

    third: Array
    mark: Array


@dataclass(frozen=True)
class ThreeAngles:
    """The geometry of three rotations.

    Attributes:
        first, second, last: their axes at zero angles, shape (3,).
    """

    first: Array
    second: Array
    last: Array

    @cached_property
    def across(self) -> Array:
        """c, perpendicular to the first two."""
        return np.cross(self.first, self.second)

    @cached_property
    def offset(self) -> float:
        """λ: of the second angle, where the third axis coincides with the first."""
        return float(np.arctan2(self.last @ self.across, self.last @ self.first))

    def is_near_pole(self, angle: float, limit: float) -> bool:
        """Whether the sine of the second angle, less the offset, is small."""
        return abs(sin(angle - self.offset)) < limit

    def sines(self, first: float, second: float) -> tuple[float, float]:
        """Of the second angle before and after turning the axes, from the angles after it."""
        sine = sin(second - self.offset)
        return sqrt(max(1.0 - (sine * cos(first)) ** 2, 0.0)), abs(sine)

    def attitude(self, angles: Array) -> AttitudeAxes:
        """The attitude at angles of shape (3, ...)."""
        direction, second = self._frame(angles[0])
        mu = angles[1] - self.offset
        third = np.cos(mu) * _column(self.first, mu) + np.sin(mu) * direction
        mark = np.cos(angles[2]) * second + np.sin(angles[2]) * np.cross(third, second, axis=0)
        return AttitudeAxes(third, mark)

    def angles(self, attitude: AttitudeAxes, choice: PoleChoice, times: Array) -> Array:
        """The angles of an attitude, shape (3, ...), as an arctangent gives them."""
        third, mark, side = attitude.third, attitude.mark, choice.side
        along, aside = _dot(self.second, third), -_dot(self.across, third)
        sine = np.hypot(along, aside)
        steady = choice.first + choice.rate * (times - choice.time)
        first = np.where(sine > AT_POLE, np.arctan2(side * along, side * aside), steady)
        mu = np.arctan2(side * sine, _dot(self.first, third))
        _, second = self._frame(first)
        last = np.arctan2(_inner(mark, np.cross(third, second, axis=0)), _inner(mark, second))
        return np.array([first, mu + self.offset, last])

    def angular_velocity(self, angles: Array, rates: Array) -> Array:
        """Angular velocity along the axes from which the angles are counted, shape (3, ...)."""
        _, second = self._frame(angles[0])
        third = self.attitude(angles).third
        first = _column(self.first, angles[0])
        found: Array = rates[0] * first + rates[1] * second + rates[2] * third
        return found

    def rates(self, angles: Array, angular_velocity: Array, choice: PoleChoice) -> Array:
        """The rates of the angles."""
        direction, second = self._frame(angles[0])
        mu = angles[1] - self.offset
        about = _dot(self.first, angular_velocity)
        with np.errstate(all="ignore"):
            last = _inner(angular_velocity, direction) / np.sin(mu)
        last = np.where(np.abs(np.sin(mu)) > AT_POLE, last, (about - choice.rate) * np.cos(mu))
        first = about - last * np.cos(mu)
        return np.array([first, _inner(angular_velocity, second), last])

    def angular_acceleration(self, angles: Array, rates: Array, second_rates: Array) -> Array:
        """The rate of the angular velocity along axes that do not turn."""
        _, second = self._frame(angles[0])
        third, first = self.attitude(angles).third, _column(self.first, angles[0])
        turned = rates[0] * first + rates[1] * second
        found: Array = (
            self.angular_velocity(angles, second_rates)
            + rates[1] * rates[0] * np.cross(first, second, axis=0)
            + rates[2] * np.cross(turned, third, axis=0)
        )
        return found

    def turned(self, vector: Array) -> Array:
        """A vector along the axes that are turned by a right angle."""
        found: Array = np.array([self.across, self.second, -self.first]).T @ self._parts(vector)
        return found

    def turned_back(self, vector: Array) -> Array:
        """The opposite."""
        found: Array = np.array([-self.across, self.second, self.first]).T @ self._parts(vector)
        return found

    def _parts(self, vector: Array) -> Array:
        """Components along a, b, c."""
        found: Array = np.array([self.first, self.second, self.across]) @ vector
        return found

    def _frame(self, angle: Array) -> tuple[Array, Array]:
        """d, and the second axis."""
        second, across = _column(self.second, angle), _column(self.across, angle)
        sine, cosine = np.sin(angle), np.cos(angle)
        return sine * second - cosine * across, cosine * second + sine * across


def _column(vector: Array, like: Array) -> Array:
    """A constant vector, to be combined with arrays of shape (...)."""
    return vector.reshape(3, *(1 for _ in np.shape(like)))


def _dot(constant: Array, vector: Array) -> Array:
    found: Array = np.tensordot(constant, vector, 1)
    return found


def _inner(one: Array, other: Array) -> Array:
    found: Array = np.sum(one * other, axis=0)
    return found

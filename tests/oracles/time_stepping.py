"""Moreau and Jean's time-stepping of bodies with dry friction: no events, no modes, first order.

In each step the impulse of the support is the one with which the velocity at the end of the step
obeys Signorini's condition and Coulomb's law (J. J. Moreau, in Nonsmooth Mechanics and
Applications, CISM 302, 1988; M. Jean, Comput. Methods Appl. Mech. Eng. 177, 1999). Whether it
sticks or slips, touches or not, is decided by that alone. One coefficient of friction; velocities
are advanced implicitly. Vectors of a level plane are complex numbers, x + iy.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .parts import Array

#: Velocity of the support at a time under a place.
Support = Callable[[float, complex], complex]

#: Place, velocity, and velocity a ω × ẑ at which rolling would carry it.
State = tuple[complex, complex, complex]

_ROUNDS = 100  # for the direction of slip within a step
_Z = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Slider:
    """A ball, k = I/(m a²), or a block, k = ∞, with friction μ on a level support that moves."""

    k: float
    mu: float
    g: float

    def follow(self, support: Support, state: State, duration: float, steps: int) -> State:
        """The state a duration later; `support` counts time from its begin."""
        place, velocity, rim = state
        h = duration / steps
        felt = 1 + 1 / self.k
        most = felt * self.mu * self.g * h
        for step in range(1, steps + 1):
            slip = velocity - rim - support(step * h, place)
            size = abs(slip)
            left = 1 - most / size if size > most else 0.0
            impulse = slip * (left - 1) / felt
            velocity += impulse
            rim -= impulse / self.k
            place += h * velocity
        return place, velocity, rim


@dataclass(frozen=True)
class Disk:
    """Mass, radius, moments of inertia across the axis and about it, of a thin disk on a table."""

    m: float
    a: float
    across: float
    about: float
    mu: float
    g: float

    def follow(self, state: Array, duration: float, steps: int) -> Array:
        """Place, velocity, axis and angular velocity of the disk, shape (12,), in the lab."""
        place, velocity, axis, omega = np.split(np.array(state, dtype=float), 4)
        h = duration / steps
        push = np.zeros(3)
        for _ in range(steps):
            begin, axis = axis, _turned(axis, h / 2 * omega)
            arm = self._arm(axis)
            along = np.outer(axis, axis)
            inverse = (np.eye(3) - along) / self.across + along / self.about
            velocity = velocity - h * self.g * _Z
            omega = omega - h * self._gyration(axis, omega - h / 2 * self._gyration(axis, omega))
            hat = _hat(arm)
            felt = np.eye(3) / self.m - hat @ inverse @ hat
            gap = place[2] + arm[2]
            free = velocity + np.cross(omega, arm)
            push = impulse(felt, free + _Z * max(gap, 0.0) / h, self.mu, push)
            velocity = velocity + push / self.m
            omega = omega + inverse @ (hat @ push)
            place = place + h * velocity
            axis = _turned(begin, h * omega)
        return np.concatenate([place, velocity, axis, omega])

    def _gyration(self, axis: Array, omega: Array) -> Array:
        """I⁻¹ (ω × I ω) = (I₃/I₁ − 1) ω₃ ω × n."""
        spun = (self.about - self.across) / self.across * (axis @ omega)
        return np.asarray(spun * np.cross(omega, axis))

    def _arm(self, axis: Array) -> Array:
        """From the centre to the lowest point."""
        steep = _Z - axis * axis[2]
        return np.asarray(-self.a * steep / np.linalg.norm(steep))


def impulse(felt: Array, free: Array, mu: float, guess: Array) -> Array:
    """Of a contact whose velocity without it would be `free`: none, sticking, or slipping.

    `felt` is the change of velocity at the contact per impulse there, shape (3, 3).
    """
    if free[2] >= 0:
        return np.zeros(3)
    held = -np.linalg.solve(felt, free)
    if held[2] > 0 and np.hypot(*held[:2]) <= mu * held[2]:
        return held
    against = guess[:2] if np.any(guess[:2]) else held[:2]
    against = against / np.hypot(*against)
    for _ in range(_ROUNDS):
        cone = np.array([*(mu * against), 1.0])
        push = -free[2] / (felt[2] @ cone) * cone
        slip = (free + felt @ push)[:2]
        size = np.hypot(*slip)
        # damped: the direction turned by its own slip, measured in what an impulse undoes
        wanted = mu * push[2] * against - slip / felt[0, 0]
        turned = wanted / np.hypot(*wanted)
        moved = np.hypot(*(turned - against))
        against = turned
        if moved < 1e-13 or size < 1e-15:
            break
    cone = np.array([*(mu * against), 1.0])
    return np.asarray(-free[2] / (felt[2] @ cone) * cone)


def _hat(r: Array) -> Array:
    return np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])


def _turned(axis: Array, angle: Array) -> Array:
    size = np.linalg.norm(angle)
    if size == 0:
        return axis
    along = angle / size
    return np.asarray(
        axis * np.cos(size)
        + np.cross(along, axis) * np.sin(size)
        + along * (along @ axis) * (1 - np.cos(size))
    )


@dataclass(frozen=True)
class RestingBall:
    """A ball, k = I/(m a²), that slides, rolls and spins on a level table until it rests.

    Coefficients of sliding friction, of rolling resistance, and of friction against spinning over
    the radius. `spin` is a ω·ẑ, and `rim` as in a `State`.
    """

    k: float
    sliding: float
    rolling: float
    spinning: float
    g: float

    def follow(
        self, velocity: complex, rim: complex, spin: float, duration: float, steps: int
    ) -> tuple[complex, complex, float, complex]:
        """Velocity, rim, spin and place a duration later, from the origin."""
        h, place = duration / steps, 0j
        weight = self.g * h
        for _ in range(steps):
            # Each law in turn, with the impulses of the other, until both hold at the end of the
            # step: slip = v - rim changes by (1 + 1/k) of the first, rim by 1/k of the second.
            rubbed, resisted = 0j, 0j
            for _ in range(_ROUNDS):
                slip = (velocity - rim) - resisted / self.k
                rubbed = _opposing(slip, self.sliding * weight, 1 + 1 / self.k)
                turning = rim - rubbed / self.k
                resisted = _opposing(turning, self.rolling * weight, 1 / self.k)
            velocity += rubbed
            rim += (resisted - rubbed) / self.k
            spin += _opposing(spin, self.spinning * weight, 1 / self.k).real / self.k
            place += h * velocity
        return velocity, rim, spin, place


def _opposing(speed: complex, most: float, felt: float) -> complex:
    """The impulse that brings a speed to zero, or towards it where that exceeds the most."""
    needed = -speed / felt
    return needed if abs(needed) <= most else needed * most / abs(needed)

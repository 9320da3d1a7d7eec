"""A thin disk on a level table with friction that is smooth: −μ N tanh(|s|/ε) ŝ, never switched.

Centre (x, y), symmetry axis n and angular velocity ω in the lab; the height follows from n. As
ε falls the motion tends to that with dry friction, its error in proportion to ε.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from .parts import Array

_Z = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Disk:
    """Mass, radius, moments of inertia across the axis and about it."""

    m: float
    a: float
    across: float
    about: float
    mu: float
    g: float


def slip(disk: Disk, velocity: Array, n: Array, omega: Array) -> Array:
    """Velocity of the lowest point, the height's rate included."""
    return velocity + np.cross(omega, arm(disk, n))


def arm(disk: Disk, n: Array) -> Array:
    steep = _Z - n * n[2]
    return -disk.a * steep / np.linalg.norm(steep)


def follow(disk: Disk, state: Array, duration: float, eps: float) -> Array:
    """State x, y, v_x, v_y, n (3), ω (3) after some time."""
    found = solve_ivp(
        lambda _, y: _rates(disk, y, eps),
        (0.0, duration),
        state,
        method="LSODA",
        rtol=1e-11,
        atol=1e-13,
    )
    return np.asarray(found.y[:, -1])


def _rates(disk: Disk, y: Array, eps: float) -> Array:
    n = y[4:7] / np.linalg.norm(y[4:7])
    omega = y[7:10]
    n_rate = np.cross(omega, n)
    s = np.sqrt(1 - n[2] ** 2)
    rise = -disk.a * n[2] * n_rate[2] / s
    velocity = np.array([y[2], y[3], rise])
    slipping = slip(disk, velocity, n, omega)[:2]
    size = np.hypot(*slipping)
    grip = np.tanh(size / eps) / size if size > 1e-12 * eps else 1 / eps
    push = np.array([*(-disk.mu * grip * slipping), 1.0])

    inertia = disk.across * (np.eye(3) - np.outer(n, n)) + disk.about * np.outer(n, n)
    spin = inertia @ omega
    inverse = np.linalg.inv(inertia)
    torque = np.cross(arm(disk, n), push)
    free, forced = inverse @ -np.cross(omega, spin), inverse @ torque
    turned = np.cross(omega, n_rate)

    def lift(alpha: Array, with_rest: bool) -> float:
        """Second rate of the height a √(1 − n_z²)."""
        bend = np.cross(alpha, n)[2]
        if not with_rest:
            return float(-disk.a * n[2] * bend / s)
        bend += turned[2]
        square = n_rate[2] ** 2
        return float(-disk.a * ((square + n[2] * bend) / s + n[2] ** 2 * square / s**3))

    normal = (disk.g + lift(free, True)) / (1 / disk.m - lift(forced, False))
    acceleration = normal * push[:2] / disk.m
    return np.array([y[2], y[3], *acceleration, *n_rate, *(free + normal * forced)])

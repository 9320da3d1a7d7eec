"""Closed forms of a ball, k = I/(m a²), that slides, spins and bounces on a level table."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .parts import Array


@dataclass(frozen=True)
class Slide:
    """A ball that slides on a table at rest: a parabola, then a straight line.

    Attributes:
        velocity: of its centre at the start, m/s.
        spin: ω_x, ω_y at the start, rad/s.
    """

    k: float
    a: float
    mu: float
    g: float
    velocity: Array
    spin: Array

    @property
    def rim(self) -> Array:
        """u = a ω × ẑ, the velocity at which rolling would carry it."""
        return self.a * np.array([self.spin[1], -self.spin[0]])

    @property
    def slip(self) -> Array:
        return self.velocity - self.rim

    @property
    def time(self) -> float:
        """When it rolls."""
        return float(np.hypot(*self.slip)) / ((1 + 1 / self.k) * self.mu * self.g)

    @property
    def final(self) -> Array:
        return (self.velocity + self.k * self.rim) / (1 + self.k)

    def place(self, t: float) -> Array:
        """Its centre, from where it started."""
        sliding = min(t, self.time)
        drag = self.mu * self.g * self.slip / np.hypot(*self.slip)
        parabola = self.velocity * sliding - drag * sliding**2 / 2
        return parabola + self.final * (t - sliding)


@dataclass(frozen=True)
class Bounces:
    """A ball dropped on a table that moves evenly; friction acts in the bounces only, and after.

    Attributes:
        height: of its lowest point at the start, m.
        rise: its vertical velocity there, m/s.
        slip: its lowest point against the table, m/s.
    """

    k: float
    mu: float
    g: float
    restitution: float
    height: float
    rise: float
    slip: float

    @property
    def impact(self) -> float:
        """Speed of the first landing."""
        return float(np.sqrt(self.rise**2 + 2 * self.g * self.height))

    @property
    def first(self) -> float:
        return (self.rise + self.impact) / self.g

    def landing(self, n: int) -> float:
        """Time of the landing number n = 0, 1, …"""
        e = self.restitution
        return self.first + 2 * self.impact / self.g * sum(e**i for i in range(1, n + 1))

    @property
    def end(self) -> float:
        """When it has come to rest on the table."""
        e = self.restitution
        return self.first + 2 * self.impact * e / (self.g * (1 - e))

    def slip_after(self, landings: int) -> float:
        """Slip speed after so many landings: friction takes at most μ (1 + 1/k) per impulse."""
        e = self.restitution
        impulse = sum((1 + e) * self.impact * e**i for i in range(landings))
        return max(self.slip - self.mu * (1 + 1 / self.k) * impulse, 0.0)

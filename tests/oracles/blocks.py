"""Closed forms of a block that sticks to, and slips on, a shaking or tilting support."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq


@dataclass(frozen=True)
class Shaken:
    """On a sheet with X = R sin(w t): slip and grip by the sheet's acceleration alone."""

    reach: float
    w: float
    mu: float
    mu_static: float
    g: float

    @property
    def slips(self) -> float:
        """First instant at which the sheet accelerates by μ_s g."""
        return float(np.arcsin(self.mu_static * self.g / (self.reach * self.w**2))) / self.w

    def speed(self, t: float) -> float:
        """Of the block, slipping since then: the sheet decelerates faster than friction can."""
        start = self.reach * self.w * np.cos(self.w * self.slips)
        return float(start - self.mu * self.g * (t - self.slips))

    def slip(self, t: float) -> float:
        return float(self.speed(t) - self.reach * self.w * np.cos(self.w * t))

    @property
    def sticks(self) -> float:
        """When the sheet has its speed again."""
        looks = self.slips + np.linspace(1e-3, 1.0, 4000) * 2 * np.pi / self.w
        signs = np.array([self.slip(t) for t in looks])
        after = int(np.argmax(signs < 0))
        return float(brentq(self.slip, looks[after - 1], looks[after], xtol=1e-15, rtol=1e-14))

    @property
    def shift(self) -> float:
        """How far it has slipped in between, m."""
        t = self.sticks - self.slips
        start = self.reach * self.w * np.cos(self.w * self.slips)
        own = start * t - self.mu * self.g * t * t / 2
        sheet = self.reach * (np.sin(self.w * self.sticks) - np.sin(self.w * self.slips))
        return float(own - sheet)


@dataclass(frozen=True)
class Tilted:
    """On a plane that tilts by rate·t about a horizontal line under it, y up the slope."""

    rate: float
    height: float
    y: float
    mu_static: float
    g: float

    def reserve(self, t: float) -> float:
        """Static limit less friction needed, per mass."""
        beta, spin = self.rate * t, self.rate**2
        along = self.g * np.sin(beta) - self.y * spin
        normal = self.g * np.cos(beta) - self.height * spin
        return float(self.mu_static * normal - abs(along))

    @property
    def slips(self) -> float:
        return float(brentq(self.reserve, 0.0, 1.5 / self.rate, xtol=1e-15, rtol=1e-14))

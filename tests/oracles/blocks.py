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
    def crest(self) -> float:
        """The static limit over the largest acceleration of the sheet: sine of the phase then."""
        return float(self.mu_static * self.g / (self.reach * self.w**2))

    @property
    def slips(self) -> float:
        """First instant at which the sheet accelerates by μ_s g."""
        return float(np.arcsin(self.crest)) / self.w

    def slip(self, phase: float) -> float:
        """Over R w, a phase after it has begun: cos φ − (μ/μ_s) θ sin φ − cos(φ + θ)."""
        sine = self.crest
        cosine = np.sqrt((1 - sine) * (1 + sine))
        lag = _sine_less_angle(phase) + phase * (1 - self.mu / self.mu_static)
        return float(2 * cosine * np.sin(phase / 2) ** 2 + sine * lag)

    @property
    def lasts(self) -> float:
        """Phase over which it slips: until the sheet has its speed again."""
        looks = np.geomspace(1e-9, 2 * np.pi, 20_000)
        signs = np.array([self.slip(phase) for phase in looks])
        after = int(np.argmax(signs < 0))
        return float(brentq(self.slip, looks[after - 1], looks[after], xtol=1e-15, rtol=1e-14))

    @property
    def sticks(self) -> float:
        return self.slips + self.lasts / self.w

    @property
    def shift(self) -> float:
        """How far it has slipped in between, m."""
        steps, weights = np.polynomial.legendre.leggauss(40)
        half = self.lasts / 2
        slips = np.array([self.slip(half * (1 + step)) for step in steps])
        return float(self.reach * half * (weights @ slips))


def _sine_less_angle(angle: float) -> float:
    """sin θ − θ, to its last digit."""
    if abs(angle) > 0.5:
        return float(np.sin(angle) - angle)
    term = total = -(angle**3) / 6
    for n in range(5, 25, 2):
        term *= -(angle**2) / (n * (n - 1))
        total += term
    return total


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

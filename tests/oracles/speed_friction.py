"""A block or ball that slides straight under friction that depends on its slip speed.

σ' = −f g (μ + c σ + (μ_s − μ) exp(−σ/w)), f = 1 for a block and 1 + 1/k for a ball.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .parts import Array


@dataclass(frozen=True)
class Sliding:
    """Friction, and the slip speed at the start.

    Attributes:
        viscous: c, s/m.
        surplus: μ_s − μ.
        stribeck: w, m/s.
        felt: f.
    """

    slip: float
    mu: float
    g: float
    viscous: float = 0.0
    surplus: float = 0.0
    stribeck: float = 1.0
    felt: float = 1.0

    def slowing(self, slip: Array) -> Array:
        falling = self.surplus * np.exp(-slip / self.stribeck)
        return self.felt * self.g * (self.mu + self.viscous * slip + falling)

    def time(self, slip: float) -> float:
        """When it has come down to a slip."""
        return self._gathered(slip, lambda at: 1 / self.slowing(at))

    def way(self, slip: float) -> float:
        """How far it has slipped by then."""
        return self._gathered(slip, lambda at: at / self.slowing(at))

    def _gathered(self, slip: float, integrand: Callable[[Array], Array]) -> float:
        """From a slip to that of the start, by Gauss's rule in panels."""
        points, weights = np.polynomial.legendre.leggauss(20)
        edges = np.linspace(slip, self.slip, 41)
        half = (edges[1] - edges[0]) / 2
        middles = (edges[:-1] + edges[1:]) / 2
        return float(half * np.sum(integrand(middles[:, None] + half * points) @ weights))

    def viscous_slip(self, t: float) -> float:
        """The exponential of dry and viscous friction alone."""
        rate, dry = self.felt * self.g * self.viscous, self.mu / self.viscous
        return float((self.slip + dry) * np.exp(-rate * t) - dry)

    @property
    def viscous_end(self) -> float:
        rate = self.felt * self.g * self.viscous
        return float(np.log1p(self.viscous * self.slip / self.mu) / rate)

    @property
    def stribeck_end(self) -> float:
        """Of Stribeck's law without viscous friction."""
        top = self.slip / self.stribeck
        gone = top + np.log((self.mu + self.surplus * np.exp(-top)) / (self.mu + self.surplus))
        return float(self.stribeck * gone / (self.mu * self.felt * self.g))

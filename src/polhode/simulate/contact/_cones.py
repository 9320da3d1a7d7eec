"""Forces within cones of friction: whether some of those that balance the loads lie in all."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from polhode.simulate.integrate._arrays import Array

HELD = 1e-12  # of the largest force: forces this far outside their cones are at its edge

#: A reaction as a constant, and its changes with those that are free.
Affine = tuple[float, Array]


class FrictionCone:
    """μ N - |T| of a contact, where N and T depend on the free reactions; or N, with no limit."""

    def __init__(self, most: float, normal: Affine, *along: Affine) -> None:
        factor = 1.0 if np.isinf(most) else most
        self._normal = factor * normal[0], factor * normal[1]
        self._constants = np.array([c for c, _ in along])
        self._slopes = np.array([s for _, s in along]).reshape(len(along), len(normal[1]))

    def reserve(self, free: Array) -> float:
        """How far the force is within the cone, N."""
        constant, slope = self._normal
        along = self._constants + self._slopes @ free
        return float(constant + slope @ free - np.sqrt(along @ along))

    def barrier(self, free: Array, least: float) -> tuple[Array, Array]:
        """Gradient and Hessian of -log((μ N - least)² - |T|²) by `free` and `least`."""
        constant, slope = self._normal
        height = constant + slope @ free - least
        along = self._constants + self._slopes @ free
        inside = height**2 - along @ along
        rise = np.append(slope, -1.0)  # of the height
        turns = np.hstack([self._slopes, np.zeros((len(along), 1))])
        first = 2 * (height * rise - along @ turns)
        second = 2 * (np.outer(rise, rise) - turns.T @ turns)
        return -first / inside, np.outer(first, first) / inside**2 - second / inside


@dataclass
class _Search:
    """Reactions that raise the least reserve of all cones, by a barrier (Boyd and Vandenberghe,
    Convex Optimization, 2004, sect. 11.3)."""

    cones: Sequence[FrictionCone]
    free: Array
    least: float

    def weights(self, scale: float) -> Iterator[Any]:
        """Weights of the least reserve, up to one at which it is as large as it can be."""
        weight = 1 / scale
        while 2 * len(self.cones) / weight > HELD * scale / 10:
            yield weight
            weight *= 8

    def centred(self, weight: float) -> None:
        """Newton's method for the largest weight · least + Σ log inside."""
        for _ in range(50):
            parts = [cone.barrier(self.free, self.least) for cone in self.cones]
            gradient = sum((g for g, _ in parts), np.zeros(len(self.free) + 1))
            gradient[-1] -= weight
            hessian = sum((h for _, h in parts), np.zeros((len(gradient), len(gradient))))
            step = np.asarray(-np.linalg.lstsq(hessian, gradient, rcond=1e-14)[0], dtype=float)
            decrement = float(-gradient @ step)
            # damped as for self-concordant functions
            share = 1.0 if decrement < 0.25 else 1 / (1 + decrement**0.5)
            while not self._is_inside(step, share) and share > 1e-12:
                share /= 2
            self.free = self.free + share * step[:-1]
            self.least += share * float(step[-1])
            if decrement < 1e-10 or share <= 1e-12:
                return

    def _is_inside(self, step: Array, share: float) -> bool:
        free, least = self.free + share * step[:-1], self.least + share * step[-1]
        return all(cone.reserve(free) > least for cone in self.cones)


def can_hold(cones: Sequence[FrictionCone], count: int, scale: float) -> bool:
    """Whether there are free reactions for which all forces lie within their cones.

    Args:
        count: of the free reactions.
        scale: size of the forces, N.
    """
    free = np.zeros(count)

    def reserve(at: Array) -> float:
        return min((cone.reserve(at) for cone in cones), default=0.0)

    if reserve(free) >= -HELD * scale:
        return True
    if not count:
        return False
    search = _Search(cones, free, reserve(free) - scale)
    for weight in search.weights(scale):
        search.centred(weight)
        if reserve(search.free) >= -HELD * scale:
            return True
    return False


def strained(cones: Sequence[FrictionCone], count: int, scale: float) -> tuple[int, ...]:
    """The cones at whose edges the forces are, where their least reserve is largest."""
    free = np.zeros(count)
    search = _Search(cones, free, min(cone.reserve(free) for cone in cones) - scale)
    for weight in search.weights(scale) if count else ():
        search.centred(weight)
    reserves = [cone.reserve(search.free) for cone in cones]
    return tuple(i for i, r in enumerate(reserves) if r <= min(reserves) + _STRAINED * scale)


_STRAINED = 1e-6  # of the largest force: reserves that differ by less are the same

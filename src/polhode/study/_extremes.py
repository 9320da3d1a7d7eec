"""The largest value of a quantity along a motion."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.simulate import Trajectory
from polhode.study._columns import Array

Quantity: TypeAlias = str | Symbol | Expr

_LOOKS = 4  # between the ends of a step
_NARROWED = 40


def largest(run: Trajectory, quantity: Quantity, sign: float) -> float:
    """The largest value of sign · quantity, which is smooth within a step of the integrator."""

    def values(times: Array) -> Array:
        return sign * run.evaluate(quantity, times)

    ends = np.unique(np.concatenate([segment.steps for segment in run.segments]))
    ends = ends[ends <= run.duration]
    inside = np.linspace(0.0, 1.0, _LOOKS, endpoint=False)
    grid = np.append((ends[:-1, None] + np.diff(ends)[:, None] * inside).ravel(), run.duration)
    found = values(grid)
    best = int(np.argmax(found))
    left, right = grid[max(best - 1, 0)], grid[min(best + 1, len(grid) - 1)]
    return max(float(found[best]), _narrowed(values, left, right))


def _narrowed(values: Callable[[Array], Array], left: float, right: float) -> float:
    """The largest value between two times, by looking ever closer around the best so far."""
    best = -np.inf
    for _ in range(_NARROWED):
        times = np.linspace(left, right, 7)
        found = values(times)
        k = int(np.argmax(found))
        best = max(best, float(found[k]))
        left, right = times[max(k - 1, 0)], times[min(k + 1, 6)]
        if right - left <= 1e-9 * max(abs(right), 1e-300):
            break
    return best

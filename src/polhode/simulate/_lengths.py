"""Lengths of vectors that vanish on the way, where their square roots have no series.

Along a straight line |v| = √(v_x² + v_y²) is a multiple of |t − t₀|, and a series about an earlier
instant goes on as if it were one of t₀ − t: friction along v/|v| would drive. Steps that see the
branch of the root near them are shorter than the way to it, so that within one step a length
changes little. One that falls to almost nothing within a step was passed unseen.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from polhode.algebra import SquareRoot
from polhode.base import NumericError
from polhode.simulate._dynamics import Dynamics
from polhode.simulate._segment import TrajectoryPiece, values_of
from polhode.simulate.integrate._stepping import Array

_PLACES = np.linspace(0.0, 1.0, 9)  # of a step, at which a radicand is looked at
_SMALL = 0.05  # of the largest radicand within a step: a reason to look closer
_NOTHING = 1e-6  # of the same: what no step that saw the root coming can fall to
_NARROWED = 60  # times by a third


def refuse_vanishing(dynamics: Dynamics, part: TrajectoryPiece) -> None:
    """Refuse a part of a motion on which a length vanishes.

    Raises:
        NumericError: with the length and the time.
    """
    roots = dynamics.lengths
    if not roots or not part.end > part.begin:
        return
    steps = part.solution.steps
    knots = np.append(steps[steps < part.end], part.end)
    times = knots[:-1, None] + np.diff(knots)[:, None] * _PLACES
    inside = replace(part)  # so that what is remembered for readers of the motion stays

    def radicands(times: Array) -> Array:
        found = values_of(dynamics, inside, [root.radicand for root in roots], times.ravel())
        return found.reshape(len(roots), *times.shape)

    values = radicands(times)
    largest, least = values.max(axis=2), values.min(axis=2)
    for k, step in zip(*np.nonzero(least < _SMALL * largest), strict=True):
        when = _lowest(radicands, int(k), times[step], values[k, step])
        if radicands(np.array([when]))[k, 0] < _NOTHING * largest[k, step]:
            raise _vanishes(roots[k], when)


def _lowest(functions: Callable[[Array], Array], k: int, times: Array, values: Array) -> float:
    """Where one of some functions is least within a step, beside the least of some values."""
    place = int(np.argmin(values))
    left, right = times[max(place - 1, 0)], times[min(place + 1, len(times) - 1)]
    for _ in range(_NARROWED):
        third = (right - left) / 3
        first, second = functions(np.array([left + third, right - third]))[k]
        left, right = (left, right - third) if first < second else (left + third, right)
    return float((left + right) / 2)


def _vanishes(root: SquareRoot, time: float) -> NumericError:
    return NumericError(
        f"sqrt({root.radicand}) vanishes at t = {time:.9g} s, and has no direction there",
        expected="a length that stays positive: what follows is not determined",
        advice="start elsewhere, or give the line that the motion keeps to one coordinate: an "
        "absolute value is followed through zero; declare dry friction as ph.Coulomb",
    )

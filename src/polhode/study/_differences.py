"""Derivatives from differences of motions, extrapolated to no difference.

Source: C. J. F. Ridders, Advances in Engineering Software 4 (1982) 75.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from polhode.study._columns import Array

_FIRST = 1e-3  # of the size of what is varied
_FINER = 4
_RUNGS = 6
_ENOUGH = 1e-10  # relative error


class Slope(NamedTuple):
    """A derivative, and what it is uncertain by."""

    value: Array
    error: Array


def slope(values: Callable[[float], Array | None], middle: Array, size: float) -> Slope | None:
    """Derivative of values by what they depend on, element by element.

    Args:
        values: at a departure from where it is wanted; None where they cannot be compared.
        middle: where it is wanted.
        size: by which departures are measured.

    Returns:
        None where there are none to compare, however small the departure. Where the derivative
        jumps it is the mean of both sides, and the error half of the jump.
    """
    best: Slope | None = None
    rising, folded = list[Array](), list[Array]()  # differences of ever higher order
    for rung in range(_RUNGS):
        step = _FIRST * size / _FINER**rung
        ahead, behind = values(step), values(-step)
        if ahead is None or behind is None:
            rising, folded = [], []
            continue
        rising = _extrapolated((ahead - behind) / (2 * step), rising, 2)
        folded = _extrapolated((ahead - 2 * middle + behind) / (2 * step), folded, 1)
        if len(rising) == 1:
            best = best or Slope(rising[0], np.full_like(rising[0], np.inf))
            continue
        error = np.abs(rising[-1] - rising[-2]) + np.abs(folded[-1])
        best = _better(best, Slope(rising[-1], error))
        if np.all(best.error <= _ENOUGH * np.abs(best.value)):
            break
    return best


def _extrapolated(finest: Array, coarser: list[Array], first: int) -> list[Array]:
    """With ever more terms of the error taken off, of which the first goes with that power."""
    found = [finest]
    for order, coarse in enumerate(coarser):
        found.append(found[-1] + (found[-1] - coarse) / (_FINER ** (2 * order + first) - 1))
    return found


def _better(one: Slope | None, other: Slope) -> Slope:
    if one is None:
        return other
    surer = other.error < one.error
    return Slope(np.where(surer, other.value, one.value), np.where(surer, other.error, one.error))

"""Differential equations given as a function of numbers, integrated by extrapolation.

For equations that are no program, such as those of an independent check. Over a step the midpoint
rule is done with 2, 4, 6, … parts; its error is a series in the squares of their lengths, whose
terms are eliminated one by one.

Source: Gragg, SIAM Journal on Numerical Analysis 2 (1965) 384; Hairer, Nørsett and Wanner, Solving
Ordinary Differential Equations I, section II.9.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from polhode.base._errors import NumericError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

_COLUMNS = 9  # of the extrapolation: up to order 18
_EASY = 6  # columns within which a step has been a short one
_SHORTEST = 1e-13  # of the whole, for a step
_SMALL = 1e-2  # of the largest component: smaller ones are as accurate as that


def integrated(
    rates: Callable[[float, Array], Any],
    begin: float,
    end: float,
    state: Any,
    tolerance: float,
) -> Array:
    """The state at the end.

    Args:
        rates: of the state, from the independent variable and the state.
        state: at the beginning.
        tolerance: of a step, relative to the largest component so far of each.

    Raises:
        NumericError: where the equations cannot be followed.
    """
    import numpy as np

    def slopes(here: float, state: Array) -> Array:
        return np.asarray(rates(here, state), dtype=float)

    here, now = begin, np.array(state, dtype=float)
    length, scale = end - begin, np.abs(now)
    step = length
    while here != end:
        last = abs(end - here) <= abs(step)
        if last:
            step = end - here
        with np.errstate(all="ignore"):
            found, columns = _extrapolated(slopes, here, now, step, scale, tolerance)
        if found is None:
            step /= 4
            if not abs(step) > _SHORTEST * abs(length):
                raise NumericError(
                    f"differential equations between {begin:g} and {end:g}, followed to {here:g}",
                    expected="rates that are finite and smooth",
                )
            continue
        here, now = (end if last else here + step), found
        scale = np.maximum(scale, np.abs(now))
        if columns < _EASY:
            step *= 2
    return now


def _extrapolated(
    slopes: Callable[[float, Array], Array],
    here: float,
    state: Array,
    step: float,
    scale: Array,
    tolerance: float,
) -> tuple[Array | None, int]:
    """The state after a step, None if it does not converge, and the columns that it took."""
    import numpy as np

    first = slopes(here, state)
    above: list[Array] = []
    for k in range(1, _COLUMNS + 1):
        row = [_by_midpoints(slopes, here, state, first, step, 2 * k)]
        for j, earlier in enumerate(above, 1):
            ratio = (k / (k - j)) ** 2
            row.append(row[-1] + (row[-1] - earlier) / (ratio - 1))
        if not np.all(np.isfinite(row[-1])):
            return None, k
        if k > 2:
            size = np.maximum(scale, np.abs(row[-1]))
            # components that are zero have the scale of the others
            allowed = tolerance * np.maximum(size, _SMALL * np.max(size, initial=0.0))
            if np.all(np.abs(row[-1] - row[-2]) <= allowed):
                return row[-1], k
        above = row
    return None, _COLUMNS


def _by_midpoints(
    slopes: Callable[[float, Array], Array],
    here: float,
    state: Array,
    first: Array,
    step: float,
    parts: int,
) -> Array:
    """The midpoint rule in so many parts, begun by Euler's rule and smoothed at its end."""
    part = step / parts
    before, now = state, state + part * first
    for i in range(1, parts):
        before, now = now, before + 2 * part * slopes(here + i * part, now)
    smoothed: Array = (before + now + part * slopes(here + step, now)) / 2
    return smoothed

"""Polynomials in powers, one after the other, read at many places at once."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_AT_ONCE = 4096  # places: the coefficients of more would fill the memory


def evaluated(coefficients: Array, which: NDArray[np.intp], places: Array) -> Array:
    """Values of polynomials, shape (rows, places).

    Args:
        coefficients: by rising power, shape (polynomials, rows, powers).
        which: the polynomial at each place.
        places: what is raised to the powers.
    """
    found = np.empty((coefficients.shape[1], len(places)))
    for here in _portions(len(places)):
        chosen = coefficients[which[here]]
        powers = powers_of(places[here], chosen.shape[2] - 1)
        # what is added to the first term is summed up before, so that it is rounded only once
        rest = np.einsum("prk,pk->pr", chosen[:, :, 1:], powers)
        found[:, here] = (chosen[:, :, 0] + rest).T
    return found


def powers_of(values: Array, count: int) -> Array:
    """The first, second, … power of each, shape (values, count)."""
    return np.asarray(np.multiply.accumulate(np.repeat(values[:, None], count, axis=1), axis=1))


def pieces_at(knots: Array, times: Array) -> NDArray[np.intp]:
    """Between which knots, by the place of the left one; beyond the ends the outermost."""
    return np.searchsorted(knots[1:-1], times, "right")


def _portions(count: int) -> Iterator[slice]:
    for begin in range(0, count, _AT_ONCE):
        yield slice(begin, begin + _AT_ONCE)

"""Array helpers: values in rows, times in order, and piecewise polynomials at many places."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_CHUNK = 4096  # places evaluated together: coefficients are copied for each, which bounds memory


def rows(values: Sequence[Any], size: int, dtype: Any = float) -> Any:
    """Values as rows, shape (values, size): arrays of that size, or numbers to fill a row."""
    found = np.empty((len(values), size), dtype)
    for row, value in zip(found, values, strict=True):
        row[:] = value
    return found


def ascending(times: Sequence[Array]) -> Array:
    """All times, sorted and without repetitions; `np.unique` would import `numpy.ma` for it."""
    every: Array = np.sort(np.concatenate(times))
    first: Array = every[np.append([True], every[1:] != every[:-1])]
    return first


def occurring(which: NDArray[np.signedinteger[Any]]) -> NDArray[np.intp]:
    """Which of the whole numbers from 0 on occur, in order."""
    return np.flatnonzero(np.bincount(which))


# -- piecewise polynomials ---------------------------------------------------------------------


def evaluated(coefficients: Array, which: NDArray[np.intp], places: Array) -> Array:
    """Values of polynomials, shape (rows, places).

    Neighbours that read the same polynomial, as the nodes of a quadrature do, are read together.

    Args:
        coefficients: by rising power, shape (polynomials, rows, powers).
        which: the polynomial at each place.
        places: what is raised to the powers.
    """
    found = np.empty((coefficients.shape[1], len(places)))
    for begin in range(0, len(places), _CHUNK):
        here = slice(begin, begin + _CHUNK)
        asked = which[here]
        changes = np.flatnonzero(np.diff(asked)) + 1
        # The largest group size that divides every run of neighbours on the same polynomial: the
        # places form groups of this size, and each group needs one copy of its coefficients.
        together = int(np.gcd.reduce(np.append(changes, len(asked))))
        chosen = coefficients[asked[::together]]
        powers = powers_of(places[here], chosen.shape[2] - 1)
        powers = powers.reshape(len(powers), -1, together).swapaxes(0, 1)
        # The constant term is added last: it is usually the largest, and is rounded only once.
        values = chosen[:, :, :1] + chosen[:, :, 1:] @ powers
        found[:, here] = values.swapaxes(0, 1).reshape(len(found), -1)
    return found


def powers_of(values: Array, count: int) -> Array:
    """The first, second, … power of each, shape (count, values)."""
    powers = np.empty((count, len(values)))
    powers[:1] = values
    known = 1  # doubled in every pass: x^(known + j) = x^known · x^j
    while known < count:
        new = powers[known : 2 * known]
        np.multiply(powers[: len(new)], powers[known - 1], out=new)
        known += len(new)
    return powers


def pieces_at(knots: Array, times: Array) -> NDArray[np.intp]:
    """The piece that every time is in; beyond the ends, the outermost."""
    return np.searchsorted(knots[1:-1], times, "right")


_PROBED = 8 * float(np.finfo(float).eps)  # a few roundings


def probed(states: Array) -> Array:
    """States, shape (states, times), changed by a few roundings: what depends on them is unsure.

    They change alternately up and down, so that common factors do not cancel.
    """
    signs = np.where(np.arange(len(states)) % 2, -1.0, 1.0)
    changed: Array = states * (1.0 + _PROBED * signs[:, None])
    return changed

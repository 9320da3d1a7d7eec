"""Python functions of time as polynomials, to rounding."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import pairwise
from math import inf, isfinite

import numpy as np
from numpy.polynomial import chebyshev

from polhode.base import NumericError
from polhode.simulate.forcing._pieces import Pieces
from polhode.simulate.integrate._stepping import Array

Function = Callable[[float], float]

_DEGREE = 11
_ROUNDING = 6 * np.finfo(float).eps
_NOTHING = np.finfo(float).eps / 2  # a coefficient that small is rounding
_HELPED = 64  # by what halving a piece reduces its error at least, and in fact by 4096
_AT_ENDS = 16  # roundings by which a piece may be off where it ends
_SHORTEST = 1e-7  # length of a piece over the whole: shorter ones mean a corner
_MOST = 100_000  # pieces


def approximated(
    function: Function, start: float, end: float, *, corners: Iterable[float] = ()
) -> Pieces:
    """A smooth Python function of time as polynomials that agree with it to rounding.

    Outside the span it is at rest where the span ends.

    Args:
        function: of the time in seconds.
        start: s.
        end: s.
        corners: times at which the function or its rate jumps.

    Raises:
        NumericError: for a function that has no finite value, or is not smooth between corners.
    """
    bounds = [start, *sorted(float(t) for t in corners if start < t < end), end]
    if not (isfinite(start) and isfinite(end) and start < end):
        raise NumericError(f"a span from {start:g} s to {end:g} s", expected="a span of time")
    knots, tables, jerks = np.array([start]), list[Array](), list[int]()
    for left, right in pairwise(bounds):
        ends, table = _joined(_resolved(function, left, right, _SHORTEST * (end - start)))
        knots = np.concatenate([knots, ends])
        tables.append(table)
        jerks.append(len(knots) - 1)
    return Pieces(knots, np.vstack(tables), tuple(jerks[:-1]))


@dataclass(frozen=True)
class _Piece:
    """A polynomial between two times, in powers of the time since the left one.

    Attributes:
        size: of the function's values.
        rounding: what the function's values are uncertain by, as far as they tell.
        error: by how much they differ from it between the values that it was made of.
    """

    left: float
    right: float
    powers: Array
    size: float
    rounding: float
    error: float


def _resolved(function: Function, left: float, right: float, shortest: float) -> list[_Piece]:
    """Pieces from left to right, halved until each agrees with the function."""
    whole = _fitted(function, left, right)
    done, waiting = list[_Piece](), [(whole, inf)]
    while waiting:
        piece, before = waiting.pop()
        a, b = piece.left, piece.right
        if _agrees(piece, before, _ROUNDING * whole.size):
            done.append(piece)
        elif b - a < shortest or len(done) > _MOST:
            raise _not_smooth(a)
        else:
            halves = ((a + b) / 2, b), (a, (a + b) / 2)
            waiting += [(_fitted(function, *half), piece.error) for half in halves]
    return done


def _agrees(piece: _Piece, before: float, noise: float) -> bool:
    """Whether what is left of the error is rounding: of the values, or of what they are made of.

    The latter shows, where large terms cancel, in that halving the piece has not helped.
    """
    return piece.error <= piece.rounding or before / _HELPED < piece.error <= noise


def _fitted(function: Function, left: float, right: float) -> _Piece:
    """The polynomial through the function's values, compared with it in between."""
    values = _values(function, left, right, _NODES)
    series = _SERIES @ (values - values[0])
    size = float(np.max(np.abs(values)))
    series[np.abs(series) < _NOTHING * size] = 0.0
    series[0] += values[0]
    error = chebyshev.chebval(_BETWEEN, series) - _values(function, left, right, _BETWEEN)
    rate = float(np.max(np.abs(np.diff(values) / np.diff(_NODES)))) * 2 / (right - left)
    rounding = _ROUNDING * (size + max(abs(left), abs(right)) * rate)
    powers = _POWERS @ series / (right - left) ** np.arange(_DEGREE + 1)
    return _Piece(left, right, powers, size, rounding, float(np.max(np.abs(error))))


def _not_smooth(time: float) -> NumericError:
    return NumericError(
        f"a prescribed motion that is not smooth near t = {time:.6g} s",
        expected="a smooth function of time",
        advice="name the times at which it jumps or has a corner",
    )


def _values(function: Function, left: float, right: float, places: Array) -> Array:
    """Of the function, at places between -1 and 1."""
    times = (left + right + (right - left) * places) / 2
    try:
        values = np.array([float(function(t)) for t in times.tolist()])
    except Exception as error:  # whatever a user's function may raise
        raise NumericError(
            f"a prescribed motion that fails between {left:.6g} s and {right:.6g} s ({error})",
            expected="a function from a time in seconds to a number",
        ) from error
    if not np.all(np.isfinite(values)):
        raise NumericError(
            f"a prescribed motion that is not finite at t = {times[~np.isfinite(values)][0]:.6g} s",
            expected="a number at every time",
        )
    return values


def _joined(pieces: list[_Piece]) -> tuple[Array, Array]:
    """Right ends and coefficients, with the last rounding between pieces taken out.

    Values and rates on both sides of a joint are brought to their mean by a cubic on either side.

    Raises:
        NumericError: where they differ by more: the function jumps, or has a corner, at a joint.
    """
    right = np.array([piece.right for piece in pieces])
    span = right - np.array([piece.left for piece in pieces])
    table = np.array([piece.powers for piece in pieces])
    powers = np.arange(_DEGREE + 1)
    reached = np.array(
        [
            np.sum(table * span[:, None] ** powers, axis=1),
            np.sum((table * powers)[:, 1:] * span[:, None] ** powers[:-1], axis=1),
        ]
    )
    apart = table.T[:2, 1:] - reached[:, :-1]
    unsure = _AT_ENDS * np.array([max(piece.rounding, piece.error) for piece in pieces])
    unsure = np.array([unsure, 2 * _DEGREE**2 / span * unsure])  # Markov's inequality
    torn = np.flatnonzero(np.any(np.abs(apart) > unsure[:, 1:] + unsure[:, :-1], axis=0))
    if len(torn):
        raise _not_smooth(right[torn[0]])
    gaps = np.pad(apart, ((0, 0), (1, 1))) / 2
    (d, v), (e, w) = -gaps[:, :-1], gaps[:, 1:]
    table[:, 0] += d
    table[:, 1] += v
    table[:, 2] += 3 * (e - d) / span**2 - (2 * v + w) / span
    table[:, 3] += 2 * (d - e) / span**3 + (v + w) / span**2
    return right, table


def _shifted_powers() -> Array:
    """Chebyshev polynomials over [-1, 1] in powers of the place counted from 0 to 1."""
    columns = [np.eye(1, _DEGREE + 1)[0]]
    columns.append(2 * np.roll(columns[0], 1) - columns[0])
    while len(columns) <= _DEGREE:
        columns.append(4 * np.roll(columns[-1], 1) - 2 * columns[-1] - columns[-2])
    return np.array(columns).T


_NODES = chebyshev.chebpts1(_DEGREE + 1)
_BETWEEN = np.cos(np.pi * np.arange(_DEGREE + 2) / (_DEGREE + 1))[1:-1]
_SERIES = chebyshev.chebvander(_NODES, _DEGREE).T * 2 / (_DEGREE + 1)
_SERIES[0] /= 2
_POWERS = _shifted_powers()

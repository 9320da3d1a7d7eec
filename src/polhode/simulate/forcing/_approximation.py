"""Python functions of time as piecewise polynomials that agree with them to rounding."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, inf, isfinite
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev, polynomial

from polhode.base import NumericError
from polhode.simulate.forcing._pieces import Pieces
from polhode.simulate.integrate._stepping import Array

Function = Callable[[float], float]

_GOLDEN = (5**0.5 - 1) / 2
_MOST_AGAIN = 1000  # evaluations of a function to confirm one motion, at most
_NEAR = 1e-9  # of the span: times this close to a corner are skipped


@dataclass(frozen=True, eq=False)
class Approximation(Pieces):
    """A Python function of time as polynomials, with the resolution it was sampled at.

    Attributes:
        resolution: s. Changes that last longer have been seen; shorter ones, such as a pulse
            between two of the times at which the function was evaluated, may have been missed.
        function: the function; None in a copy in another process.
        allowed: largest difference from each polynomial that is accepted, shape (pieces,).
    """

    resolution: float = 0.0
    function: Function | None = None
    allowed: Array | None = None

    def __repr__(self) -> str:
        return (
            f"a function of time from {self.start:.6g} s to {self.end:.6g} s as "
            f"{len(self.coefficients)} polynomials; changes that last less than "
            f"{self.resolution:.3g} s may have been missed"
        )

    def __getstate__(self) -> dict[str, Any]:
        """Without the function, which often cannot be sent to another process."""
        fields = ("knots", "coefficients", "corners", "resolution")
        return {name: getattr(self, name) for name in fields} | {"function": None, "allowed": None}

    def confirm(self, name: str, steps: Array) -> None:
        """Evaluate the function again between the ends of steps of a motion.

        Args:
            name: of the prescribed function.
            steps: increasing times, s.

        Raises:
            NumericError: where it differs from the value that the motion was computed with.
        """
        if self.function is None or self.allowed is None:
            return
        # A time within each step, neither at rest nor at a corner; not its middle, since the
        # function was evaluated there if the step is a piece.
        times = steps[:-1] + _GOLDEN * np.diff(steps)
        times = times[:: ceil(len(times) / _MOST_AGAIN) or 1]
        near = _NEAR * (self.end - self.start)
        times = times[(times > self.start + near) & (times < self.end - near)]
        corners = self.knots[list(self.corners)]
        times = times[np.all(np.abs(times[:, None] - corners) > near, axis=1)]
        values = values_of(self.function, times)
        piece = np.searchsorted(self.knots, times, "right") - 1
        wrong = np.flatnonzero(np.abs(values - self.value(times)) > self.allowed[piece])
        if len(wrong):
            first = wrong[0]
            raise NumericError(
                f"{name} = {values[first]:.6g} at t = {times[first]:.9g} s, where the motion was "
                f"computed with {float(self.value(times[first])):.6g}: the function was evaluated "
                f"before and after, but not there",
                expected=f"a function without changes shorter than {self.resolution:.3g} s, "
                "and the same value at every evaluation",
                advice="give the motion as polhode.approximated(function, 0, duration, "
                "resolution=...), with its shortest change as the resolution",
            )


def sampling_times(left: float, right: float, resolution: float) -> Array:
    """Times between two others, at most a resolution apart, and from the ends.

    Two spacings in golden ratio alternate aperiodically: evenly spaced times could miss every pulse
    of a periodic function.
    """
    count = ceil((right - left) / (_GOLDEN * resolution))
    numbers = np.arange(count)
    return left + (right - left) * (numbers + (_GOLDEN * (numbers + 1)) % 1) / count


def values_of(function: Function, times: Array) -> Array:
    """Values of a function at some times.

    Raises:
        NumericError: where it fails, or has no finite value.
    """
    try:
        values = np.array([float(function(t)) for t in times.tolist()])
    except Exception as error:  # whatever a user's function may raise
        raise NumericError(
            f"a prescribed motion that fails between {np.min(times):.6g} s and "
            f"{np.max(times):.6g} s ({error})",
            expected="a function of the time in seconds that returns a number",
        ) from error
    if not np.all(np.isfinite(values)):
        raise NumericError(
            f"a prescribed motion that is not finite at t = {times[~np.isfinite(values)][0]:.6g} s",
            expected="a number at every time",
        )
    return values


# -- fitting ---------------------------------------------------------------------------------------

_DEGREE = 11  # of every polynomial
_ROUNDING = 6 * np.finfo(float).eps  # relative, of a function of a few operations
_NEGLIGIBLE = np.finfo(float).eps / 2  # smaller relative coefficients are rounding
_SMALLEST = np.finfo(float).tiny  # smaller numbers have fewer digits
# Halving a piece reduces the error of a polynomial of degree 11 by 2¹²: an error that falls by less
# than this factor is rounding.
_REDUCTION = 64
_AT_ENDS = 16  # times the rounding or error found: allowed where a piece was not checked
_SHORTEST = 1e-7  # length of a piece over the span: where shorter ones are needed is a corner
_MOST = 100_000  # pieces
_LOOKS = 2000  # resolutions in a span, by default
_MOST_LOOKS = 10_000_000  # the same, at most


def approximated(
    function: Function,
    start: float,
    end: float,
    *,
    corners: Iterable[float] = (),
    resolution: float | None = None,
) -> Approximation:
    """A smooth Python function of time as polynomials that agree with it to rounding.

    The function is evaluated at times at most the resolution apart, and more often where that is
    not enough: no change that lasts longer than the resolution is missed, a shorter one may be. A
    motion computed with it evaluates it again between its steps.

    Outside the span it keeps the value at the end of the span.

    Args:
        function: of the time in seconds.
        start: s.
        end: s.
        corners: times at which the function or its rate jumps.
        resolution: s; by default 1/2000 of the span. The function is evaluated 1.6 times per
            resolution.

    Raises:
        NumericError: for a function that is not finite, or not smooth between corners, and for a
            resolution that is too fine or not positive.
    """
    bounds = [start, *sorted(float(t) for t in corners if start < t < end), end]
    if not (isfinite(start) and isfinite(end) and start < end):
        raise NumericError(f"a span from {start:g} s to {end:g} s", expected="a span of time")
    finest = _resolution(resolution, end - start)
    knots, tables, jerks = np.array([start]), list[Array](), list[int]()
    allowed = list[Array]()
    for left, right in pairwise(bounds):
        times = sampling_times(left, right, finest)
        seen = _Evaluations(times, values_of(function, times))
        pieces = _resolved(function, left, right, _SHORTEST * (end - start), seen)
        ends, table = _joined(pieces)
        knots = np.concatenate([knots, ends])
        tables.append(table)
        jerks.append(len(knots) - 1)
        # doubled, since joining the pieces has moved their ends
        allowed.append(np.array([2 * piece.allowed for piece in pieces]))
    return Approximation(
        knots,
        np.vstack(tables),
        tuple(jerks[:-1]),
        resolution=finest,
        function=function,
        allowed=np.concatenate(allowed),
    )


def _resolution(given: float | None, span: float) -> float:
    if given is None:
        return span / _LOOKS
    if not (isfinite(given) and span / _MOST_LOOKS <= given):
        raise NumericError(
            f"a resolution of {given:g} s over {span:g} s",
            expected=f"a time of at least {span / _MOST_LOOKS:g} s",
            advice="give the duration of the shortest change of the function",
        )
    return float(given)


@dataclass(frozen=True)
class _Evaluations:
    """Values of the function at increasing times, used to check the polynomials only."""

    times: Array
    values: Array

    def within(self, left: float, right: float) -> _Evaluations:
        first, last = np.searchsorted(self.times, [left, right]).tolist()
        return _Evaluations(self.times[first:last], self.values[first:last])


@dataclass(frozen=True)
class _Piece:
    """A polynomial between two times, in powers of the time since the left one.

    Attributes:
        size: of the function's values.
        rounding: estimated uncertainty of the function's values.
        error: largest difference from the function between the interpolation nodes.
        allowed: difference that is accepted elsewhere.
    """

    left: float
    right: float
    powers: Array
    size: float
    rounding: float
    error: float
    allowed: float

    def misses(self, seen: _Evaluations) -> bool:
        """Whether it differs by more than allowed from one of the values within it."""
        own = seen.within(self.left, self.right)
        values = polynomial.polyval(own.times - self.left, self.powers)
        return bool(np.any(np.abs(values - own.values) > self.allowed))


def _resolved(
    function: Function, left: float, right: float, shortest: float, seen: _Evaluations
) -> list[_Piece]:
    """Pieces from left to right, bisected until each agrees with the function."""
    noise = _ROUNDING * float(np.max(np.abs(seen.values)))
    whole = _fitted(function, left, right, noise)
    noise = max(noise, _ROUNDING * whole.size)
    done, waiting = list[_Piece](), [(whole, inf)]
    while waiting:
        piece, before = waiting.pop()
        a, b = piece.left, piece.right
        is_short = b - a < shortest
        # An error below the rounding of the values is rounding. If the function itself cancels
        # large terms its rounding is larger: then bisection no longer reduces the error.
        agrees = (
            piece.error <= piece.rounding
            or (0.0 if is_short else before) / _REDUCTION < piece.error <= noise
        )
        if agrees and not piece.misses(seen):
            done.append(piece)
        elif is_short or len(done) > _MOST:
            raise _not_smooth(a)
        else:
            halves = ((a + b) / 2, b), (a, (a + b) / 2)
            waiting += [(_fitted(function, *half, noise), piece.error) for half in halves]
    return done


def _fitted(function: Function, left: float, right: float, noise: float) -> _Piece:
    """The polynomial through the function's values at Chebyshev nodes, checked in between."""
    # One value is subtracted first, so that the rounding of the series is relative to changes.
    values = _values(function, left, right, _NODES)
    series = _SERIES @ (values - values[0])
    size = float(np.max(np.abs(values)))
    series[np.abs(series) < _NEGLIGIBLE * size] = 0.0
    series[0] += values[0]
    apart = chebyshev.chebval(_BETWEEN, series) - _values(function, left, right, _BETWEEN)
    error = float(np.max(np.abs(apart)))
    rate = float(np.max(np.abs(np.diff(values) / np.diff(_NODES)))) * 2 / (right - left)
    rounding = _ROUNDING * (size + max(abs(left), abs(right)) * rate) + _SMALLEST
    powers = _POWERS @ series / (right - left) ** np.arange(_DEGREE + 1)
    allowed = _AT_ENDS * max(rounding, error, noise)
    return _Piece(left, right, powers, size, rounding, error, allowed)


def _not_smooth(time: float) -> NumericError:
    return NumericError(
        f"a prescribed motion that is not smooth near t = {time:.6g} s",
        expected="a smooth function of time",
        advice="give the times at which it jumps or has a corner as corners",
    )


def _values(function: Function, left: float, right: float, places: Array) -> Array:
    """Values of the function at positions between -1 and 1 in an interval."""
    return values_of(function, (left + right + (right - left) * places) / 2)


def _joined(pieces: list[_Piece]) -> tuple[Array, Array]:
    """Right ends and coefficients, with the rounding between neighbours removed.

    A cubic added on either side of a joint brings values and rates to their mean.

    Raises:
        NumericError: where they differ by more than rounding: the function jumps, or has a
            corner, at a joint.
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
    unsure = np.array([piece.allowed for piece in pieces])
    # Markov's inequality, |p'| ≤ (2 n²/length) max |p|, bounds the error of rates.
    unsure = np.array([unsure, 2 * _DEGREE**2 / span * unsure])
    jumps = np.flatnonzero(np.any(np.abs(apart) > unsure[:, 1:] + unsure[:, :-1], axis=0))
    if len(jumps):
        raise _not_smooth(right[jumps[0]])
    gaps = np.pad(apart, ((0, 0), (1, 1))) / 2
    (d, v), (e, w) = -gaps[:, :-1], gaps[:, 1:]
    table[:, 0] += d
    table[:, 1] += v
    table[:, 2] += 3 * (e - d) / span**2 - (2 * v + w) / span
    table[:, 3] += 2 * (d - e) / span**3 + (v + w) / span**2
    return right, table


def _shifted_powers() -> Array:
    """Chebyshev polynomials over [-1, 1] in powers of the position scaled to [0, 1]."""
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

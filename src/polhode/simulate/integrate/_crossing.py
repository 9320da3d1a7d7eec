"""Where functions of time first fall below zero, found to rounding.

Guards are evaluated after the motion has been computed, so that they do not disturb its steps.
Each is resolved into Legendre series piece by piece. A series bounds the function over its whole
piece, |Σ c_k P_k| ≤ Σ |c_k|, so that no dip between samples is missed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.polynomial import legendre

from polhode.base import bisected, zero_between
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._quadrature import resolved

#: Share of the largest value of a guard: a dip below zero that is no deeper counts as rounding.
NOISE = 1e-13
_CLEAR = 1e-3  # of the largest value on a piece: this far below zero a guard has surely fallen
_POLISHED = 6  # secant steps from the root of the series, which is accurate to about 1e-13 already
_DENSE = 65  # places at which a series is looked at, besides its extremes


@dataclass(frozen=True)
class Crossing:
    """A guard that falls through zero.

    Attributes:
        time: s.
        guard: its place among the guards.
    """

    time: float
    guard: int


def first_fall(
    guards: Callable[[Array], Array],
    knots: Array,
    uncertainty: Callable[[Array], Array] | None = None,
) -> Crossing | None:
    """The first instant at which one of several functions falls below zero.

    Args:
        guards: values at some times, shape (functions, times); smooth between knots.
        knots: s.
        uncertainty: of these values, where it may be more than rounding of their size, as it is
            near singular positions.
    """
    if len(knots) < 2:
        return None
    left, right, series = resolved(guards, knots, uncertainty=uncertainty)
    noise = _noise(left, right, series)
    if uncertainty is not None:
        noise = np.maximum(noise, uncertainty((left + right) / 2))
    least = series[:, :, 0] - np.sum(np.abs(series[:, :, 1:]), axis=2)
    suspects = least < -noise
    found: list[Crossing] = []
    for k in range(len(series)):
        time = _fall(guards, k, left, right, series[k], suspects[k], noise[k])
        if time is not None:
            found.append(Crossing(time, k))
    return min(found, key=lambda crossing: crossing.time, default=None)


def roots(function: Callable[[Array], Array], knots: Array) -> list[float]:
    """All instants at which one function of time, shape (1, times), crosses zero."""
    if len(knots) < 2:
        return []
    left, right, series = resolved(function, knots)
    found = list[float]()
    for i in range(len(left)):
        for place in _real_roots(series[0, i]):
            time = _time(left[i], right[i], place)
            # A root is a crossing if the sign differs on both sides; a tangency is not.
            beside = np.clip(np.array([place - 1e-6, place + 1e-6]), -1, 1)
            earlier, later = legendre.legval(beside, series[0, i])
            if earlier * later < 0:
                polished = _polished(function, 0, time, 1e-7 * (right[i] - left[i]))
                found.append(min(max(polished, float(left[i])), float(right[i])))
    return sorted(found)


def first_zero_vector(vector: Callable[[Array], Array], times: Array, small: float) -> float | None:
    """The first instant at which a vector passes through zero.

    There it turns round, so that its component along what it was before changes its sign, and its
    length is only rounding. The length itself has no sign, and a corner.

    Args:
        vector: components at some times, shape (components, times).
        times: s, so close together that it turns round at most once between two.
        small: length that is rounding, of the largest.
    """
    values = vector(times)
    lengths = np.linalg.norm(values, axis=0)
    largest = float(np.max(lengths, initial=0.0))
    is_clear = lengths > small * largest  # others, as at a start from zero, are rounding
    times, values = times[is_clear], values[:, is_clear]
    turned = np.sum(values[:, :-1] * values[:, 1:], axis=0) < 0
    for k in np.flatnonzero(turned):
        before = values[:, k]

        def along(time: float, before: Array = before) -> float:
            return float(before @ vector(np.array([time]))[:, 0])

        when = bisected(along, float(times[k]), float(times[k + 1]))
        if float(np.linalg.norm(vector(np.array([when])))) <= small * largest:
            return when
    return None


def bracketed_zeros(
    function: Callable[[float], float], grid: Array, values: Sequence[float] | Array
) -> list[float]:
    """Zeros of a function, one between neighbours of a grid at which its values differ in sign."""
    return [
        zero_between(function, float(a), float(b))
        for (a, u), (b, v) in pairwise(zip(grid, values, strict=True))
        if u < 0 < v or v < 0 < u or u == 0  # their product may overflow
    ]


def _noise(left: Array, right: Array, series: Array) -> Array:
    """How far below zero counts as rounding: of the guards, and of the times they are taken at."""
    scale = np.maximum([_size(guard) for guard in series], 1e-300)
    slopes = np.sum(np.abs(legendre.legder(series, axis=2)), axis=2)
    length, last = right - left, 2 * np.spacing(np.maximum(np.abs(left), np.abs(right)))
    # A piece of no length, between neighbouring doubles, has no slope to speak of.
    spacing = np.divide(last, length, out=np.zeros_like(last), where=length > 0)
    return np.asarray(NOISE * scale[:, None] + slopes * spacing)


def _size(series: Array) -> float:
    """Largest coefficient of a guard, shape (pieces, coefficients), up to where it has fallen.

    Beyond that the equations do not hold, and may run away: a support that pulls with friction
    drives a body ever faster.
    """
    sizes = np.max(np.abs(series), axis=1, initial=0.0)
    fallen = np.flatnonzero(np.sum(series, axis=1) < -_CLEAR * sizes)  # values at the right ends
    return float(np.max(sizes[: fallen[0] + 1] if fallen.size else sizes, initial=0.0))


def _fall(
    guards: Callable[[Array], Array],
    k: int,
    left: Array,
    right: Array,
    series: Array,
    suspects: Array,
    noises: Array,
) -> float | None:
    for i in np.flatnonzero(suspects):
        noise = float(noises[i])
        dense = legendre.legval(np.linspace(-1, 1, _DENSE), series[i])
        turns = np.array(_real_roots(_slope(series[i])), dtype=float)
        extremes = legendre.legval(turns, series[i])
        if np.min(dense) >= -noise and np.min(extremes, initial=0.0) >= -noise:
            continue
        # Negative from the very beginning of the piece: it has fallen there already.
        if dense[0] <= 0 and not np.any(dense > noise):
            return float(left[i])
        place = _first_fall_place(series[i], noise)
        if place is not None:
            time = _time(left[i], right[i], place)
            # The second point of the secant, before the root: within the motion, where the guard
            # is defined, and close to a root that lies close to the beginning.
            near = min(1e-7 * (right[i] - left[i]), 1e-3 * (time - left[0]))
            polished = _polished(guards, k, time, near)
            return min(max(polished, float(left[i])), float(right[i]))
    return None


def _first_fall_place(series: Array, noise: float) -> float | None:
    """Where in [-1, 1] a series first goes below zero by more than noise."""
    places = np.array([-1.0, *_real_roots(series), 1.0])
    slopes = _real_roots(_slope(series))
    for a, b in pairwise(places):
        inside = [p for p in slopes if a < p < b]
        values = legendre.legval(np.array([(a + b) / 2, b, *inside]), series)
        if np.min(values) < -noise:
            return float(a)
    return None


def _slope(series: Array) -> Array:
    return np.asarray(legendre.legder(series), dtype=float)


def _real_roots(series: Array) -> list[float]:
    # Trailing coefficients that are rounding would add spurious roots: they are cut off.
    size = np.max(np.abs(series))
    kept = np.flatnonzero(np.abs(series) > 1e-16 * size)
    if not kept.size or kept[-1] == 0:
        return []
    found = legendre.legroots(series[: kept[-1] + 1])
    # A double root may split into a complex pair, at a distance of the square root of the rounding.
    real = found[np.abs(found.imag) < 1e-7].real
    return sorted(float(r) for r in real if -1 <= r <= 1)


def _time(left: float, right: float, place: float) -> float:
    return float((left + right + (right - left) * place) / 2)


def _polished(guards: Callable[[Array], Array], k: int, time: float, near: float) -> float:
    """Secant steps on the function itself, which must stay near the root of its series."""
    older, newer = time - near, time
    values = guards(np.array([older, newer]))[k]
    before, now = float(values[0]), float(values[1])
    for _ in range(_POLISHED):
        if now == 0.0 or now == before:
            break
        step = -now * (newer - older) / (now - before)
        if not abs(step) <= 10 * near:
            break
        older, before = newer, now
        newer = newer + step
        now = float(guards(np.array([newer]))[k, 0])
    return float(newer if abs(newer - time) <= 10 * near else time)

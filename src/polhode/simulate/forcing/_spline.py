"""Smooth curves through samples, or near them where the samples are noisy."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import isfinite

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import ArrayLike

from polhode.base import NumericError
from polhode.simulate.forcing._pieces import Pieces
from polhode.simulate.integrate._stepping import Array

_LEAST_TO_SMOOTH = 3
_SOFTEST, _STIFFEST = -12.0, 12.0  # decades of the penalty on curvature, time in mean steps


def sampled(
    times: ArrayLike,
    values: ArrayLike,
    *,
    starts: Sequence[int] = (),
    noise: float = 0.0,
) -> Pieces:
    """A function of time from samples: cubic splines with continuous acceleration.

    At rest before the first sample, it starts from rest there and stops at once at the last. Where
    a new segment starts its rate jumps. A segment sets out from the end of the one before it; if
    its first sample repeats that time with another value, the value jumps.

    Args:
        times: s, increasing within a segment.
        values: one for each time.
        starts: which samples begin a new segment, besides the first.
        noise: standard deviation of the values. The curve is then the smoothest one that passes
            them at that distance in the mean, and its value never jumps.

    Raises:
        NumericError: for times that do not increase, values that are not finite, a noise that is
            negative, and segments with too few samples.
    """
    t, x = np.asarray(times, dtype=float), np.asarray(values, dtype=float)
    _refuse(t, x, starts, noise)
    knots, tables, corners = t[:1], list[Array](), list[int]()
    for first, stop in pairwise((0, *starts, len(t))):
        own, through = t[first:stop], x[first:stop]
        if first:
            corners.append(len(knots) - 1)
            own, through = _joined(own, through, knots, tables[-1], noise)
        tables.append(_curve(own, through, noise, clamped=not first))
        knots = np.concatenate([knots, own[1:]])
    return Pieces(knots, np.vstack(tables), tuple(corners))


def _joined(
    own: Array, through: Array, knots: Array, table: Array, noise: float
) -> tuple[Array, Array]:
    """The samples of a segment, with the end of the one before it in front."""
    ended = polynomial.polyval(knots[-1] - knots[-2], table[-1])
    if own[0] > knots[-1]:
        return np.concatenate([knots[-1:], own]), np.concatenate([[ended], through])
    return own, np.concatenate([[ended], through[1:]]) if noise else through


def _curve(t: Array, x: Array, noise: float, *, clamped: bool) -> Array:
    """Coefficients of the pieces of one segment; `clamped` starts from rest."""
    with np.errstate(all="ignore"):  # what overflows is refused in words by `Pieces`
        return _near(t, x, noise, clamped) if noise else _through(t, x, clamped)


def _through(t: Array, x: Array, clamped: bool) -> Array:
    """Of the curve through the samples, with no more freedom at its ends than it needs."""
    from scipy.interpolate import CubicSpline

    if len(t) == 2:
        rate, bend = (x[1] - x[0]) / (t[1] - t[0]), 0.0
        if clamped:
            rate, bend = 0.0, rate / (t[1] - t[0])
        return np.array([[x[0], rate, bend, 0.0]])
    start = (1, 0.0) if clamped else "not-a-knot"
    return np.asarray(CubicSpline(t, x, bc_type=(start, "not-a-knot")).c[::-1].T)


def _near(t: Array, x: Array, noise: float, clamped: bool) -> Array:
    """Of the smoothest curve whose mean distance from the samples is the noise.

    The samples are continued backwards in time, evenly for a start from rest, oddly about the
    first one for a start from there.
    """
    step = float(t[-1] - t[0]) / (len(t) - 1)
    since = (t - t[0]) / step
    sign = 1.0 if clamped else -1.0
    begin = 0.0 if clamped else x[0]
    mirrored = np.concatenate([-since[:0:-1], since])
    samples = np.concatenate([sign * (x[:0:-1] - begin), x - begin])
    table = _discrepant(mirrored, samples, noise)[len(t) - 1 :]
    table = table / step ** np.arange(4)
    table[0, 1 if clamped else 0] = 0.0
    table[:, 0] += begin
    return table


def _discrepant(t: Array, x: Array, noise: float) -> Array:
    """The smoothing spline at a given distance from its samples (Reinsch 1967)."""
    from scipy.optimize import brentq

    def excess(stiffness: float) -> float:
        values, _ = _smoothed(t, x, 10.0**stiffness)
        return float(np.sqrt(np.mean((values - x) ** 2))) - noise

    if excess(_SOFTEST) > 0:
        stiffness = _SOFTEST
    elif excess(_STIFFEST) < 0:
        stiffness = _STIFFEST
    else:
        stiffness = brentq(excess, _SOFTEST, _STIFFEST, xtol=1e-4)
    return _natural(t, *_smoothed(t, x, 10.0**stiffness))


def _smoothed(t: Array, x: Array, stiffness: float) -> tuple[Array, Array]:
    """Values and second derivatives, at the samples, of the natural cubic spline g with the least
    Σ (g − x)² + stiffness · ∫ g̈² dt.

    With Q x the second differences and R the products of hat functions, the second derivatives γ
    solve (R + stiffness Q Qᵀ) γ = Q x, and g = x − stiffness Qᵀ γ.
    """
    from scipy.linalg import solveh_banded

    h = np.diff(t)
    before, after = 1 / h[:-1], 1 / h[1:]
    middle = -before - after
    bands = np.zeros((3, len(t) - 2))
    bands[0] = (h[:-1] + h[1:]) / 3 + stiffness * (before**2 + middle**2 + after**2)
    bands[1, :-1] = h[1:-1] / 6 + stiffness * after[:-1] * (middle[:-1] + middle[1:])
    bands[2, :-2] = stiffness * after[:-2] * before[2:]
    bend = solveh_banded(bands, np.diff(np.diff(x) / h), lower=True)
    bend = np.concatenate([[0.0], bend, [0.0]])
    return x - stiffness * np.diff(np.diff(bend) / h, prepend=0.0, append=0.0), bend


def _natural(t: Array, values: Array, bend: Array) -> Array:
    """Coefficients of the pieces of a cubic spline from values and second derivatives."""
    h = np.diff(t)
    rates = np.diff(values) / h - h * (2 * bend[:-1] + bend[1:]) / 6
    return np.column_stack([values[:-1], rates, bend[:-1] / 2, np.diff(bend) / (6 * h)])


def _refuse(t: Array, x: Array, starts: Sequence[int], noise: float) -> None:
    if t.ndim != 1 or t.shape != x.shape:
        raise NumericError(
            f"samples of shape {x.shape} at times of shape {t.shape}",
            expected="one value for each time",
        )
    if not (np.all(np.isfinite(t)) and np.all(np.isfinite(x))):
        raise NumericError("samples that are not finite", expected="numbers")
    if not (isfinite(noise) and noise >= 0):
        raise NumericError(f"a noise of {noise:g}", expected="a standard deviation, or 0 for none")
    least = _LEAST_TO_SMOOTH if noise else 2
    bounds = (0, *starts, len(t))
    if min(stop - first for first, stop in pairwise(bounds)) < least:
        raise NumericError(
            f"{len(t)} samples in segments that begin at samples {bounds[:-1]}",
            expected=f"at least {least} samples in each, in order",
        )
    allowed = np.isin(np.arange(1, len(t)), starts)  # a segment may begin when the last one ends
    wrong = np.flatnonzero((np.diff(t) < 0) | ((np.diff(t) == 0) & ~allowed))
    if len(wrong):
        raise NumericError(
            f"the sample at {t[wrong[0] + 1]:g} s after the one at {t[wrong[0]]:g} s",
            expected="times that increase",
        )

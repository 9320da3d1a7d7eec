"""Cubic splines through samples or near them, by their second derivatives at the samples."""

from __future__ import annotations

import numpy as np

from polhode.simulate.integrate._arrays import Array


def spline_through(t: Array, x: Array, clamped: tuple[bool, bool]) -> Array:
    """Coefficients of the interpolating spline, in powers of the time since each sample.

    Between neighbours i and i + 1, at a distance h, with second derivatives γ and the slope d of
    the chord, the rate at i is d − h (2 γᵢ + γᵢ₊₁)/6 and at i + 1 it is d + h (γᵢ + 2 γᵢ₊₁)/6.
    Rates that agree make equations for γ.

    Args:
        t: at least two increasing times; three unless both ends are clamped.
        x: samples.
        clamped: whether the rate is zero at the first and at the last time. Otherwise the third
            derivative does not jump at the next sample (not a knot).

    Returns:
        shape (samples - 1, 4).
    """
    h = np.diff(t)
    slopes = np.diff(x) / h
    if len(t) == 3 and not any(clamped):  # a parabola
        bend = np.full(3, 2 * (slopes[1] - slopes[0]) / (h[0] + h[1]))
        return _coefficients(h, x, bend)
    below, above = np.append(0.0, h), np.append(h, 0.0)
    diagonal = 2 * (below + above)
    right = 6 * np.diff(slopes, prepend=0.0, append=0.0)
    if not clamped[0]:  # γ₀ = γ₁ − (h₀/h₁) (γ₂ − γ₁)
        diagonal[1] += h[0] + h[0] ** 2 / h[1]
        above[1] -= h[0] ** 2 / h[1]
    if not clamped[1]:
        diagonal[-2] += h[-1] + h[-1] ** 2 / h[-2]
        below[-2] -= h[-1] ** 2 / h[-2]
    first, stop = (0 if clamped[0] else 1), (len(t) if clamped[1] else len(t) - 1)
    rows = slice(first, stop)
    bend = _tridiagonal(below[rows], diagonal[rows], above[rows], right[rows])
    if not clamped[0]:
        bend = np.append(bend[0] - h[0] / h[1] * (bend[1] - bend[0]), bend)
    if not clamped[1]:
        bend = np.append(bend, bend[-1] + h[-1] / h[-2] * (bend[-1] - bend[-2]))
    table = _coefficients(h, x, bend)
    if clamped[0]:
        table[0, 1] = 0.0
    return table


def spline_near(t: Array, x: Array, stiffness: float) -> tuple[Array, Array]:
    """Coefficients of the natural cubic spline g with the least Σ (g − x)² + stiffness · ∫ g̈² dt.

    With Q x the second differences and R the products of hat functions, the second derivatives γ
    solve (R + stiffness Q Qᵀ) γ = Q x, and g = x − stiffness Qᵀ γ (Reinsch 1967).

    Returns:
        the coefficients as those of `spline_through`, and g at the samples.
    """
    h = np.diff(t)
    before, after = 1 / h[:-1], 1 / h[1:]
    middle = -before - after
    bend = _pentadiagonal(
        (h[:-1] + h[1:]) / 3 + stiffness * (before**2 + middle**2 + after**2),
        h[1:-1] / 6 + stiffness * after[:-1] * (middle[:-1] + middle[1:]),
        stiffness * after[:-2] * before[2:],
        np.diff(np.diff(x) / h),
    )
    bend = np.concatenate([[0.0], bend, [0.0]])
    values = x - stiffness * np.diff(np.diff(bend) / h, prepend=0.0, append=0.0)
    return _coefficients(h, values, bend), values


def _coefficients(h: Array, x: Array, bend: Array) -> Array:
    rates = np.diff(x) / h - h * (2 * bend[:-1] + bend[1:]) / 6
    return np.column_stack([x[:-1], rates, bend[:-1] / 2, np.diff(bend) / (6 * h)])


# -- linear equations with few diagonals -----------------------------------------------------------
#
# Without pivots: all matrices here are positive definite or dominated by their diagonal.


def _tridiagonal(below: Array, diagonal: Array, above: Array, right: Array) -> Array:
    """The solution of equations of which row i has below[i], diagonal[i] and above[i]."""
    pivots, found = diagonal.tolist(), right.tolist()
    lower, upper = below.tolist(), above.tolist()
    for i in range(1, len(found)):
        factor = lower[i] / pivots[i - 1]
        pivots[i] -= factor * upper[i - 1]
        found[i] -= factor * found[i - 1]
    found[-1] /= pivots[-1]
    for i in reversed(range(len(found) - 1)):
        found[i] = (found[i] - upper[i] * found[i + 1]) / pivots[i]
    return np.array(found)


def _pentadiagonal(diagonal: Array, first: Array, second: Array, right: Array) -> Array:
    """The solution of equations with a symmetric matrix, by L D Lᵀ, from its diagonals."""
    # two rows before the first one and two after the last, with nothing beside the diagonal
    pivots, near, far, found = [1.0, 1.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]
    beside = [0.0, *first.tolist()], [0.0, 0.0, *second.tolist()]
    for d, e, f, r in zip(diagonal.tolist(), *beside, right.tolist(), strict=False):
        two = f / pivots[-2]
        one = (e - f * near[-1]) / pivots[-1]
        found.append(r - one * found[-1] - two * found[-2])
        pivots.append(d - one**2 * pivots[-1] - two * f)
        near.append(one)
        far.append(two)
    near, far, solved = [*near, 0.0, 0.0], [*far, 0.0, 0.0], [0.0, 0.0]
    for i in reversed(range(2, len(found))):
        later = near[i + 1] * solved[-1] + far[i + 2] * solved[-2]
        solved.append(found[i] / pivots[i] - later)
    return np.array(solved[:1:-1])

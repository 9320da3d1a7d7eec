"""Integrals of functions of time, as functions of time: Gauss's rule on pieces that are bisected.

The values at 16 Gauss nodes give the Legendre series of a piece. Its last coefficients say whether
it has converged, and its integral is known term by term.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from polhode.simulate.integrate._arrays import Array, evaluated, pieces_at

_NODES, _WEIGHTS = legendre.leggauss(16)
_ORDERS = np.arange(len(_NODES))
#: Legendre coefficients of the polynomial through values at the nodes.
_ANALYSIS = (
    (2 * _ORDERS[:, None] + 1) / 2 * legendre.legvander(_NODES, len(_NODES) - 1).T * _WEIGHTS
)
#: From those to the integral from -1 on, as coefficients of powers.
_ANTIDERIVATIVES = np.zeros((len(_NODES), len(_NODES) + 1))
for _k in range(len(_NODES)):
    _ANTIDERIVATIVES[_k, : _k + 2] = legendre.leg2poly(legendre.legint(np.eye(_k + 1)[_k], lbnd=-1))
_CONVERGED = 1e-14  # last two coefficients of a converged series, over the largest value anywhere
# Below this, last coefficients that do not fall when a piece is halved are rounding (of a function
# whose own terms cancel); a smooth function reduces them to far less than a quarter.
_NOISE = 1e-8
_FALLING = 0.25
# The last coefficients of noise: its values, times (2k + 1)/2 over the root of their count.
_NOISY_TAIL = 4.0
_SLOPES = 2.0 * _ORDERS  # of a Legendre series over its whole piece, for coefficients of one sign
_SHORTEST = 1e-11  # length of a piece over the time: shorter ones have no digits left
_ONLY_NOISE = 1e-3  # uncertainty over the largest value: above, a function is only rounding
_MOST = 100_000  # new pieces at a time; nothing smooth needs more


@dataclass(frozen=True)
class Quadrature:
    """Integrals of several functions of time from their common start.

    Attributes:
        knots: ends of the pieces, s, shape (pieces + 1,).
        totals: integrals up to each knot, shape (functions, pieces + 1).
        powers: coefficients of the integral from the left end of each piece, in powers of the
            place from -1 to 1 in it, shape (pieces, functions, order).
    """

    knots: Array
    totals: Array
    powers: Array

    def at(self, times: Array) -> Array:
        """The integrals at some times, shape (functions, times)."""
        piece = pieces_at(self.knots, times)
        left, right = self.knots[piece], self.knots[piece + 1]
        place = (2 * times - left - right) / (right - left)
        return np.asarray(self.totals[:, piece] + evaluated(self.powers, piece, place))


def integral(
    function: Callable[[Array], Array],
    knots: Array,
    noise: Array | None = None,
    start: Array | None = None,
) -> Quadrature:
    """Integrate smooth functions of time to rounding.

    Args:
        function: values at some times, shape (functions, times).
        knots: ends of the first pieces, on which 16 nodes may be enough, s.
        noise: uncertainty of the values of each function, shape (functions,).
        start: what the integrals will be added to; below its rounding nothing is resolved.
    """
    negligible = None
    if start is not None:
        negligible = np.spacing(np.abs(start)) / (_NOISY_TAIL * (knots[-1] - knots[0]))
    left, right, coefficients = resolved(function, knots, noise, negligible)
    halves = (right - left) / 2
    inside = (coefficients @ _ANTIDERIVATIVES) * halves[None, :, None]
    pieces = 2 * halves * coefficients[:, :, 0]
    # Summed up in long doubles, so that many small pieces do not add up their rounding.
    totals = np.cumsum(pieces.astype(np.longdouble), axis=1).astype(float)
    start = np.zeros((len(totals), 1))
    knots = np.append(left, right[-1:])
    return Quadrature(
        knots, np.hstack([start, totals]), np.ascontiguousarray(inside.swapaxes(0, 1))
    )


def resolved(
    function: Callable[[Array], Array],
    knots: Array,
    noise: Array | None = None,
    negligible: Array | None = None,
    uncertainty: Callable[[Array], Array] | None = None,
) -> tuple[Array, Array, Array]:
    """Pieces on which the Legendre series have converged, in order, and their coefficients.

    Functions that are only noise, such as the sum of forces on a body at rest, are not tested:
    their series never converge.

    Args:
        function, knots, noise: as for `integral`.
        negligible: size of the values of each function that does not matter.
        uncertainty: of the values at some times, where it differs much from time to time.

    Returns:
        Left and right ends, shape (pieces,), and coefficients, shape (functions, pieces, order).
    """
    left, right = knots[:-1], knots[1:]
    before = np.full(len(left), np.inf)
    done: list[tuple[Array, Array, Array]] = []
    scale = np.zeros((1, 1, 1))
    while len(left):
        times = (left[:, None] + right[:, None] + (right - left)[:, None] * _NODES) / 2
        values = function(times.ravel())
        values = values.reshape(len(values), len(left), len(_NODES))
        coefficients = values @ _ANALYSIS.T  # shape (functions, pieces, order)
        largest = np.max(np.abs(coefficients), axis=(1, 2), keepdims=True)
        scale = np.maximum(scale, largest)
        sizes = np.where(scale > 0, scale, 1.0)
        tails = np.abs(coefficients[:, :, -2:]) / sizes
        # Times are rounded, and values with them by their slopes; a piece may have no length.
        shares = np.spacing(right) / np.maximum(right - left, np.spacing(right))
        uncertain = np.abs(coefficients) @ _SLOPES * shares
        if noise is not None:
            tails[noise > _ONLY_NOISE * sizes[:, 0, 0]] = 0.0
            uncertain = np.maximum(uncertain, noise[:, None])
        if negligible is not None:
            uncertain = np.maximum(uncertain, negligible[:, None])
        if uncertainty is not None:
            uncertain = np.maximum(uncertain, uncertainty((left + right) / 2))
        tails[tails <= _NOISY_TAIL * uncertain[:, :, None] / sizes] = 0.0
        tail = np.max(tails, axis=(0, 2), initial=0.0)
        rough = (tail > _CONVERGED) & ((tail > _NOISE) | (tail < _FALLING * before))
        rough &= (right - left > _SHORTEST * np.abs(right)) & (np.sum(rough) < _MOST)
        done.append((left[~rough], right[~rough], coefficients[:, ~rough]))
        middle = (left[rough] + right[rough]) / 2
        left, right = np.append(left[rough], middle), np.append(middle, right[rough])
        before = np.tile(tail[rough], 2)
    lefts, rights, parts = (list(column) for column in zip(*done, strict=True))
    left, right = np.concatenate(lefts), np.concatenate(rights)
    order = np.argsort(left)
    return left[order], right[order], np.concatenate(parts, axis=1)[:, order]

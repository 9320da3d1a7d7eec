"""Exponents that are zero for whatever parameters: of departures along a family of steady motions.

Whether an exponent is zero by structure or happens to pass through zero cannot be seen from its
size. It is seen at other parameters: what is zero there too is so by structure.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from polhode.base import NumericError
from polhode.study._columns import Array

#: Relative change of the parameters, and size below which a singular value there is rounding.
_CHANGE = 1e-3
_ROUNDING = 1e-9
_STEPS = 25
_SEED = 20071955


def elsewhere(values: Array) -> Array:
    """Values near by, changed at random and each by another share."""
    random = np.random.default_rng(_SEED)
    shares = random.uniform(0.5, 1, len(values)) * random.choice([-1, 1], len(values))
    return np.asarray(values * (1 + _CHANGE * shares))


def steady_near(state: Array, residual: Callable[[Array], tuple[Array, Array]]) -> Array:
    """The steady state nearest to a state, by Newton's method.

    Args:
        state: where to begin.
        residual: of a state: what vanishes on steady motions, and its derivatives.

    Raises `NumericError` where there is none near by.
    """
    found = np.array(state)
    for _ in range(_STEPS):
        left, slopes = residual(found)
        scale = np.max(np.abs(slopes), initial=0.0) * max(1.0, np.max(np.abs(found)))
        if not np.all(np.isfinite(left)) or not np.all(np.isfinite(slopes)):
            break
        if np.max(np.abs(left), initial=0.0) <= _ROUNDING**1.5 * scale:
            return found
        # Steps along what hardly matters would lead far away: they are left out.
        found = found - np.linalg.lstsq(slopes, left, rcond=_CHANGE**2)[0]
    raise NumericError(
        "no steady motion near this one at other parameters",
        expected="one of a family, on which the exponents that are always zero can be counted",
        advice="look at all eigenvalues",
    )


@dataclass(frozen=True)
class Neutral:
    """How many exponents of a matrix are zero by structure.

    Attributes:
        chain: independent departures that stay as they are; then those that grow in proportion to
            time towards these; then those that grow as its square; and so on.
    """

    chain: tuple[int, ...]

    @classmethod
    def of(cls, generic: Array) -> Neutral:
        """Counted on a matrix that vanishes by structure only."""
        return cls(tuple(_falling(generic)))

    def removed(self, matrix: Array) -> Array:
        """The matrix on what is left when the departures counted are taken out."""
        for count in self.chain:
            *_, directions = np.linalg.svd(matrix)
            rest = directions[: len(matrix) - count]
            matrix = rest @ matrix @ rest.T
        return matrix


def _falling(matrix: Array) -> Iterator[int]:
    while len(matrix):
        _, sizes, directions = np.linalg.svd(matrix)
        kept = int(np.sum(sizes > _ROUNDING * max(sizes[0], np.finfo(float).tiny)))
        if kept == len(matrix):
            return
        yield len(matrix) - kept
        matrix = directions[:kept] @ matrix @ directions[:kept].T

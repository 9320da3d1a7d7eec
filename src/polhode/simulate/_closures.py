"""Closed loops: coordinates that are not given are solved for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import pi

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, Symbol
from polhode.base import ConstraintError
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate._values import Numbers

Array = NDArray[np.float64]

_CLOSED = 1e-9  # residual, relative to its largest term or slope, of a loop that is closed
_GUESSES = 40
_STEPS = 60


def close(
    dynamics: Dynamics, given: Numbers, parameters: Numbers
) -> tuple[dict[Symbol, float], dict[str, float]]:
    """All coordinates at the start, and those among them that had to be assumed.

    Without closed loops a coordinate that is not given starts at zero. With them it is solved for,
    by Newton's method from zero, then from guesses spread over a turn.

    Raises:
        ConstraintError: where no configuration with the given coordinates closes the loops.
    """
    coordinates = dynamics.equations.coordinates
    free = tuple(q for q in coordinates if q not in given)
    if not dynamics.equations.closures:
        return (
            {q: given.get(q, 0.0) for q in coordinates},
            {q.published: 0.0 for q in free},
        )
    loop = _Loop(dynamics, given, free, parameters)
    found = loop.closed()
    values = {**given, **dict(zip(free, (float(x) for x in found), strict=True))}
    chosen = len(free) > loop.rank(found)
    assumed = {q.published: values[q] for q in free} if chosen else {}
    return {q: values[q] for q in coordinates}, assumed


class _Loop:
    """The closures as functions of the free coordinates."""

    def __init__(
        self, dynamics: Dynamics, given: Numbers, free: tuple[Symbol, ...], parameters: Numbers
    ) -> None:
        self._closures = dynamics.equations.closures
        self._free = free
        self._given = given
        slopes = [closure.diff(q) for closure in self._closures for q in free]
        self._residual = _of_free(dynamics, self._closures, given, free, parameters)
        self._slopes = _of_free(dynamics, slopes, given, free, parameters)

    def closed(self) -> Array:
        """Free coordinates that close the loops."""
        tried = []
        for guess in self._guesses():
            tried.append(self._newton(guess))
            if self._misfit(tried[-1]) <= _CLOSED:
                return tried[-1]
        raise self._stays_open(min(tried, key=self._misfit))

    def rank(self, place: Array) -> int:
        """How many coordinates the loops determine there."""
        return int(np.linalg.matrix_rank(self._jacobian(place))) if self._free else 0

    def _misfit(self, place: Array) -> float:
        slopes = np.max(np.abs(self._jacobian(place)), initial=0.0) if self._free else 1.0
        return float(np.max(np.abs(self._residual(place))) / (slopes or 1.0))

    def _jacobian(self, place: Array) -> Array:
        return np.reshape(self._slopes(place), (len(self._closures), len(self._free)))

    def _newton(self, place: Array) -> Array:
        """Damped Gauss-Newton steps of least length."""
        for _ in range(_STEPS if self._free else 0):
            residual = self._residual(place)
            step = np.linalg.lstsq(self._jacobian(place), -residual, rcond=1e-12)[0]
            size, now = 1.0, np.linalg.norm(residual)
            while size > 1e-3 and np.linalg.norm(self._residual(place + size * step)) >= now:
                size /= 2
            if size <= 1e-3:
                break
            place = place + size * step
        return place

    def _guesses(self) -> Iterator[Array]:
        """Zero, then points that fill the cube of one turn evenly (Weyl's sequence)."""
        primes = np.array([p for p in range(2, 400) if all(p % d for d in range(2, p))])
        slopes = np.sqrt(primes[: len(self._free)]) % 1.0
        for k in range(_GUESSES if self._free else 1):
            yield 2 * pi * ((k * slopes + 0.5) % 1.0 - 0.5)

    def _stays_open(self, place: Array) -> ConstraintError:
        residual = np.abs(self._residual(place))
        worst = self._closures[int(np.argmax(residual))]
        names = ", ".join(f"{q.published} = {v:g}" for q, v in self._given.items())
        return ConstraintError(
            f"no configuration with {names or 'these lengths'} closes the loop {worst} = 0",
            expected=f"a residual of zero, not {np.max(residual):.3g} m at best",
            advice="leave out the coordinates that the loop determines, or change the lengths",
        )


def _of_free(
    dynamics: Dynamics,
    expressions: Sequence[Expr],
    given: Numbers,
    free: tuple[Symbol, ...],
    parameters: Numbers,
) -> Callable[[Array], Array]:
    arguments = (*free, *given, *parameters, CLOCK)
    function = dynamics.program(expressions, arguments).function()
    known = (*given.values(), *parameters.values(), 0.0)
    return lambda place: np.array(function(*(float(x) for x in place), *known), dtype=float)

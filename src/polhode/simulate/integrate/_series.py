"""Solutions as Taylor series in numbers of any precision, step by step."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from polhode.algebra import Program
from polhode.simulate.integrate._arrays import occurring, pieces_at
from polhode.simulate.integrate._number_types import DOUBLES, NumberType


@dataclass(frozen=True, eq=False)
class TaylorSolution:
    """All states over the steps of an integration, in numbers of any precision.

    Attributes:
        numbers: their type.
        times: where the steps begin, and where the last one ends, s.
        limbs: coefficients of the powers of the share of a step that has passed, each as a sum of
            doubles, the largest first; shape (limbs, steps, order + 1, states).
    """

    numbers: NumberType
    times: Any
    limbs: Any = field(repr=False)

    def at(self, times: Any) -> Any:
        """The states at some times, shape (states, times)."""
        return self._evaluated(self.numbers, self.times, times, self._piece)

    def rounded_at(self, times: Any) -> Any:
        """The states at some times in doubles, to their rounding; only the first limb is needed."""
        return self._evaluated(DOUBLES, self._rounded_times, times, lambda i: self.limbs[0, i])

    # -- by the step and the share of it that has passed ---------------------------------------

    @property
    def steps(self) -> int:
        """How many there are."""
        return len(self.times) - 1

    def state(self, step: int, share: Any) -> Any:
        """The states within a step, shape (states,)."""
        return _horner(self._piece(step), self.numbers.array([share]))[:, 0]

    def time(self, step: int, share: Any) -> Any:
        """The time there, s."""
        begin, end = self.times[step : step + 2]
        return begin + (end - begin) * self.numbers.scalar(self.numbers.array(share)[()])

    def rounded_states(self, places: Any) -> Any:
        """States in doubles, shape (states, places), at places that count the steps."""
        which = pieces_at(np.arange(len(self.times), dtype=float), places)
        found = np.empty((self.limbs.shape[3], len(places)))
        for i in occurring(which):
            here = which == i
            found[:, here] = _horner(self.limbs[0, i], places[here] - i)
        return found

    def rounded_times(self, places: Any, begin: Any) -> Any:
        """The times there since some instant, s, in doubles."""
        which = pieces_at(np.arange(len(self.times), dtype=float), places)
        own = self.numbers.array([begin])[0]  # a long double less another number is an error
        since = np.array([float(time - own) for time in self.times])
        lengths = np.array([float(step) for step in self.times[1:] - self.times[:-1]])
        return since[which] + (places - which) * lengths[which]

    def without_empty_steps(self) -> TaylorSolution:
        """Without steps so short that no time passes in these numbers."""
        passes = self.times[1:] > self.times[:-1]
        if not np.any(passes):
            return self
        times = np.append(self.times[:1], self.times[1:][passes])
        return replace(self, times=times, limbs=self.limbs[:, passes])

    @cached_property
    def _rounded_times(self) -> Any:
        return np.array([float(time) for time in self.times])

    @cached_property
    def _known(self) -> dict[int, Any]:
        return {}

    def _piece(self, i: int) -> Any:
        """Coefficients of a step, shape (order + 1, states)."""
        if i not in self._known:
            self._known[i] = self.numbers.joined(list(self.limbs[:, i]))
        return self._known[i]

    def _evaluated(
        self, numbers: NumberType, starts: Any, times: Any, piece: Callable[[int], Any]
    ) -> Any:
        which = pieces_at(starts, times)
        found = np.empty((self.limbs.shape[3], len(times)), dtype=numbers.dtype)
        for i in occurring(which):
            here = which == i
            share = (times[here] - starts[i]) / (starts[i + 1] - starts[i])
            found[:, here] = _horner(piece(int(i)), share)
        return found


def _horner(coefficients: Any, places: Any) -> Any:
    """Polynomials at some places, shape (states, places), from coefficients by rising power."""
    total = coefficients[-1][:, None] + 0 * places
    for row in coefficients[-2::-1]:
        total = row[:, None] + total * places
    return total


def limbs_of(values: Any, count: int) -> Any:
    """Numbers of any NumPy type as sums of doubles, the largest first; shape (count, *shape)."""
    limbs = []
    for _ in range(count):
        limbs.append(values.astype(float))
        values = values - limbs[-1].astype(values.dtype)
    return np.array(limbs)


class SeriesCallback(Protocol):
    """Called after every step."""

    def __call__(self, time: float, step: float, state: Sequence[Any]) -> bool:
        """Whether to go on, from the end of a step of that length."""


@dataclass(frozen=True)
class InitialValueProblem:
    """An initial value problem.

    Attributes:
        program: of the rates of its first arguments, the states.
        numbers: the type of numbers to compute with.
        constants: values of the parameters, as mpmath numbers with spare bits.
        start: values of the states, likewise.
        begin: s, likewise.
        end: s, likewise.
    """

    program: Program
    numbers: NumberType
    constants: list[Any]
    start: list[Any]
    begin: Any
    end: Any


class SeriesIntegrator(Protocol):
    """Taylor's method in numbers of any precision."""

    name: str

    def integrate(self, problem: InitialValueProblem, watch: SeriesCallback) -> TaylorSolution:
        """The motion up to its end, until `watch` returns false, or as far as it goes.

        Raises:
            NumericError: where the motion cannot even begin.
        """

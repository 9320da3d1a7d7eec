"""Prescribed motions whose coefficients change at given times, for batches of motions."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Symbol
from polhode.simulate.forcing._prescribed_motion import PrescribedMotion
from polhode.simulate.integrate._arrays import Array

_SMOOTH = 1e-9  # of the largest acceleration: a smaller jump does not count


@dataclass(frozen=True)
class ForcingIntervals:
    """Coefficients of prescribed motions, constant on intervals of time.

    Attributes:
        drive: the prescribed motions.
        end: of all motions, s.
    """

    drive: PrescribedMotion
    end: float

    @cached_property
    def breaks(self) -> Array:
        """When coefficients change during the motion, s."""
        return np.array(sorted(t for t in self.drive.breaks if 0 < t < self.end), dtype=float)

    @cached_property
    def jerks(self) -> Array:
        """When a velocity jumps during the motion, s."""
        return np.array(sorted(t for t in self.drive.jerks if 0 < t < self.end), dtype=float)

    @cached_property
    def abrupt(self) -> frozenset[float]:
        """When the acceleration of a prescribed motion jumps, and forces with it, s."""
        found = set[float]()
        for pieces in self.drive.pieces.values():
            knots, powers = pieces.knots, np.arange(2, pieces.coefficients.shape[1])
            after = pieces.acceleration(knots)
            # Σ k (k − 1) c_k h^(k − 2) at the end of every piece; at rest before the first.
            factors = powers * (powers - 1) * np.diff(knots)[:, None] ** (powers - 2)
            at_ends = np.sum(pieces.coefficients[:, 2:] * factors, axis=1)
            before = np.concatenate([[0.0], at_ends])
            largest = max(float(np.max(np.abs(after))), float(np.max(np.abs(before))))
            found |= set(knots[np.abs(after - before) > _SMOOTH * largest].tolist())
        return frozenset(found)

    @cached_property
    def symbols(self) -> tuple[Symbol, ...]:
        """The coefficients."""
        return tuple(self.drive.constants(0.0))

    @cached_property
    def _begins(self) -> Array:
        return np.concatenate([[0.0], self.breaks])

    @cached_property
    def _table(self) -> Array:
        """Shape (symbols, intervals)."""
        rows = [list(self.drive.constants(t).values()) for t in self._begins.tolist()]
        return np.array(rows, dtype=float).reshape(len(rows), len(self.symbols)).T

    def from_then(self, times: Array) -> dict[Symbol, Array]:
        """Coefficients that hold from some times on."""
        return self._held(np.searchsorted(self.breaks, times, "right"))

    def until_then(self, times: Array) -> dict[Symbol, Array]:
        """Coefficients that hold up to some times."""
        return self._held(np.searchsorted(self.breaks, times, "left"))

    def _held(self, intervals: NDArray[np.intp]) -> dict[Symbol, Array]:
        return dict(zip(self.symbols, self.table(intervals), strict=True))

    def table(self, intervals: NDArray[np.intp]) -> Array:
        """Coefficients on some intervals, by their numbers; shape (symbols, intervals)."""
        return self._table[:, intervals]

    def interval_begin(self, time: float) -> float:
        """Beginning of the interval that lasts until a time, s."""
        return float(self._begins[np.searchsorted(self.breaks, time, "left")])

    def until_jerk(self, begin: Array) -> Array:
        """How far motions go before a support jerks, at most to their end; s, shape (motions,)."""
        return np.append(self.jerks, self.end)[np.searchsorted(self.jerks, begin, "right")]


@dataclass(frozen=True)
class PauseTimes:
    """Times at which motions pause: to record a sample, or because the forcing changes.

    Attributes:
        times: s, rising.
        samples: place of each among the requested times, or -1.
        held: coefficients that hold up to each, shape (symbols, times), in their order.
        abrupt: where forces may jump.
    """

    times: Array
    samples: list[int]
    held: Array
    abrupt: list[bool]

    @classmethod
    def of(cls, asked: Array, intervals: ForcingIntervals) -> PauseTimes:
        """Requested times together with the breaks of the prescribed motions."""
        times = np.union1d(asked, intervals.breaks)
        places = {time: place for place, time in enumerate(asked.tolist())}
        return cls(
            times,
            [places.get(time, -1) for time in times.tolist()],
            intervals.table(np.searchsorted(intervals.breaks, times, "left")),
            [time in intervals.abrupt for time in times.tolist()],
        )

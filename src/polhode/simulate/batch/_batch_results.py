"""The results of a batch: states of its motions at sample times, and their events."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Symbol
from polhode.simulate.batch._batch_segment import BatchSegment, Quantity
from polhode.simulate.batch._forcing_intervals import ForcingIntervals
from polhode.simulate.integrate._arrays import Array

LAST = -1
"""The sample at the end of a motion, whenever that is."""

Rows = NDArray[np.intp]


@dataclass(frozen=True)
class Events:
    """The events of motions, in order of time.

    Attributes:
        kinds: all that occur.
        times: s, shape (motions, most events of one of them); not-a-number where there is none.
        codes: places among the kinds, or -1.
    """

    kinds: tuple[str, ...]
    times: Array
    codes: Rows


@dataclass(frozen=True)
class BatchResults:
    """States of motions at sample times, each in the contact mode that it was in.

    Attributes:
        times: of the samples, s; the last is the time at which every motion has ended.
        constants: of all parameters, shape (motions,).
        intervals: of prescribed motions.
        end: of every motion, s.
        first: modes that they start in.
        last: modes that they end in.
    """

    times: Array
    constants: Mapping[Symbol, Array]
    intervals: ForcingIntervals
    end: Array
    first: list[str]
    last: list[str]
    _recorded: dict[int, dict[int, list[tuple[BatchSegment, Rows, Array]]]] = field(
        default_factory=dict
    )
    _events: list[tuple[int, float, str]] = field(default_factory=list)

    @classmethod
    def of(
        cls,
        count: int,
        times: Array,
        constants: Mapping[Symbol, Array],
        intervals: ForcingIntervals,
        mode: str,
    ) -> BatchResults:
        """Results of motions that have yet to be integrated."""
        end = np.full(count, times[-1])
        return cls(times, constants, intervals, end, [mode] * count, [mode] * count)

    def constants_from(self, rows: Rows, times: Array) -> dict[Symbol, Array]:
        """All constants of some motions, as they hold from some times on."""
        return self._constants_of(rows) | self.intervals.from_then(times)

    def constants_until(self, rows: Rows, times: Array) -> dict[Symbol, Array]:
        """All constants of some motions, as they hold up to some times."""
        return self._constants_of(rows) | self.intervals.until_then(times)

    def _constants_of(self, rows: Rows) -> dict[Symbol, Array]:
        return {symbol: values[rows] for symbol, values in self.constants.items()}

    def record(self, sample: int, batch_segment: BatchSegment, rows: Rows, states: Array) -> None:
        """Record states of some motions, shape (states, rows)."""
        by_mode = self._recorded.setdefault(sample, {})
        by_mode.setdefault(id(batch_segment), []).append((batch_segment, rows, states))

    def record_one(
        self, sample: int, batch_segment: BatchSegment, row: int, state: Mapping[Symbol, float]
    ) -> None:
        """Record the state of one motion."""
        states = np.array([[state.get(symbol, 0.0)] for symbol in batch_segment.states])
        self.record(sample, batch_segment, np.array([row]), states)

    def record_event(self, row: int, time: float, kind: str) -> None:
        """Record an event of a motion."""
        self._events.append((row, time, kind))

    def finish(self, row: int, time: float, mode: str) -> None:
        """Record the end of a motion."""
        self.end[row] = time
        self.last[row] = mode

    def values(self, quantity: Quantity, sample: int) -> Array:
        """A quantity at a sample time, shape (motions,); not-a-number where a motion had ended."""
        found = np.full(len(self.end), np.nan)
        clock = self.end if sample == LAST else np.full(len(self.end), self.times[sample])
        constants = self.constants_until if sample == LAST else self.constants_from
        for parts in self._recorded.get(sample, {}).values():
            batch_segment, *_ = parts[0]
            rows = np.concatenate([rows for _, rows, _ in parts])
            states = np.concatenate([states for *_, states in parts], axis=1)
            seen = dict(zip(batch_segment.states, states, strict=True))
            known = constants(rows, clock[rows])
            found[rows] = batch_segment.values(quantity, clock[rows], seen, known)
        return found

    def events(self) -> Events:
        """All events, motion by motion."""
        kinds = tuple(dict.fromkeys(kind for *_, kind in self._events))
        ordered = sorted(self._events, key=lambda one: one[:2])
        rows = np.array([row for row, *_ in ordered], dtype=np.intp)
        places = np.arange(len(rows)) - np.searchsorted(rows, rows, "left")
        shape = (len(self.end), int(np.max(places, initial=-1)) + 1)
        times, codes = np.full(shape, np.nan), np.full(shape, -1, dtype=np.intp)
        times[rows, places] = [time for _, time, _ in ordered]
        codes[rows, places] = [kinds.index(kind) for *_, kind in ordered]
        return Events(kinds, times, codes)

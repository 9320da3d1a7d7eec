"""Integrates many motions together through one contact mode, for as long as each stays in it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Symbol
from polhode.derive import Guard
from polhode.model import Phase
from polhode.simulate._names import Name
from polhode.simulate.batch._batch_results import LAST, BatchResults, Rows
from polhode.simulate.batch._batch_segment import SLIP_ENDS, BatchSegment
from polhode.simulate.batch._lanes import NONE, BatchArrivals, BatchStage
from polhode.simulate.contact._mode_state import ModeState
from polhode.simulate.integrate._arrays import Array

_CHUNK = 4096  # motions that are integrated together: enough to fill all lanes, in bounded memory
_LANDED = 1e-10  # slip speed, relative to the velocities that cancel in it, that counts as none

Phases = tuple[Phase, ...]
SegmentFor = Callable[[Phases], BatchSegment]
Starts = Callable[[int], Mapping[Name, Any]]


@dataclass(frozen=True)
class Group:
    """Motions that enter one mode and are integrated together.

    Attributes:
        rows: which ones they are.
        begin: s, shape (motions,).
        states: by symbol, shape (motions,).
        scales: size of the velocities that slips are the difference of, m/s.
        entries: of the mode; None where a motion starts in it.
        changes: of mode so far.
    """

    rows: Rows
    begin: Array
    states: Mapping[Symbol, Array]
    scales: Array
    entries: Sequence[ModeState | None]
    changes: Sequence[int]


@dataclass(frozen=True)
class BatchExit:
    """How a motion leaves a mode.

    Attributes:
        phases: of the contacts, in the mode.
        guard: that ended it; None for a jerk of a support.
        time: s.
        state: by symbol.
        changes: of mode before.
    """

    phases: Phases
    guard: Guard | None
    time: float
    state: Mapping[Symbol, float]
    changes: int


class ModeBatch:
    """Motions of one system, each with its own numbers, in their first mode.

    Args:
        batch_segments: the modes, for many motions.
        results: records their states and events.

    Attributes:
        results: the same.
        lost: motions that are to be integrated individually from their start.
    """

    def __init__(self, batch_segments: SegmentFor, results: BatchResults) -> None:
        self._batch_segment = batch_segments
        self.results = results
        self.lost: set[int] = set()

    def start(self, row: int) -> None:
        """Start a motion whose first mode is not known in advance."""
        self.lost.add(row)

    def run(self) -> None:
        """Integrate the motions that wait for others, until none is left."""

    def together(self, phases: Phases, group: Group) -> None:
        """Integrate motions through one mode."""
        batch_segment = self._batch_segment(phases)
        constants = self.results.constants_from(group.rows, group.begin)
        stage = batch_segment.stage(group.begin, group.states, constants, group.scales)
        clear = batch_segment.clear(stage)
        for i in np.flatnonzero(~clear).tolist():
            self._doubt(int(group.rows[i]), group.entries[i])
        which = np.flatnonzero(clear)
        for begin in range(0, len(which), _CHUNK):
            self._integrate_chunk(phases, group, stage, which[begin : begin + _CHUNK])

    def _leave(self, row: int, departure: BatchExit) -> None:
        """A motion leaves the mode, and does not end there."""
        self.lost.add(row)

    def _doubt(self, row: int, entry: ModeState | None) -> None:
        """A motion starts so close to a guard that it may not stay in the mode at all."""
        self.lost.add(row)

    def _integrate_chunk(
        self, phases: Phases, group: Group, stage: BatchStage, which: Rows
    ) -> None:
        batch_segment, times = self._batch_segment(phases), self.results.times
        rows, stage = group.rows[which], stage.some(which)
        found = self._with_slips_ended(
            batch_segment, rows, stage, batch_segment.follow(stage, times[1:])
        )
        starts = np.flatnonzero(stage.begin == 0.0)
        self.results.record(0, batch_segment, rows[starts], stage.states[:, starts])
        for sample, time in enumerate(self.results.times[1:-1]):
            there = np.flatnonzero((stage.begin <= time) & (time < found.end))
            self.results.record(
                sample + 1, batch_segment, rows[there], found.states[sample][:, there]
            )
        self.lost |= set(rows[~found.good].tolist())
        on = found.good & (found.guard == NONE)
        over = found.end >= self.results.times[-1]
        self._finish(batch_segment, rows, found, on & over, "", batch_segment.mode)
        self._go_on(phases, group, which, found, on & ~over, None)
        for k, ending in enumerate(batch_segment.endings):
            here = found.good & (found.guard == k)
            if ending.kind:
                self._finish(batch_segment, rows, found, here, ending.kind, ending.mode)
            else:
                self._go_on(phases, group, which, found, here, ending.guard)

    def _go_on(
        self,
        phases: Phases,
        group: Group,
        which: Rows,
        found: BatchArrivals,
        here: NDArray[np.bool_],
        guard: Guard | None,
    ) -> None:
        """Motions go on in another mode."""
        symbols = self._batch_segment(phases).states
        for j in np.flatnonzero(here).tolist():
            state = dict(zip(symbols, found.states[-1, :, j].tolist(), strict=True))
            changes = group.changes[which[j]]
            departure = BatchExit(phases, guard, float(found.end[j]), state, changes)
            self._leave(int(group.rows[which[j]]), departure)

    def _with_slips_ended(
        self, batch_segment: BatchSegment, rows: Rows, stage: BatchStage, found: BatchArrivals
    ) -> BatchArrivals:
        """The arrivals, extrapolated to where slips that have nearly ended vanish.

        The remaining time is so short that a linear extrapolation is exact to rounding.
        """
        states, end, good = found.states.copy(), found.end.copy(), found.good.copy()
        good &= found.guard != batch_segment.doubtful
        for k, ending in enumerate(batch_segment.endings):
            here = np.flatnonzero(found.guard == k)
            if ending.slips is None or not len(here):
                continue
            constants = self.results.constants_until(rows[here], end[here])
            there = stage.some(here).moved(
                end[here], states[-1][:, here], batch_segment.ordered(constants, len(here))
            )
            # The slip s + ṡ τ is shortest at τ = −s·ṡ/|ṡ|²; what is left of it there must be zero.
            rates = batch_segment.rates(there)
            places = [batch_segment.states.index(s) for s in ending.slips]
            slip, change = there.states[places], rates[places]
            left = -np.sum(slip * change, axis=0) / np.sum(change * change, axis=0)
            states[-1][:, here] += left * rates
            end[here] += left
            miss = np.hypot(*(slip + left * change))
            good[here] &= miss <= _LANDED / SLIP_ENDS * stage.least[k, here]
        return replace(found, states=states, end=end, good=good)

    def _finish(
        self,
        batch_segment: BatchSegment,
        rows: Rows,
        found: BatchArrivals,
        here: NDArray[np.bool_],
        kind: str,
        mode: str,
    ) -> None:
        """Record the end of motions, by an event or not."""
        which = np.flatnonzero(here)
        self.results.record(LAST, batch_segment, rows[which], found.states[-1][:, which])
        for row, time in zip(rows[which].tolist(), found.end[which].tolist(), strict=True):
            self.results.finish(row, time, mode)
            if kind:
                self.results.record_event(row, time, kind)

"""Integrates many motions through all their contact modes: together within modes, singly between.

Motions that leave a mode wait until others enter the same mode; then these are integrated together.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from polhode.algebra import Symbol
from polhode.base import SilentProgress
from polhode.derive import Guard
from polhode.model import Phase
from polhode.simulate._names import Name
from polhode.simulate._segment import TrajectoryPiece, state_at
from polhode.simulate._task import Task
from polhode.simulate.batch._batch_results import LAST, BatchResults
from polhode.simulate.batch._batch_segment import BatchSegment
from polhode.simulate.batch._forcing_intervals import ForcingIntervals
from polhode.simulate.batch._mode_batch import (
    BatchExit,
    Group,
    ModeBatch,
    Phases,
    SegmentFor,
    Starts,
)
from polhode.simulate.contact._guard_monitor import GuardMonitor
from polhode.simulate.contact._hybrid_integrator import HybridIntegrator, HybridSolution
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._mode_pieces import double_pieces, mode_exit
from polhode.simulate.contact._mode_state import ModeState, beyond, state_on
from polhode.simulate.contact._slip_onset import slip_onset_piece
from polhode.simulate.contact._through_modes import check_numbers, first_entry
from polhode.simulate.contact._transition import Transitions

# -- one motion, from mode to mode -----------------------------------------------------------------

_LARGE = (
    6  # speeds: the expanded determinant of a mass matrix has up to 6! terms; more are too many
)


@dataclass(frozen=True)
class Entered:
    """A motion at the instant from which it may be integrated together with others.

    Attributes:
        entry: of its mode.
        time: s.
        state: by symbol.
        piece: of its motion in this mode so far.
        guard: that has ended the mode already.
    """

    entry: ModeState
    time: float
    state: Mapping[Symbol, float]
    piece: TrajectoryPiece | None = None
    guard: Guard | None = None


class SingleTrajectoryStepper:
    """Takes motions from mode to mode, one at a time: transitions are not vectorised.

    Args:
        hybrid: the modes.
        task: what all motions have in common.
        intervals: of prescribed motions.
    """

    def __init__(self, hybrid: HybridSystem, task: Task, intervals: ForcingIntervals) -> None:
        self._hybrid = hybrid
        self._task = task
        self._transitions = Transitions(hybrid)
        self._intervals = intervals

    def first(self, start: Mapping[Name, Any]) -> ModeState:
        """How a motion enters its first mode."""
        check_numbers(self._hybrid)
        return first_entry(self._hybrid, replace(self._task, start=start))[0]

    def can_be_batched(self, entry: ModeState) -> bool:
        """Whether a mode can be integrated for many motions together.

        Not with open contacts, which land with impacts, nor with absolute values, nor with forces
        that are open: guards do not say where these give way.
        """
        mode = self._hybrid.mode(entry.phases)
        large = mode.can_jam and len(mode.mode.equations.mass.rows) > _LARGE
        smooth = not mode.dynamics.undecided
        decided = mode.open_forces is None
        return decided and smooth and not large and not any(p.flies for p in entry.phases)

    def set_constants(self, constants: Mapping[Symbol, float]) -> None:
        """Take the numbers of a motion."""
        self._hybrid.set_constants(constants)

    def phases(self, mode: str) -> tuple[Phase, ...]:
        """The phases of all contacts in a mode."""
        return self._hybrid.automaton.named(mode)

    def leave(self, departure: BatchExit) -> tuple[str, ModeState]:
        """What happens where a mode ends, and how the next mode is entered."""
        self._hybrid.update_forcing(self._intervals.interval_begin(departure.time))
        mode = self._hybrid.mode(departure.phases)
        state = departure.state
        left = mode_exit(mode, departure.guard, state, departure.time, 0.0)
        before = ModeState(departure.phases, left.shared, np.empty(0), np.empty(0))
        return self._transitions.next(before, left)

    def enter(self, entry: ModeState, end: float) -> Entered:
        """The beginning of a mode: slips that begin have to be integrated individually."""
        mode = self._hybrid.mode(entry.phases)
        begin, state = entry.shared.time, state_on(self._hybrid, entry)
        if not entry.onset:
            return Entered(entry, begin, state)
        contacts = self._hybrid.automaton.contacts
        monitor = GuardMonitor(self._hybrid, self._task.near_flat, mode, entry)
        span = (begin, self._hybrid.drive.until(begin, end))
        piece, guard = monitor.cut(slip_onset_piece(mode, entry, state, span, contacts))
        return Entered(entry, piece.end, state_at(piece, piece.end), piece, guard)

    def speed_scale(self, entry: ModeState) -> float:
        """Size of the velocities that a slip is the difference of, m/s."""
        return self._hybrid.touching.scale(entry.shared, beyond(entry.phases)) or 1.0

    def to_the_end(self, entry: ModeState, end: float) -> HybridSolution:
        """The rest of a motion, integrated individually."""
        pieces = double_pieces(self._hybrid, self._task.near_flat, SilentProgress())
        return HybridIntegrator(self._hybrid, pieces, self._task.until).integrate(entry, end)


_MOST_CHANGES = 1000  # of mode, before a motion is integrated individually


@dataclass(frozen=True)
class _Waiting:
    row: int
    changes: int
    scale: float
    entered: Entered


class BatchScheduler(ModeBatch):
    """Motions of one system that go on from mode to mode.

    Args:
        batch_segments, results: as in `ModeBatch`.
        stepper: takes single motions from mode to mode.
        starts: start values of a motion.
    """

    def __init__(
        self,
        batch_segments: SegmentFor,
        results: BatchResults,
        stepper: SingleTrajectoryStepper,
        starts: Starts,
    ) -> None:
        super().__init__(batch_segments, results)
        self._stepper = stepper
        self._starts = starts
        self._waiting: dict[Phases, list[_Waiting]] = {}

    def run(self) -> None:
        """Integrate the motions that wait, mode by mode, until none is left."""
        while self._waiting:
            # The fullest queue first: meanwhile motions that leave its mode join the others.
            phases = max(self._waiting, key=lambda p: len(self._waiting[p]))
            waiting = self._waiting.pop(phases)
            states = [w.entered.state for w in waiting]
            group = Group(
                np.array([w.row for w in waiting]),
                np.array([w.entered.time for w in waiting]),
                {s: np.array([state[s] for state in states]) for s in states[0]},
                np.array([w.scale for w in waiting]),
                [w.entered.entry for w in waiting],
                [w.changes for w in waiting],
            )
            self.together(phases, group)

    def start(self, row: int) -> None:
        def begin() -> None:
            entry = self._stepper.first(self._starts(row))
            self.results.first[row] = self._batch_segment(entry.phases).mode
            self._enter(row, entry, 0)

        self._attempt(row, begin)

    def _leave(self, row: int, departure: BatchExit) -> None:
        def go_on() -> None:
            kind, entry = self._stepper.leave(departure)
            self.results.record_event(row, departure.time, kind)
            self._enter(row, entry, departure.changes + 1)

        self._attempt(row, go_on)

    def _doubt(self, row: int, entry: ModeState | None) -> None:
        if entry is None:
            self.start(row)
        else:
            self._attempt(row, lambda: self._by_itself(row, entry))

    def _attempt(self, row: int, step: Callable[[], None]) -> None:
        """Take a step with one motion; if it fails, the motion is integrated individually later."""
        constants = self.results.constants
        self._stepper.set_constants({s: float(values[row]) for s, values in constants.items()})
        try:
            step()
        except Exception:  # any error concerns this motion alone
            self.lost.add(row)

    def _enter(self, row: int, entry: ModeState, changes: int) -> None:
        """Let a motion enter a mode, and wait there for others."""
        end = float(self.results.times[-1])
        if changes > _MOST_CHANGES or not self._stepper.can_be_batched(entry):
            return self._by_itself(row, entry)
        entered = self._stepper.enter(entry, end)
        if entered.guard is not None or entered.time >= end:
            return self._by_itself(row, entry)
        if entered.piece is not None:
            self._record_piece(row, self._batch_segment(entry.phases), entered.piece)
        scale = self._stepper.speed_scale(entry) if entry.slips else 0.0
        waiting = _Waiting(row, changes, scale, entered)
        return self._waiting.setdefault(entry.phases, []).append(waiting)

    def _by_itself(self, row: int, entry: ModeState) -> None:
        """Integrate a motion individually from where it enters a mode."""
        solution = self._stepper.to_the_end(entry, float(self.results.times[-1]))
        batch_segments = [
            self._batch_segment(self._stepper.phases(segment.mode)) for segment in solution.segments
        ]
        for batch_segment, segment in zip(batch_segments, solution.segments, strict=True):
            for piece in segment.parts:
                self._record_piece(row, batch_segment, piece)
        last = solution.segments[-1]
        self.results.record_one(LAST, batch_segments[-1], row, state_at(last.parts[-1], last.end))
        self.results.finish(row, last.end, solution.ending)
        for change in solution.changes:
            self.results.record_event(row, change.time, change.kind)

    def _record_piece(self, row: int, batch_segment: BatchSegment, piece: TrajectoryPiece) -> None:
        """Record the states at the samples on a piece."""
        times = self.results.times[:-1]
        for sample in np.flatnonzero((piece.begin <= times) & (times < piece.end)):
            self.results.record_one(
                int(sample), batch_segment, row, state_at(piece, float(times[sample]))
            )

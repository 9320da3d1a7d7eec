"""Many motions through all their contact modes: abreast within a mode, one by one in between.

Motions that leave a mode wait until those that are in the same next mode are taken up together.
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
from polhode.simulate.batch._mode_batch import BatchExit, Group, ModeBatch, Phases, Starts, Stays
from polhode.simulate.contact._guard_monitor import GuardMonitor
from polhode.simulate.contact._hybrid_integrator import HybridIntegrator, HybridSolution
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._mode_pieces import double_pieces, leaving
from polhode.simulate.contact._mode_state import ModeState, beyond, state_on
from polhode.simulate.contact._slip_onset import onset
from polhode.simulate.contact._through_modes import check_numbers, first_entry
from polhode.simulate.contact._transition import Transitions

# -- one motion, from mode to mode -----------------------------------------------------------------

_LARGE = 6  # a matrix whose determinant has too many terms to be watched


@dataclass(frozen=True)
class Entered:
    """A motion at the point from which it may go abreast with others.

    Attributes:
        entry: of its mode.
        time: s.
        state: by symbol.
        part: what it did in this mode so far.
        guard: that has ended the mode already.
    """

    entry: ModeState
    time: float
    state: Mapping[Symbol, float]
    part: TrajectoryPiece | None = None
    guard: Guard | None = None


class SingleTrajectoryStepper:
    """Follows single motions over what cannot be done for many at once.

    Args:
        machine: the modes.
        task: what is asked for of every motion.
        stretches: of prescribed motions.
    """

    def __init__(self, machine: HybridSystem, task: Task, stretches: ForcingIntervals) -> None:
        self._machine = machine
        self._task = task
        self._transitions = Transitions(machine)
        self._stretches = stretches

    def first(self, start: Mapping[Name, Any]) -> ModeState:
        """How a motion enters its first mode."""
        check_numbers(self._machine)
        return first_entry(self._machine, replace(self._task, start=start))[0]

    def goes_abreast(self, entry: ModeState) -> bool:
        """Whether its mode is one for lanes: what flies lands with a shock, one by one.

        Absolute values are followed from side to side, one motion by itself.
        """
        mode = self._machine.mode(entry.phases)
        large = mode.can_jam and len(mode.mode.equations.mass.rows) > _LARGE
        smooth = not mode.dynamics.undecided
        return smooth and not large and not any(phase.flies for phase in entry.phases)

    def take(self, constants: Mapping[Symbol, float]) -> None:
        """Take the numbers of a motion."""
        self._machine.take(constants)

    def phases(self, mode: str) -> tuple[Phase, ...]:
        """Of the contacts in a mode."""
        return self._machine.automaton.named(mode)

    def leave(self, departure: BatchExit) -> tuple[str, ModeState]:
        """What happens where a mode ends, and how the motion enters the next."""
        self._machine.move_on(self._stretches.begun_before(departure.time))
        mode = self._machine.mode(departure.phases)
        state = departure.state
        left = leaving(mode, departure.guard, state, departure.time, 0.0)
        before = ModeState(departure.phases, left.place, np.empty(0), np.empty(0))
        return self._transitions.next(before, left)

    def enter(self, entry: ModeState, end: float) -> Entered:
        """The beginning of a mode: a slip that sets in, for which vectors are no use."""
        mode = self._machine.mode(entry.phases)
        begin, state = entry.place.time, state_on(self._machine, entry)
        if not entry.onset:
            return Entered(entry, begin, state)
        contacts = self._machine.automaton.contacts
        lookout = GuardMonitor(self._machine, self._task.near_flat, mode, entry)
        span = (begin, self._machine.drive.until(begin, end))
        part, guard = lookout.cut(onset(mode, entry, state, span, contacts))
        return Entered(entry, part.end, state_at(part, part.end), part, guard)

    def speed_scale(self, entry: ModeState) -> float:
        """Size of the velocities that a slip is the difference of, m/s."""
        return self._machine.touching.scale(entry.place, beyond(entry.phases)) or 1.0

    def to_the_end(self, entry: ModeState, end: float) -> HybridSolution:
        """All the rest, step by step."""
        pieces = double_pieces(self._machine, self._task.near_flat, SilentProgress())
        return HybridIntegrator(self._machine, pieces, self._task.until).integrate(entry, end)


_MOST_CHANGES = 1000  # of one motion, before it is left to itself


@dataclass(frozen=True)
class _Waiting:
    row: int
    changes: int
    scale: float
    entered: Entered


class BatchScheduler(ModeBatch):
    """Motions of one system that go on from mode to mode.

    Args:
        stays, sightings: as of a company.
        pilot: takes single motions from mode to mode.
        starts: start values of a motion.
    """

    def __init__(
        self, stays: Stays, sightings: BatchResults, pilot: SingleTrajectoryStepper, starts: Starts
    ) -> None:
        super().__init__(stays, sightings)
        self._pilot = pilot
        self._starts = starts
        self._waiting: dict[Phases, list[_Waiting]] = {}

    def run(self) -> None:
        """Follow all that wait, until nobody does."""
        while self._waiting:
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
            entry = self._pilot.first(self._starts(row))
            self.sightings.first[row] = self._stays(entry.phases).mode
            self._enter(row, entry, 0)

        self._attempt(row, begin)

    def _leave(self, row: int, departure: BatchExit) -> None:
        def go_on() -> None:
            kind, entry = self._pilot.leave(departure)
            self.sightings.happened(row, departure.time, kind)
            self._enter(row, entry, departure.changes + 1)

        self._attempt(row, go_on)

    def _doubt(self, row: int, entry: ModeState | None) -> None:
        if entry is None:
            self.start(row)
        else:
            self._attempt(row, lambda: self._by_itself(row, entry))

    def _attempt(self, row: int, step: Callable[[], None]) -> None:
        """Take a step with one motion; one that fails is told when it is followed by itself."""
        constants = self.sightings.constants
        self._pilot.take({s: float(values[row]) for s, values in constants.items()})
        try:
            step()
        except Exception:  # whatever it is, it is this motion's alone
            self.lost.add(row)

    def _enter(self, row: int, entry: ModeState, changes: int) -> None:
        """Let a motion enter a mode, and wait for others in it."""
        end = float(self.sightings.times[-1])
        if changes > _MOST_CHANGES or not self._pilot.goes_abreast(entry):
            return self._by_itself(row, entry)
        entered = self._pilot.enter(entry, end)
        if entered.guard is not None or entered.time >= end:
            return self._by_itself(row, entry)
        if entered.part is not None:
            self._note_stretch(row, self._stays(entry.phases), entered.part)
        scale = self._pilot.speed_scale(entry) if entry.slips else 0.0
        waiting = _Waiting(row, changes, scale, entered)
        return self._waiting.setdefault(entry.phases, []).append(waiting)

    def _by_itself(self, row: int, entry: ModeState) -> None:
        """Follow a motion step by step from where it enters a mode."""
        course = self._pilot.to_the_end(entry, float(self.sightings.times[-1]))
        stays = [self._stays(self._pilot.phases(segment.mode)) for segment in course.segments]
        for stay, segment in zip(stays, course.segments, strict=True):
            for part in segment.parts:
                self._note_stretch(row, stay, part)
        last = course.segments[-1]
        self.sightings.note_one(LAST, stays[-1], row, state_at(last.parts[-1], last.end))
        self.sightings.finish(row, last.end, course.ending)
        for change in course.changes:
            self.sightings.happened(row, change.time, change.kind)

    def _note_stretch(self, row: int, stay: BatchSegment, part: TrajectoryPiece) -> None:
        """States at the looks within a stretch of time."""
        times = self.sightings.times[:-1]
        for look in np.flatnonzero((part.begin <= times) & (times < part.end)):
            self.sightings.note_one(int(look), stay, row, state_at(part, float(times[look])))

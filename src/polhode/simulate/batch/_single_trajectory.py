"""Takes one motion out of a contact mode, and into the next as far as that cannot go abreast."""

from __future__ import annotations

from collections.abc import Mapping
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
from polhode.simulate.batch._forcing_intervals import ForcingIntervals
from polhode.simulate.batch._mode_batch import BatchExit
from polhode.simulate.contact._checks import check_numbers
from polhode.simulate.contact._guard_monitor import GuardMonitor
from polhode.simulate.contact._hybrid_integrator import HybridIntegrator, HybridSolution, leaving
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._mode_state import ModeState, state_on
from polhode.simulate.contact._slip_direction import onset
from polhode.simulate.contact._through import first_entry

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


class SingleTrajectoryStepper(HybridIntegrator):
    """Follows single motions over what cannot be done for many at once.

    Args:
        machine: the modes.
        task: what is asked for of every motion.
        stretches: of prescribed motions.
    """

    def __init__(self, machine: HybridSystem, task: Task, stretches: ForcingIntervals) -> None:
        super().__init__(machine, task.near_flat, SilentProgress(), task.until)
        self._task = task
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
        lookout = GuardMonitor(self._machine, self._near_flat, mode, entry)
        span = (begin, self._machine.drive.until(begin, end))
        part, guard = lookout.cut(onset(mode, entry, state, span, contacts))
        return Entered(entry, part.end, state_at(part, part.end), part, guard)

    def speed_scale(self, entry: ModeState) -> float:
        """Size of the velocities that a slip is the difference of, m/s."""
        return self._speed_scale(entry)

    def to_the_end(self, entry: ModeState, end: float) -> HybridSolution:
        """All the rest, step by step."""
        walk = HybridIntegrator(self._machine, self._near_flat, self._progress, self._until)
        return walk.along(entry, end)

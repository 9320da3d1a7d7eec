"""The course of a motion through its contact modes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from polhode.algebra import Symbol
from polhode.base import NumericError, Progress
from polhode.derive import Guard
from polhode.model import Rolling
from polhode.simulate._absolute_values import (
    SideChange,
    SideChangeCount,
    Sides,
    nearer,
    overshoots,
    refuse_vanishing,
    sides_at,
    told_change,
)
from polhode.simulate._absolute_values import beyond as beyond_side
from polhode.simulate._dynamics import WORK
from polhode.simulate._event import ModeSwitch
from polhode.simulate._segment import Segment, TrajectoryPiece, state_at
from polhode.simulate.contact._carried import gap_symbol, room_symbol, slip_symbols
from polhode.simulate.contact._contact_kinematics import ContactKinematics, State, fall_of
from polhode.simulate.contact._guard_monitor import GuardMonitor
from polhode.simulate.contact._hybrid_system import CompiledMode, HybridSystem
from polhode.simulate.contact._mode_state import ModeState, beyond, directions_of, state_on
from polhode.simulate.contact._slip_onset import onset
from polhode.simulate.contact._transition import ModeExit, Transitions
from polhode.simulate.forcing._prescribed_motion import PrescribedMotion
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._driver import integrate
from polhode.simulate.integrate._stop_criteria import StepCount, Stop, StopCriteria

_LOOK = 400  # steps after which the guards are looked at
VANISHED = 1e-14  # slip speed, relative to the velocities around, that is none
LANDED = 1e-10  # the same at an instant at which the slip velocity turns round
_MOST_EVENTS = 50_000
_INSTANT = 32  # steps of rounding of the time: a hop that is over sooner is none
_BEGUN = 1e-9  # of the time: a slip that begins is not told from rounding sooner
_NO_TIME = 1e-11  # of the time of the whole motion
_MOST_AT_ONCE = 32  # changes of mode while no time passes: far more than contacts can have


@dataclass(frozen=True)
class HybridSolution:
    """Segments and the changes between them; the motion may end before its time."""

    segments: tuple[Segment, ...]
    changes: tuple[ModeSwitch, ...]
    ending: str


class HybridIntegrator:
    """Follows a motion from mode to mode.

    Args:
        machine: the modes.
        near_flat: value at which an expression that must stay positive, such as sin θ, counts as
            gone.
        progress: told of every step.
        until: what, once it happens, ends the motion.
    """

    def __init__(
        self,
        machine: HybridSystem,
        near_flat: float,
        progress: Progress,
        until: frozenset[str] = frozenset(),
    ) -> None:
        self._machine = machine
        self._near_flat = near_flat
        self._progress = progress
        self._until = until
        self._segments: list[Segment] = []
        self._changes: list[ModeSwitch] = []
        self._instants: list[float] = []
        self._transitions = Transitions(machine)
        self._tally = StepCount()
        self._sides_ended = SideChangeCount()

    def along(self, entry: ModeState, end: float) -> HybridSolution:
        """Follow the motion up to a time, or to where it goes flat.

        Raises:
            NumericError: where it cannot be continued.
        """
        while entry.place.time < end:
            outcome = self.stay(entry, end)
            self._segments.extend(outcome.segments)
            self._changes.extend(outcome.turns)
            now = outcome.leaving.place.time
            if outcome.leaving.guard is None and (now >= end or outcome.interrupted):
                break
            time, before = outcome.segment.end, outcome.segment.mode
            last = self._last(outcome)
            if last is not None:
                return HybridSolution(tuple(self._segments), (*self._changes, last), last.after)
            kind, entry = self._transitions.next(entry, outcome.leaving)
            after = self._machine.mode(entry.phases).mode.name
            self._changes.append(ModeSwitch(time, kind, before, after))
            self._instants.append(now)
            if len(self._changes) > _MOST_EVENTS:
                raise _chattering(time)
            if self._stands_still(end):
                raise self._undecided(time, {before, after})
        return HybridSolution(tuple(self._segments), tuple(self._changes), self._segments[-1].mode)

    def _stands_still(self, end: float) -> bool:
        """Whether mode has followed mode for long while no time has passed.

        Next to none counts as none unless contacts rebound, ever more often.
        """
        last = self._instants[-_MOST_AT_ONCE:]
        passed = last[-1] - last[0]
        if len(last) < _MOST_AT_ONCE or passed > _NO_TIME * end:
            return False
        instant = 8 * self._machine.numbers.spacing(last[-1])
        return bool(passed <= instant) or not self._rebounds()

    def _undecided(self, time: float, modes: set[str]) -> NumericError:
        # Where N vanishes while unlimited friction still pulls, the contact cannot open, for
        # without friction it would close again; nor can it hold, for it would have to pull
        # (Painlevé). Limited friction may bring a ball back to an edge from either side.
        names = sorted(modes) if len(modes) > 1 else [*modes, "contact"]
        unlimited = any(isinstance(c, Rolling) for c in self._machine.automaton.contacts)
        give = "give the contact a friction coefficient mu, or " if unlimited else ""
        return NumericError(
            f"at t = {float(time):.9g} s no mode can follow: {' and '.join(names)} exclude each "
            "other",
            expected="friction that gives way before the contact has to open"
            if unlimited
            else "a contact mode that lasts for some time",
            advice=f"{give}end the motion before that time",
        )

    def _rebounds(self) -> bool:
        contacts = self._machine.automaton.contacts
        return any(self._machine.value(contact.restitution) > 0 for contact in contacts)

    def _last(self, outcome: Outcome) -> ModeSwitch | None:
        """The change that ends the motion, if this is one."""
        guard = outcome.leaving.guard
        kind = guard.kind if guard is not None else ""
        time, mode = outcome.segment.end, outcome.segment.mode
        if kind == "near-flat":
            return ModeSwitch(time, "goes flat", mode, "near-flat")
        return ModeSwitch(time, kind, mode, mode) if kind in self._until else None

    # -- one mode -------------------------------------------------------------------------------

    def stay(self, entry: ModeState, end: float) -> Outcome:
        """As long as the mode lasts."""
        whole = self._machine.mode(entry.phases)
        begin = now = entry.place.time
        machine, drive = self._machine, self._machine.drive
        parts = list[TrajectoryPiece]()
        before, turns = list[Segment](), list[ModeSwitch]()
        state = state_on(machine, entry)
        mode = whole.on(sides_at(whole.dynamics, whole.here(state, now)))
        lookout = GuardMonitor(machine, self._near_flat, mode, entry)
        guard: Guard | None = None
        scale = 0.0
        shortest = _BEGUN * begin if entry.onset else _INSTANT * float(np.spacing(begin))
        while guard is None and now < end:
            machine.move_on(now)
            limit = drive.until(now, end)
            first = not (parts or before)
            if first:
                limit = min(limit, now + max(self.hop(mode, entry), shortest))
            span = (now, limit)
            if entry.onset and first:
                part = onset(mode, entry, state, span, machine.automaton.contacts)
                part, guard = lookout.cut(part)
            else:
                rest = parts[-1].solution.rest(now) if parts else mode.rest(state, now)
                if entry.slips:
                    scale = max(scale, self.scale_at(place_of(mode, state, now), entry))
                watched = self._watched(mode, entry, scale or 1.0)
                part, guard = self._up_to(lookout, rest, span, watched)
            parts.append(part)
            now, state = part.end, state_at(part, part.end)
            if isinstance(guard, SideChange):
                machine.move_on(now)
                sides = self._turned(whole, mode, state, now, guard)
                if sides != mode.dynamics.sides:
                    kind, name = told_change(guard, sides), mode.mode.name
                    turns.append(ModeSwitch(now, kind, name, name))
                before.append(Segment(mode.mode.name, begin, now, mode.dynamics, tuple(parts)))
                begin, parts, guard = now, [], None
                mode = whole.on(sides)
                lookout = replace(lookout, mode=mode)
            elif now > span[0] and now in drive.breaks and not _settled(guard, now, drive):
                guard = None
            if part.solution.stop is Stop.INTERRUPTED or now in drive.jerks:
                break
        if parts:
            before.append(Segment(mode.mode.name, begin, now, mode.dynamics, tuple(parts)))
        there = leaving(mode, guard, state, now, entry.place.work)
        return Outcome(tuple(before), tuple(turns), there)

    def _turned(
        self,
        whole: CompiledMode,
        mode: CompiledMode,
        state: Mapping[Symbol, Any],
        now: Any,
        passage: SideChange,
    ) -> Sides:
        """The sides of absolute values that follow where one ends."""
        self._sides_ended.count(now, passage)
        return beyond_side(whole.dynamics, whole.here(state, now), mode.dynamics.sides, passage)

    def _up_to(
        self, lookout: GuardMonitor, rest: Array, span: tuple[float, float], watched: StopCriteria
    ) -> tuple[TrajectoryPiece, Guard | None]:
        """Up to the end of a span, or to the first guard that falls."""
        whole = self._stretch(lookout.mode, rest, span, watched)
        part, guard = lookout.cut(whole)
        again = nearer(whole.solution.steps, part.end) if isinstance(guard, SideChange) else None
        if again is not None:
            return self._up_to(lookout, rest, (span[0], again), watched)
        refuse_vanishing(lookout.mode.dynamics, part)
        return part, guard

    def hop(self, mode: CompiledMode, entry: ModeState) -> float:
        """How far ahead a contact that opened on the way may be expected to be closed again, or one
        that crossed an edge to be back at it, s.

        A short hop within a long step would be lost in the rounding of the long one.
        """
        hops = [fall_of(*hop) for hop in self._hops(mode, entry) if hop[2] < 0]
        return 1.5 * min((hop for hop in hops if hop > 0), default=np.inf)

    def _hops(self, mode: CompiledMode, entry: ModeState) -> Iterator[tuple[Any, Any, Any]]:
        """Heights and distances to an edge with their first and second rates."""
        if not (entry.gaps or entry.rooms):
            return
        state, now, meetings = entry.state, entry.place.time, self._meetings(entry)
        if entry.gaps:
            falls = mode.closing_rates(state, now)
            yield from ((gap, meetings[i].velocity[2], falls[i]) for i, gap in entry.gaps.items())
        if entry.rooms:
            bends = mode.room_rates(state, now, directions_of(entry, self._machine.numbers))
            for i, room in entry.rooms.items():
                is_beyond = entry.phases[i].is_beyond
                yield room, meetings[i].leaving(is_beyond=is_beyond), bends[i]

    def _stretch(
        self,
        mode: CompiledMode,
        start: Array,
        span: tuple[float, float],
        watched: StopCriteria,
    ) -> TrajectoryPiece:
        flow = mode.flow
        constants = mode.parameters
        solution = integrate(flow, mode.stepper, constants, start, span, self._progress, watched)
        return TrajectoryPiece(span[0], float(solution.steps[-1]), solution, constants)

    def _watched(self, mode: CompiledMode, entry: ModeState, scale: float) -> StopCriteria:
        if not (mode.mode.guards or mode.passages):
            return StopCriteria(tally=self._tally)
        core = mode.flow.core.symbols
        vectors = [slip_symbols(self._machine.automaton.contacts[i]) for i in sorted(entry.slips)]
        places = tuple(
            tuple(core.index(s) for s in pair) for pair in vectors if set(pair) <= set(core)
        )
        flat, passed = self._is_flat(mode), self._has_passed(mode)

        def over(time: float, state: Sequence[float]) -> bool:
            return flat(time, state) or passed(time, state)

        least, passing = VANISHED * scale, LANDED * scale
        return StopCriteria(_LOOK, places, least, passing, over, self._tally)

    def _is_flat(self, mode: CompiledMode) -> Callable[[float, Sequence[float]], bool]:
        """Whether a state of the core is beyond the side on which the equations hold.

        What follows there may take any number of steps, and does not count.
        """
        if not any(guard.kind == "near-flat" for guard in mode.mode.guards):
            return lambda time, state: False
        values, constants, least = mode.sides, mode.parameters.tolist(), self._near_flat
        return lambda time, state: min(values(*state, *constants, time)) < least

    def _has_passed(self, mode: CompiledMode) -> Callable[[float, Sequence[float]], bool]:
        """Whether a state of the core is beyond the end of a side."""
        if not mode.passages:
            return lambda time, state: False
        return overshoots(mode.dynamics, mode.passages, mode.flow, mode.parameters)

    def _speed_scale(self, entry: ModeState) -> float:
        return self.scale_at(entry.place, entry) or 1.0

    def scale_at(self, place: State, entry: ModeState) -> float:
        """Size of the velocities that slips are the difference of, m/s."""
        meetings = self._machine.touching.at(place, beyond(entry.phases))
        return max((meeting.scale for meeting in meetings), default=0.0)

    def _meetings(self, entry: ModeState) -> list[ContactKinematics]:
        """What meets where a mode is entered."""
        return self._machine.touching.at(entry.place, beyond(entry.phases))


def leaving(
    mode: CompiledMode,
    guard: Guard | None,
    state: Mapping[Symbol, Any],
    time: Any,
    work: Any,
) -> ModeExit:
    """Where a mode ends, in a state of it; the work is as before where none is done."""
    contacts = [touch.contact for touch in mode.mode.touches]
    gaps, rooms = (
        {i: state[s] for i, contact in enumerate(contacts) if (s := symbol(contact)) in state}
        for symbol in (gap_symbol, room_symbol)
    )
    return ModeExit(guard, place_of(mode, state, time, work), gaps, rooms)


def place_of(mode: CompiledMode, state: Mapping[Symbol, Any], time: Any, work: Any = 0.0) -> State:
    """A state of a mode as all modes have it; the work as it was before where none is done."""
    own = {s: state[s] for s in mode.dynamics.states if s not in mode.dynamics.carried}
    return mode.lifted(time, own, state.get(WORK, work))


@dataclass(frozen=True)
class Outcome:
    """A stay in a mode, and where it ended.

    Attributes:
        segments: one for every set of sides of absolute values.
        turns: the changes of these.
        leaving: how it ended.
    """

    segments: tuple[Segment, ...]
    turns: tuple[ModeSwitch, ...]
    leaving: ModeExit

    @property
    def segment(self) -> Segment:
        """The last of them."""
        return self.segments[-1]

    @property
    def interrupted(self) -> bool:
        """Whether who listens had enough."""
        return self.segment.parts[-1].solution.stop is Stop.INTERRUPTED


def _settled(guard: Guard | None, time: float, drive: PrescribedMotion) -> bool:
    """Whether what happens where a stretch of the forcing ends is up to that stretch alone.

    Whether a body slips or lifts off there is up to the forces that hold from there on.
    """
    kind = guard.kind if guard is not None else ""
    return kind == "near-flat" or (kind == "sticks" and time not in drive.jerks)


def _chattering(time: float) -> NumericError:
    return NumericError(
        f"more than {_MOST_EVENTS} changes of contact mode up to t = {float(time):.9g} s",
        expected="a motion that settles",
        advice="it chatters: end the motion before that time, or change the friction",
    )

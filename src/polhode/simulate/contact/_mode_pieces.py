"""Integrates a contact mode in pieces: each up to the end of a slip, a guard, or a pause.

`ModePieces` is what all types of numbers share; `DoublePieces` integrates in double precision.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from polhode.algebra import Symbol
from polhode.base import NumericError, Progress
from polhode.derive import Guard
from polhode.simulate._absolute_values import (
    Instant,
    SideChange,
    Sides,
    overshoots,
    shorter_span,
    sides_at,
)
from polhode.simulate._dynamics import WORK, Dynamics
from polhode.simulate._independent_speeds import SpeedWatch
from polhode.simulate._mode_integration import PieceEnd, StateValues
from polhode.simulate._segment import TrajectoryPiece, state_at
from polhode.simulate._turned_piece import TurnedPiece
from polhode.simulate._vanishing_lengths import refuse_lost_stretch, refuse_vanishing
from polhode.simulate.contact._attitude_charts import (
    angles_change,
    as_declared,
    has_left_angles,
    passing_straight,
)
from polhode.simulate.contact._auxiliary_states import (
    edge_distance_symbol,
    gap_symbol,
    slip_symbols,
)
from polhode.simulate.contact._contact_kinematics import State, fall_of
from polhode.simulate.contact._description_changes import speed_change
from polhode.simulate.contact._guard_monitor import GuardMonitor
from polhode.simulate.contact._hybrid_system import CompiledMode, HybridSystem
from polhode.simulate.contact._mode_state import ModeState, beyond, directions_of, state_on
from polhode.simulate.contact._onset_directions import NO_SLIP
from polhode.simulate.contact._slip_onset import slip_onset_piece
from polhode.simulate.contact._transition import ModeExit
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._driver import integrate
from polhode.simulate.integrate._stop_criteria import StepCount, Stop, StopCriteria

#: Slip speed below which a slip has ended, relative to the velocities that cancel in it.
VANISHED = 1e-14
#: The same where the slip velocity reverses within a step: there its rounding is larger, and it
#: passes zero at a small distance instead of vanishing.
REVERSED = 1e-10
# Steps after which the guards are checked. A check resolves every guard into series; steps beyond
# the end of a mode are thrown away.
_PAUSE = 400
_INSTANT = 32  # units in the last place of the time: a shorter hop counts as none
_BEGUN = 1e-9  # of the time: a slip that lasts less than this cannot be resolved in it


def may_be_overshot(guard: Guard | None) -> bool:
    """Whether a step may go far beyond the fall of a guard: a free fall is a single step."""
    return isinstance(guard, SideChange) or (guard is not None and guard.kind == "touches down")


class ModePieces(ABC):
    """Pieces of a motion within one contact mode.

    Args:
        hybrid: the modes.
        entry: where this one is entered.
        near_flat: value at which an expression that must stay positive, such as sin θ, counts as
            zero.

    Attributes:
        start: all states where the mode is entered.
    """

    def __init__(self, hybrid: HybridSystem, entry: ModeState, near_flat: float) -> None:
        self._hybrid = hybrid
        self._entry = entry
        self._near_flat = near_flat
        self._whole = hybrid.mode(entry.phases)
        self.start: StateValues = state_on(hybrid, entry)
        here = self._whole.instant(self.start, entry.shared.time)
        self.put_on(sides_at(self._whole.dynamics, here))
        self._has_begun = False
        self._scale: Any = 0.0

    @property
    def name(self) -> str:
        return self._whole.mode.name

    @property
    def whole(self) -> Dynamics:
        return self._whole.dynamics

    @property
    def dynamics(self) -> Dynamics:
        return self._mode.dynamics

    def put_on(self, sides: Sides) -> None:
        self._mode = self._whole.on(sides)
        self._monitor = GuardMonitor(self._hybrid, self._near_flat, self._mode, self._entry)

    def instant(self, state: StateValues, time: Any) -> Instant:
        self._hybrid.update_forcing(time)
        return self._whole.instant(state, time)

    @abstractmethod
    def stored_time(self, time: Any) -> Any:
        """A time in the numbers in which trajectories keep it."""

    def next(
        self, state: StateValues, now: Any, end: Any, before: TrajectoryPiece | None
    ) -> PieceEnd:
        drive = self._hybrid.drive
        self._hybrid.update_forcing(now)
        limit = drive.until(now, end)
        if self._has_begun:
            found = self._piece(state, (now, limit), before)
        else:
            limit = min(limit, now + max(self._time_to_closing(), self._shortest()))
            first = self._slip_onset if self._entry.onset else self._piece
            found = first(state, (now, limit), before)
        self._has_begun = True
        if now < found.time and found.time in drive.breaks and found.guard is not None:
            # At a knot of the forcing the guards of friction and normal forces are not continuous:
            # whether a contact slips or opens is for the forces after it to decide. The next piece
            # finds out; what ends there for kinematic reasons (lying flat, a slip that vanishes)
            # has ended all the same, unless the support jerks.
            kept = () if found.time in drive.jerks else ("sticks",)
            ends = isinstance(found.guard, SideChange) or found.guard.ends
            if not (ends or found.guard.kind in kept):
                found = replace(found, guard=None)
        interrupted = found.piece.solution.stop is Stop.INTERRUPTED
        return replace(found, is_last=interrupted or found.time in drive.jerks)

    @abstractmethod
    def _slip_onset(
        self, state: StateValues, span: tuple[Any, Any], before: TrajectoryPiece | None
    ) -> PieceEnd:
        """The piece on which slips begin, as far as their directions have to be integrated."""

    @abstractmethod
    def _piece(
        self, state: StateValues, span: tuple[Any, Any], before: TrajectoryPiece | None
    ) -> PieceEnd:
        """Any other piece: up to the first guard that falls, or to the end of a span."""

    # -- the first piece must not leap over a contact that soon closes again ---------------------

    def _shortest(self) -> Any:
        return _INSTANT * self._hybrid.numbers.spacing(self._entry.shared.time)

    def _time_to_closing(self) -> Any:
        """How soon a contact that has opened may close again, or one return to an edge, s.

        A hop that is short compared with the first step would be lost in the rounding of the step.
        The time is that of a parabola with the initial rates, and half as much again.
        """
        entry, mode = self._entry, self._mode
        if not (entry.gaps or entry.edge_distances):
            return np.inf
        rising = list[tuple[Any, Any, Any]]()  # heights or distances, with first and second rates
        state, now = entry.state, entry.shared.time
        points = self._hybrid.touching.at(entry.shared, beyond(entry.phases))
        if entry.gaps:
            directions = directions_of(entry, self._hybrid.numbers)
            falls = mode.closing_rates(state, now, directions)
            rising += [(gap, points[i].velocity[2], falls[i]) for i, gap in entry.gaps.items()]
        if entry.edge_distances:
            second_rates = mode.room_rates(state, now, directions_of(entry, self._hybrid.numbers))
            for i, edge_distance in entry.edge_distances.items():
                is_beyond = entry.phases[i].is_beyond
                rising.append(
                    (edge_distance, points[i].leaving(is_beyond=is_beyond), second_rates[i])
                )
        hops = [fall_of(*rise) for rise in rising if rise[2] < 0]
        return 1.5 * min((hop for hop in hops if hop > 0), default=np.inf)

    # -- used by pieces in all precisions ----------------------------------------------------------

    def speed_scale(self, state: StateValues, now: Any) -> Any:
        """Largest of the terms that have cancelled in slip velocities so far, m/s.

        It only grows: a slip that ends while everything slows down with it must still vanish
        relative to the velocities that its rounding comes from.
        """
        shared = shared_state(self._mode, state, now)
        here = self._hybrid.touching.scale(shared, beyond(self._entry.phases))
        self._scale = max(self._scale, here)
        return self._scale

    @property
    def fastest(self) -> Any:
        """The largest of these terms in the modes so far, whose rounding is carried on, m/s."""
        return self._scale

    def slips_in(self, symbols: Sequence[Symbol]) -> tuple[tuple[int, ...], ...]:
        """Places of slip velocities among some states, for the slips that are integrated there."""
        contacts = self._hybrid.automaton.contacts
        pairs = [slip_symbols(contacts[i]) for i in sorted(self._entry.slips)]
        auxiliary = [pair for pair in pairs if set(pair) <= set(symbols)]
        return tuple(tuple(symbols.index(s) for s in pair) for pair in auxiliary)

    def exit(self, found: PieceEnd) -> ModeExit:
        """How the mode is left."""
        work = self._entry.shared.work
        leaving = mode_exit(self._mode, found.guard, found.state, found.time, work)
        return replace(leaving, still=self._still(leaving.shared))

    def _still(self, shared: State) -> frozenset[int]:
        """The contacts whose slip has ended: a body that turns as it slides stops at all at once.

        What counts as none is measured by the speeds that there were: those at the end of a slip
        are themselves only rounding.
        """
        points = self._hybrid.touching.at(shared, beyond(self._entry.phases))
        least = self._hybrid.numbers.finer(NO_SLIP) * self.fastest
        size = self._hybrid.numbers.size
        return frozenset(i for i in self._entry.slips if size(points[i].velocity[:2]) <= least)


class DoublePieces(ModePieces):
    """Pieces in double precision.

    Args:
        hybrid, entry, near_flat: as in `ModePieces`.
        progress: notified of every step.
        tally: of the steps of the whole motion.
        before: the pieces of the mode before, if there was one.
    """

    def __init__(
        self,
        hybrid: HybridSystem,
        entry: ModeState,
        near_flat: float,
        progress: Progress,
        tally: StepCount,
        before: DoublePieces | None,
    ) -> None:
        super().__init__(hybrid, entry, near_flat)
        self._fastest_before = before.fastest if before is not None else 0.0
        self._progress = progress
        self._tally = tally
        self._watch = SpeedWatch(self._whole.dependence) if hybrid.speeds else None

    def stored_time(self, time: float) -> float:
        return time

    @property
    def fastest(self) -> float:
        return max(self._fastest_before, float(self._scale))

    @property
    def dynamics(self) -> Dynamics:
        hybrid = self._hybrid
        return hybrid.dynamics_in((), self._entry.phases) if hybrid.chart else super().dynamics

    def next(
        self, state: StateValues, now: float, end: float, before: TrajectoryPiece | None
    ) -> PieceEnd:
        own = before.turned if isinstance(before, TurnedPiece) else before
        found = super().next(state, now, end, own)
        if not self._hybrid.chart:
            return found
        return replace(found, piece=as_declared(self._hybrid, self._mode, found.piece))

    def _shortest(self) -> float:
        begin = self._entry.shared.time
        return _BEGUN * begin if self._entry.onset else float(super()._shortest())

    def _slip_onset(
        self, state: StateValues, span: tuple[float, float], before: TrajectoryPiece | None
    ) -> PieceEnd:
        contacts = self._hybrid.automaton.contacts
        piece = slip_onset_piece(self._mode, self._entry, state, span, contacts)
        return _piece_end(*self._monitor.cut(piece))

    def _piece(
        self, state: StateValues, span: tuple[float, float], before: TrajectoryPiece | None
    ) -> PieceEnd:
        now = span[0]
        rest = before.solution.rest(now) if before else self._mode.rest(state, now)
        scale = self.speed_scale(state, now) if self._entry.slips else 0.0
        criteria = self._criteria(scale or 1.0, self._straight(state, now))
        return _piece_end(*self._up_to(rest, span, criteria))

    def _up_to(
        self, rest: Array, span: tuple[float, float], criteria: StopCriteria
    ) -> tuple[TrajectoryPiece, Guard | None]:
        """Up to the end of a span, or to the first guard that falls."""
        flow, constants = self._mode.flow, self._mode.parameters
        solution = integrate(
            flow, self._mode.stepper, constants, rest, span, self._progress, criteria
        )
        whole = TrajectoryPiece(span[0], float(solution.steps[-1]), solution, constants)
        try:
            regular, speeds = self._watch.regular_part(whole) if self._watch else (whole, None)
            piece, guard = self._monitor.cut(regular)
        except NumericError:
            refuse_lost_stretch(self._mode.dynamics, whole)  # if that is the reason
            raise
        if guard is None:
            there = state_at(piece, piece.end)
            straight = self._straight(there, piece.end)
            guard = angles_change(self._hybrid, there, straight)
            if guard is None and speeds is not None:
                guard = speed_change(self._hybrid, self._entry.phases, there, piece.end)
        again = shorter_span(solution.steps, piece.end) if may_be_overshot(guard) else None
        if again is not None:
            return self._up_to(rest, (span[0], again), criteria)
        refuse_vanishing(self._mode.dynamics, piece)
        return piece, guard

    def _straight(self, state: StateValues, now: float) -> frozenset[int]:
        return passing_straight(self._hybrid, self._mode, self._mode.instant(state, now))

    def _criteria(self, scale: float, straight: frozenset[int]) -> StopCriteria:
        """What stops an integration: slips that end, too many steps, or a guard to check.

        Args:
            scale: of the terms that cancel in slips, m/s.
            straight: attitudes that pass straight through gimbal lock.
        """
        mode, near_flat = self._mode, self._near_flat
        core, checks = mode.flow.core.symbols, list[Callable[[float, Sequence[float]], bool]]()
        if self._watch and (check := self._watch.overshoot(core, mode.parameters)):
            checks.append(check)
        if check := has_left_angles(self._hybrid, core, straight):
            checks.append(check)
        if not (mode.mode.guards or mode.side_guards or checks or self._watch):
            return StopCriteria(tally=self._tally)
        # Where a disk is beyond flat, or an absolute value beyond the end of its side, the
        # equations do not hold, and going on with them may take any number of steps.
        if mode.watched_sides:
            positive, constants = mode.sides, mode.parameters.tolist()
            checks.append(lambda time, state: min(positive(*state, *constants, time)) < near_flat)
        if mode.side_guards:
            checks.append(overshoots(mode.dynamics, mode.side_guards, mode.flow, mode.parameters))

        def over(time: float, state: Sequence[float]) -> bool:
            return any(check(time, state) for check in checks)

        vectors = self.slips_in(core)
        return StopCriteria(_PAUSE, vectors, VANISHED * scale, REVERSED * scale, over, self._tally)


def double_pieces(
    hybrid: HybridSystem, near_flat: float, progress: Progress
) -> Callable[[ModeState], DoublePieces]:
    """A function that makes the pieces of each mode a motion enters, in double precision."""
    tally, last = StepCount(), list[DoublePieces]()

    def pieces(entry: ModeState) -> DoublePieces:
        before = last.pop() if last else None
        last.append(DoublePieces(hybrid, entry, near_flat, progress, tally, before))
        return last[-1]

    return pieces


def _piece_end(piece: TrajectoryPiece, guard: Guard | None) -> PieceEnd:
    return PieceEnd(piece, state_at(piece, piece.end), piece.end, guard)


def mode_exit(
    mode: CompiledMode,
    guard: Guard | None,
    state: StateValues,
    time: Any,
    work: Any,
) -> ModeExit:
    """How a mode is left from one of its states; `work` is used if that state has none."""
    contacts = [touch.contact for touch in mode.mode.touches]
    gaps, edge_distances = (
        {i: state[s] for i, contact in enumerate(contacts) if (s := symbol(contact)) in state}
        for symbol in (gap_symbol, edge_distance_symbol)
    )
    return ModeExit(guard, shared_state(mode, state, time, work), gaps, edge_distances)


def shared_state(mode: CompiledMode, state: StateValues, time: Any, work: Any = 0.0) -> State:
    """The shared state of a state of one mode; `work` is used if that state has none."""
    own = {s: state[s] for s in mode.dynamics.states if s not in mode.dynamics.auxiliary}
    return mode.embedding(time, own, state.get(WORK, work))

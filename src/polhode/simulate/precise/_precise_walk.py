"""The course of a motion through its contact modes, in numbers of higher precision."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from polhode.base import Progress
from polhode.derive import Guard
from polhode.simulate._absolute_values import (
    SideChange,
    nearer,
    refuse_vanishing,
    sides_at,
    told_change,
)
from polhode.simulate._event import ModeSwitch
from polhode.simulate._segment import Segment, TrajectoryPiece
from polhode.simulate.contact._carried import slip_symbols
from polhode.simulate.contact._guard_monitor import GuardMonitor
from polhode.simulate.contact._hybrid_integrator import (
    LANDED,
    VANISHED,
    HybridIntegrator,
    Outcome,
    leaving,
    place_of,
)
from polhode.simulate.contact._hybrid_system import CompiledMode, HybridSystem
from polhode.simulate.contact._mode_state import ModeState, state_on
from polhode.simulate.integrate._stop_criteria import Stop, StopCriteria
from polhode.simulate.precise._first_slip import first_slip
from polhode.simulate.precise._landing import PiecePoint, fallen, landing
from polhode.simulate.precise._precise_piece import (
    InDoubles,
    PieceIntegrator,
    PrecisePiece,
    StateValues,
)

_LOOK = 12  # steps after which the guards are looked at
_INSTANT = 32  # steps of rounding of the time: a hop that is over sooner is none


@dataclass(frozen=True)
class _Cut:
    """A stretch up to where its contact mode ends, or to its own end."""

    part: TrajectoryPiece
    state: StateValues
    time: Any
    guard: Guard | None


class PreciseWalk(HybridIntegrator):
    """Follows a motion from mode to mode.

    Args:
        machine: the modes, in numbers with bits to spare.
        steps: what integrates them.
        near_flat: value at which an expression that must stay positive counts as gone.
        progress: told of every step.
        until: what, once it happens, ends the motion.
    """

    def __init__(
        self,
        machine: HybridSystem,
        steps: PieceIntegrator,
        near_flat: float,
        progress: Progress,
        until: frozenset[str],
    ) -> None:
        super().__init__(machine, near_flat, progress, until)
        self._steps = steps

    def stay(self, entry: ModeState, end: Any) -> Outcome:
        """As long as the mode lasts."""
        machine = self._machine
        whole = machine.mode(entry.phases)
        begin = now = since = entry.place.time
        state: StateValues = state_on(machine, entry)
        mode = whole.on(sides_at(whole.dynamics, whole.here(state, now)))
        lookout = GuardMonitor(machine, self._near_flat, mode, entry)
        parts = list[TrajectoryPiece]()
        before, turns = list[Segment](), list[ModeSwitch]()
        guard, stop = None, Stop.PAUSE
        shortest = _INSTANT * machine.numbers.spacing(begin)
        limit = min(end, begin + max(self.hop(mode, entry), shortest))
        while guard is None and now < end and stop is not Stop.INTERRUPTED:
            if entry.onset and not (parts or before):
                watched = self._watched_in(mode, entry, state, now)
                contacts = machine.automaton.contacts
                stretch = first_slip(mode, entry, state, limit, contacts, self._steps.numbers)
                cut = self._cut(lookout, stretch, watched)
            else:
                stretch, cut = self._next(lookout, state, (now, limit), begin)
            parts.append(cut.part)
            state, now, guard, stop = cut.state, cut.time, cut.guard, stretch.stop
            limit = end
            if isinstance(guard, SideChange):
                sides = self._turned(whole, mode, state, now, guard)
                if sides != mode.dynamics.sides:
                    kind, name = told_change(guard, sides), mode.mode.name
                    turns.append(ModeSwitch(self._steps.numbers.array([now])[0], kind, name, name))
                before.append(self._segment(mode, since, now, parts))
                since, parts, guard = now, [], None
                mode = whole.on(sides)
                lookout = replace(lookout, mode=mode)
        if parts:
            before.append(self._segment(mode, since, now, parts))
        there = leaving(mode, guard, state, now, entry.place.work)
        return Outcome(tuple(before), tuple(turns), there)

    def _segment(
        self, mode: CompiledMode, begin: Any, end: Any, parts: Sequence[TrajectoryPiece]
    ) -> Segment:
        ends = self._steps.numbers.array([begin, end])
        return Segment(mode.mode.name, ends[0], ends[1], mode.dynamics, tuple(parts))

    def _next(
        self, lookout: GuardMonitor, state: StateValues, span: tuple[Any, Any], begin: Any
    ) -> tuple[PrecisePiece, _Cut]:
        """Up to the end of a span, or to the first guard that falls."""
        watched = self._watched_in(lookout.mode, lookout.entry, state, span[0])
        stretch = self._steps.along(lookout.mode, state, span, watched, begin)
        cut = self._cut(lookout, stretch, watched)
        again = None
        if isinstance(cut.guard, SideChange):
            again = nearer(stretch.series.times, cut.part.end, self._steps.numbers)
        if again is not None:
            limit = self._machine.numbers.array([again])[0]
            return self._next(lookout, state, (span[0], limit), begin)
        refuse_vanishing(lookout.mode.dynamics, cut.part.rounded())
        return stretch, cut

    def _watched_in(
        self, mode: CompiledMode, entry: ModeState, state: StateValues, now: Any
    ) -> StopCriteria:
        """What to look at from a state on."""
        symbols = self._steps.symbols(mode.dynamics)
        contacts = self._machine.automaton.contacts
        pairs = [slip_symbols(contacts[i]) for i in sorted(entry.slips)]
        carried = [pair for pair in pairs if set(pair) <= set(symbols)]
        places = tuple(tuple(symbols.index(s) for s in pair) for pair in carried)
        scale = self.scale_at(place_of(mode, state, now), entry) or 1 if pairs else 1
        finer = self._steps.numbers.finer
        least, passing = finer(VANISHED) * scale, finer(LANDED) * scale
        return StopCriteria(_LOOK, places, float(least), float(passing), tally=self._tally)

    def _cut(self, lookout: GuardMonitor, stretch: PrecisePiece, watched: StopCriteria) -> _Cut:
        """A stretch up to the first guard that falls."""
        landed = landing(stretch, watched)
        seen = InDoubles(stretch)
        fall = lookout.first_fall(seen)
        spot, guard = PiecePoint(stretch.series.steps - 1, 1), None
        if landed is not None:
            spot, guard = landed[0], lookout.landing(landed[1])
        if fall is not None and fall[0] < spot.step + float(spot.share):
            guard = fall[1]
            spot = fallen(lookout.mode.dynamics, lookout.looked_at(guard), stretch, fall[0])
        if guard is None and stretch.stop is Stop.STUCK:
            raise lookout.broken(seen)
        time = stretch.series.time(spot.step, spot.share)
        careful = self._machine.numbers
        state = stretch.state(spot.step, spot.share, careful)
        return _Cut(stretch.part(time), state, careful.array([time])[0], guard)

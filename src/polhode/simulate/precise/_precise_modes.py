"""Integrates a contact mode in numbers of higher precision."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

import numpy as np

from polhode.base import NumericError
from polhode.simulate._absolute_values import shorter_span
from polhode.simulate._dynamics import CLOCK
from polhode.simulate._mode_integration import PieceEnd, StateValues
from polhode.simulate._segment import TrajectoryPiece
from polhode.simulate._vanishing_lengths import refuse_vanishing
from polhode.simulate.contact._description_changes import SpeedChange
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._mode_expressions import vanishing_expression
from polhode.simulate.contact._mode_pieces import REVERSED, VANISHED, ModePieces, may_be_overshot
from polhode.simulate.contact._mode_state import ModeState
from polhode.simulate.contact._open_forces import GivesWay
from polhode.simulate.contact._slip_onset import polar_shape
from polhode.simulate.integrate._flint import SlipSeries
from polhode.simulate.integrate._stop_criteria import StepCount, Stop, StopCriteria
from polhode.simulate.precise._precise_piece import (
    InDoubles,
    PiecePoint,
    SeriesPiece,
    SeriesStepper,
    refined_crossing,
    slip_end,
)

_PAUSE = 12  # steps after which the guards are checked; they are long, and cost much


class PrecisePieces(ModePieces):
    """Pieces in higher precision.

    Args:
        hybrid: the modes, in numbers with spare bits.
        entry, near_flat: as in `ModePieces`.
        steps: integrates them.
        tally: of the steps of the whole motion.
        changes: of the independent speeds that are still to come, with their times.
    """

    def __init__(
        self,
        hybrid: HybridSystem,
        entry: ModeState,
        near_flat: float,
        steps: SeriesStepper,
        tally: StepCount,
        changes: deque[tuple[Any, SpeedChange]],
    ) -> None:
        super().__init__(hybrid, entry, near_flat)
        self._steps = steps
        self._tally = tally
        self._changes = changes

    def stored_time(self, time: Any) -> Any:
        return self._steps.numbers.array([time])[0]

    def next(
        self, state: StateValues, now: Any, end: Any, before: TrajectoryPiece | None
    ) -> PieceEnd:
        if not self._changes:
            return super().next(state, now, end, before)
        # A change may have been due where a contact changed: then it is made after the next piece.
        time, change = self._changes[0]
        found = super().next(state, now, min(end, time) if now < time else end, before)
        if found.guard is None and not found.is_last and time <= found.time < end:
            self._changes.popleft()
            return replace(found, guard=change)
        return found

    def _piece(
        self, state: StateValues, span: tuple[Any, Any], before: TrajectoryPiece | None
    ) -> PieceEnd:
        criteria = self._criteria(state, span[0])
        piece = self._steps.along(self._mode, state, span, criteria)
        found = self._cut(piece, criteria)
        again = None
        if may_be_overshot(found.guard):
            again = shorter_span(piece.series.times, found.piece.end, self._steps.numbers)
        if again is not None:
            limit = self._hybrid.numbers.array([again])[0]
            return self._piece(state, (span[0], limit), before)
        refuse_vanishing(self._mode.dynamics, found.piece.rounded())
        return found

    def _slip_onset(
        self, state: StateValues, span: tuple[Any, Any], before: TrajectoryPiece | None
    ) -> PieceEnd:
        """The piece over which a power series about the first instant of slip converges."""
        mode, entry, numbers = self._mode, self._entry, self._steps.numbers
        contacts = self._hybrid.automaton.contacts
        shape = polar_shape(mode, entry, contacts)
        others = (*mode.dynamics.parameters, CLOCK)
        program = mode.dynamics.program(shape.wanted, (*shape.symbols, *shape.given, *others))
        constants, begin = mode.parameters.tolist(), entry.shared.time
        start = [state[s] for s in shape.symbols]
        angles = [entry.onset[i] for i in shape.starting]
        series = SlipSeries(
            program, others, numbers, constants, start, angles, begin, span[1]
        ).series()
        if series is None:
            names = ", ".join(contacts[i].name for i in shape.starting)
            raise NumericError(
                f"slip that begins at {names} at t = {float(begin):.9g} s cannot be followed in "
                f"{numbers.name} precision",
                expected="a direction in which it grows steadily",
                advice="compute the motion in doubles, or end it before that time",
            )
        piece = SeriesPiece.of((*shape.symbols, *shape.polars), series, constants, Stop.PAUSE)
        return self._cut(piece, self._criteria(state, begin))

    def _criteria(self, state: StateValues, now: Any) -> StopCriteria:
        """What stops an integration: slips that end, too many steps, or a pause for checks."""
        vectors = self.slips_in(self._steps.symbols(self._mode.dynamics))
        scale = self.speed_scale(state, now) or 1 if self._entry.slips else 1
        finer = self._steps.numbers.finer
        least, passing = finer(VANISHED) * scale, finer(REVERSED) * scale
        return StopCriteria(_PAUSE, vectors, float(least), float(passing), tally=self._tally)

    def _cut(self, piece: SeriesPiece, criteria: StopCriteria) -> PieceEnd:
        """A piece up to the first guard that falls."""
        # The end of slip is known to all digits, the fall of a guard in double precision so far:
        # whichever comes first is the event.
        ended_slip = slip_end(piece, criteria)
        seen = InDoubles(piece, self._entry.shared.time)
        fall = self._monitor.first_fall(seen)
        point, guard = PiecePoint(piece.series.steps - 1, 1), None
        if ended_slip is not None:
            point, guard = ended_slip[0], self._monitor.sticking_guard(ended_slip[1])
        if fall is not None and fall[0] < point.step + float(point.share):
            guard = fall[1]
            if isinstance(guard, GivesWay):
                (time,) = seen.times(np.array([fall[0]]))
                raise NumericError(
                    f"contacts whose forces are open give way at t = {float(time):.9g} s",
                    expected="double precision, in which that instant is found",
                    advice="leave out precision for this motion",
                )
            positive = vanishing_expression(guard, self._monitor.near_flat)
            point = refined_crossing(self._mode.dynamics, positive, piece, fall[0])
        if guard is None and piece.solution.stop is Stop.STUCK:
            raise self._monitor.broken(seen)
        time = piece.series.time(point.step, point.share)
        careful = self._hybrid.numbers
        state = piece.state(point, careful)
        return PieceEnd(replace(piece, end=time), state, careful.array([time])[0], guard)


def precise_pieces(
    hybrid: HybridSystem,
    near_flat: float,
    steps: SeriesStepper,
    changes: Iterable[tuple[float, SpeedChange]],
) -> Callable[[ModeState], PrecisePieces]:
    """A function that makes the pieces of each mode a motion enters.

    Args:
        changes: of the independent speeds in doubles: any place nearby does as well.
    """
    tally, careful = StepCount(), hybrid.numbers.array
    left = deque((careful([time])[0], change) for time, change in changes)
    return lambda entry: PrecisePieces(hybrid, entry, near_flat, steps, tally, left)

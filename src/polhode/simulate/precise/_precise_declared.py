"""Motions whose contacts stay as declared, in numbers of higher precision."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from polhode.simulate._absolute_values import (
    Instant,
    SideChange,
    SideChangeCount,
    Sides,
    first_end_of_side,
    guards_of_sides,
    shorter_span,
    sides_at,
)
from polhode.simulate._dynamics import CLOCK, WORK, Dynamics
from polhode.simulate._gimbal_lock import broken_at
from polhode.simulate._mode_integration import PieceEnd, StateValues, integrate_mode
from polhode.simulate._segment import Segment, TrajectoryPiece
from polhode.simulate._task import AS_DECLARED
from polhode.simulate._vanishing_lengths import refuse_vanishing
from polhode.simulate.contact._hybrid_integrator import HybridSolution
from polhode.simulate.integrate._arrays import Array, rows
from polhode.simulate.integrate._stop_criteria import Stop, StopCriteria
from polhode.simulate.precise._precise_piece import (
    InDoubles,
    PiecePoint,
    SeriesPiece,
    SeriesStepper,
    refined_crossing,
)
from polhode.simulate.precise._precise_start import Given

# Steps after which the guards of absolute values are checked: fewer than in double precision, since
# a step is long and costs much.
_PAUSE = 12


def as_declared(
    dynamics: Dynamics, given: Given, steps: SeriesStepper, rough: Sequence[Segment]
) -> HybridSolution:
    """Integrate a motion whose contacts stay as they are declared.

    Other speeds become independent where they do in doubles: any place nearby does as well.

    Args:
        dynamics: of which no sides of absolute values are known.
        rough: the segments of the motion in doubles.

    Raises:
        NumericError: where the motion cannot be continued.
    """
    careful, begin = steps.numbers.careful, given.context.mpf(0)
    state: StateValues = given.state(dynamics.states) | {WORK: begin}
    changes = [
        _SpeedChange(careful.array([after.begin])[0], replace(after.dynamics, sides={}))
        for before, after in pairwise(rough)
        if after.dynamics.equations is not before.dynamics.equations
    ]
    pieces = _PreciseDeclaredPieces(dynamics, given, steps, changes)
    pieces.put_on(sides_at(dynamics, pieces.instant(state, begin)))
    run = integrate_mode(pieces, state, begin, steps.end, SideChangeCount())
    return HybridSolution(run.segments, run.switches, AS_DECLARED)


@dataclass(frozen=True)
class _Equations:
    """The equations on some sides of all absolute values, with numbers."""

    dynamics: Dynamics
    parameters: Any


@dataclass(frozen=True)
class _SpeedChange:
    """When other speeds become independent, s, and the equations from then on."""

    time: Any
    whole: Dynamics


class _PreciseDeclaredPieces:
    """Pieces of such a motion."""

    name = AS_DECLARED

    def __init__(
        self,
        whole: Dynamics,
        given: Given,
        steps: SeriesStepper,
        changes: Sequence[_SpeedChange],
    ) -> None:
        self._given = given
        self._steps = steps
        self._changes = list(changes)
        self._take(whole)
        self.dynamics = whole

    def _take(self, whole: Dynamics) -> None:
        """Go on with the equations on other independent speeds."""
        self.whole = whole
        careful = self._steps.numbers.careful
        self._constants = careful.array([self._given.parameters[s] for s in whole.parameters])

    def put_on(self, sides: Sides) -> None:
        self.dynamics = self.whole.on(sides)

    def instant(self, state: StateValues, time: Any) -> Instant:
        return Instant(state, self._constants, time, self._steps.numbers.careful)

    def stored_time(self, time: Any) -> Any:
        return self._steps.numbers.array([time])[0]

    def next(
        self, state: StateValues, now: Any, end: Any, before: TrajectoryPiece | None
    ) -> PieceEnd:
        side_guards, careful = guards_of_sides(self.dynamics), self._steps.numbers.careful
        criteria = StopCriteria(pause=_PAUSE) if side_guards else StopCriteria()
        equations = _Equations(self.dynamics, self._constants)
        until = min([end, *(change.time for change in self._changes[:1])])
        piece = self._steps.along(equations, state, (now, until), criteria)
        found = _first_side_end(self.dynamics, side_guards, piece)
        stop = piece.solution.stop
        if found is None:
            point, time, change = PiecePoint(piece.series.steps - 1, 1), piece.end, None
            if stop is Stop.STUCK:
                last = piece.state(point, careful)
                raise broken_at(self.dynamics.equations, last, float(time))
        else:
            point, change = found
            time = piece.series.time(point.step, point.share)
            again = shorter_span(piece.series.times, time, self._steps.numbers)
            if again is not None:
                return self.next(state, now, careful.array([again])[0], before)
        cut = replace(piece, end=time)
        refuse_vanishing(self.dynamics, cut.rounded())
        there: StateValues = cut.state(point, careful)
        then = careful.array([time])[0]
        if change is None and until < end and piece.end >= self.stored_time(until):
            there = self._on_other_speeds(there, then)
        return PieceEnd(cut, there, then, change, is_last=stop is Stop.INTERRUPTED)

    def _on_other_speeds(self, state: StateValues, time: Any) -> StateValues:
        """Go on with other independent speeds: the state in terms of these."""
        before, here = self.whole, self.instant(state, time)
        self._take(self._changes.pop(0).whole)
        there = here.on_other_speeds(before, self.whole)
        self.put_on(sides_at(self.whole, self.instant(there, time)))
        return there


def _first_side_end(
    dynamics: Dynamics, side_guards: Sequence[SideChange], piece: SeriesPiece
) -> tuple[PiecePoint, SideChange] | None:
    """Where the first side ends, and the guard that falls there; None if none ends."""
    if not side_guards:
        return None
    seen = InDoubles(piece, piece.begin)
    arguments = (*seen.symbols, *dynamics.parameters, CLOCK)
    function = dynamics.function([change.positive for change in side_guards], arguments)

    def values(places: Array) -> Array:
        found = function(*seen.at(places), *seen.constants, seen.times(places))
        return np.asarray(rows(found, len(places)))

    fall = first_end_of_side(values, seen.knots)
    if fall is None:
        return None
    change = side_guards[fall.guard]
    return refined_crossing(dynamics, change.positive, piece, fall.time), change

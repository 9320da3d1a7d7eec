"""A motion within one contact mode, as it is declared, in numbers of higher precision."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from polhode.simulate._absolute_values import (
    Here,
    SideChange,
    SideChangeCount,
    beyond,
    from_zero,
    nearer,
    passages_of,
    refuse_vanishing,
    sides_at,
    told_change,
)
from polhode.simulate._dynamics import CLOCK, WORK, Dynamics
from polhode.simulate._event import ModeSwitch
from polhode.simulate._segment import Segment, TrajectoryPiece
from polhode.simulate._task import AS_DECLARED
from polhode.simulate.contact._hybrid_integrator import HybridSolution
from polhode.simulate.integrate._arrays import Array, rows
from polhode.simulate.integrate._crossing import first_fall
from polhode.simulate.integrate._stepping import broken
from polhode.simulate.integrate._stop_criteria import Stop, StopCriteria
from polhode.simulate.precise._given import Given
from polhode.simulate.precise._landing import PiecePoint, fallen
from polhode.simulate.precise._precise_piece import (
    InDoubles,
    PieceIntegrator,
    PrecisePiece,
    StateValues,
)

_LOOK = 12  # steps after which absolute values are looked at


@dataclass(frozen=True)
class _Declared:
    """The equations of the contacts as they are declared, with numbers."""

    dynamics: Dynamics
    parameters: Any


@dataclass(frozen=True)
class _DeclaredCut:
    """A stretch up to the end of a side, or to its own."""

    part: TrajectoryPiece
    state: StateValues
    time: Any
    stop: Stop
    passage: SideChange | None


def as_declared(dynamics: Dynamics, given: Given, steps: PieceIntegrator) -> HybridSolution:
    """The contacts as they are declared, and kept to.

    Args:
        dynamics: of which no sides of absolute values are known.

    Raises:
        NumericError: where the motion cannot be continued.
    """
    numbers, careful = steps.numbers, steps.numbers.careful
    constants = careful.array([given.parameters[s] for s in dynamics.parameters])
    now = given.context.mpf(0)
    state: StateValues = given.state(dynamics.states) | {WORK: now}
    face = dynamics.on(sides_at(dynamics, Here(state, constants, now, careful)))
    segments, changes, turns = list[Segment](), list[ModeSwitch](), SideChangeCount()
    parts, stop = list[TrajectoryPiece](), Stop.TIME
    while now < steps.end and stop is not Stop.INTERRUPTED:
        cut = _along(_Declared(face, constants), state, (now, steps.end), steps)
        parts.append(cut.part)
        state, now, stop = cut.state, cut.time, cut.stop
        if cut.passage is None:
            continue
        turns.count(now, cut.passage)
        segments.append(_segment(face, parts))
        parts = []
        here = Here(state, constants, now, careful)
        sides = beyond(dynamics, here, face.sides, cut.passage)
        if sides != face.sides:
            time, kind = numbers.array([now])[0], told_change(cut.passage, sides)
            changes.append(ModeSwitch(time, kind, AS_DECLARED, AS_DECLARED))
        face = dynamics.on(sides)
    if parts:
        segments.append(_segment(face, parts))
    return HybridSolution(tuple(segments), tuple(changes), AS_DECLARED)


def _segment(face: Dynamics, parts: list[TrajectoryPiece]) -> Segment:
    return Segment(AS_DECLARED, parts[0].begin, parts[-1].end, face, tuple(parts))


def _along(
    moving: _Declared, state: StateValues, span: tuple[Any, Any], steps: PieceIntegrator
) -> _DeclaredCut:
    """Up to the end of a span, or of a side."""
    passages, careful = passages_of(moving.dynamics), steps.numbers.careful
    watched = StopCriteria(pause=_LOOK) if passages else StopCriteria()
    stretch = steps.along(moving, state, span, watched, span[0])
    found = _passed(moving.dynamics, passages, stretch)
    if found is None:
        if stretch.stop is Stop.STUCK:
            raise broken(float(stretch.series.times[-1]))
        spot, time, passage = (
            PiecePoint(stretch.series.steps - 1, 1),
            stretch.series.times[-1],
            None,
        )
    else:
        spot, passage = found
        time = stretch.series.time(spot.step, spot.share)
        again = nearer(stretch.series.times, time, steps.numbers)
        if again is not None:
            return _along(moving, state, (span[0], careful.array([again])[0]), steps)
    part = stretch.part(time)
    refuse_vanishing(moving.dynamics, part.rounded())
    there = stretch.state(spot.step, spot.share, careful)
    return _DeclaredCut(part, there, careful.array([time])[0], stretch.stop, passage)


def _passed(
    dynamics: Dynamics, passages: Sequence[SideChange], stretch: PrecisePiece
) -> tuple[PiecePoint, SideChange] | None:
    """Where the first side ends, and which."""
    if not passages:
        return None
    seen = InDoubles(stretch)
    arguments = (*seen.symbols, *dynamics.parameters, CLOCK)
    function = dynamics.function([passage.positive for passage in passages], arguments)

    def values(places: Array) -> Array:
        found = function(*seen.at(places), *seen.constants, seen.times(places))
        return np.asarray(rows(found, len(places)))

    fall = first_fall(from_zero(values, seen.knots), seen.knots)
    if fall is None:
        return None
    passage = passages[fall.guard]
    return fallen(dynamics, passage.positive, stretch, fall.time), passage

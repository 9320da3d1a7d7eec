"""A motion computed again in numbers of higher precision, along the one in doubles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from polhode.algebra import Expr
from polhode.base import DeclarationError, Progress
from polhode.simulate._absolute_values import (
    Here,
    SideChange,
    SideChangeCount,
    beyond,
    from_zero,
    nearer,
    passages_of,
    sides_at,
    told_change,
)
from polhode.simulate._dynamics import CLOCK, WORK, Dynamics
from polhode.simulate._event import Event, ModeSwitch, events_of, placed
from polhode.simulate._lengths import refuse_vanishing
from polhode.simulate._segment import Segment, TrajectoryPiece
from polhode.simulate._task import AS_DECLARED, Guarded, MotionResult, Task
from polhode.simulate._trajectory import Trajectory
from polhode.simulate._watching import passages
from polhode.simulate.contact._hybrid_integrator import HybridSolution
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._initial_mode import begun_at
from polhode.simulate.contact._state import State
from polhode.simulate.forcing._pieces import Pieces
from polhode.simulate.integrate._crossing import first_fall
from polhode.simulate.integrate._number_types import NumberType
from polhode.simulate.integrate._rows import rows
from polhode.simulate.integrate._series import SeriesIntegrator
from polhode.simulate.integrate._stepping import Array, broken
from polhode.simulate.integrate._stop_criteria import Stop, StopCriteria
from polhode.simulate.precise._landing import PiecePoint, fallen
from polhode.simulate.precise._precise_piece import (
    InDoubles,
    PieceIntegrator,
    PrecisePiece,
    StateValues,
)
from polhode.simulate.precise._precise_start import Given, evaluated, read_exactly
from polhode.simulate.precise._precise_walk import PreciseWalk
from polhode.simulate.precise._wanted import Wanted

# -- equations of one contact mode, kept to as declared --------------------------------------------

_LOOK = 12  # steps between checks of the signs of absolute values


@dataclass(frozen=True)
class _Declared:
    """The equations of the contacts as declared, with the values of their parameters."""

    dynamics: Dynamics
    parameters: Any


@dataclass(frozen=True)
class _DeclaredCut:
    """A stretch up to a sign change of an absolute value, or to the end."""

    part: TrajectoryPiece
    state: StateValues
    time: Any
    stop: Stop
    passage: SideChange | None


def as_declared(dynamics: Dynamics, given: Given, steps: PieceIntegrator) -> HybridSolution:
    """The motion with the contacts as declared, without looking for mode changes.

    Args:
        dynamics: with the signs of absolute values not yet decided.

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
    """Integrate to the end of a span, or to the first sign change of an absolute value."""
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
    """Where the first sign changes, and which."""
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


def precisely(
    rough: Trajectory, motion: MotionResult, task: Task, wanted: Wanted, progress: Progress
) -> Trajectory:
    """The motion in numbers of higher precision.

    Args:
        rough: the motion in doubles.
        motion: the parts it was made of.
        task: parameters and start, as given.
        wanted: the precision, duration, samples and events requested.

    Raises:
        DeclarationError: for prescribed motions that are known only in double precision.
        NumericError: where the motion cannot be continued.
    """
    numbers = wanted.numbers
    _refuse_samples(task.forcing, numbers)
    known = {*motion.begun.dynamics.parameters, *motion.segments[0].dynamics.parameters}
    given = read_exactly(motion.begun, known, task, numbers)
    (duration,) = evaluated([wanted.duration.exact()], {}, numbers.exact)
    end = numbers.array([duration])[0]
    steps = PieceIntegrator(_integrator(task.integrator.name), numbers, end, progress)
    if motion.guarded is None:
        course = as_declared(motion.begun.dynamics, given, steps)
        # Start, end and sign changes are those found now, other events those seen in doubles.
        first, *turns, last = events_of(course)
        seen = [e for e in rough.events[1:-1] if not e.divides and e.time < last.time]
        between = sorted([*turns, *placed(seen, course.segments)], key=lambda event: event.time)
        events = (first, *between, last)
    else:
        course = _through_modes(motion.guarded, given, steps, task, progress)
        events = events_of(course)
    end = course.segments[-1].end
    run = replace(
        rough,
        segments=course.segments,
        duration=end,
        t=_samples(wanted, duration, end),
        mode=course.ending,
        integrator=steps.name,
        events=events,
    )
    return _with_events(run, wanted.events)


def _refuse_samples(forcing: Mapping[Any, Any], numbers: NumberType) -> None:
    for name, given in forcing.items():
        if isinstance(given, Pieces) or (callable(given) and not isinstance(given, Expr)):
            raise DeclarationError(
                f"the motion {name}, known only in double precision, in {numbers.name} precision",
                expected="an expression of time for every prescribed function",
                advice="write it with polhode.time instead of samples or a Python function",
            )


def _integrator(name: str) -> SeriesIntegrator:
    if name == "heyoka":
        from polhode.simulate.integrate._heyoka_series import TaylorSeries

        return TaylorSeries()
    from polhode.simulate.integrate._flint import PowerSeries

    return PowerSeries()


# -- through contact modes ---------------------------------------------------------------------


def _through_modes(
    guarded: Guarded, given: Given, steps: PieceIntegrator, task: Task, progress: Progress
) -> HybridSolution:
    """The motion through all contact modes, as the forces demand."""
    rough, numbers = guarded.machine, steps.numbers.careful
    hybrid = HybridSystem(
        rough.automaton, rough.drive, given.parameters, rough.integrator, None, numbers, rough
    )
    equations = rough.automaton.apart.equations
    coordinates, speeds = (
        numbers.array(list(given.state(symbols).values()))
        for symbols in (equations.coordinates, equations.speeds)
    )
    zero = given.context.mpf(0)
    first = begun_at(hybrid, State(zero, coordinates, speeds, zero), guarded.apart)
    walk = PreciseWalk(hybrid, steps, task.near_flat, progress, task.until)
    return walk.along(first, steps.end)


# -- samples and events ------------------------------------------------------------------------


def _samples(wanted: Wanted, duration: Any, end: Any) -> Any:
    numbers = wanted.numbers
    if not isinstance(wanted.samples, int):
        times = numbers.array(wanted.samples)
        return times[times <= end]
    last = wanted.samples - 1
    times = numbers.array([duration * k / last for k in range(last + 1)])
    return times[times <= end]


def _with_events(run: Trajectory, events: Mapping[str, Expr]) -> Trajectory:
    """The same motion with an event at every zero crossing of some expressions."""
    segments = run.segments
    found = []
    for name, expression in events.items():
        for near, k, begins in passages([s.rounded() for s in segments], expression):
            segment, mode = segments[k], segments[k].mode
            time = segment.begin if begins else _root(segment, expression, near)
            found.append(Event(time, name, mode, mode, segment, segment))
    first, *between, last = run.events
    inside = sorted([*between, *found], key=lambda event: event.time)
    return replace(run, events=(first, *inside, last))


def _root(segment: Segment, expression: Expr, near: float) -> Any:
    """The zero of an expression, from its position in doubles."""
    wanted, numbers = [Expr.of(expression)], segment.numbers
    length = segment.end - segment.begin

    def value(share: Any) -> Any:
        return segment.values(wanted, numbers.array([segment.begin + share * length]))[0, 0]

    share = numbers.zero(value, float((near - segment.begin) / length))
    return segment.begin + min(max(share, 0), 1) * length

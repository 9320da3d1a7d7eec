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

_LOOK = 12  # steps between checks of the signs of absolute values


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
    (duration,) = evaluated([wanted.duration.exact()], numbers.exact)
    end = numbers.array([duration])[0]
    steps = PieceIntegrator(_integrator(task.integrator.name), numbers, end, progress)
    if motion.guarded is None:
        solution = as_declared(motion.begun.dynamics, given, steps)
        # Start, end and sign changes are those found now, other events those seen in doubles.
        first, *sign_changes, last = events_of(solution)
        seen = [e for e in rough.events[1:-1] if not e.divides and e.time < last.time]
        others = placed(seen, solution.segments)
        between = sorted([*sign_changes, *others], key=lambda event: event.time)
        events = (first, *between, last)
    else:
        solution = _through_modes(motion.guarded, given, steps, task, progress)
        events = events_of(solution)
    end = solution.segments[-1].end
    run = replace(
        rough,
        segments=solution.segments,
        duration=end,
        t=_samples(wanted, duration, end),
        mode=solution.ending,
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


# -- equations of one contact mode, kept to as declared --------------------------------------------


@dataclass(frozen=True)
class _WithValues:
    """The equations of the contacts as declared, with the values of their parameters."""

    dynamics: Dynamics
    parameters: Any


@dataclass(frozen=True)
class _Arrival:
    """A stretch up to a sign change of an absolute value, or to the end."""

    part: TrajectoryPiece
    state: StateValues
    time: Any
    stop: Stop
    sign_change: SideChange | None


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
    signed = dynamics.on(sides_at(dynamics, Here(state, constants, now, careful)))
    segments, changes, sign_changes = list[Segment](), list[ModeSwitch](), SideChangeCount()
    parts, stop = list[TrajectoryPiece](), Stop.TIME
    while now < steps.end and stop is not Stop.INTERRUPTED:
        arrival = _along(_WithValues(signed, constants), state, (now, steps.end), steps)
        parts.append(arrival.part)
        state, now, stop = arrival.state, arrival.time, arrival.stop
        if arrival.sign_change is None:
            continue
        sign_changes.count(now, arrival.sign_change)
        segments.append(_segment(signed, parts))
        parts = []
        here = Here(state, constants, now, careful)
        sides = beyond(dynamics, here, signed.sides, arrival.sign_change)
        if sides != signed.sides:
            time, kind = numbers.array([now])[0], told_change(arrival.sign_change, sides)
            changes.append(ModeSwitch(time, kind, AS_DECLARED, AS_DECLARED))
        signed = dynamics.on(sides)
    if parts:
        segments.append(_segment(signed, parts))
    return HybridSolution(tuple(segments), tuple(changes), AS_DECLARED)


def _segment(signed: Dynamics, parts: list[TrajectoryPiece]) -> Segment:
    return Segment(AS_DECLARED, parts[0].begin, parts[-1].end, signed, tuple(parts))


def _along(
    declared: _WithValues, state: StateValues, span: tuple[Any, Any], steps: PieceIntegrator
) -> _Arrival:
    """Integrate to the end of a span, or to the first sign change of an absolute value."""
    passages, careful = passages_of(declared.dynamics), steps.numbers.careful
    watched = StopCriteria(pause=_LOOK) if passages else StopCriteria()
    stretch = steps.along(declared, state, span, watched, span[0])
    found = _first_sign_change(declared.dynamics, passages, stretch)
    if found is None:
        if stretch.stop is Stop.STUCK:
            raise broken(float(stretch.series.times[-1]))
        point, change = PiecePoint(stretch.series.steps - 1, 1), None
        time = stretch.series.times[-1]
    else:
        point, change = found
        time = stretch.series.time(point.step, point.share)
        again = nearer(stretch.series.times, time, steps.numbers)
        if again is not None:
            return _along(declared, state, (span[0], careful.array([again])[0]), steps)
    part = stretch.part(time)
    refuse_vanishing(declared.dynamics, part.rounded())
    arrived = stretch.state(point.step, point.share, careful)
    return _Arrival(part, arrived, careful.array([time])[0], stretch.stop, change)


def _first_sign_change(
    dynamics: Dynamics, passages: Sequence[SideChange], stretch: PrecisePiece
) -> tuple[PiecePoint, SideChange] | None:
    """Where the first sign changes, and which."""
    if not passages:
        return None
    seen = InDoubles(stretch)
    arguments = (*seen.symbols, *dynamics.parameters, CLOCK)
    function = dynamics.function([change.positive for change in passages], arguments)

    def values(places: Array) -> Array:
        found = function(*seen.at(places), *seen.constants, seen.times(places))
        return np.asarray(rows(found, len(places)))

    fall = first_fall(from_zero(values, seen.knots), seen.knots)
    if fall is None:
        return None
    change = passages[fall.guard]
    return fallen(dynamics, change.positive, stretch, fall.time), change


# -- through contact modes -------------------------------------------------------------------------


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


# -- samples and events ----------------------------------------------------------------------------


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

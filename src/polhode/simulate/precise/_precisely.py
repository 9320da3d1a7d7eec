"""Repeats a motion in numbers of higher precision."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import chain
from typing import Any

from polhode.algebra import Expr
from polhode.base import DeclarationError, Progress
from polhode.simulate._event import Event, events_of, in_mode, placed, zero_crossings
from polhode.simulate._segment import Segment
from polhode.simulate._task import Guarded, MotionResult, Task
from polhode.simulate._trajectory import Trajectory
from polhode.simulate.contact._contact_kinematics import State
from polhode.simulate.contact._hybrid_integrator import HybridIntegrator, HybridSolution
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._through_modes import initial_mode
from polhode.simulate.forcing._pieces import Pieces
from polhode.simulate.integrate._integrators import heyoka_is_used
from polhode.simulate.integrate._number_types import NumberType
from polhode.simulate.integrate._series import SeriesIntegrator
from polhode.simulate.precise._precise_declared import as_declared
from polhode.simulate.precise._precise_modes import precise_pieces
from polhode.simulate.precise._precise_piece import SeriesStepper
from polhode.simulate.precise._precise_start import Given, evaluated, read_exactly
from polhode.simulate.precise._wanted import PrecisionRequest


def precisely(
    rough: Trajectory,
    motion: MotionResult,
    task: Task,
    wanted: PrecisionRequest,
    progress: Progress,
) -> Trajectory:
    """The same motion in other numbers.

    Args:
        rough: the motion in doubles.
        motion: the same, as it was integrated.
        task: parameters and start, as they were given.

    Raises:
        DeclarationError: for prescribed motions that are known in double precision only.
        NumericError: where the motion cannot be continued.
    """
    numbers = wanted.numbers
    _refuse_samples(task.forcing, numbers)
    used = (segment.dynamics.parameters for segment in motion.segments)
    known = {*motion.initial.dynamics.parameters, *chain.from_iterable(used)}
    given = read_exactly(motion.initial, known, task, numbers)
    (duration,) = evaluated([wanted.duration.exact()], numbers.exact)
    end = numbers.array([duration])[0]
    steps = SeriesStepper(_integrator(), numbers, end, progress)
    if motion.guarded is None:
        course = as_declared(motion.initial.dynamics, given, steps, motion.segments)
        events = _events_beside(rough, course)
    else:
        course = _through_modes(motion.guarded, given, steps, task)
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


def _events_beside(rough: Trajectory, course: HybridSolution) -> tuple[Event, ...]:
    """Start, changes of side and end; between them, further events of the motion in doubles."""
    first, *turns, last = events_of(course)
    seen = [e for e in rough.events[1:-1] if not e.divides and e.time < last.time]
    between = sorted([*turns, *placed(seen, course.segments)], key=lambda event: event.time)
    return (first, *between, last)


def _refuse_samples(forcing: Mapping[Any, Any], numbers: NumberType) -> None:
    for name, given in forcing.items():
        if isinstance(given, Pieces) or (callable(given) and not isinstance(given, Expr)):
            raise DeclarationError(
                f"the motion {name}, known only in double precision, in {numbers.name} precision",
                expected="an expression of time for every prescribed function",
                advice="write it with polhode.time instead of samples or a Python function",
            )


def _integrator() -> SeriesIntegrator:
    if heyoka_is_used():
        from polhode.simulate.integrate._heyoka import TaylorSeries

        return TaylorSeries()
    from polhode.simulate.integrate._flint import PowerSeries

    return PowerSeries()


# -- integration -------------------------------------------------------------------------------


def _through_modes(
    guarded: Guarded, given: Given, steps: SeriesStepper, task: Task
) -> HybridSolution:
    """Integrate through all contact modes.

    The declaration, its modes and its prescribed motions are those of the system in doubles, which
    also serves to bracket directions of slip and to detect jamming.
    """
    rough, numbers = guarded.hybrid, steps.numbers.careful
    independent = rough.speeds
    machine = HybridSystem(
        rough.declared, rough.drive, given.parameters, rough.integrator, None, numbers, rough
    )
    machine.on_speeds(independent)
    equations = machine.automaton.separated.equations
    coordinates, speeds = (
        numbers.array(list(given.state(symbols).values()))
        for symbols in (equations.coordinates, equations.speeds)
    )
    zero = given.context.mpf(0)
    first = initial_mode(machine, State(zero, coordinates, speeds, zero), guarded.separated)
    pieces = precise_pieces(machine, task.near_flat, steps, guarded.speed_changes)
    found = HybridIntegrator(machine, pieces, task.until).integrate(first, steps.end)
    rough.on_speeds(independent)
    return found


# -- samples and events ------------------------------------------------------------------------


def _samples(wanted: PrecisionRequest, duration: Any, end: Any) -> Any:
    numbers = wanted.numbers
    if not isinstance(wanted.samples, int):
        times = numbers.array(wanted.samples)
        return times[times <= end]
    last = wanted.samples - 1
    times = numbers.array([duration * k / last for k in range(last + 1)])
    return times[times <= end]


def _with_events(run: Trajectory, events: Mapping[str, Expr]) -> Trajectory:
    """The same motion with an event wherever one of some expressions passes through zero."""
    segments = run.segments
    found = []
    for name, expression in events.items():
        for near, k, begins in zero_crossings([s.rounded() for s in segments], expression):
            segment, mode = segments[k], segments[k].mode
            time = segment.begin if begins else _root(segment, in_mode(segment, expression), near)
            found.append(Event(time, name, mode, mode, segment, segment))
    first, *between, last = run.events
    inside = sorted([*between, *found], key=lambda event: event.time)
    return replace(run, events=(first, *inside, last))


def _root(segment: Segment, expression: Expr, near: float) -> Any:
    """The time at which an expression is zero, refined from that in doubles.

    The unknown is the share of the segment: of order one, whatever the time.
    """
    wanted, numbers = [Expr.of(expression)], segment.numbers
    length = segment.end - segment.begin

    def value(share: Any) -> Any:
        return segment.values(wanted, numbers.array([segment.begin + share * length]))[0, 0]

    share = numbers.zero(value, float((near - segment.begin) / length))
    return segment.begin + min(max(share, 0), 1) * length

"""A motion once more in numbers of higher precision, within one contact mode."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.base import DeclarationError, Enough, NumericError, Progress
from polhode.derive import Mode
from polhode.simulate._dynamics import CLOCK, WORK, Dynamics
from polhode.simulate._event import Event, placed
from polhode.simulate._segment import Part, Segment
from polhode.simulate._task import Motion, Task
from polhode.simulate._trajectory import Trajectory
from polhode.simulate._watching import passages
from polhode.simulate.contact._machine import gap_symbol, slip_symbols
from polhode.simulate.forcing._pieces import Pieces
from polhode.simulate.integrate._crossing import first_fall
from polhode.simulate.integrate._driver import Solution, Stop
from polhode.simulate.integrate._flow import flow_of
from polhode.simulate.integrate._integrators import broken
from polhode.simulate.integrate._numbers import Numbers
from polhode.simulate.integrate._series import Launch, Series, SeriesIntegrator
from polhode.simulate.precise._exactly import evaluated, exact_value, exact_values, on
from polhode.simulate.precise._precise_start import precise_start

_POLISHED = 24  # secant steps to an event at most
_NEAR = 1e-9  # of a duration: how far from it they set out


@dataclass(frozen=True)
class Wanted:
    """What is asked for, as it was given.

    Attributes:
        numbers: what to compute in.
        duration: s, with a unit or exactly.
        samples: how many, or their times.
        events: expressions whose passing through zero is recorded, by name.
    """

    numbers: Numbers
    duration: Any
    samples: Any
    events: Mapping[str, Expr]


def precisely(
    rough: Trajectory, motion: Motion, task: Task, wanted: Wanted, progress: Progress
) -> Trajectory:
    """The same motion in other numbers.

    Args:
        rough: in doubles.
        motion: what it was made of.
        task: numbers and start, as they were given.

    Raises:
        DeclarationError: for prescribed motions that are known to doubles only.
        NumericError: where the contact mode changes.
    """
    _refuse_changes(motion, wanted.numbers)
    _refuse_samples(task.forcing, wanted.numbers)
    course = _Course(motion, task, wanted)
    series = course.integrated(progress)
    segment = course.segment(series)
    run = replace(
        rough,
        segments=(segment,),
        duration=segment.end,
        t=_samples(wanted, segment.end),
        integrator=course.integrator.name,
        events=_events(rough, segment),
    )
    if motion.mode is not None:
        _refuse_falls(run.rounded(), motion.mode, task.near_flat, wanted.numbers)
    return _with_events(run, wanted)


def _refuse_changes(motion: Motion, numbers: Numbers) -> None:
    if motion.changes:
        first = motion.changes[0]
        raise _switch(first.time, first.kind, numbers)


def _refuse_falls(run: Trajectory, mode: Mode, near_flat: float, numbers: Numbers) -> None:
    """Refuse a motion that leaves its mode, though in doubles it does not."""
    guards = [guard for guard in mode.guards if guard.kind != "sticks"]
    sides = [g.positive - near_flat if g.kind == "near-flat" else g.positive for g in guards]
    (segment,) = run.segments
    fall = first_fall(lambda times: segment.values(sides, times), segment.steps) if sides else None
    if fall is not None and fall.time > 0:
        raise _switch(fall.time, guards[fall.guard].kind, numbers)


def _switch(time: float, kind: str, numbers: Numbers) -> NumericError:
    return NumericError(
        f"{kind} at t = {time:.15g} s, in {numbers.name} precision",
        expected="a motion within one contact mode: only in doubles are modes followed",
        advice="end before that time, and start the next mode from there",
    )


def _refuse_samples(forcing: Mapping[Any, Any], numbers: Numbers) -> None:
    for name, given in forcing.items():
        if isinstance(given, Pieces) or (callable(given) and not isinstance(given, Expr)):
            raise DeclarationError(
                f"the motion {name}, which is known to doubles only, in {numbers.name} precision",
                expected="an expression of time for every prescribed function",
                advice="write it with polhode.time instead of samples or a Python function",
            )


# -- what is integrated ------------------------------------------------------------------------


class _Course:
    """The equations of the mode, and exact numbers for them."""

    def __init__(self, motion: Motion, task: Task, wanted: Wanted) -> None:
        self._motion = motion
        self._numbers = wanted.numbers
        self._context = wanted.numbers.exact
        self.integrator = _integrator(task.integrator.name)
        self.dynamics = _stateless(motion.segments[0].dynamics, motion.mode)
        begun = motion.begun
        known = {*self.dynamics.parameters, *begun.dynamics.parameters}
        exact = exact_values(task.given, known, {})
        self._parameters = self._evaluated(exact)
        start = exact_values(task.start, _startable(begun.dynamics), exact)
        self._given = self._evaluated(start)
        (self._end,) = evaluated([exact_value(wanted.duration, {})], {}, self._context)

    def _evaluated(self, values: Mapping[Symbol, Expr]) -> dict[Symbol, Any]:
        found = evaluated(list(values.values()), {}, self._context)
        return dict(zip(values, found, strict=True))

    def integrated(self, progress: Progress) -> Series:
        """From the start to the end, or to where progress ends it."""
        flow = flow_of(self.dynamics, reduced=False)
        state = self._start() | {WORK: self._context.mpf(0)}
        launch = Launch(
            flow.core.program,
            self._numbers,
            self._constants,
            [state[s] for s in flow.core.symbols],
            self._end,
        )
        watch = _Watch(progress, float(self._end))
        series = self.integrator.integrate(launch, watch)
        if series.times[-1] < self._numbers.array(self._end) and not watch.enough:
            raise broken(float(series.times[-1]))
        return series

    @property
    def _constants(self) -> list[Any]:
        return [self._parameters[s] for s in self.dynamics.parameters]

    def _start(self) -> dict[Symbol, Any]:
        """Coordinates and speeds of the mode, from those in which the start was read."""
        begun = self._motion.begun
        parameters = {s: self._parameters[s] for s in begun.dynamics.parameters}
        found = precise_start(begun.dynamics, begun.start, self._given, parameters, self._context)
        own = self.dynamics.states
        lifted = begun.dynamics.lifted
        wanted = [lifted.get(s, Expr.generator(s)) for s in own]
        program = begun.dynamics.program(wanted, (*found, *parameters, CLOCK))
        zero = self._context.mpf(0)
        values = program.function(on(self._context))(*found.values(), *parameters.values(), zero)
        return dict(zip(own, values, strict=True))

    def segment(self, series: Series) -> Segment:
        """The motion, known at every instant."""
        flow = flow_of(self.dynamics, reduced=False)
        end = self._numbers.scalar(series.times[-1])
        solution = Solution(
            flow.core.symbols,
            {},
            series.times,
            Stop.TIME if end >= self._numbers.array(self._end) else Stop.INTERRUPTED,
            None,
            series.at,
            self._numbers,
            series.rounded_at,
        )
        constants = self._numbers.array(self._constants)
        begin = self._numbers.scalar(series.times[0])
        part = Part(begin, end, solution, constants)
        return Segment(self._motion.segments[0].mode, begin, end, self.dynamics, (part,))


def _integrator(name: str) -> SeriesIntegrator:
    if name == "heyoka":
        from polhode.simulate.integrate._heyoka_series import TaylorSeries

        return TaylorSeries()
    from polhode.simulate.integrate._flint import PowerSeries

    return PowerSeries()


def _startable(dynamics: Dynamics) -> tuple[Symbol, ...]:
    equations = dynamics.equations
    rates = (*equations.kinematics, *equations.dependent)
    return (*equations.coordinates, *equations.speeds, *rates)


def _stateless(dynamics: Dynamics, mode: Mode | None) -> Dynamics:
    """Slips and gaps taken from the state, from which so many digits do not drown."""
    if mode is None:
        return dynamics
    own = dict[Symbol, Expr]()
    for touch in mode.touches:
        own |= zip(slip_symbols(touch.contact), touch.slip, strict=True)
        own[gap_symbol(touch.contact)] = touch.gap
    seen = {s: value for s, value in own.items() if s in dynamics.carried}
    return replace(
        dynamics,
        carried={},
        meanings={**dynamics.meanings, **seen},
        lifted={**dynamics.lifted, **seen},
    )


class _Watch:
    """Tells of every step, and ends where it is told to, or where steps become too short."""

    def __init__(self, progress: Progress, end: float) -> None:
        self.enough = False
        self._progress = progress
        self._least = 1e-14 * end
        self._end = end
        self._time = -np.inf

    def __call__(self, time: float) -> bool:
        try:
            self._progress.advance()
        except Enough:
            self.enough = True
        stuck = time - self._time < self._least and time < self._end
        self._time = time
        return not (self.enough or stuck)


# -- samples and events ------------------------------------------------------------------------


def _samples(wanted: Wanted, end: Any) -> Any:
    numbers = wanted.numbers
    if not isinstance(wanted.samples, int):
        times = numbers.array(wanted.samples)
        return times[times <= end]
    (duration,) = evaluated([exact_value(wanted.duration, {})], {}, numbers.exact)
    last = wanted.samples - 1
    times = numbers.array([duration * k / last for k in range(last + 1)])
    return times[times <= end]


def _events(rough: Trajectory, segment: Segment) -> tuple[Event, ...]:
    """Those of the motion in doubles, at its own beginning and end."""
    begun, *between, ended = rough.events
    stop = segment.parts[-1].solution.stop
    kind = "interrupted" if stop is Stop.INTERRUPTED else "end"
    own = (
        replace(begun, time=segment.begin),
        *(event for event in between if event.time < segment.end),
        replace(ended, time=segment.end, kind=kind),
    )
    return placed(own, [segment])


def _with_events(run: Trajectory, wanted: Wanted) -> Trajectory:
    """The same motion with an event wherever one of some expressions passes through zero."""
    (segment,) = run.segments
    (rounded,) = run.rounded().segments
    found = [
        Event(_root(segment, expression, time), name, segment.mode, segment.mode, segment, segment)
        for name, expression in wanted.events.items()
        for time in passages(rounded, expression)
    ]
    first, *between, last = run.events
    inside = sorted([*between, *found], key=lambda event: event.time)
    return replace(run, events=(first, *inside, last))


def _root(segment: Segment, expression: Expr, near: float) -> Any:
    """Where an expression is zero, from where it is in doubles, by the secant method."""
    numbers = segment.parts[0].solution.numbers
    wanted = [Expr.of(expression)]

    def value(time: Any) -> Any:
        return segment.values(wanted, numbers.array([time]))[0, 0]

    newer = numbers.scalar(numbers.array(near)[()])
    older = newer + _NEAR * segment.end * (-1 if 2 * near > segment.end else 1)
    before, now = value(older), value(newer)
    for _ in range(_POLISHED):
        if now in (0, before):
            break
        older, newer = newer, newer - now * (newer - older) / (now - before)
        newer = min(max(newer, segment.begin), segment.end)
        before, now = now, value(newer)
        if newer == older:
            break
    return newer

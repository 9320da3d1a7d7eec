"""From equations, numbers and a start to a trajectory within one contact mode."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from polhode.algebra import Expr, ExprLike, Kind, Symbol
from polhode.base import (
    TIME,
    DeclarationError,
    NumericError,
    Progress,
    SilentProgress,
    UnitError,
    look_up,
    to_si,
)
from polhode.derive import derive
from polhode.model import System
from polhode.simulate._driver import integrate
from polhode.simulate._dynamics import Dynamics, EquationsOfMotion
from polhode.simulate._flow import WORK, Flow, flow_of
from polhode.simulate._integrators import Array, chosen
from polhode.simulate._names import Name, by_name, published
from polhode.simulate._start import Start, read_start
from polhode.simulate._trajectory import Event, Trajectory
from polhode.simulate._validity import pulling_contacts, refuse_lost_side
from polhode.simulate._values import idle_parameters, read_parameters

SAMPLES = 1001


def simulate(
    subject: System | EquationsOfMotion,
    parameters: Mapping[Name, Any],
    start: Mapping[Name, Any],
    duration: Any,
    *,
    tolerance: float | None = None,
    forcing: Mapping[Name, ExprLike] | None = None,
    invariants: Mapping[str, Expr] | None = None,
    samples: int | ArrayLike = SAMPLES,
    mode: str = "as declared",
    progress: Progress | None = None,
) -> Trajectory:
    """Integrate the motion of a system to rounding, within one contact mode.

    Names may be symbols or published names; values are SI numbers, texts with a unit, or exact
    expressions.

    Args:
        subject: a declaration, or the equations derived from it.
        parameters: the value of every parameter.
        start: coordinates, speeds, rates of coordinates and dependent speeds in any mixture that
            does not contradict itself. What they leave open starts at zero and is listed in
            `assumed`; coordinates that close a loop are solved for.
        duration: s.
        tolerance: relative, of one step; by default the best that the integrator holds.
        forcing: every prescribed function as an expression of time.
        invariants: expressions to be watched for drift, by name.
        samples: number of equally spaced sample times, or the times, s.
        mode: what to call the contact mode.
        progress: told of every step.

    Raises:
        ConstraintError: for start values that contradict each other or the constraints.
        DeclarationError: for names that are not known, and values that are missing or impossible.
        NumericError: where the motion is not defined or cannot be continued.
        UnitError: for a value that cannot be read or has the wrong dimension.
    """
    seconds: dict[str, float] = {}
    with _timed(seconds, "derive"):
        equations = derive(subject) if isinstance(subject, System) else subject
        idle = idle_parameters(equations, parameters)
        dynamics = Dynamics(equations, _prescribed(equations, forcing or {}), idle)
    end = _duration(duration)
    times = _samples(samples, end)
    numbers = read_parameters(dynamics, parameters)
    begin = read_start(dynamics, start, numbers)
    integrator = chosen()
    with _timed(seconds, "compile"):
        flow = flow_of(dynamics, reduced=integrator.dense)
        stepper = integrator.prepare(flow, _tolerance(tolerance))
    with _timed(seconds, "integrate"), _shown(progress or SilentProgress()) as shown:
        constants = np.array(list(numbers.values()), dtype=float)
        state = _ordered(flow, dynamics, begin)
        solution = integrate(flow, stepper, constants, state, end, shown)
    trajectory = Trajectory(
        dynamics=dynamics,
        parameters={symbol.published: value for symbol, value in numbers.items()},
        duration=end,
        t=times,
        mode=mode,
        events=(Event(0.0, "start", None, mode), Event(end, "end", mode, None)),
        assumed=begin.assumed,
        seconds=seconds,
        integrator=integrator.name,
        invariants=invariants or {},
        _solution=solution,
    )
    refuse_lost_side(trajectory)
    return replace(trajectory, events=_events(trajectory, mode))


def _events(trajectory: Trajectory, mode: str) -> tuple[Event, ...]:
    """Start and end, and where a contact would have had to let go."""
    pulls = (Event(t, f"{name} pulls", mode, mode) for t, name in pulling_contacts(trajectory))
    start, end = trajectory.events
    return (start, *sorted(pulls, key=lambda event: event.time), end)


def _prescribed(
    equations: EquationsOfMotion, forcing: Mapping[Name, ExprLike]
) -> dict[Symbol, Expr]:
    known = by_name(equations.functions)
    given = {
        look_up(published(name), known, "prescribed function of this system"): Expr.of(motion)
        for name, motion in forcing.items()
    }
    missing = [symbol.published for symbol in equations.functions if symbol not in given]
    if missing:
        raise DeclarationError(
            f"no motion for {', '.join(missing)}",
            expected="an expression of time for every prescribed function",
            advice=f"add forcing={{'{missing[0]}': ...}} with an expression of polhode.time",
        )
    for symbol, motion in given.items():
        strange = [s for s in motion.symbols() if s.kind not in (Kind.TIME, Kind.PARAMETER)]
        if strange:
            raise DeclarationError(
                f"the prescribed {symbol.published}(t) depends on {strange[0].published}",
                expected="an expression of time and parameters",
                advice="a force that depends on the motion is a load of the system",
            )
    return given


def _duration(value: Any) -> float:
    duration = to_si(value, TIME, "duration")
    if duration <= 0:
        raise UnitError(f"a duration of {duration:g} s", expected="a positive one")
    return duration


def _samples(samples: int | ArrayLike, duration: float) -> Array:
    if isinstance(samples, int):
        if samples < 2:
            raise NumericError(f"{samples} samples", expected="at least two")
        return np.linspace(0.0, duration, samples)
    times = np.asarray(samples, dtype=float)
    if times.ndim != 1 or not np.all((times >= 0) & (times <= duration)):
        raise NumericError(
            f"sample times {times!r}", expected=f"a list of times from 0 to {duration:g} s"
        )
    return times


def _tolerance(tolerance: float | None) -> float | None:
    if tolerance is not None and not 0 < tolerance < 1:
        raise NumericError(f"a tolerance of {tolerance}", expected="one between 0 and 1")
    return tolerance


def _ordered(flow: Flow, dynamics: Dynamics, start: Start) -> Array:
    values = dict(zip(dynamics.states, start.state, strict=True)) | {WORK: 0.0}
    return np.array([values[symbol] for symbol in flow.states], dtype=float)


@contextmanager
def _timed(seconds: dict[str, float], what: str) -> Iterator[None]:
    began = time.perf_counter()
    yield
    seconds[what] = time.perf_counter() - began


@contextmanager
def _shown(progress: Progress) -> Iterator[Progress]:
    progress.begin("integrating")
    try:
        yield progress
    finally:
        progress.finish()

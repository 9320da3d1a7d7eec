"""Integrates a motion whose contacts stay as they are declared."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from polhode.base import DeclarationError, Progress
from polhode.simulate._absolute_values import (
    Instant,
    SideChange,
    SideChangeCount,
    Sides,
    first_side_change,
    guards_of_sides,
    overshoots,
    refuse_vanishing,
    shorter_span,
    sides_at,
)
from polhode.simulate._dynamics import WORK, Dynamics, EquationsOfMotion
from polhode.simulate._mode_integration import PieceEnd, StateValues, integrate_mode
from polhode.simulate._segment import TrajectoryPiece, state_at
from polhode.simulate._start import read_start
from polhode.simulate._task import AS_DECLARED, InitialState, MotionResult, Task, timed
from polhode.simulate._values import Numbers, idle_parameters, read_parameters
from polhode.simulate.forcing._prescribed_motion import PrescribedMotion, prescribed_motion
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._driver import integrate, stuck
from polhode.simulate.integrate._flow import Flow, flow_of
from polhode.simulate.integrate._stepping import Integrator, Stepper
from polhode.simulate.integrate._stop_criteria import StepCount, Stop, StopCriteria

_PAUSE = 400  # steps after which the guards of absolute values are checked


class AsDeclared:
    """Motions of one system whose contacts stay as they are declared."""

    def __init__(self, equations: EquationsOfMotion, task: Task) -> None:
        with timed(task, "derive"):
            self._drive = prescribed_motion(equations.functions, task.forcing, task.end)
            jerks = [time for time in self._drive.jerks if 0 < time < task.end]
            if jerks:
                raise DeclarationError(
                    f"a support that jerks at t = {min(jerks):g} s, with the equations of one "
                    "contact mode",
                    expected="the declaration itself, whose contacts can slip and stick",
                    advice="simulate the System instead of the equations derived from it",
                )
            idle = idle_parameters(equations, task.given)
            self._dynamics = Dynamics(equations, self._drive.expressions, idle)
        self._integrator = task.integrator
        self._tolerance = task.tolerance
        self._smooth: dict[int, _SmoothEquations] = {}

    def follow(self, task: Task, progress: Progress) -> MotionResult:
        dynamics, drive = self._dynamics, self._drive
        numbers = read_parameters(dynamics, task.given, drive.constants(0.0))
        first = {**numbers, **drive.constants(0.0)}
        at_start = {s: first[s] for s in dynamics.parameters}
        begin = read_start(dynamics, task.start, at_start)
        state = {**dict(zip(dynamics.states, begin.state, strict=True)), WORK: 0.0}
        pieces = _DeclaredPieces(self, numbers, drive, progress)
        with timed(task, "compile"):
            pieces.put_on(sides_at(dynamics, pieces.instant(state, 0.0)))
            pieces.equations.stepper  # noqa: B018
        with timed(task, "integrate"):
            run = integrate_mode(pieces, state, 0.0, task.end, SideChangeCount())
        return MotionResult(
            run.segments,
            run.switches,
            AS_DECLARED,
            {symbol.published: value for symbol, value in numbers.items()},
            begin.assumed,
            unguarded=True,
            initial=InitialState(dynamics, begin),
            drive=drive,
        )

    @property
    def dynamics(self) -> Dynamics:
        """The equations with absolute values in them."""
        return self._dynamics

    def on(self, sides: Sides) -> _SmoothEquations:
        """The equations on given sides of all absolute values, compiled once."""
        dynamics = self._dynamics.on(sides)
        if id(dynamics) not in self._smooth:
            made = _SmoothEquations(dynamics, self._integrator, self._tolerance)
            self._smooth[id(dynamics)] = made
        return self._smooth[id(dynamics)]


class _SmoothEquations:
    """Compiled equations on one side of every absolute value, and the guards of these sides."""

    def __init__(self, dynamics: Dynamics, integrator: Integrator, tolerance: float | None) -> None:
        self.dynamics = dynamics
        self.side_guards = guards_of_sides(dynamics)
        self._integrator = integrator
        self._tolerance = tolerance

    @cached_property
    def flow(self) -> Flow:
        return flow_of(self.dynamics, reduced=self._integrator.dense)

    @cached_property
    def stepper(self) -> Stepper:
        return self._integrator.prepare(self.flow, self._tolerance)

    def criteria(self, constants: Array, tally: StepCount) -> StopCriteria:
        """Criteria that stop an integration so that its guards are checked."""
        if not self.side_guards:
            return StopCriteria()
        over = overshoots(self.dynamics, self.side_guards, self.flow, constants)
        return StopCriteria(pause=_PAUSE, over=over, tally=tally)


class _DeclaredPieces:
    """Pieces of such a motion, in double precision."""

    name = AS_DECLARED

    def __init__(
        self, declared: AsDeclared, numbers: Numbers, drive: PrescribedMotion, progress: Progress
    ) -> None:
        self._declared = declared
        self._numbers = numbers
        self._drive = drive
        self._progress = progress
        self._tally = StepCount()
        self._constants = self._constants_at(0.0)

    @property
    def whole(self) -> Dynamics:
        return self._declared.dynamics

    @property
    def dynamics(self) -> Dynamics:
        return self.equations.dynamics

    def put_on(self, sides: Sides) -> None:
        self.equations = self._declared.on(sides)

    def instant(self, state: StateValues, time: float) -> Instant:
        return Instant(state, self._constants, time)

    def stored_time(self, time: float) -> float:
        return time

    def next(
        self, state: StateValues, now: float, end: float, before: TrajectoryPiece | None
    ) -> PieceEnd:
        flow, then = self.equations.flow, self._constants
        rest = before.solution.rest(now) if before else flow.rest(state, then, now)
        self._constants = self._constants_at(now)
        piece, change = self._up_to(rest, (now, self._drive.until(now, end)))
        interrupted = piece.solution.stop is Stop.INTERRUPTED
        there: dict[Any, Any] = {WORK: 0.0, **state_at(piece, piece.end)}
        return PieceEnd(piece, there, piece.end, change, is_last=interrupted)

    def _up_to(
        self, rest: Array, span: tuple[float, float]
    ) -> tuple[TrajectoryPiece, SideChange | None]:
        """Up to the end of a span, or of a side."""
        equations, constants = self.equations, self._constants
        criteria = equations.criteria(constants, self._tally)
        solution = integrate(
            equations.flow, equations.stepper, constants, rest, span, self._progress, criteria
        )
        reached = span[1] if solution.stop is Stop.TIME else float(solution.steps[-1])
        whole = TrajectoryPiece(span[0], reached, solution, constants)
        piece, change = first_side_change(equations.dynamics, equations.side_guards, whole)
        again = shorter_span(solution.steps, piece.end) if change is not None else None
        if again is not None:
            return self._up_to(rest, (span[0], again))
        refuse_vanishing(equations.dynamics, piece)
        if change is None and solution.stop is Stop.STUCK:
            raise stuck(solution)
        return piece, change

    def _constants_at(self, now: float) -> Array:
        known = {**self._numbers, **self._drive.constants(now)}
        return np.array([known[s] for s in self.whole.parameters])

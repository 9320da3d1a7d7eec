"""Follows a motion within one contact mode, as it is declared."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np

from polhode.algebra import Symbol
from polhode.base import DeclarationError, Progress
from polhode.simulate._absolute_values import (
    Here,
    SideChange,
    SideChangeCount,
    Sides,
    beyond,
    first_passage,
    nearer,
    overshoots,
    passages_of,
    refuse_vanishing,
    sides_at,
    told_change,
)
from polhode.simulate._dynamics import WORK, Dynamics, EquationsOfMotion
from polhode.simulate._event import ModeSwitch
from polhode.simulate._segment import Segment, TrajectoryPiece, state_at
from polhode.simulate._start import read_start
from polhode.simulate._task import AS_DECLARED, InitialState, MotionResult, Task, timed
from polhode.simulate._values import idle_parameters, read_parameters
from polhode.simulate.forcing._prescribed_motion import PrescribedMotion, prescribed_motion
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._driver import integrate, stuck
from polhode.simulate.integrate._flow import Flow, flow_of
from polhode.simulate.integrate._stepping import Integrator, Stepper
from polhode.simulate.integrate._stop_criteria import StepCount, Stop, StopCriteria

_LOOK = 400  # steps after which absolute values are looked at


class AsDeclared:
    """The contacts as they are declared, and kept to."""

    def __init__(self, equations: EquationsOfMotion, task: Task) -> None:
        with timed(task, "derive"):
            self._drive = prescribed_motion(equations.functions, task.forcing, task.end)
            _refuse_jerks(self._drive, task.end)
            idle = idle_parameters(equations, task.given)
            self._dynamics = Dynamics(equations, self._drive.expressions, idle)
        self._integrator = task.integrator
        self._tolerance = task.tolerance
        self._faces: dict[int, _Face] = {}

    def follow(self, task: Task, progress: Progress) -> MotionResult:
        dynamics, drive = self._dynamics, self._drive
        numbers = read_parameters(dynamics, task.given, drive.constants(0.0))
        first = {**numbers, **drive.constants(0.0)}
        at_start = {s: first[s] for s in dynamics.parameters}
        begin = read_start(dynamics, task.start, at_start)
        state = {**dict(zip(dynamics.states, begin.state, strict=True)), WORK: 0.0}
        here = Here(state, np.array(list(at_start.values())), 0.0)
        with timed(task, "compile"):
            face = self._face(sides_at(dynamics, here))
            face.stepper  # noqa: B018
        with timed(task, "integrate"):
            course = _DeclaredSolution(drive, numbers, task.end, progress)
            while course.is_under_way:
                here, passage = course.along(face, here)
                if passage is not None:
                    face = self._face(course.turned(face, here, passage, dynamics))
        return MotionResult(
            tuple(course.segments),
            tuple(course.changes),
            AS_DECLARED,
            {symbol.published: value for symbol, value in numbers.items()},
            begin.assumed,
            unguarded=True,
            begun=InitialState(dynamics, begin),
            drive=drive,
        )

    def _face(self, sides: Sides) -> _Face:
        """The equations on given sides of all absolute values, compiled once."""
        dynamics = self._dynamics.on(sides)
        if id(dynamics) not in self._faces:
            self._faces[id(dynamics)] = _Face(dynamics, self._integrator, self._tolerance)
        return self._faces[id(dynamics)]


class _Face:
    """Equations that are smooth, compiled, and what ends them."""

    def __init__(self, dynamics: Dynamics, integrator: Integrator, tolerance: float | None) -> None:
        self.dynamics = dynamics
        self.passages = passages_of(dynamics)
        self._integrator = integrator
        self._tolerance = tolerance

    @cached_property
    def flow(self) -> Flow:
        return flow_of(self.dynamics, reduced=self._integrator.dense)

    @cached_property
    def stepper(self) -> Stepper:
        return self._integrator.prepare(self.flow, self._tolerance)

    def watched(self, constants: Array, tally: StepCount) -> StopCriteria:
        """What stops an integration for a look."""
        if not self.passages:
            return StopCriteria()
        over = overshoots(self.dynamics, self.passages, self.flow, constants)
        return StopCriteria(pause=_LOOK, over=over, tally=tally)


class _DeclaredSolution:
    """A motion as it grows, from one set of sides to the next."""

    def __init__(
        self,
        drive: PrescribedMotion,
        numbers: Mapping[Symbol, float],
        end: float,
        progress: Progress,
    ) -> None:
        self.segments = list[Segment]()
        self.changes = list[ModeSwitch]()
        self.is_under_way = True
        self._drive = drive
        self._numbers = numbers
        self._end = end
        self._progress = progress
        self._tally = StepCount()
        self._turns = SideChangeCount()

    def along(self, face: _Face, here: Here) -> tuple[Here, SideChange | None]:
        """As long as the same equations hold: where that ends, and what ends it."""
        begin = now = here.time
        rest = face.flow.rest(here.state, here.constants, now)
        parts, constants = list[TrajectoryPiece](), here.constants
        passage: SideChange | None = None
        while passage is None and now < self._end and self.is_under_way:
            constants = self._constants(face.dynamics, now)
            span = (now, self._drive.until(now, self._end))
            part, passage = self._part(face, constants, rest, span)
            self.is_under_way = part.solution.stop is not Stop.INTERRUPTED
            parts.append(part)
            now = part.end
            rest = part.solution.rest(now)
        self.is_under_way = self.is_under_way and now < self._end
        self.segments.append(Segment(AS_DECLARED, begin, now, face.dynamics, tuple(parts)))
        state: dict[Symbol, Any] = {WORK: 0.0, **state_at(parts[-1], now)} if passage else {}
        return Here(state, constants, now), passage

    def _part(
        self, face: _Face, constants: Array, rest: Array, span: tuple[float, float]
    ) -> tuple[TrajectoryPiece, SideChange | None]:
        """Up to the end of a span, or of a side."""
        watched = face.watched(constants, self._tally)
        solution = integrate(
            face.flow, face.stepper, constants, rest, span, self._progress, watched
        )
        reached = span[1] if solution.stop is Stop.TIME else float(solution.steps[-1])
        whole = TrajectoryPiece(span[0], reached, solution, constants)
        part, passage = first_passage(face.dynamics, face.passages, whole)
        again = nearer(whole.solution.steps, part.end) if passage is not None else None
        if again is not None:
            return self._part(face, constants, rest, (span[0], again))
        refuse_vanishing(face.dynamics, part)
        if passage is None and solution.stop is Stop.STUCK:
            raise stuck(solution)
        return part, passage

    def turned(
        self, face: _Face, here: Here, passage: SideChange, dynamics: Dynamics
    ) -> dict[Any, int]:
        """The sides that follow where one ends."""
        self._turns.count(here.time, passage)
        sides = beyond(dynamics, here, face.dynamics.sides, passage)
        if sides != face.dynamics.sides:
            kind = told_change(passage, sides)
            self.changes.append(ModeSwitch(here.time, kind, AS_DECLARED, AS_DECLARED))
        return sides

    def _constants(self, dynamics: Dynamics, now: float) -> Array:
        known = {**self._numbers, **self._drive.constants(now)}
        return np.array([known[s] for s in dynamics.parameters])


def _refuse_jerks(drive: PrescribedMotion, end: float) -> None:
    felt = [time for time in drive.jerks if 0 < time < end]
    if felt:
        raise DeclarationError(
            f"a support that jerks at t = {min(felt):g} s, under one contact mode",
            expected="the declaration itself, whose contacts can slip and stick",
            advice="simulate the System, not the equations derived from it",
        )

"""Follows a motion within one contact mode, as it is declared."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from polhode.base import DeclarationError, Progress
from polhode.simulate._dynamics import WORK, Dynamics, EquationsOfMotion
from polhode.simulate._segment import Part, Segment
from polhode.simulate._start import read_start
from polhode.simulate._task import AS_DECLARED, Begun, Motion, Task, timed
from polhode.simulate._values import idle_parameters, read_parameters
from polhode.simulate.forcing._drive import Drive, drive_of
from polhode.simulate.integrate._driver import integrate, stuck
from polhode.simulate.integrate._flow import Flow, flow_of
from polhode.simulate.integrate._stepping import Stepper
from polhode.simulate.integrate._watched import Stop


class AsDeclared:
    """The contacts as they are declared, and kept to."""

    def __init__(self, equations: EquationsOfMotion, task: Task) -> None:
        with timed(task, "derive"):
            self._drive = drive_of(equations.functions, task.forcing, task.end)
            _refuse_jerks(self._drive, task.end)
            idle = idle_parameters(equations, task.given)
            self._dynamics = Dynamics(equations, self._drive.expressions, idle)
        self._integrator = task.integrator
        self._tolerance = task.tolerance

    @cached_property
    def _flow(self) -> Flow:
        return flow_of(self._dynamics, reduced=self._integrator.dense)

    @cached_property
    def _stepper(self) -> Stepper:
        return self._integrator.prepare(self._flow, self._tolerance)

    def follow(self, task: Task, progress: Progress) -> Motion:
        dynamics, drive = self._dynamics, self._drive
        numbers = read_parameters(dynamics, task.given, drive.constants(0.0))
        first = {**numbers, **drive.constants(0.0)}
        at_start = {s: first[s] for s in dynamics.parameters}
        begin = read_start(dynamics, task.start, at_start)
        with timed(task, "compile"):
            flow, stepper = self._flow, self._stepper
        state = {**dict(zip(dynamics.states, begin.state, strict=True)), WORK: 0.0}
        rest = flow.rest(state, np.array(list(at_start.values())), 0.0)
        parts = []
        with timed(task, "integrate"):
            for span in drive.stretches(task.end):
                known = {**numbers, **drive.constants(span[0])}
                constants = np.array([known[s] for s in dynamics.parameters])
                solution = integrate(flow, stepper, constants, rest, span, progress)
                if solution.stop is Stop.STUCK:
                    raise stuck(solution)
                if solution.stop is Stop.INTERRUPTED:
                    parts.append(Part(span[0], float(solution.steps[-1]), solution, constants))
                    break
                parts.append(Part(*span, solution, constants))
                rest = solution.rest(span[1])
        segment = Segment(AS_DECLARED, 0.0, parts[-1].end, dynamics, tuple(parts))
        return Motion(
            (segment,),
            (),
            AS_DECLARED,
            {symbol.published: value for symbol, value in numbers.items()},
            begin.assumed,
            unguarded=True,
            begun=Begun(dynamics, begin),
            drive=drive,
        )


def _refuse_jerks(drive: Drive, end: float) -> None:
    felt = [time for time in drive.jerks if 0 < time < end]
    if felt:
        raise DeclarationError(
            f"a support that jerks at t = {min(felt):g} s, under one contact mode",
            expected="the declaration itself, whose contacts can slip and stick",
            advice="simulate the System, not the equations derived from it",
        )

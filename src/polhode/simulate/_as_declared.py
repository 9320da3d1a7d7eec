"""Integrates a motion whose contacts stay as they are declared."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from math import inf

import numpy as np

from polhode.algebra import Symbol
from polhode.base import DeclarationError, NumericError, Progress
from polhode.simulate._absolute_values import (
    Instant,
    SideChange,
    SideChangeCount,
    Sides,
    first_side_change,
    guards_of_sides,
    overshoots,
    shorter_span,
    sides_at,
)
from polhode.simulate._closed_loops import dead_point
from polhode.simulate._dynamics import WORK, Dynamics, EquationsOfMotion
from polhode.simulate._gimbal_lock import broken_at
from polhode.simulate._independent_speeds import SpeedChoices, SpeedWatch
from polhode.simulate._mode_integration import PieceEnd, StateValues, integrate_mode
from polhode.simulate._segment import TrajectoryPiece, state_at
from polhode.simulate._start import Start, check_start, read_start, unchecked_start
from polhode.simulate._task import AS_DECLARED, InitialState, MotionResult, Task, timed
from polhode.simulate._turned_angles import AttitudeChoices, TurnedEquations
from polhode.simulate._turned_piece import TurnedPiece, turned_piece
from polhode.simulate._values import Numbers, idle_parameters, read_parameters
from polhode.simulate._vanishing_lengths import refuse_lost_stretch, refuse_vanishing
from polhode.simulate.forcing._prescribed_motion import PrescribedMotion, prescribed_motion
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._driver import integrate
from polhode.simulate.integrate._stepping import IntegratedEquations, Integrator
from polhode.simulate.integrate._stop_criteria import StepCount, Stop, StopCriteria

_FINE = 1e-3  # s: a single step, as of a free fall, is graded down to this length
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
        self._choices = SpeedChoices(self._dynamics)
        self._attitudes: dict[int, AttitudeChoices] = {}

    def follow(self, task: Task, progress: Progress) -> MotionResult:
        pieces = _DeclaredPieces(self, task, self._drive, progress)
        dynamics, begin = pieces.dynamics, pieces.start
        state = {**dict(zip(dynamics.states, begin.state, strict=True)), WORK: 0.0}
        with timed(task, "compile"):
            pieces.put_on(sides_at(dynamics, pieces.instant(state, 0.0)))
            pieces.equations.stepper  # noqa: B018
        with timed(task, "integrate"):
            run = integrate_mode(pieces, state, 0.0, task.end, SideChangeCount())
        return MotionResult(
            run.segments,
            run.switches,
            AS_DECLARED,
            pieces.parameters,
            begin.assumed,
            unguarded=True,
            initial=InitialState(dynamics, begin),
            drive=self._drive,
        )

    @property
    def choices(self) -> SpeedChoices:
        """The equations on all choices of independent speeds, with absolute values in them."""
        return self._choices

    def attitudes(self, dynamics: Dynamics) -> AttitudeChoices:
        """Equations in other angles, for some of the former."""
        if id(dynamics) not in self._attitudes:
            made = AttitudeChoices(dynamics, self._integrator, self._tolerance)
            self._attitudes[id(dynamics)] = made
        return self._attitudes[id(dynamics)]

    def smooth(self, dynamics: Dynamics) -> _SmoothEquations:
        """Equations on given sides of all absolute values, compiled once."""
        if id(dynamics) not in self._smooth:
            made = _SmoothEquations(dynamics, self._integrator, self._tolerance)
            self._smooth[id(dynamics)] = made
        return self._smooth[id(dynamics)]


class _SmoothEquations(IntegratedEquations):
    """Compiled equations on one side of every absolute value, and the guards of these sides."""

    def __init__(self, dynamics: Dynamics, integrator: Integrator, tolerance: float | None) -> None:
        super().__init__(dynamics, integrator, tolerance)
        self.side_guards = guards_of_sides(dynamics)


class _DeclaredPieces:
    """Pieces of such a motion, in double precision."""

    name = AS_DECLARED

    def __init__(
        self, declared: AsDeclared, task: Task, drive: PrescribedMotion, progress: Progress
    ) -> None:
        self._declared = declared
        self._task = task
        self._drive = drive
        self._progress = progress
        self._tally = StepCount()
        self._turned: TurnedEquations | None = None
        self._near: tuple[int, ...] = ()
        with timed(task, "derive"):
            self._take(declared.choices.at_start(task.start, self._numbers_of))
        self.put_on({})
        self.start = self._read_start()

    def _read_start(self) -> Start:
        """The state at the start, where the declared angles may be singular."""
        start = unchecked_start(self.whole, self._task.start, self._values)
        state = dict(zip(self.whole.states, start.state.tolist(), strict=True))
        turned = self._turned_equations(state, 0.0) if self._attitudes.near(state) else None
        if turned is None:
            return read_start(self.whole, self._task.start, self._values)
        constants = self._constants_of(turned.dynamics, 0.0)
        values = turned.angles.state(state, self._constants, 0.0)
        known = dict(zip(turned.dynamics.parameters, constants.tolist(), strict=True))
        check_start(turned.dynamics, Start(values, {}), known)
        return start

    def _numbers_of(self, dynamics: Dynamics) -> Numbers:
        """The value of every constant that some equations have, at the start."""
        held = self._drive.constants(0.0)
        return {**read_parameters(dynamics, self._task.given, held), **held}

    def _take(self, whole: Dynamics) -> None:
        """Go on with the equations on other independent speeds."""
        self.whole = whole
        self._numbers = self._numbers_of(whole)
        self._constants = self._constants_at(0.0)
        self._watch = SpeedWatch(self._declared.choices.dependence(whole))
        self._attitudes = self._declared.attitudes(whole)

    @property
    def _values(self) -> Numbers:
        return dict(zip(self.whole.parameters, self._constants.tolist(), strict=True))

    @property
    def parameters(self) -> dict[str, float]:
        """The value of every parameter by name, those of prescribed motions left out."""
        held = self._drive.constants(0.0)
        return {s.published: value for s, value in self._numbers.items() if s not in held}

    @property
    def dynamics(self) -> Dynamics:
        return self.equations.dynamics

    def put_on(self, sides: Sides) -> None:
        self.equations = self._declared.smooth(self.whole.on(sides))

    def instant(self, state: StateValues, time: float) -> Instant:
        return Instant(state, self._constants, time)

    def stored_time(self, time: float) -> float:
        return time

    def next(
        self, state: StateValues, now: float, end: float, before: TrajectoryPiece | None
    ) -> PieceEnd:
        flow, then = self.equations.flow, self._constants
        turned = self._turned_equations(state, now)
        if turned is not None:
            return self._turned_end(turned, state, now, end)
        if before is None or isinstance(before, TurnedPiece):
            rest = flow.rest(state, then, now)
        else:
            rest = before.solution.rest(now)
        self._constants = self._constants_at(now)
        self._near = self._attitudes.near(state)
        piece, change, speeds = self._up_to(rest, (now, self._drive.until(now, end)))
        interrupted = piece.solution.stop is Stop.INTERRUPTED
        there: StateValues = {WORK: 0.0, **state_at(piece, piece.end)}
        if speeds is not None:
            there = self._on_speeds(speeds, there, piece.end)
        return PieceEnd(piece, there, piece.end, change, is_last=interrupted)

    def _on_speeds(
        self, speeds: tuple[Symbol, ...], state: StateValues, time: float
    ) -> StateValues:
        """Go on with other independent speeds: the state in terms of these."""
        before, here = self.whole, self.instant(state, time)
        with timed(self._task, "derive"):
            self._take(self._declared.choices.on(speeds))
        there = here.on_other_speeds(before, self.whole)
        self._constants = self._constants_at(time)
        self.put_on(sides_at(self.whole, self.instant(there, time)))
        return there

    def _up_to(
        self, rest: Array, span: tuple[float, float]
    ) -> tuple[TrajectoryPiece, SideChange | None, tuple[Symbol, ...] | None]:
        """Up to the end of a span or of a side, or to where other speeds have to be independent."""
        equations, constants = self.equations, self._constants
        criteria = self._criteria()
        # A step up to a change of side is short already: see `shorter_span` below.
        finest = inf if equations.side_guards else _FINE
        solution = integrate(
            equations.flow,
            equations.stepper,
            constants,
            rest,
            span,
            self._progress,
            criteria,
            finest,
        )
        reached = span[1] if solution.stop is Stop.TIME else float(solution.steps[-1])
        whole = TrajectoryPiece(span[0], reached, solution, constants)
        try:
            regular, speeds = self._watch.regular_part(whole)
        except NumericError:
            refuse_lost_stretch(equations.dynamics, whole)  # if that is the reason
            raise
        piece, change = first_side_change(equations.dynamics, equations.side_guards, regular)
        again = shorter_span(solution.steps, piece.end) if change is not None else None
        if again is not None:
            return self._up_to(rest, (span[0], again))
        refuse_vanishing(equations.dynamics, piece)
        if change is not None:
            return piece, change, None
        if speeds is None and solution.stop is Stop.STUCK:
            refuse_lost_stretch(equations.dynamics, whole)
            there, dynamics = state_at(whole, reached), equations.dynamics
            lost = dead_point(dynamics, there, constants, reached)
            raise lost or broken_at(dynamics.equations, there, reached)
        return piece, None, speeds

    def _criteria(self) -> StopCriteria:
        """Criteria that stop an integration so that guards, speeds and angles are checked."""
        equations, core = self.equations, self.equations.flow.core.symbols
        checks = [
            self._watch.overshoot(core, self._constants),
            self._attitudes.overshoot(core, self._near),
        ]
        if equations.side_guards:
            dynamics, guards = equations.dynamics, equations.side_guards
            checks.append(overshoots(dynamics, guards, equations.flow, self._constants))
        found = [check for check in checks if check is not None]
        if not (found or self._watch.is_needed):
            return StopCriteria()

        def over(time: float, state: Sequence[float]) -> bool:
            return any(check(time, state) for check in found)

        has_pauses = equations.side_guards or self._watch.is_needed or self._near
        return StopCriteria(_PAUSE if has_pauses else inf, over=over, tally=self._tally)

    # -- gimbal lock ------------------------------------------------------------------------------

    def _turned_equations(self, state: StateValues, now: float) -> TurnedEquations | None:
        """The equations in other angles in which to go on; None in the declared angles."""
        choices, here = self._attitudes, self.instant(state, now)
        if not choices.attitudes:
            return None
        needed = choices.needed(state, here, is_turned=self._turned is not None)
        self._turned = choices.equations(needed, state, partial(self._constants_of, now=now))
        return self._turned

    def _turned_end(
        self, turned: TurnedEquations, state: StateValues, now: float, end: float
    ) -> PieceEnd:
        """The next piece, integrated in other angles."""
        dynamics, flow = turned.dynamics, turned.flow
        declared = self._constants_at(now)
        constants = self._constants_of(dynamics, now)
        own = dict(state)
        if not set(dynamics.states) <= own.keys():
            values = turned.angles.state(state, declared, now)
            own |= zip(dynamics.states, values.tolist(), strict=True)
        span = (now, self._drive.until(now, end))
        criteria = StopCriteria(_PAUSE, over=turned.overshoot(), tally=self._tally)
        rest = flow.rest(own, constants, now)
        found = integrate(flow, turned.stepper, constants, rest, span, self._progress, criteria)
        reached = span[1] if found.stop is Stop.TIME else float(found.steps[-1])
        if found.stop is Stop.STUCK and reached <= now:
            raise broken_at(dynamics.equations, own, reached)
        inside = TrajectoryPiece(now, reached, found, constants)
        refuse_vanishing(dynamics, inside)
        piece = turned_piece(turned.angles, inside, state, declared)
        self._constants = declared
        there = {WORK: 0.0, **state_at(piece, reached), **state_at(inside, reached)}
        return PieceEnd(piece, there, reached, None, is_last=found.stop is Stop.INTERRUPTED)

    def _constants_of(self, dynamics: Dynamics, now: float) -> Array:
        known = {**self._numbers, **self._drive.constants(now)}
        return np.array([known[s] for s in dynamics.parameters])

    def _constants_at(self, now: float) -> Array:
        return self._constants_of(self.whole, now)

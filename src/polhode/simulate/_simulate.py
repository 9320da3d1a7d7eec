"""From a declaration, numbers and a start to a trajectory."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from polhode.algebra import Expr, Symbol, read_value
from polhode.base import (
    TIME,
    ByIdentity,
    DeclarationError,
    NumericError,
    Progress,
    SilentProgress,
    UnitError,
)
from polhode.derive import Automaton, automaton
from polhode.model import System, declared_parameters
from polhode.simulate._as_declared import AsDeclared
from polhode.simulate._dynamics import EquationsOfMotion, constants
from polhode.simulate._event import Event, events_of, placed, requested_events
from polhode.simulate._names import Name, published
from polhode.simulate._overlap import doubt_of, meetings, pairs_of, unwatched
from polhode.simulate._segment import cut
from polhode.simulate._task import MotionResult, Prepared, Task, timed
from polhode.simulate._trajectory import Trajectory
from polhode.simulate._validity import (
    doubt_about,
    pulling_elements,
    refuse_lost_side,
    slack_ropes,
    warn_of,
)
from polhode.simulate._values import given_values, with_formulas
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._integrators import chosen
from polhode.simulate.integrate._number_types import DOUBLES, Precision, numbers_for
from polhode.simulate.precise._wanted import PrecisionRequest


def prepared(subject: System | Automaton | EquationsOfMotion, task: Task) -> Prepared:
    """A subject with everything done that does not depend on values of parameters and start.

    Raises:
        DeclarationError: for what has no equations of motion.
    """
    if isinstance(subject, System):
        subject = _modes(ByIdentity(subject))
    if isinstance(subject, Automaton):
        if subject.contacts:  # imported only here, since most of it is for contacts alone
            from polhode.simulate.contact._through_modes import ThroughModes, can_be_followed

            if can_be_followed(subject):
                return ThroughModes(subject, task)
        with timed(task, "derive"):
            subject = subject.together.equations
    if not hasattr(subject, "kinematics"):
        raise DeclarationError(
            f"{subject!r} cannot be simulated",
            expected="a System, its automaton, or equations derived from it",
            advice="put bodies, contacts and loads together in a System(...) first",
        )
    return AsDeclared(subject, task)


@lru_cache(maxsize=8)  # few: the cache keeps the systems and their equations alive
def _modes(key: ByIdentity[System]) -> Automaton:
    """The modes of a system, derived once however often it is simulated."""
    return automaton(key.subject)


SAMPLES = 1001
_MOST_SAMPLES = 10_000_000  # every quantity that is sampled takes 80 MB then
_LONGEST = 1e18  # s; the age of the universe is less
#: Sine of the tilt at which a disk counts as lying flat.
NEAR_FLAT = 1e-3


class Experiment:
    """Successive motions of one system over one duration, compiled in the first run.

    The prescribed motions, and the names of the given parameters, are those of the first run.
    Threads must not share it: a compiled integrator holds the state of its motion.

    Args:
        subject: a declaration, its automaton, or equations derived from it.
        duration: s.
        until: events that end the motion once they happen.
        tolerance, forcing, invariants, events, samples, near_flat, precision: as in `simulate`.

    Raises:
        NumericError: for impossible samples or an impossible tolerance.
        UnitError: for a duration that cannot be read.
    """

    def __init__(
        self,
        subject: System | Automaton | EquationsOfMotion,
        duration: Any,
        *,
        tolerance: float | None = None,
        forcing: Mapping[Name, Any] | None = None,
        invariants: Mapping[str, Expr] | None = None,
        events: Mapping[str, Expr] | None = None,
        samples: int | ArrayLike = SAMPLES,
        near_flat: float = NEAR_FLAT,
        until: Collection[str] = (),
        precision: Precision = None,
    ) -> None:
        self.subject = subject
        motions = {name: self._motion(name, m) for name, m in (forcing or {}).items()}
        given = read_value("duration", duration).in_dimension(TIME)
        self.duration = _duration(given.rounded())
        self._times = _samples(samples, self.duration)
        self._wanted = PrecisionRequest(numbers_for(precision), given, samples, events or {})
        self._invariants = invariants or {}
        self._events = events or {}
        self._integrator = chosen()
        self._prepared: Prepared | None = None
        if tolerance is not None and not 0 < tolerance < 1:
            raise NumericError(f"a tolerance of {tolerance}", expected="a number between 0 and 1")
        self._plan = Task(
            given={},
            start={},
            forcing=motions,
            end=self.duration,
            integrator=self._integrator,
            tolerance=tolerance,
            near_flat=near_flat,
            seconds={},
            until=frozenset(until),
        )

    def prepare(self, parameters: Mapping[Name, Any]) -> None:
        """Derive and compile now; otherwise the first run does so.

        Args:
            parameters: those that will be given, with any values.

        Raises:
            DeclarationError: for a prescribed motion that is missing or impossible.
            NumericError: for one that is not smooth, or contacts whose forces are undetermined.
        """
        self._ready(replace(self._plan, given=parameters, seconds={}))

    def run(
        self,
        parameters: Mapping[Name, Any],
        start: Mapping[Name, Any],
        progress: Progress | None = None,
    ) -> Trajectory:
        """One motion, as `simulate` gives it; its `doubt` says if it cannot be relied on.

        Raises:
            ConstraintError, DeclarationError, NumericError, UnitError: as `simulate`.
        """
        given = with_formulas(parameters, self._parameter_names)
        begun = given_values(start)
        task = replace(self._plan, given=given, start=begun, seconds={})
        shown = progress or SilentProgress()
        shown.begin("integrating")
        try:
            motion = self._ready(task).follow(task, shown)
            run = self._trajectory(motion, task)
            if self._wanted.numbers is DOUBLES:
                run = _with(run, requested_events(run.segments, self._events))
            else:
                from polhode.simulate.precise._precisely import precisely  # mpmath is heavy

                with timed(task, "integrate"):
                    run = precisely(run, motion, task, self._wanted, shown)
            run = _ended(run, task.until)
            return _with_meetings(replace(run, doubt=doubt_about(run, task.tolerance)))
        finally:
            shown.finish()

    def _parameter_names(self) -> set[str]:
        """Names of all parameters of the system, of its bodies and of its prescribed motions."""
        motions = (m for m in self._plan.forcing.values() if isinstance(m, Expr))
        return {symbol.published for symbol in (*self._parameters(), *constants(motions))}

    def _parameters(self) -> Iterable[Symbol]:
        system = getattr(self.subject, "system", self.subject)
        return (*getattr(self.subject, "parameters", ()), *declared_parameters(system))

    def _motion(self, name: Name, motion: Any) -> Any:
        """A prescribed motion; text is a formula of t and parameters of the system."""
        if not isinstance(motion, str):
            return motion
        names = {symbol.published: symbol for symbol in self._parameters()}
        value = read_value(published(name), motion, names)
        return value.number if isinstance(value.number, Expr) else Expr.of(value.rounded())

    def _ready(self, task: Task) -> Prepared:
        if self._prepared is None:
            self._prepared = prepared(self.subject, task)
        return self._prepared

    def _trajectory(self, motion: MotionResult, task: Task) -> Trajectory:
        end = motion.segments[-1].end
        for segment in motion.segments:
            motion.drive.confirm(segment.steps)
        trajectory = Trajectory(
            system=getattr(self.subject, "system", self.subject),
            segments=motion.segments,
            parameters=motion.parameters,
            duration=end,
            t=self._times[self._times <= end],
            mode=motion.ending,
            events=events_of(motion),
            assumed=motion.assumed,
            seconds=task.seconds,
            integrator=task.integrator.name,
            invariants=self._invariants,
            resolution=motion.drive.resolution,
        )
        if motion.unguarded:
            refuse_lost_side(trajectory)
        lost = [*pulling_elements(trajectory, motion.unguarded), *slack_ropes(trajectory)]
        if not lost:
            return trajectory
        mode = trajectory.mode
        events = [Event(time, kind, mode, mode) for time, kind in lost]
        return _with(trajectory, placed(events, trajectory.segments))


def _with_meetings(run: Trajectory) -> Trajectory:
    """The same motion with an event and a doubt where bodies pass through each other."""
    if not isinstance(run.system, System) or not hasattr(run.equations, "kinetics"):
        return run
    pairs = pairs_of(ByIdentity(run.system))
    run = replace(run, assumed={**run.assumed, **unwatched(pairs)})
    if not pairs.watched:
        return run
    found = meetings([segment.rounded() for segment in run.segments], pairs)
    run = _with(run, placed([meeting.event for meeting in found], run.segments))
    return replace(run, doubt="; ".join(filter(None, (run.doubt, doubt_of(found)))))


def _with(trajectory: Trajectory, events: Iterable[Event]) -> Trajectory:
    """The same motion with further events between its start and its end."""
    start, *between, end = trajectory.events
    between = sorted([*between, *events], key=lambda event: event.time)
    return replace(trajectory, events=(start, *between, end))


def _ended(trajectory: Trajectory, until: Collection[str]) -> Trajectory:
    """The same motion up to the first of some events, if it has one of them."""
    for place, event in enumerate(trajectory.events[1:-1], 1):
        if event.kind in until and event.time > trajectory.segments[0].begin:
            segments = cut(trajectory.segments, event.time)
            mode = segments[-1].mode
            last = placed([Event(event.time, "end", mode, None)], segments)
            return replace(
                trajectory,
                segments=segments,
                duration=event.time,
                t=trajectory.t[trajectory.t <= event.time],
                mode=mode,
                events=(*trajectory.events[: place + 1], *last),
            )
    return trajectory


def _duration(duration: float) -> float:
    if duration <= 0:
        raise UnitError(f"a duration of {duration:g} s", expected="a positive one")
    if duration > _LONGEST:
        raise UnitError(f"a duration of {duration:g} s", expected=f"at most {_LONGEST:g} s")
    return duration


def _samples(samples: int | ArrayLike, duration: float) -> Array:
    if isinstance(samples, int):
        if not 2 <= samples <= _MOST_SAMPLES:
            raise NumericError(f"{samples} samples", expected=f"from 2 to {_MOST_SAMPLES}")
        return np.linspace(0.0, duration, samples)
    times = np.asarray(samples, dtype=float)
    if times.ndim != 1 or not np.all((times >= 0) & (times <= duration)):
        raise NumericError(
            f"sample times {times!r}", expected=f"a list of times from 0 to {duration:g} s"
        )
    return times


def simulate(
    subject: System | Automaton | EquationsOfMotion,
    parameters: Mapping[Name, Any],
    start: Mapping[Name, Any],
    duration: Any,
    *,
    tolerance: float | None = None,
    forcing: Mapping[Name, Any] | None = None,
    invariants: Mapping[str, Expr] | None = None,
    events: Mapping[str, Expr] | None = None,
    samples: int | ArrayLike = SAMPLES,
    near_flat: float = NEAR_FLAT,
    precision: Precision = None,
    progress: Progress | None = None,
) -> Trajectory:
    """Integrate the motion of a system to rounding, through all its contact modes.

    The contacts of a declaration stick, slip, open and close as their forces demand, and every
    change is located to rounding. Equations, in contrast, describe one contact mode: contacts stay
    as they are, and an event marks where one would have to pull.

    Absolute values in loads, |x| and x/|x|, are followed from one side of zero to the other, and
    an event marks where x passes through zero. If forces drive x back to zero from both sides, as
    dry friction does with a slip that has come to rest, it stays zero for as long as they do.

    Particles and balls that meet one another, or the support of another body, with no contact
    declared between them pass through each other: an event marks where. Pairs with other shapes
    are not watched, and listed in `assumed`; pairs that a joint links, or that overlap at the
    start, may overlap.

    If bodies meet in that way, or the energy balance or a closed loop is off by more than rounding
    explains, a `DriftWarning` is issued, and `doubt` of the trajectory gives the reason.

    Names may be symbols or published names; values are SI numbers, texts with a unit, or exact
    expressions.

    Args:
        subject: a declaration, its automaton, or equations derived from it.
        parameters: the value of every parameter; texts and expressions may be formulas of others,
            as in {"m": 0.2, "a": "30 mm", "I": "m*a**2/2"}.
        start: coordinates, speeds, rates of coordinates and dependent speeds in any consistent
            combination. What they leave open starts at zero and is listed in `assumed`;
            coordinates that close a loop are solved for. A contact with friction starts without
            slip unless the given speeds contradict that: then the speeds that rolling determines
            are listed in `assumed` with their values.
        duration: s.
        tolerance: relative, of one step; by default the best that the integrator holds.
        forcing: every prescribed function: an expression of time or its text, such as
            "sin(2*t)/10", a Python function of the time in seconds, or samples read with `sampled`
            or `read_sheet`. Features of a function shorter than a 2000th of the duration may be
            missed, see `approximated`.
        invariants: expressions whose drift is monitored, by name.
        events: expressions whose zero crossings are recorded as events, by name. One that is zero
            at the start has an event only when it passes through zero again; one that reaches zero
            where the contact mode changes, as a height does in a landing, has one there.
        samples: number of equally spaced sample times, or the times, s.
        near_flat: value, for instance of the sine of the tilt of a disk, at which it counts as
            lying flat. The motion ends there, since a flat disk has no single point of contact.
        precision: double, extended (the machine's long doubles), quadruple, or a number of
            decimal digits. Beyond double precision, values are taken exactly as written:
            "0.1 m" is a tenth, the float 0.1 its binary value.
        progress: notified of every step.

    Raises:
        ConstraintError: for start values that contradict each other or the constraints.
        DeclarationError: for unknown names, and values that are missing or impossible.
        NumericError: where the motion is not defined or cannot be continued, or where its drift
            shows that it is wrong.
        UnitError: for a value that cannot be read or has the wrong dimension.
    """
    experiment = Experiment(
        subject,
        duration,
        tolerance=tolerance,
        forcing=forcing,
        invariants=invariants,
        events=events,
        samples=samples,
        near_flat=near_flat,
        precision=precision,
    )
    run = experiment.run(parameters, start, progress)
    warn_of(run)
    return run

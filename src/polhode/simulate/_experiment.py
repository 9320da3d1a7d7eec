"""A system set up once, to be run with as many numbers and starts as one likes."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from polhode.algebra import Expr, read_value
from polhode.base import TIME, NumericError, Progress, SilentProgress, UnitError
from polhode.derive import Automaton
from polhode.model import System
from polhode.simulate._drift_warning import doubt_about
from polhode.simulate._dynamics import EquationsOfMotion
from polhode.simulate._event import Event, events_of, placed
from polhode.simulate._follow import prepared
from polhode.simulate._names import Name
from polhode.simulate._task import MotionResult, Prepared, Task, timed
from polhode.simulate._trajectory import Trajectory
from polhode.simulate._validity import pulling_contacts, refuse_lost_side
from polhode.simulate._values import given_values
from polhode.simulate._watching import with_events
from polhode.simulate.integrate._integrators import chosen
from polhode.simulate.integrate._number_types import DOUBLES, Precision, numbers_for
from polhode.simulate.integrate._stepping import Array
from polhode.simulate.precise._wanted import Wanted

SAMPLES = 1001
_LONGEST = 1e18  # s; the world is not as old
#: Sine of the tilt at which a disk counts as lying flat.
NEAR_FLAT = 1e-3


class Experiment:
    """Motions of one system over one duration, one after the other; compiled for the first.

    Which parameters are given, and the prescribed motions, stay as they were in the first run.
    Not to be shared by threads: the compiled integrators hold the motion they are at.

    Args:
        subject: a declaration, its automaton, or equations derived from it.
        duration: s.
        until: events that end the motion once they happen.
        tolerance, forcing, invariants, events, samples, near_flat, precision: as in `simulate`.

    Raises:
        NumericError: for samples or a tolerance that cannot be.
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
        given = read_value("duration", duration).in_dimension(TIME)
        self.duration = _duration(given.rounded())
        self._times = _samples(samples, self.duration)
        self._wanted = Wanted(numbers_for(precision), given, samples, events or {})
        self._invariants = invariants or {}
        self._events = events or {}
        self._integrator = chosen()
        self._prepared: Prepared | None = None
        self._plan = Task(
            given={},
            start={},
            forcing=forcing or {},
            end=self.duration,
            integrator=self._integrator,
            tolerance=_tolerance(tolerance),
            near_flat=near_flat,
            seconds={},
            until=frozenset(until),
        )

    def prepare(self, parameters: Mapping[Name, Any]) -> None:
        """Do what does not depend on numbers, as the first run does it otherwise.

        Args:
            parameters: those that will be given.

        Raises:
            DeclarationError: for a prescribed motion that is missing or cannot be.
            NumericError: for one that is not smooth, or contacts that cannot be followed.
        """
        self._ready(replace(self._plan, given=parameters, seconds={}))

    def run(
        self,
        parameters: Mapping[Name, Any],
        start: Mapping[Name, Any],
        progress: Progress | None = None,
    ) -> Trajectory:
        """One motion, as `simulate` gives it; what speaks against it is in its `doubt`.

        Raises:
            ConstraintError, DeclarationError, NumericError, UnitError: as `simulate`.
        """
        given, begun = given_values(parameters), given_values(start)
        task = replace(self._plan, given=given, start=begun, seconds={})
        with _shown(progress or SilentProgress()) as shown:
            motion = self._ready(task).follow(task, shown)
            run = self._trajectory(motion, task)
            if self._wanted.numbers is DOUBLES:
                run = with_events(run, self._events)
            else:
                from polhode.simulate.precise._precisely import precisely  # that few enter

                with timed(task, "integrate"):
                    run = precisely(run, motion, task, self._wanted, shown)
            return replace(run, doubt=doubt_about(run, task.tolerance))

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
            trajectory = replace(trajectory, events=_with_pulls(trajectory))
        return trajectory


def _with_pulls(trajectory: Trajectory) -> tuple[Event, ...]:
    """What happens, and where a contact would have had to let go."""
    mode = trajectory.mode
    pulls = (Event(t, f"{name} pulls", mode, mode) for t, name in pulling_contacts(trajectory))
    start, *changes, end = trajectory.events
    between = sorted([*changes, *placed(pulls, trajectory.segments)], key=lambda e: e.time)
    return (start, *between, end)


def _duration(duration: float) -> float:
    if duration <= 0:
        raise UnitError(f"a duration of {duration:g} s", expected="a positive one")
    if duration > _LONGEST:
        raise UnitError(f"a duration of {duration:g} s", expected=f"at most {_LONGEST:g} s")
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


@contextmanager
def _shown(progress: Progress) -> Iterator[Progress]:
    progress.begin("integrating")
    try:
        yield progress
    finally:
        progress.finish()

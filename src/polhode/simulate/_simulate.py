"""From a declaration, numbers and a start to a trajectory."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from polhode.algebra import Expr
from polhode.base import TIME, NumericError, Progress, SilentProgress, UnitError, to_si
from polhode.derive import Automaton
from polhode.model import System
from polhode.simulate._dynamics import EquationsOfMotion
from polhode.simulate._follow import Motion, Task, follow
from polhode.simulate._integrators import Array, chosen
from polhode.simulate._names import Name
from polhode.simulate._trajectory import Event, Trajectory
from polhode.simulate._validity import pulling_contacts, refuse_lost_side
from polhode.simulate._watching import with_events

SAMPLES = 1001
#: Sine of the tilt at which a disk counts as lying flat.
NEAR_FLAT = 1e-3


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
    progress: Progress | None = None,
) -> Trajectory:
    """Integrate the motion of a system to rounding, through all its contact modes.

    Contacts of a declaration stick, slip, open and close as their forces demand, and every change
    is found to rounding. Equations, on the other hand, are those of one contact mode: they are
    kept to, and a contact that would have to pull is an event.

    Names may be symbols or published names; values are SI numbers, texts with a unit, or exact
    expressions.

    Args:
        subject: a declaration, its automaton, or equations derived from it.
        parameters: the value of every parameter.
        start: coordinates, speeds, rates of coordinates and dependent speeds in any mixture that
            does not contradict itself. What they leave open starts at zero and is listed in
            `assumed`; coordinates that close a loop are solved for.
        duration: s.
        tolerance: relative, of one step; by default the best that the integrator holds.
        forcing: every prescribed function: an expression of time, a Python function of the time
            in seconds, or samples read with `sampled` or `read_sheet`.
        invariants: expressions to be watched for drift, by name.
        events: expressions whose passing through zero is recorded, by name.
        samples: number of equally spaced sample times, or the times, s.
        near_flat: value of the sine of the tilt of a disk, for instance, at which it counts as
            lying flat: the point of contact is not defined beyond, and the motion ends there.
        progress: told of every step.

    Raises:
        ConstraintError: for start values that contradict each other or the constraints.
        DeclarationError: for names that are not known, and values that are missing or impossible.
        NumericError: where the motion is not defined or cannot be continued.
        UnitError: for a value that cannot be read or has the wrong dimension.
    """
    seconds: dict[str, float] = {}
    end = _duration(duration)
    times = _samples(samples, end)
    task = Task(
        given=parameters,
        start=start,
        forcing=forcing or {},
        end=end,
        integrator=chosen(),
        tolerance=_tolerance(tolerance),
        near_flat=near_flat,
        seconds=seconds,
    )
    with _shown(progress or SilentProgress()) as shown:
        motion = follow(subject, task, shown)
    end = motion.segments[-1].end
    trajectory = Trajectory(
        segments=motion.segments,
        parameters=motion.parameters,
        duration=end,
        t=times[times <= end],
        mode=motion.ending,
        events=_events(motion),
        assumed=motion.assumed,
        seconds=seconds,
        integrator=task.integrator.name,
        invariants=invariants or {},
    )
    if motion.unguarded:
        refuse_lost_side(trajectory)
        trajectory = replace(trajectory, events=_with_pulls(trajectory))
    return with_events(trajectory, events or {})


def _events(motion: Motion) -> tuple[Event, ...]:
    end = motion.segments[-1].end
    return (
        Event(0.0, "start", None, motion.segments[0].mode),
        *(Event(c.time, c.kind, c.before, c.after) for c in motion.changes),
        Event(end, "end", motion.ending, None),
    )


def _with_pulls(trajectory: Trajectory) -> tuple[Event, ...]:
    """Start and end, and where a contact would have had to let go."""
    mode = trajectory.mode
    pulls = (Event(t, f"{name} pulls", mode, mode) for t, name in pulling_contacts(trajectory))
    start, end = trajectory.events
    return (start, *sorted(pulls, key=lambda event: event.time), end)


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


@contextmanager
def _shown(progress: Progress) -> Iterator[Progress]:
    progress.begin("integrating")
    try:
        yield progress
    finally:
        progress.finish()

"""From a declaration, numbers and a start to a trajectory."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from numpy.typing import ArrayLike

from polhode.algebra import Expr
from polhode.base import Progress
from polhode.derive import Automaton
from polhode.model import System
from polhode.simulate._drift_warning import warn_of
from polhode.simulate._dynamics import EquationsOfMotion
from polhode.simulate._experiment import NEAR_FLAT, SAMPLES, Experiment
from polhode.simulate._names import Name
from polhode.simulate._trajectory import Trajectory
from polhode.simulate.integrate._number_types import Precision


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

    Contacts of a declaration stick, slip, open and close as their forces demand, and every change
    is found to rounding. Equations, on the other hand, are those of one contact mode: they are
    kept to, and a contact that would have to pull is an event.

    Absolute values in loads, |x| and x/|x|, are followed from one side of zero to the other: where
    x passes zero is an event. Where forces drive it back to zero from both sides, as dry friction
    does a slip that has come to rest, it stays zero for as long as they do.

    A motion whose energy balance or closed loops are off by more than rounding explains says so by
    a `DriftWarning` and in its `doubt`.

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
            in seconds, or samples read with `sampled` or `read_sheet`. What a function does for
            less than a 2000th of the duration may be missed, see `approximated`.
        invariants: expressions to be watched for drift, by name.
        events: expressions whose passing through zero is recorded, by name.
        samples: number of equally spaced sample times, or the times, s.
        near_flat: value of the sine of the tilt of a disk, for instance, at which it counts as
            lying flat: the point of contact is not defined beyond, and the motion ends there.
        precision: double, extended (the machine's long doubles), quadruple, or a number of
            decimal digits. Values are then taken exactly as they are written: "0.1 m" is a
            tenth, the float 0.1 its binary value.
        progress: told of every step.

    Raises:
        ConstraintError: for start values that contradict each other or the constraints.
        DeclarationError: for names that are not known, and values that are missing or impossible.
        NumericError: where the motion is not defined or cannot be continued, or where it is wrong
            beyond doubt, as its drift tells.
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

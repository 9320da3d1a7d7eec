"""Whether a computed motion can be relied on.

It must stay where its equations hold, its contacts may only push, and its energy must balance.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from math import ceil, isfinite, log10
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode.algebra import Expr
from polhode.base import DriftWarning, NumericError, bisected
from polhode.derive import height_of
from polhode.model import Contact, Rope
from polhode.simulate._closed_loops import passed_dead_point
from polhode.simulate._drift import imbalance_of
from polhode.simulate._gimbal_lock import closest_to_gimbal_lock
from polhode.simulate._segment import Segment
from polhode.simulate._singular_constraints import turned_at_dead_point
from polhode.simulate.integrate._arrays import Array

if TYPE_CHECKING:
    from polhode.simulate._trajectory import Trajectory


#: Instants at which a motion is checked: no more than a piece keeps the states of, so that the
#: checks of several quantities share them.
_CHECKS = 10_000

_UNLOADED = 1e-12  # tension of a rope, of kinetic energy over its length, that is only rounding


def refuse_lost_side(trajectory: Trajectory) -> None:
    """Refuse a motion that left the side its equations were derived for.

    Raises:
        NumericError: with the time; a disk that falls flat reaches sin θ = 0, a rod the floor.
    """
    equations: Any = trajectory.equations
    flat = (c for c in _contacts(trajectory) if c.may_fall_flat)
    heights = [height_of(equations, contact) for contact in flat]
    above = [height for height in heights if trajectory.evaluate(height, 0.0) > 0]
    for sign in (*equations.assumed_positive, *above, *getattr(equations, "limits", ())):
        time = _first_fall(trajectory, sign)
        if time is not None:
            raise NumericError(
                f"{sign} reaches zero at t = {time:.6g} s",
                expected="a positive value throughout: the equations hold on that side only",
                advice=f"end the run before that time, for instance at {0.99 * time:.3g} s",
            )


def _contacts(trajectory: Trajectory) -> list[Contact]:
    elements = getattr(trajectory.equations.system, "elements", ())
    return [element for element in elements if isinstance(element, Contact)]


def pulling_elements(trajectory: Trajectory, unguarded: bool) -> Iterator[tuple[float, str]]:
    """Contacts, and joints that stand for one, that would have to pull: from when on, and in words.

    Of forces that Newton's laws leave open, those of least norm are looked at: with others the
    contact might push.

    Args:
        unguarded: whether contacts are kept closed; otherwise those that would have to pull open.
    """
    equations: Any = trajectory.equations
    if len({segment.mode for segment in trajectory.segments}) > 1:
        return
    for element in getattr(equations.system, "elements", ()):
        push = element.push
        is_open = push in equations.undetermined
        opens = isinstance(element, Contact) and not unguarded
        if push is not None and not opens and (is_open or push in trajectory.reactions):
            time = _first_fall(trajectory, equations.least[push] if is_open else push)
            if time is not None:
                yield time, f"{element.name} {'may pull' if is_open else 'pulls'}"


def slack_ropes(trajectory: Trajectory) -> Iterator[tuple[float, str]]:
    """Ropes that would have to push to stay taut: from when on, and in words."""
    equations: Any = trajectory.equations
    for rope in getattr(equations.system, "elements", ()):
        if not isinstance(rope, Rope):
            continue
        (tension,) = (r.name for r in equations.kinetics.restraints[rope.name])
        is_open = tension in equations.undetermined
        if is_open or tension in trajectory.reactions:
            # A rope without a load is not slack: in free flight its tension is rounding.
            length = float(trajectory.evaluate(rope.length(equations.kinetics.places), 0.0))
            moving = np.max(_sampled(trajectory, equations.kinetic_energy)[1]) / (length or np.inf)
            wanted = equations.least[tension] if is_open else tension
            times, values = _sampled(trajectory, wanted)
            pushing = np.flatnonzero(values < -_UNLOADED * moving)
            if pushing.size:
                words = f"{rope.name} {'may go' if is_open else 'goes'} slack"
                yield float(times[pushing[0]]), words


def _sampled(trajectory: Trajectory, quantity: Expr | str) -> tuple[Array, Array]:
    times = np.linspace(0.0, trajectory.duration, _CHECKS)
    return times, np.broadcast_to(trajectory.evaluate(quantity, times), times.shape)


def _first_fall(trajectory: Trajectory, quantity: Expr | str) -> float | None:
    """When a quantity ceases to be positive; None where it is positive whenever it is checked."""
    times, values = _sampled(trajectory, quantity)
    fallen = np.flatnonzero(~(values > 0))
    if not fallen.size:
        return None
    first = int(fallen[0])
    if first == 0:
        return float(times[0])
    return bisected(
        lambda time: float(trajectory.evaluate(quantity, time)),
        float(times[first - 1]),
        float(times[first]),
    )


# -- whether energy and closed loops balance to rounding -------------------------------------------
#
# One step of an integrator leaves the energy off by a few roundings (or by its tolerance, if that
# is larger); over many steps these add up at worst in proportion to their number. Near a singular
# position, such as a disk about to lie flat, terms that nearly cancel lose further digits. A larger
# imbalance is not rounding: a force jumps unnoticed, or does work that was not counted.

_LOST = 1e7  # roundings allowed for cancellation
_PER_STEP = 100.0  # roundings (or tolerances) allowed for every step
_WRONG = 1e-3  # of the energy or the lengths: a larger imbalance is an error, not a warning


def doubt_about(run: Trajectory, tolerance: float | None) -> str:
    """Why a motion cannot be relied on; empty if it can.

    Args:
        tolerance: of its steps, if one was requested.

    Raises:
        NumericError: for a motion that is certainly wrong.
    """
    if (lost := turned_at_dead_point(run.segments)) is not None:
        raise lost
    numbers = run.segments[0].numbers
    rounding = 2.0 ** (1 - numbers.bits)
    step = max(rounding, tolerance or 0.0)
    steps = sum(len(segment.steps) for segment in run.segments)
    allowed = _LOST * rounding + _PER_STEP * step * steps
    for what, size in imbalance_of(run.segments).items():
        if not isfinite(size) or size <= allowed:
            continue
        reason = f"{what} is off by {size:.1e} of its scale, where rounding explains {allowed:.0e}"
        if size > max(_WRONG, allowed):
            raise passed_dead_point(run.segments) or NumericError(
                f"a motion that is wrong: {reason}",
                expected="errors of rounding alone",
                advice="check for a load that jumps, or whose power is not that of its force; if "
                "there is none, please report this",
            )
        return reason
    closest = closest_to_gimbal_lock(run.segments)
    return (closest.doubt if closest is not None else "") or _doubt_of_speeds(run.segments)


def _doubt_of_speeds(segments: Sequence[Segment]) -> str:
    """What is lost where the rates of coordinates hardly follow from the speeds a user chose.

    With u = q̇ sin q, the rate u/sin q is known to the rounding of the largest speed so far, divided
    by sin q.
    """
    for segment in segments:
        equations = segment.dynamics.equations
        if not getattr(equations.system, "speeds", ()):
            continue
        rates, speeds = equations.kinematics, list(map(Expr.generator, equations.speeds))
        slopes = [(q, rate.diff(u)) for q, rate in rates.items() for u in equations.speeds]
        slopes = [s for s in slopes if any(v.kind.varies for v in s[1].denominator.symbols())]
        for part in segment.parts if slopes else ():
            if not part.angles_replaced.isdisjoint(equations.coordinates):
                continue
            times = part.solution.steps[part.solution.steps <= part.end]
            wanted = [*(slope for _, slope in slopes), *(rates[q] for q, _ in slopes), *speeds]
            values = np.abs(part.values(segment.dynamics, wanted, times).astype(float))
            factors, moving, others = np.split(values, [len(slopes), 2 * len(slopes)])
            fastest = np.max(moving, axis=1)
            losses = factors * np.maximum.accumulate(np.max(others, axis=0))
            losses /= np.where(fastest > 0, fastest, np.inf)[:, None]
            i, k = np.unravel_index(np.argmax(losses), losses.shape)
            if losses[i, k] > _LOST:
                return (
                    f"{slopes[i][0].published} hardly follows from the chosen speeds at "
                    f"t = {float(times[k]):.6g} s, where up to {ceil(log10(losses[i, k]))} digits "
                    "are lost; choose other speeds"
                )
    return ""


def refuse_doubt(run: Trajectory) -> None:
    """Refuse a motion that cannot be relied on.

    Raises:
        NumericError: with the reason.
    """
    if run.doubt:
        raise NumericError(
            f"a motion that cannot be relied on: {run.doubt}",
            expected="one whose errors rounding explains",
        )


def warn_of(run: Trajectory) -> None:
    """Warn of a motion that cannot be relied on."""
    if run.doubt:
        warnings.warn(f"this motion cannot be relied on: {run.doubt}", DriftWarning, stacklevel=3)

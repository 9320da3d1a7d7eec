"""Motions integrated from the numeric balance of every body: a second opinion on a course."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from math import isclose
from typing import Any

import numpy as np
from scipy.differentiate import derivative
from scipy.integrate import solve_ivp

from polhode.algebra import Symbol
from polhode.base import PolhodeError
from polhode.claims._verdict import Confirmation
from polhode.claims.balance._declared import declared
from polhode.claims.balance._newton_euler import true_motion
from polhode.claims.contexts._sampled_motion import TIME, Followed
from polhode.claims.states._numeric import Array, number
from polhode.model import System

_TOLERANCES = (1e-6, 1e-9)
_FINE = 1e-13
_STEP = 0.02  # s
_ROUNDING = 1e-5


def followed_anew(followed: Followed, sample: int) -> Confirmation | None:
    """Both sides at a sample of a motion, with the motion and all accelerations found anew.

    Loosely at first: what then agrees to several digits does not do so by chance.
    """
    found = (_followed_within(tolerance, followed, sample) for tolerance in _TOLERANCES)
    loose = next(found)
    return loose if loose is None or loose.agrees else next(found)


def _followed_within(tolerance: float, followed: Followed, sample: int) -> Confirmation | None:
    course, component = followed.course, followed.component
    system = course.run.equations.system
    since = float(course.times[sample])
    try:
        state = _moved(system, _whole(system, course.start), since, tolerance)
    except (PolhodeError, ArithmeticError, KeyError):
        return None
    numbers = {**course.start, **state, TIME: since + course.begin}
    left, right = (float(number(side, numbers)) for side in (component.left, component.right))
    told = [float(side[sample]) for side in followed.sides]
    scale = max(*map(abs, told), 1e-12)
    agrees = all(
        isclose(one, other, rel_tol=_ROUNDING, abs_tol=_ROUNDING * scale)
        for one, other in zip((left, right), told, strict=True)
    )
    return Confirmation({"t": since + course.begin}, left, right, agrees)


def rate_along_motion(
    system: System, state: Mapping[Symbol, float], speeds: Collection[Symbol], symbol: Symbol
) -> float:
    """Rate of a number of the motion through a state, such as a reaction, by differences.

    Args:
        system: the declaration.
        state: parameters, coordinates and speeds.
        speeds: enough of them to fix all others.
        symbol: of the number.
    """
    start = _whole(system, state)
    free = set(declared(system).speeds) - set(speeds)

    def at(times: Array) -> Array:
        moved = [_moved(system, start, time, _FINE, free)[symbol] for time in np.ravel(times)]
        return np.reshape(moved, np.shape(times))

    found = derivative(at, 0.0, initial_step=_STEP, order=8, maxiter=4)
    return float(found.df)


def _whole(system: System, start: Mapping[Symbol, float]) -> dict[Symbol, float]:
    """With a number for parameters on which the motion does not depend."""
    return dict.fromkeys(declared(system).parameters, 1.0) | dict(start)


def _moved(
    system: System,
    start: dict[Symbol, float],
    duration: float,
    tolerance: float,
    free: Collection[Symbol] = (),
) -> dict[Symbol, float]:
    """Every number of the state a while after a start; some speeds follow from the others."""
    first = true_motion(system, start)
    rated = {s for s in first if s.derivative() in first and s not in free}
    moving = sorted(rated, key=lambda s: s.published)
    fixed = {s: v for s, v in start.items() if not s.kind.varies}

    def all_numbers(values: Any) -> dict[Symbol, float]:
        return true_motion(system, {**fixed, **dict(zip(moving, values, strict=True))})

    def rates(_: float, values: Array) -> list[float]:
        found = all_numbers(values)
        return [found[s.derivative()] for s in moving]

    if not duration:
        return first
    run = solve_ivp(
        rates,
        (0.0, duration),
        [first[s] for s in moving],
        method="DOP853",
        rtol=tolerance,
        atol=tolerance,
    )
    return all_numbers(run.y[:, -1])

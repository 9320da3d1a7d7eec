"""Accelerations and reactions at one state, by numbers, from the balance of every body.

Works from the declaration alone and shares nothing with `derive`: every body keeps all its
degrees of freedom, constraints are differentiated by jets, and one linear system gives all rates
of speeds and all reactions. Redundant supports get the least-squares reactions, or those given.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np

from polhode.algebra import Symbol, SymbolKind, Vector
from polhode.base import NumericError
from polhode.claims.balance._declared import Placement, declared, reaction_symbol
from polhode.claims.balance._jets import Array
from polhode.claims.balance._trial import Trial
from polhode.model import Body, Restraint, System

_TOLERANCE = 1e-8  # relative; to which constraints and supports must agree
_TINY = 1e-12  # rows below this are zero and are not scaled
_FINE = 1e-13  # tolerance of motions that are differentiated
_STEP = 0.02  # s

Numbers = dict[Symbol, float]


def true_motion(system: System, state: Mapping[Symbol, float]) -> Numbers:
    """Numbers of every coordinate, speed, acceleration and reaction at a state, SI.

    Args:
        system: the declaration.
        state: parameters, coordinates, enough speeds to fix all others, and reactions of redundant
            supports that are known.

    Raises `NumericError` where supports contradict one another or the state leaves speeds open.
    """
    known = declared(system)
    speeds = _speeds(known, state)
    trial = _trials(known, state, speeds)
    constraints, constrained = _constraints(trial)
    balances, loads = _balances(known, trial)
    # unknowns: rates of speeds, then reactions, on which the constraints do not depend
    count = balances.shape[1] - constraints.shape[1]
    rows = np.vstack([np.hstack([constraints, np.zeros((len(constraints), count))]), balances])
    right = np.concatenate([constrained, loads])
    symbols = [*speeds, *(reaction_symbol(r.name) for r in known.restraints)]
    given = {s: state[s] for s in symbols[len(speeds) :] if s in state}
    rows, right = _holding((rows, right), given, symbols)
    found = _solve(rows, right, "supports that contradict one another")
    reactions = {
        reaction_symbol(r.name): float(force)
        for r, force in zip(known.restraints, found[len(speeds) :], strict=True)
    }
    return _numbers(trial, state, speeds, found) | reactions


def constrained_motion(
    system: System, state: Mapping[Symbol, float], accelerations: Mapping[Symbol, float]
) -> Numbers:
    """The same for some motion that the constraints allow: these accelerations, and no forces."""
    known = declared(system)
    speeds = _speeds(known, state)
    trial = _trials(known, state, speeds)
    fixed = {s: a for s in speeds if (a := accelerations.get(s.derivative())) is not None}
    rows, right = _holding(_constraints(trial), fixed, list(speeds))
    found = _solve(rows, right, "accelerations that the constraints rule out")
    return _numbers(trial, state, speeds, found)


def trial_of(system: System, numbers: Mapping[Symbol, float]) -> Trial:
    """The motion of all bodies with these numbers: of speeds, their rates, and all that is given.

    Reactions are no part of it, for their rates are not known.
    """
    known = declared(system)
    given = (SymbolKind.PARAMETER, SymbolKind.COORDINATE, SymbolKind.TIME)
    state = {
        s: number
        for s, number in numbers.items()
        if (s.kind in given and not s.order) or s.base() in known.functions
    }
    speeds = {s: np.array([numbers[s]]) for s in known.speeds}
    rates = {s: np.array([numbers[s.derivative()]]) for s in known.speeds}
    return Trial(known, state, speeds, rates)


# -- along a motion -------------------------------------------------------------------------------


def moved(
    system: System,
    start: Mapping[Symbol, float],
    duration: float,
    tolerance: float,
    dependent: Collection[Symbol] = (),
) -> Numbers:
    """Every number of the state some time after a start, integrated by SciPy.

    Args:
        system: the declaration.
        start: parameters, coordinates and speeds; parameters that are missing play no part.
        duration: s.
        tolerance: of the integration, relative and absolute.
        dependent: speeds that follow from the others and are not integrated.
    """
    from scipy.integrate import solve_ivp  # slow to import, and few claims are refuted by motions

    start = dict.fromkeys(declared(system).parameters, 1.0) | dict(start)
    first = true_motion(system, start)
    rated = {s for s in first if s.derivative() in first and s not in dependent}
    moving = sorted(rated, key=lambda s: s.published)
    fixed = {s: v for s, v in start.items() if not s.kind.varies}

    def all_numbers(values: Any) -> Numbers:
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
    from scipy.differentiate import derivative  # slow to import, and rates of forces are rare

    dependent = set(declared(system).speeds) - set(speeds)

    def at(times: Array) -> Array:
        found = [moved(system, state, time, _FINE, dependent)[symbol] for time in np.ravel(times)]
        return np.reshape(found, np.shape(times))

    return float(derivative(at, 0.0, initial_step=_STEP, order=8, maxiter=4).df)


# -- the equations, from trial motions ------------------------------------------------------------


def _speeds(known: Placement, state: Mapping[Symbol, float]) -> Numbers:
    """Every declared speed, from those given and the velocity constraints."""
    steps = _steps(len(known.speeds))
    trial = Trial(known, state, dict(zip(known.speeds, steps, strict=True)), {})
    slips, _ = trial.slips()
    given = {s: state[s] for s in known.speeds if s in state}
    constraints = slips[:, 1:] - slips[:, :1], -slips[:, 0]
    rows, right = _holding(constraints, given, known.speeds)
    found = _solve(rows, right, "speeds that the constraints rule out")
    return dict(zip(known.speeds, map(float, found), strict=True))


def _trials(known: Placement, state: Mapping[Symbol, float], speeds: Numbers) -> Trial:
    """The state with all rates of speeds zero, and with each of them one in turn.

    Everything is affine in these rates, so that differences of the trials are its coefficients.
    """
    steps = _steps(len(speeds))
    still = {s: np.full(len(speeds) + 1, v) for s, v in speeds.items()}
    return Trial(known, state, still, dict(zip(speeds, steps, strict=True)))


def _steps(count: int) -> Array:
    return np.hstack([np.zeros((count, 1)), np.eye(count)])


def _holding(
    equations: tuple[Array, Array], given: Mapping[Symbol, float], symbols: Sequence[Symbol]
) -> tuple[Array, Array]:
    """Rows over symbols and right-hand sides, with rows below that hold those given."""
    rows, right = equations
    held = [[float(s == g) for s in symbols] for g in given]
    below = np.reshape(held, (len(given), len(symbols)))
    return np.vstack([rows, below]), np.concatenate([right, list(given.values())])


def _constraints(trial: Trial) -> tuple[Array, Array]:
    """Rates of the ruled-out velocities vanish: rows over the rates of speeds, right-hand sides."""
    _, rates = trial.slips()
    return rates[:, 1:] - rates[:, :1], -rates[:, 0]


def _balances(known: Placement, trial: Trial) -> tuple[Array, Array]:
    """Newton and Euler for every body: rows over the rates of speeds and then the reactions."""
    wrenches = [_reaction_wrenches(known, trial, r) for r in known.restraints]
    rows, right = [], []
    for body in trial.bodies:
        force = trial.acceleration(body) * trial.scalar(body.mass)
        needed = trial.values([*force, *trial.spin_rate(body)])
        columns = [wrench.get(body, np.zeros(6)) for wrench in wrenches]
        reactions = np.reshape(columns, (len(wrenches), 6)).T
        applied = np.zeros(6)
        for action in known.actions:
            if action.body == body:
                push, arm, couple = map(trial.now, (action.force, action.arm, action.couple))
                applied = applied + np.concatenate([push, couple + np.cross(arm, push)])
        rows.append(np.hstack([needed[:, 1:] - needed[:, :1], -reactions]))
        right.append(applied - needed[:, 0])
    return np.vstack(rows), np.concatenate(right)


def _reaction_wrenches(known: Placement, trial: Trial, restraint: Restraint) -> dict[Body, Array]:
    """Force and torque about the centre of mass that one unit of a reaction puts on the bodies."""
    direction = trial.now(restraint.direction) + _friction(known, trial, restraint)
    acting = {restraint.body: _wrench(trial, direction, restraint.arm)}
    if restraint.other is not None:
        acting[restraint.other] = _wrench(trial, -direction, restraint.other_arm)
    return acting


def _wrench(trial: Trial, direction: Array, arm: Vector | None) -> Array:
    if arm is None:
        return np.concatenate([np.zeros(3), direction])
    return np.concatenate([direction, np.cross(trial.now(arm), direction)])


def _friction(known: Placement, trial: Trial, restraint: Restraint) -> Array:
    """Sliding friction that goes with one unit of a normal force."""
    friction = known.frictions.get(restraint.name)
    if friction is None:
        return np.zeros(3)
    slip = np.zeros(3)
    for _, direction in friction.directions:
        speed = trial.values([trial.slip(restraint, direction)])[0, 0]
        slip = slip + speed * trial.now(direction)
    coefficient = trial.values([trial.scalar(friction.coefficient)])[0, 0]
    return np.asarray(-coefficient * slip / np.linalg.norm(slip))


def _numbers(
    trial: Trial, state: Mapping[Symbol, float], speeds: Numbers, found: Sequence[float] | Array
) -> Numbers:
    """Of the motion with these rates of speeds, in which all accelerations are affine."""
    rates = np.asarray(found[: len(speeds)], dtype=float)
    numbers = {**state, **speeds}
    numbers |= {s.derivative(): float(rate) for s, rate in zip(speeds, rates, strict=True)}
    for q in trial.coordinates:
        jet = trial.number(q)
        still, *moved = jet.second
        numbers[q.derivative()] = float(jet.rate[0])
        numbers[q.derivative().derivative()] = float(still + (np.array(moved) - still) @ rates)
    return numbers


def _solve(rows: Array, right: Array, trouble: str) -> Array:
    """Least squares of rows scaled alike; raises `NumericError` where they cannot all be met."""
    if not rows.shape[1]:
        return np.zeros(0)
    largest = np.abs(rows).max(axis=1)
    scale = np.where(largest > _TINY, largest, 1.0)
    rows, right = rows / scale[:, None], right / scale
    found = np.asarray(np.linalg.lstsq(rows, right, rcond=1e-12)[0])
    size = 1.0 + float(np.abs(right).max(initial=0.0))
    if not np.allclose(rows @ found, right, rtol=_TOLERANCE, atol=_TOLERANCE * size):
        raise NumericError(trouble, expected="a state that all supports allow")
    return found

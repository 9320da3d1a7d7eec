"""Accelerations and reactions at one state, by numbers, from the balance of every body.

Works from the declaration alone and shares nothing with `derive`: every body obeys m a = F and
dL/dt = τ about its centre of mass, constraints are differentiated by jets, and one linear system
gives all rates of speeds and all reactions. Reactions of redundant supports are those of least
squares, unless they are given.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from polhode.algebra import Symbol, SymbolKind, Vector
from polhode.base import NumericError, integrated
from polhode.judge.balance._declared import Placement, declared, reaction_symbol
from polhode.judge.balance._jets import Array
from polhode.judge.balance._trial import Trial
from polhode.model import Action, Body, Friction, Restraint, System

_TOLERANCE = 1e-8  # relative residual up to which the linear system counts as solvable
_TINY = 1e-12  # rows below this are rounding of zero rows and must not be scaled up
_FINE = 1e-13  # tolerance of motions that are differentiated: differences magnify their error
_STEPS = (0.0025, 0.005, 0.01, 0.02)  # s, of the differences

Numbers = dict[Symbol, float]


def true_motion(system: System, state: Mapping[Symbol, float]) -> Numbers:
    """The value of every coordinate, speed, acceleration and reaction at a state, SI.

    Args:
        system: the declaration.
        state: parameters, coordinates, enough speeds to determine all others, and any known
            reactions of redundant supports.

    Raises `NumericError` where supports contradict one another or the state leaves speeds open.
    """
    known = declared(system)
    speeds = _speeds(known, state)
    trial = _trials(known, state, speeds)
    constraints, constrained = _constraints(trial)
    balances, loads = _balances(known, trial)
    powers = _support_powers(known, trial)
    # Unknowns: rates of speeds u̇, then reactions λ. The constraints C u̇ = c do not contain λ, the
    # virtual power of supports that move freely, V λ = 0, no u̇:
    #     [ C    0 ]        [ c ]
    #     [ M   -W ] [u̇]    [ f ]
    #     [ 0    V ] [λ]  = [ 0 ]
    count = balances.shape[1] - constraints.shape[1]
    above = np.hstack([constraints, np.zeros((len(constraints), count))])
    below = np.hstack([np.zeros((len(powers), len(speeds))), powers])
    rows = np.vstack([above, balances, below])
    right = np.concatenate([constrained, loads, np.zeros(len(powers))])
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
    """The same for a virtual motion that obeys the constraints and has these accelerations.

    No forces enter.
    """
    known = declared(system)
    speeds = _speeds(known, state)
    trial = _trials(known, state, speeds)
    fixed = {s: a for s in speeds if (a := accelerations.get(s.derivative())) is not None}
    rows, right = _holding(_constraints(trial), fixed, list(speeds))
    found = _solve(rows, right, "accelerations that the constraints rule out")
    return _numbers(trial, state, speeds, found)


def trial_of(system: System, numbers: Mapping[Symbol, float]) -> Trial:
    """The motion of all bodies for these values of parameters, coordinates, speeds and their rates.

    Reactions are not part of it, since their rates are unknown.
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
    """The values of all quantities some time after a start, integrated by extrapolation.

    Args:
        system: the declaration.
        start: parameters, coordinates and speeds; missing parameters are set to 1, since the motion
            does not depend on them.
        duration: s.
        tolerance: of the integration, relative.
        dependent: speeds that follow from the others and are not integrated.
    """
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
    last = integrated(rates, 0.0, duration, [first[s] for s in moving], tolerance)
    return all_numbers(last)


def rate_along_motion(
    system: System, state: Mapping[Symbol, float], speeds: Collection[Symbol], symbol: Symbol
) -> float:
    """The rate of a quantity along the motion through a state, such as a reaction, by differences.

    Args:
        system: the declaration.
        state: parameters, coordinates and speeds.
        speeds: enough of them to determine all others.
        symbol: the quantity.
    """
    dependent = set(declared(system).speeds) - set(speeds)
    fixed = {s: value for s, value in state.items() if not s.kind.varies}

    def after(side: float) -> list[float]:
        """Its values after ever longer times, from one to the next away from the state."""
        here, now, values = dict(state), 0.0, list[float]()
        for step in _STEPS:
            there = moved(system, here, side * step - now, _FINE, dependent)
            here = fixed | {s: v for s, v in there.items() if s.derivative() in there}
            values.append(there[symbol])
            now = side * step
        return values

    # central differences, whose errors are series in the squares of their steps
    pairs = zip(after(1.0), after(-1.0), _STEPS, strict=True)
    slopes = [(later - earlier) / (2 * step) for later, earlier, step in pairs]
    for k in range(1, len(slopes)):
        slopes = [(4**k * a - b) / (4**k - 1) for a, b in pairwise(slopes)]
    return slopes[0]


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

    Accelerations are affine in these rates, so differences of the trials give their coefficients.
    """
    steps = _steps(len(speeds))
    still = {s: np.full(len(speeds) + 1, v) for s, v in speeds.items()}
    return Trial(known, state, still, dict(zip(speeds, steps, strict=True)))


def _steps(count: int) -> Array:
    """Rows over (count + 1) trials: zero in the first one, then one unknown after another at 1."""
    return np.hstack([np.zeros((count, 1)), np.eye(count)])


def _holding(
    equations: tuple[Array, Array], given: Mapping[Symbol, float], symbols: Sequence[Symbol]
) -> tuple[Array, Array]:
    """The equations with a row appended for each given symbol: symbol = its value."""
    rows, right = equations
    held = [[float(s == g) for s in symbols] for g in given]
    below = np.reshape(held, (len(given), len(symbols)))
    return np.vstack([rows, below]), np.concatenate([right, list(given.values())])


def _constraints(trial: Trial) -> tuple[Array, Array]:
    """Rows over the rates of speeds, and right-hand sides, by which slip velocities stay zero."""
    _, rates = trial.slips()
    return rates[:, 1:] - rates[:, :1], -rates[:, 0]


def _balances(known: Placement, trial: Trial) -> tuple[Array, Array]:
    """m a = F and dL/dt = τ for every body: rows over the rates of speeds, then the reactions."""
    wrenches = [_reaction_wrenches(known, trial, r) for r in known.restraints]
    given = _add_proportional_loads(known, trial, wrenches)
    rows, right = [], []
    for body in trial.bodies:
        force = trial.acceleration(body) * trial.scalar(body.mass)
        needed = trial.values([*force, *trial.spin_rate(body)])
        columns = [wrench.get(body, np.zeros(6)) for wrench in wrenches]
        reactions = np.reshape(columns, (len(wrenches), 6)).T
        applied = np.zeros(6)
        for action in given:
            if action.body == body:
                applied = applied + _applied(trial, action)
        rows.append(np.hstack([needed[:, 1:] - needed[:, :1], -reactions]))
        right.append(applied - needed[:, 0])
    return np.vstack(rows), np.concatenate(right)


def _support_powers(known: Placement, trial: Trial) -> Array:
    """Rows over the reactions, by which supports that move with a speed of no body take no power.

    A bead that `Pivot(bead, to=...)` places by a coordinate slides freely on a massless guide. By
    the principle of virtual power Σ λ d·∂v/∂u = 0 over all supports, where d is the direction of a
    reaction λ and v the velocity of the support.
    """
    along = [
        trial.prescribed(restraint).rate + np.zeros(trial.size) for restraint in known.restraints
    ]
    moving = np.reshape(along, (len(along), trial.size))
    slopes = (moving[:, 1:] - moving[:, :1]).T
    return np.asarray(slopes[(np.abs(slopes) > _TINY).any(axis=1)])


def _add_proportional_loads(
    known: Placement, trial: Trial, wrenches: Sequence[dict[Body, Array]]
) -> list[Action]:
    """Add to one unit of every reaction the loads in proportion to it; returns all other loads."""
    places = {restraint.name: i for i, restraint in enumerate(known.restraints)}
    given = []
    for action in known.declared_actions:
        reactions = sorted(action.reactions, key=lambda s: s.published)
        units, rest = action.per_unit(reactions)
        given.append(rest)
        for symbol, unit in zip(reactions, units, strict=True):
            if symbol.name not in places:
                raise NumericError(
                    f"a load in proportion to {symbol.name}, which is no reaction of a support",
                    expected="a load in proportion to a normal force",
                )
            acting = wrenches[places[symbol.name]]
            acting[unit.body] = acting.get(unit.body, np.zeros(6)) + _applied(trial, unit)
    return given


def _applied(trial: Trial, action: Action) -> Array:
    """Force and torque about the centre of mass."""
    push, arm, couple = map(trial.now, (action.force, action.arm, action.couple))
    return np.concatenate([push, couple + np.cross(arm, push)])


def _reaction_wrenches(known: Placement, trial: Trial, restraint: Restraint) -> dict[Body, Array]:
    """Force and torque about the centre of mass that one unit of a reaction puts on the bodies."""
    rubbing = known.frictions.get(restraint.name, ())
    direction = trial.now(restraint.direction)
    direction = direction + _friction(trial, [f for f in rubbing if not f.is_couple])
    couple = np.concatenate([np.zeros(3), _friction(trial, [f for f in rubbing if f.is_couple])])
    acting = {restraint.body: _wrench(trial, direction, restraint.arm) + couple}
    if restraint.other is not None:
        acting[restraint.other] = _wrench(trial, -direction, restraint.other_arm) - couple
    for share in restraint.more:
        further = _wrench(trial, trial.now(share.direction), share.arm)
        acting[share.body] = acting.get(share.body, np.zeros(6)) + further
    return acting


def _wrench(trial: Trial, direction: Array, arm: Vector | None) -> Array:
    if arm is None:
        return np.concatenate([np.zeros(3), direction])
    return np.concatenate([direction, np.cross(trial.now(arm), direction)])


def _friction(trial: Trial, laws: Iterable[Friction]) -> Array:
    """Dry friction, as forces or as couples, per unit normal force: -μ v/|v|, v being the slip."""
    found = np.zeros(3)
    for friction in laws:
        slips = [trial.slip(restraint, restraint.direction) for restraint in friction.sliding]
        speeds = trial.values(slips)[:, 0]
        if not speeds.any():
            raise NumericError(
                f"sliding friction of {friction.normal.name!r} at a state without slip",
                expected="a state in which it slips, since the friction points against the slip",
            )
        coefficient = trial.values([trial.scalar(friction.coefficient)])[0, 0]
        for restraint, speed in zip(friction.sliding, speeds, strict=True):
            share = -coefficient * speed / np.linalg.norm(speeds)
            found = found + share * trial.now(restraint.direction)
    return found


def _numbers(
    trial: Trial, state: Mapping[Symbol, float], speeds: Numbers, found: Sequence[float] | Array
) -> Numbers:
    """All values of the motion with these rates of speeds, in which accelerations are affine."""
    rates = np.asarray(found[: len(speeds)], dtype=float)
    numbers = {**state, **speeds}
    numbers |= {s.derivative(): float(rate) for s, rate in zip(speeds, rates, strict=True)}
    for q in trial.coordinates:
        jet = trial.number(q)
        at_zero, *at_one = jet.second  # q̈ for zero rates of speeds, then for each of them one
        numbers[q.derivative()] = float(jet.rate[0])
        slopes = np.array(at_one) - at_zero
        numbers[q.derivative().derivative()] = float(at_zero + slopes @ rates)
    return numbers


def _solve(rows: Array, right: Array, trouble: str) -> Array:
    """Least squares with rows of equal scale; raises `NumericError` where no solution exists."""
    if not rows.shape[1]:
        return np.zeros(0)
    # Rows carry different units (m/s², N, N m), so each is divided by its largest entry before
    # singular values are compared.
    largest = np.abs(rows).max(axis=1)
    scale = np.where(largest > _TINY, largest, 1.0)
    rows, right = rows / scale[:, None], right / scale
    found = np.asarray(np.linalg.lstsq(rows, right, rcond=1e-12)[0])
    size = 1.0 + float(np.abs(right).max(initial=0.0))
    if not np.allclose(rows @ found, right, rtol=_TOLERANCE, atol=_TOLERANCE * size):
        raise NumericError(trouble, expected="a state that all supports allow")
    return found

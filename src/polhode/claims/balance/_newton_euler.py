"""Accelerations and reactions at one state, by numbers, from the balance of every body.

Works from the declaration alone and shares nothing with `derive`: every body keeps all its
degrees of freedom, constraints are differentiated by jets, and one linear system gives all rates
of speeds and all reactions. Redundant supports are met by the least reactions, or as it is said.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from polhode.algebra import Symbol, SymbolKind, Vector
from polhode.base import NumericError
from polhode.claims.balance._declared import Placement, declared, reaction_symbol
from polhode.claims.balance._jets import Array
from polhode.claims.balance._trial import Trial
from polhode.model import Body, Restraint, System

_TOLERANCE = 1e-8
_TINY = 1e-12

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
    rows, right = _joined(_kinematic(trial), _balances(known, trial))
    symbols = [*speeds, *(reaction_symbol(r.name) for r in known.restraints)]
    given = {s: state[s] for s in symbols[len(speeds) :] if s in state}
    rows, right = _holding((rows, right), given, symbols)
    found = _solve(rows, right, "supports that contradict one another")
    reactions = {
        reaction_symbol(r.name): float(force)
        for r, force in zip(known.restraints, found[len(speeds) :], strict=True)
    }
    return _numbers(trial, state, speeds, found) | reactions


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


def constrained_motion(
    system: System, state: Mapping[Symbol, float], accelerations: Mapping[Symbol, float]
) -> Numbers:
    """The same for some motion that the constraints allow: these accelerations, and no forces."""
    known = declared(system)
    speeds = _speeds(known, state)
    trial = _trials(known, state, speeds)
    rows, right = _kinematic(trial)
    fixed = {s: a for s in speeds if (a := accelerations.get(s.derivative())) is not None}
    rows, right = _holding((rows, right), fixed, list(speeds))
    found = _solve(rows, right, "accelerations that the constraints rule out")
    return _numbers(trial, state, speeds, found)


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
    """The state with all rates of speeds zero, and with each of them one in turn."""
    steps = _steps(len(speeds))
    still = {s: np.full(len(speeds) + 1, v) for s, v in speeds.items()}
    return Trial(known, state, still, dict(zip(speeds, steps, strict=True)))


def _steps(count: int) -> Array:
    return np.hstack([np.zeros((count, 1)), np.eye(count)])


def _holding(
    equations: tuple[Array, Array], given: Mapping[Symbol, float], symbols: Sequence[Symbol]
) -> tuple[Array, Array]:
    """Rows over symbols and right-hand sides, and below them what holds those given."""
    rows, right = equations
    held = [[float(s == g) for s in symbols] for g in given]
    below = np.reshape(held, (len(given), len(symbols)))
    return np.vstack([rows, below]), np.concatenate([right, list(given.values())])


def _kinematic(trial: Trial) -> tuple[Array, Array]:
    """Rates of the ruled-out velocities vanish: rows over the rates of speeds, right-hand sides."""
    _, rates = trial.slips()
    return rates[:, 1:] - rates[:, :1], -rates[:, 0]


def _balances(known: Placement, trial: Trial) -> tuple[Array, Array]:
    """Newton and Euler for every body: rows over the rates of speeds and then the reactions."""
    lines = [_line(known, trial, r) for r in known.restraints]
    rows, right = [], []
    for body in trial.bodies:
        force = trial.acceleration(body) * trial.scalar(body.mass)
        need = trial.values([*force, *trial.spin_rate(body)])
        columns = [line.get(body, np.zeros(6)) for line in lines]
        reactions = np.reshape(columns, (len(lines), 6)).T
        rows.append(np.hstack([need[:, 1:] - need[:, :1], -reactions]))
        right.append(_applied(known, trial, body) - need[:, 0])
    return np.vstack(rows), np.concatenate(right)


def _line(known: Placement, trial: Trial, restraint: Restraint) -> dict[Body, Array]:
    """Force and torque about the centre that one unit of a reaction puts on the bodies."""
    direction = trial.now(restraint.direction) + _rubbing(known, trial, restraint)
    acting = {restraint.body: _wrench(trial, direction, restraint.arm)}
    if restraint.other is not None:
        acting[restraint.other] = _wrench(trial, -direction, restraint.other_arm)
    return acting


def _wrench(trial: Trial, direction: Array, arm: Vector | None) -> Array:
    if arm is None:
        return np.concatenate([np.zeros(3), direction])
    return np.concatenate([direction, np.cross(trial.now(arm), direction)])


def _rubbing(known: Placement, trial: Trial, restraint: Restraint) -> Array:
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


def _applied(known: Placement, trial: Trial, body: Body) -> Array:
    total = np.zeros(6)
    for action in known.actions:
        if action.body == body:
            force, arm, couple = map(trial.now, (action.force, action.arm, action.couple))
            total = total + np.concatenate([force, couple + np.cross(arm, force)])
    return total


def _joined(kinematic: tuple[Array, Array], balances: tuple[Array, Array]) -> tuple[Array, Array]:
    (above, first), (below, second) = kinematic, balances
    wide = np.hstack([above, np.zeros((len(above), below.shape[1] - above.shape[1]))])
    return np.vstack([wide, below]), np.concatenate([first, second])


def _numbers(
    trial: Trial, state: Mapping[Symbol, float], speeds: Numbers, found: Sequence[float] | Array
) -> Numbers:
    """Of the motion with these rates of speeds, on which all accelerations depend evenly."""
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
    if not rows.shape[1]:
        return np.zeros(0)
    largest = np.abs(rows).max(axis=1)
    scale = np.where(largest > _TINY, largest, 1.0)
    rows, right = rows / scale[:, None], right / scale
    found = np.asarray(np.linalg.lstsq(rows, right, rcond=1e-12)[0])
    if not np.allclose(rows @ found, right, rtol=_TOLERANCE, atol=_TOLERANCE * _size(right)):
        raise NumericError(trouble, expected="a state that all supports allow")
    return found


def _size(array: Array) -> float:
    return 1.0 + float(np.abs(array).max(initial=0.0))

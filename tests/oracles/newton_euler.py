"""Accelerations and multipliers of bodies in maximal coordinates, from one linear system.

    [ M  -Wᵀ ] [ twist rates ]   [ loads + gyroscopic ]
    [ J   0  ] [ multipliers ] = [ -bias - J_driven · given twist rates ]

Ideal constraints have W = J; Coulomb friction makes W differ. Redundant constraints are met by
least squares: accelerations are unique, multipliers have the smallest norm.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np
from scipy.linalg import block_diag

from .constraints import Constraint, Pair, Parts, Rows
from .parts import Array, Body, Driven, zero

RANK_TOLERANCE = 1e-12
CONSISTENCY = 1e-9


@dataclass(frozen=True)
class Wrench:
    """Force, and torque about the part's origin, in lab components."""

    force: Array = field(default_factory=zero)
    torque: Array = field(default_factory=zero)


@dataclass(frozen=True)
class Accelerations:
    """Per body: linear and angular acceleration; per constraint and part: the reaction on it."""

    linear: dict[str, Array]
    angular: dict[str, Array]
    reactions: dict[str, dict[str, Wrench]]


def bodies_of(parts: Parts) -> dict[str, Body]:
    return {name: part for name, part in parts.items() if isinstance(part, Body)}


def supports_of(parts: Parts) -> dict[str, Driven]:
    return {name: part for name, part in parts.items() if isinstance(part, Driven)}


def weights(parts: Parts, gravity: Array) -> dict[str, Wrench]:
    return {name: Wrench(force=body.mass * gravity) for name, body in bodies_of(parts).items()}


def solve(
    parts: Parts, constraints: Mapping[str, Constraint], loads: Mapping[str, Wrench]
) -> Accelerations:
    bodies = bodies_of(parts)
    rows = {name: constraint.rows(parts) for name, constraint in constraints.items()}
    mass = block_diag(*(body.mass_matrix for body in bodies.values()))
    force = np.concatenate([_force(body, loads.get(name)) for name, body in bodies.items()])
    jacobian = _over(bodies, [each.jacobian for each in rows.values()])
    wrenches = _over(bodies, [each.wrenches for each in rows.values()])
    required = np.concatenate([np.zeros(0), *(_required(each, parts) for each in rows.values())])

    no_coupling = np.zeros((len(required), len(required)))
    matrix = np.block([[mass, -wrenches.T], [jacobian, no_coupling]])
    unknowns = _least_norm(matrix, np.concatenate([force, required]))
    rates, multipliers = np.split(unknowns, [len(force)])

    twist_rates = dict(zip(bodies, rates.reshape(-1, 6), strict=True))
    return Accelerations(
        linear={name: rate[:3] for name, rate in twist_rates.items()},
        angular={name: rate[3:] for name, rate in twist_rates.items()},
        reactions=_reactions(rows, multipliers),
    )


def _least_norm(matrix: Array, right: Array) -> Array:
    unknowns = np.linalg.lstsq(matrix, right, rcond=RANK_TOLERANCE)[0]
    # Refined once: rates much smaller than the forces would else be known to the forces' rounding.
    left = np.longdouble(right) - np.longdouble(matrix) @ np.longdouble(unknowns)
    unknowns += np.linalg.lstsq(matrix, np.float64(left), rcond=RANK_TOLERANCE)[0]
    if not np.allclose(matrix @ unknowns, right, rtol=CONSISTENCY, atol=CONSISTENCY):
        raise ArithmeticError("no accelerations and reactions meet these constraints together")
    return unknowns


def _reactions(rows: Mapping[str, Rows], multipliers: Array) -> dict[str, dict[str, Wrench]]:
    reactions, start = {}, 0
    for name, each in rows.items():
        share = multipliers[start : start + len(each.residual)]
        reactions[name] = {part: _wrench(share @ block) for part, block in each.wrenches.items()}
        start += len(share)
    return reactions


def _over(bodies: Collection[str], pairs: Iterable[Pair]) -> Array:
    """The blocks of every constraint laid out over all free bodies."""
    nothing = np.zeros((0, 6 * len(bodies)))
    return np.vstack([nothing, *(_laid_out(bodies, pair) for pair in pairs)])


def _laid_out(bodies: Iterable[str], pair: Pair) -> Array:
    absent = np.zeros_like(next(iter(pair.values())))
    return np.hstack([pair.get(name, absent) for name in bodies])


def _force(body: Body, load: Wrench | None) -> Array:
    load = load or Wrench()
    return np.concatenate([load.force, load.torque + body.gyroscopic_torque])


def _required(rows: Rows, parts: Parts) -> Array:
    """What the free bodies' twist rates must add up to, row by row."""
    driven = supports_of({name: parts[name] for name in rows.jacobian})
    given = (rows.jacobian[name] @ part.twist_rate for name, part in driven.items())
    return sum((-each for each in given), -rows.bias)


def _wrench(array: Array) -> Wrench:
    return Wrench(force=array[:3], torque=array[3:])

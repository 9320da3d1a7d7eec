"""How far a computed motion strays from what must stay as it is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from polhode.algebra import Expr
from polhode.simulate._dynamics import Dynamics
from polhode.simulate._integrators import Array


@dataclass(frozen=True)
class Drift:
    """Largest departures along a trajectory.

    Attributes:
        energy: of energy − energy at the start − work done, over the energy scale: the largest
            kinetic plus absolute potential energy, or work.
        constraint: residual of the closed loops, m; zero where there are none.
        invariants: of each invariant from its value at the start, over the largest sum of the
            sizes of its terms.
    """

    energy: float
    constraint: float
    invariants: Mapping[str, float]

    def as_json(self) -> dict[str, Any]:
        """As plain numbers under the names of the attributes."""
        return {
            "energy": self.energy,
            "constraint": self.constraint,
            "invariants": dict(self.invariants),
        }


class Sampled(Protocol):
    """What is asked of a trajectory at chosen times."""

    def __call__(self, expressions: list[Expr]) -> Array:
        """Values of expressions, shape (expressions, times)."""
        ...


def drift_of(
    dynamics: Dynamics, invariants: Mapping[str, Expr], work: Array, sampled: Sampled
) -> Drift:
    """The drift over the times of the samples, the first of which is the start."""
    closures = sampled(list(dynamics.equations.closures))
    return Drift(
        energy=_energy(dynamics, work, sampled),
        constraint=float(np.max(np.abs(closures), initial=0.0)),
        invariants={name: _constancy(e, sampled) for name, e in invariants.items()},
    )


def _energy(dynamics: Dynamics, work: Array, sampled: Sampled) -> float:
    energy = dynamics.equations.energy
    at_rest = energy.subs(dict.fromkeys(dynamics.equations.speeds, 0))
    total, potential = sampled([energy, at_rest])
    scale = np.max(np.abs(total - potential) + np.abs(potential) + np.abs(work))
    return _relative(np.max(np.abs(total - total[0] - work)), scale)


def _constancy(invariant: Expr, sampled: Sampled) -> float:
    (values,) = sampled([invariant])
    scale = np.max(np.sum(np.abs(sampled(_terms(invariant))), axis=0), initial=0.0)
    return _relative(np.max(np.abs(values - values[0])), scale)


def _terms(expression: Expr) -> list[Expr]:
    found = []
    for powers, coefficient in expression.terms():
        term = Expr.constant(coefficient) / expression.denominator
        for generator, power in powers.items():
            term = term * Expr.generator(generator) ** power
        found.append(term)
    return found


def _relative(size: float, scale: float) -> float:
    return float(size / scale) if scale > 0 else float(size)

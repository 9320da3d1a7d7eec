"""What stays as it is or grows steadily: ignorable angles, spins, and all of a steady motion."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.analyse._reduced import reduced
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._reals import Array, Reals
from polhode.analyse.closed._solution import ExactSolution
from polhode.derive import Equations


@dataclass(frozen=True)
class Uniform:
    """Quantities that change at constant rates.

    Attributes:
        values: (at t = 0, rate) of each by published name.
    """

    values: dict[str, tuple[Any, Any]]

    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        """Values at times, s."""
        return {
            name: reals.number(value) + reals.number(rate) * times
            for name, (value, rate) in self.values.items()
        }


@dataclass(frozen=True)
class SteadySolution(ExactSolution):
    """A motion on which nothing happens but uniform turning."""

    kind = "steady motion"
    period = None

    @property
    def figures(self) -> dict[str, Any]:
        """None."""
        return {}

    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        """Nothing besides what is uniform."""
        return {}


def is_steady(equations: Equations, data: Data) -> bool:
    """Whether every speed and every coordinate that matters is constant from this start on."""
    system = reduced(equations)
    rates = (*system.rates, *equations.accelerations.values())
    return not any(data.number(rate) for rate in rates)


def uniform(equations: Equations, data: Data, steady: bool) -> Uniform:
    """What changes uniformly on every motion, or on one that is steady."""
    still = [s for s in equations.speeds if not equations.accelerations[s.derivative()]]
    if steady:
        still = [*reduced(equations).essential, *equations.speeds]
    zero = data.context.zero
    values = {s.published: (data.number(Expr.generator(s)), zero) for s in still}
    for q in equations.coordinates:
        rate = equations.kinematics[q.derivative()]
        if _is_constant(rate, still):
            values[q.published] = (data.number(Expr.generator(q)), data.number(rate))
    return Uniform(values)


def _is_constant(rate: Expr, still: Collection[Symbol]) -> bool:
    return all(s.kind is SymbolKind.PARAMETER or s in still for s in rate.symbols())

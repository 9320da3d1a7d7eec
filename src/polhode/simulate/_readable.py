"""Everything that can be read from a motion by name."""

from __future__ import annotations

from collections.abc import Mapping

from polhode.algebra import Expr
from polhode.simulate._dynamics import CLOCK, WORK, Dynamics


def readable(dynamics: Dynamics, invariants: Mapping[str, Expr]) -> dict[str, Expr]:
    """Quantities of one contact mode, by published name."""
    equations = dynamics.equations
    rates = (*equations.speeds, *equations.kinematics, *equations.dependent)
    moving = (*equations.coordinates, *rates, *(rate.derivative() for rate in rates))
    carried = (symbol for symbol in dynamics.carried if symbol != WORK)
    symbols = (CLOCK, *moving, *carried, *dynamics.parameters, *equations.functions)
    return {
        **{symbol.published: Expr.generator(symbol) for symbol in symbols},
        **equations.components,
        "energy": equations.energy,
        "power": equations.power,
        "work": Expr.generator(WORK),
        **{symbol.published: value for symbol, value in dynamics.lifted.items()},
        **invariants,
    }

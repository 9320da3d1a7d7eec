"""Everything that can be read from a motion by name."""

from __future__ import annotations

from collections.abc import Mapping

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.simulate._dynamics import CLOCK, WORK, Dynamics, EquationsOfMotion

_MOVING = (SymbolKind.COORDINATE, SymbolKind.SPEED)


def moving(dynamics: Dynamics) -> dict[str, Expr]:
    """Coordinates, speeds and rates, by published name; also those of other modes that follow."""
    equations = dynamics.equations
    own = (*equations.coordinates, *equations.speeds, *equations.kinematics, *equations.dependent)
    lifted = {s.published: value for s, value in dynamics.lifted.items() if s.kind in _MOVING}
    return {symbol.published: Expr.generator(symbol) for symbol in own} | lifted


def readable(dynamics: Dynamics, invariants: Mapping[str, Expr]) -> dict[str, Expr]:
    """Quantities of one contact mode, by published name."""
    equations = dynamics.equations
    rates = (*equations.speeds, *equations.kinematics, *equations.dependent)
    moving = (*equations.coordinates, *rates, *(rate.derivative() for rate in rates))
    carried = (symbol for symbol in dynamics.carried if symbol != WORK)
    symbols = (CLOCK, *moving, *carried, *dynamics.parameters, *equations.functions)
    powers = getattr(equations, "powers", {})
    return {
        **{symbol.published: Expr.generator(symbol) for symbol in symbols},
        **{f"power_{name}": power for name, power in powers.items()},
        **equations.components,
        "energy": equations.energy,
        "power": equations.power,
        "work": Expr.generator(WORK),
        **{symbol.published: value for symbol, value in dynamics.lifted.items()},
        **invariants,
    }


def quantity_names(equations: EquationsOfMotion, lifted: Mapping[Symbol, Expr]) -> set[str]:
    """What can be read by name in a contact mode."""
    return set(readable(Dynamics(equations, {}, lifted=lifted), {}))

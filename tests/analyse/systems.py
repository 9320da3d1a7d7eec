"""Catalogue systems derived once, with their symbols by name."""

from catalogue.systems import equations
from polhode.algebra import Expr
from polhode.derive import Equations

__all__ = ["equations", "symbols"]


def symbols(derived: Equations) -> dict[str, Expr]:
    """Every symbol by its published name."""
    state = (*derived.coordinates, *derived.speeds, *derived.parameters)
    return {symbol.published: Expr.generator(symbol) for symbol in state}

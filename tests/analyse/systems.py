"""Catalogue systems derived once, with their symbols by name."""

from functools import cache

from polhode.algebra import Expr
from polhode.catalogue import CATALOGUE
from polhode.derive import Equations, derive


@cache
def equations(name: str) -> Equations:
    return derive(CATALOGUE[name].build())


def symbols(derived: Equations) -> dict[str, Expr]:
    """Every symbol by its published name."""
    state = (*derived.coordinates, *derived.speeds, *derived.parameters)
    return {symbol.published: Expr.generator(symbol) for symbol in state}

"""SI units of quantities of a motion."""

from __future__ import annotations

from polhode.algebra import Expr, SymbolKind, dimension_of
from polhode.base import LENGTH, MASS, PURE, TIME, UnitError
from polhode.derive import Equations

_ENERGY = MASS * LENGTH**2 / TIME**2
_NAMED = {PURE: "", _ENERGY: "J", _ENERGY / LENGTH: "N", _ENERGY / TIME: "W"}
_TURNING = {PURE: "rad", PURE / TIME: "rad/s", PURE / TIME**2: "rad/s^2"}


def unit_in(equations: Equations, expression: Expr) -> str:
    """SI unit of an expression; empty for a pure number, and where it is not known."""
    try:
        known = equations.dimensions
        # a dependent speed has the dimension of its meaning
        meaning = equations.dependent.get(expression.symbol) if expression.symbol else None
        dimension = dimension_of(meaning or expression, known) or PURE
    except UnitError:
        return ""
    kind = None if expression.symbol is None else expression.symbol.kind
    if kind in (SymbolKind.COORDINATE, SymbolKind.SPEED) and dimension in _TURNING:
        return _TURNING[dimension]
    return _NAMED.get(dimension, str(dimension))

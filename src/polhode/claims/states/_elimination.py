"""Expressions on the states where given relations vanish."""

from __future__ import annotations

from collections.abc import Sequence

from polhode.algebra import Expr, Symbol
from polhode.base import NumericError


def eliminated(expression: Expr, relations: Sequence[Expr]) -> Expr:
    """An expression with one quantity eliminated by each relation that is to vanish.

    Each relation is solved for a quantity that it is linear in; a parameter where it can be, so
    that nothing is lost but states where its factor vanishes.

    Raises `NumericError` for a relation that is linear in nothing.
    """
    pending = list(relations)
    while pending:
        relation = pending.pop(0).numerator
        if not relation:
            continue
        symbol, value = solved(relation)
        expression = expression.subs({symbol: value})
        pending = [other.subs({symbol: value}) for other in pending]
    return expression


def solved(relation: Expr) -> tuple[Symbol, Expr]:
    """A symbol that a relation is linear in, and its value where the relation vanishes."""
    candidates = sorted(relation.symbols(), key=lambda s: (s.kind.varies, s.published))
    for symbol in candidates:
        slope = relation.diff(symbol)
        if slope and symbol not in slope.symbols():
            rest = relation - slope * Expr.generator(symbol)
            if symbol not in rest.symbols():
                return symbol, -rest / slope
    raise NumericError(
        f"the relation {relation} = 0",
        expected="one that is linear in some quantity",
        advice="restrict an angle, such as theta = pi/2",
    )

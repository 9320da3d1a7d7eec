"""Expressions on the states where given relations vanish."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod

from polhode.algebra import ONE, Expr, Symbol, factors, is_positive
from polhode.base import NumericError


def eliminated(expression: Expr, relations: Sequence[Expr]) -> Expr:
    """An expression with one quantity eliminated by each relation that is to vanish.

    Each relation is solved for a quantity that it is linear in; a parameter where it can be, so
    that nothing is lost but states where its factor vanishes.

    Raises `NumericError` for a relation that is linear in nothing, and where what is positive by
    declaration would vanish.
    """
    pending = list(relations)
    sizes: dict[Symbol, Expr] = {}  # of what is positive by declaration
    while pending:
        relation = _essential(pending.pop(0))
        if not relation:
            continue
        symbol, value = solved(relation)
        expression = expression.subs({symbol: value})
        pending = [other.subs({symbol: value}) for other in pending]
        sizes = {s: size.subs({symbol: value}) for s, size in sizes.items()}
        if symbol.positive:
            sizes[symbol] = value
        for vanished in (s for s, size in sizes.items() if not size):
            raise NumericError(
                f"conditions that were met only where {vanished.published} vanishes",
                expected="conditions that some body meets",
                advice="restrict angles and speeds one by one, such as theta = pi/2",
            )
    return expression


def _essential(relation: Expr) -> Expr:
    """The factors of a relation that can vanish, each once: a mass is no way to make it hold.

    Raises `NumericError` where no factor can.
    """
    if not relation:
        return relation
    able = [f for f in factors(relation.numerator)[1] if not is_positive(f) and not is_positive(-f)]
    if not able:
        raise NumericError(
            f"the condition {relation} = 0, which nothing meets",
            expected="conditions that do not contradict one another or the model",
        )
    return prod(able, start=ONE).numerator


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

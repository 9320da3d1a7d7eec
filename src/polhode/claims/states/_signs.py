"""Signs of expressions, as far as they can be told."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from polhode.algebra import Expr, factors, is_positive


def definite_sign(expression: Expr, assumed: Collection[Expr] = ()) -> int:
    """1 or -1 where an expression is seen to have that sign or to vanish; 0 where it may change."""
    number, powers = factors(expression)
    sign = 1 if number > 0 else -1
    for factor in (f for f, exponent in powers.items() if exponent % 2):
        if is_positive(-factor):
            sign = -sign
        elif not is_positive(factor) and factor not in assumed and not _is_square_sum(factor):
            return 0
    return sign


def strict_sign(expression: Expr, assumed: Collection[Expr] = ()) -> int:
    """1 or -1 where an expression is seen to have that sign and never to vanish; 0 otherwise."""
    return 0 if any(may_vanish(expression, assumed)) else definite_sign(expression, assumed)


def may_vanish(expression: Expr, assumed: Collection[Expr] = ()) -> Iterator[Expr]:
    """The factors of an expression that are not seen to differ from zero."""
    for factor, exponent in factors(expression)[1].items():
        known = is_positive(factor) or is_positive(-factor) or factor in assumed
        if exponent > 0 and not known and -factor not in assumed:
            yield factor


def _is_square_sum(factor: Expr) -> bool:
    """Whether every term is a positive number times even powers or positive quantities."""
    return all(
        coefficient > 0 and all(g.positive or power % 2 == 0 for g, power in powers.items())
        for powers, coefficient in factor.terms()
    )

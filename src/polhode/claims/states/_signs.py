"""Signs of expressions, as far as they can be told."""

from __future__ import annotations

from collections.abc import Collection

from polhode.algebra import Expr, factors, is_positive


def definite_sign(expression: Expr, assumed: Collection[Expr] = ()) -> int:
    """1 or -1 where the sign is seen from the factors; 0 where it is not, or varies."""
    number, powers = factors(expression)
    sign = 1 if number > 0 else -1
    for factor in (f for f, exponent in powers.items() if exponent % 2):
        if is_positive(-factor):
            sign = -sign
        elif not is_positive(factor) and factor not in assumed and not _is_square_sum(factor):
            return 0
    return sign


def _is_square_sum(factor: Expr) -> bool:
    """Whether every term is a positive number times even powers or positive quantities."""
    return all(
        coefficient > 0 and all(g.positive or power % 2 == 0 for g, power in powers.items())
        for powers, coefficient in factor.terms()
    )

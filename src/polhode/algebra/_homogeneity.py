"""The dimension of an expression whose symbols have known ones."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import prod

from polhode.algebra._expression import Expr
from polhode.algebra._functions import pi
from polhode.algebra._ring import Generator, Symbol
from polhode.base import PURE, TIME, Dimension, UnitError


def dimension_of(expression: Expr, known: Mapping[Symbol, Dimension]) -> Dimension | None:
    """The dimension that all terms of an expression have; None for a bare number.

    A bare number added to other terms is taken to be in their SI unit.

    Args:
        expression: any.
        known: dimension of every symbol that has one; those of time derivatives follow.

    Raises:
        UnitError: where terms of different dimensions are added.
    """
    if expression.symbols() <= pi.symbols():
        return None
    above, below = (_of_sum(part, known) for part in (expression.numerator, expression.denominator))
    return above / below


def _of_sum(polynomial: Expr, known: Mapping[Symbol, Dimension]) -> Dimension:
    products = (powers for powers, _ in polynomial.terms())
    found = dict.fromkeys(
        prod((_of_factor(g, known) ** p for g, p in powers.items()), start=PURE)
        for powers in products
        if not all(g.symbols() <= pi.symbols() for g in powers)
    )
    if len(found) > 1:
        raise UnitError(
            f"{polynomial} adds quantities in {' and '.join(map(str, found))}",
            expected="terms of one dimension",
        )
    return next(iter(found), PURE)


def _of_factor(generator: Generator, known: Mapping[Symbol, Dimension]) -> Dimension:
    if isinstance(generator, Symbol):
        return known.get(generator.base(), PURE) / TIME**generator.order
    if generator.depth and generator.partner() is None:  # a root
        return (dimension_of(generator.arguments[0], known) or PURE) ** Fraction(1, 2)
    return PURE

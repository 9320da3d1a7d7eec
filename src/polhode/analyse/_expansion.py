"""Expansions in a small quantity, with the first term that is dropped."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from polhode.algebra import Expr, Symbol, as_symbol, taylor
from polhode.analyse._given import Given, images_given

#: Powers beyond the last one kept in which the first dropped term is sought.
_FURTHER = 6


@dataclass(frozen=True)
class Expansion:
    """A Taylor polynomial in a small quantity.

    Attributes:
        small: the quantity.
        order: highest power kept.
        polynomial: the approximation.
        dropped: the first term left out that is not zero, with its power; None if exact.
    """

    small: Symbol
    order: int
    polynomial: Expr
    dropped: tuple[int, Expr] | None


def expand(
    expression: Expr,
    small: Expr | Symbol,
    order: int = 1,
    *,
    about: Mapping[Any, Given] | None = None,
) -> Expansion:
    """Expand in a small quantity.

    To expand about a motion, say how the quantities depart from it: `about={theta: pi/2 + e*x}`
    with small `e`; rates and accelerations follow.

    Args:
        expression: exact.
        small: the small quantity; it must not vary.
        order: highest power to keep.
        about: quantities by name or symbol, as exact functions of the small one, numbers or text
            with a unit.
    """
    parameter = as_symbol(small)
    images = images_given(expression, about)
    table = dict(images)
    for symbol, image in images.items():  # their rates and accelerations too, unless given
        rate, value = symbol, image
        while rate.kind.varies and rate.order < 2:
            rate, value = rate.derivative(), value.dt()
            table.setdefault(rate, value)
    exact = expression.subs(table)
    polynomial = taylor(exact, parameter, order)
    if not (exact - polynomial):
        return Expansion(parameter, order, polynomial, None)
    kept = polynomial
    for power in range(order + 1, order + 1 + _FURTHER):
        longer = taylor(exact, parameter, power)
        if term := longer - kept:
            return Expansion(parameter, order, polynomial, (power, term))
        kept = longer
    return Expansion(parameter, order, polynomial, None)

"""Expansions in a small quantity, with the order of what is dropped."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from polhode.algebra import Expr, Symbol, as_symbol, taylor
from polhode.analyse._given import Given, images_given


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
        about: quantities by name or symbol, as exact functions of the small one; also numbers and
            text with a unit.
    """
    parameter = as_symbol(small)
    images = _with_rates(images_given(expression, about))
    placed = expression.subs(images)
    polynomial = taylor(placed, parameter, order)
    return Expansion(parameter, order, polynomial, _dropped(placed, parameter, order))


def _with_rates(images: Mapping[Symbol, Expr]) -> dict[Symbol, Expr]:
    """Give the two rates of every quantity too, unless they were given."""
    table = dict(images)
    for symbol, image in images.items():
        rate, value = symbol, image
        while rate.kind.varies and rate.order < 2:
            rate, value = rate.derivative(), value.dt()
            table.setdefault(rate, value)
    return table


def _dropped(expression: Expr, small: Symbol, order: int) -> tuple[int, Expr] | None:
    if not (expression - taylor(expression, small, order)):
        return None
    for power in range(order + 1, order + 7):
        term = taylor(expression, small, power) - taylor(expression, small, power - 1)
        if term:
            return power, term
    return None

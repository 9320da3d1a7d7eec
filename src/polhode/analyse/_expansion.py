"""Expansions in a small quantity, or in one over a large one, with the first term dropped."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from polhode.algebra import Expr, Symbol, as_symbol, taylor
from polhode.analyse._given import Given, images_given
from polhode.base import NumericError

#: Powers beyond the last one kept in which the first dropped term is sought.
_FURTHER = 6
_HIGHEST_POLE = 4
_INVERSE = Symbol("inverse", positive=True)


@dataclass(frozen=True)
class Expansion:
    """A Taylor polynomial in a small quantity, with negative powers where there is a pole.

    Attributes:
        small: the quantity; the large one for an expansion in one over it.
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
    """Expand in a small quantity, or in one over a large one.

    To expand about a motion, say how the quantities depart from it: `about={theta: pi/2 + e*x}`
    with small `e`; rates and accelerations follow. For fast spin, expand in `1/omega_1`; the large
    quantity is taken as positive.

    Args:
        expression: exact.
        small: the small quantity, which must not vary, or one over a large one.
        order: highest power to keep.
        about: quantities by name or symbol, as exact functions of the small one, numbers or text
            with a unit.

    Raises:
        NumericError: where the expression is infinite there other than by a power down to -4.
    """
    images = images_given(expression, about)
    table = dict(images)
    for symbol, image in images.items():  # their rates and accelerations too, unless given
        rate, value = symbol, image
        while rate.kind.varies and rate.order < 2:
            rate, value = rate.derivative(), value.dt()
            table.setdefault(rate, value)
    exact = expression.subs(table)
    large = _large(small)
    if large is None:
        return _expanded(exact, as_symbol(small), order)
    found = _expanded(exact.subs({large: 1 / Expr.generator(_INVERSE)}), _INVERSE, order)
    back: dict[Symbol, Expr] = {_INVERSE: 1 / Expr.generator(large)}
    dropped = found.dropped and (found.dropped[0], found.dropped[1].subs(back))
    return Expansion(large, order, found.polynomial.subs(back), dropped)


def _large(small: Expr | Symbol) -> Symbol | None:
    """The large quantity that a small one is one over, if it is."""
    if isinstance(small, Symbol) or small.symbol is not None or not small:
        return None
    return (1 / small).symbol


def _expanded(exact: Expr, parameter: Symbol, order: int) -> Expansion:
    scale, pole = Expr.generator(parameter), _pole(exact, parameter)
    regular = exact * scale**pole

    def up_to(power: int) -> Expr:
        return taylor(regular, parameter, power + pole) / scale**pole

    polynomial = up_to(order) if order + pole >= 0 else Expr.of(0)
    if not (exact - polynomial):
        return Expansion(parameter, order, polynomial, None)
    kept = polynomial
    for power in range(order + 1, order + 1 + _FURTHER):
        longer = up_to(power)
        if term := longer - kept:
            return Expansion(parameter, order, polynomial, (power, term))
        kept = longer
    return Expansion(parameter, order, polynomial, None)


def _pole(exact: Expr, parameter: Symbol) -> int:
    """The least power of the parameter that makes an expression finite where it is zero."""
    scale = Expr.generator(parameter)
    for power in range(_HIGHEST_POLE + 1):
        with suppress(ZeroDivisionError):
            (exact * scale**power).subs({parameter: 0})
            return power
    raise NumericError(
        f"an expansion in {parameter.published} of {exact}",
        expected=f"a finite value where it is zero, or a power of it down to -{_HIGHEST_POLE}",
        advice="write a quotient such as x/sin(x) in another form first",
    )

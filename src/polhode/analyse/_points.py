"""Exact evaluation at random rational points, sines and cosines on the unit circle."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from random import Random

from polhode.algebra import Expr, Generator, Symbol
from polhode.base import NumericError

Point = Mapping[Generator, Expr]


def random_point(expressions: Iterable[Expr], random: Random) -> dict[Generator, Expr]:
    """A rational value for every symbol, sine and cosine; others follow from their arguments.

    Raises `NumericError` for square roots and exponentials, which have no rational points.
    """
    generators = {g: None for e in expressions for g in e.ring.generators}
    point: dict[Generator, Expr] = {}
    for generator in generators:
        partner = generator.partner()
        if isinstance(generator, Symbol):
            point[generator] = Expr.constant(_fraction(random))
        elif partner is not None:
            odd, sign = partner
            half = Expr.constant(_fraction(random))
            below = 1 - sign * half * half
            point[generator] = (1 + sign * half * half) / below
            point[odd] = 2 * half / below
    missing = [g for g in generators if g not in point]
    if missing:
        raise NumericError(
            f"a rational point of {missing[0].key}",
            expected="sines, cosines and hyperbolic functions only",
            advice="",
        )
    return point


def at_point(expression: Expr, point: Point) -> Fraction:
    """The exact value of an expression."""
    value = expression.recast({g: point[g] for g in expression.generators}).rational
    if value is None:
        raise NumericError(f"the value of {expression} at a rational point", expected="a number")
    return value


def _fraction(random: Random) -> Fraction:
    return Fraction(random.randint(2, 97), random.randint(2, 97))

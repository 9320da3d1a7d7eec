"""Steady motions for given numbers: all real roots of an algebraic relation."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from flint import fmpq, fmpq_poly

from polhode.algebra import Expr, Symbol, as_symbol, pi
from polhode.analyse._given import Given, values_given
from polhode.analyse._steady import SteadyMotion
from polhode.base import NumericError, Shown

#: Relations of a higher degree in the unknown are refused.
LARGEST_DEGREE = 24


@dataclass(frozen=True)
class SteadyValues(Shown):
    """All values of one quantity on a family of steady motions.

    Attributes:
        quantity: the one left open.
        values: all real roots, ascending; angles in (-π, π].
        degree: of the polynomial they are roots of, which bounds their number.
    """

    quantity: Symbol
    values: tuple[float, ...]
    degree: int


def steady_values(family: SteadyMotion, at: Mapping[Any, Given]) -> SteadyValues:
    """Every value that one quantity can have when all others are given numbers.

    The roots are isolated in exact arithmetic: none is missed and none is spurious.

    Args:
        family: with one relation.
        at: numbers for all parameters and all state variables but one: by name or symbol, in SI
            units or as text with a unit.
    """
    given = values_given(family.reduced.equations, at)
    relations = [r for e in family.relations if (r := e.subs(family.fixed).subs(given))]
    unknown = sorted({s for r in relations for s in r.symbols()}, key=lambda s: s.published)
    if len(relations) != 1 or len(unknown) != 1:
        names = ", ".join(s.published for s in unknown) or "nothing"
        raise NumericError(
            f"a steady motion with {names} left open",
            expected="one relation in one unknown",
            advice="give numbers for all other quantities with at=",
        )
    (symbol,) = unknown
    polynomial, is_half_tangent = _polynomial(relations[0], symbol)
    roots = _real_roots(polynomial)
    if is_half_tangent:
        roots = [2 * math.atan(root) for root in roots] + _straight_angle(relations[0], symbol)
    return SteadyValues(symbol, tuple(sorted(roots)), polynomial.degree())


def _polynomial(relation: Expr, symbol: Symbol) -> tuple[fmpq_poly, bool]:
    """The relation as a polynomial in the symbol, or in the tangent of half of it."""
    tangent = Expr.generator(Symbol("half_tangent"))
    below = 1 + tangent**2
    images = {}
    for generator in relation.generators:
        for function in generator.companions():
            is_even = function.partner() is not None
            images[function] = ((1 - tangent**2) if is_even else 2 * tangent) / below
    variable = as_symbol(tangent) if images else symbol
    expression = relation.recast(images).numerator if images else relation.numerator
    coefficients = [fmpq(0)] * (LARGEST_DEGREE + 1)
    for powers, number in expression.terms():
        degree = powers.pop(variable, 0)
        if powers or degree > LARGEST_DEGREE:
            raise NumericError(
                f"the relation {relation} = 0",
                expected=f"an algebraic one of degree {LARGEST_DEGREE} at most in one unknown",
                advice="give the angle, and ask for the speed",
            )
        coefficients[degree] = fmpq(number.numerator, number.denominator)
    return fmpq_poly(coefficients), bool(images)


def _real_roots(polynomial: fmpq_poly) -> list[float]:
    """Isolated in ball arithmetic: a root is real if its ball reaches the axis."""
    if polynomial.degree() < 1:
        return []
    found: Any = polynomial.complex_roots()
    return [float(root.real.mid()) for root, _ in found if root.imag.contains(0)]


def _straight_angle(relation: Expr, symbol: Symbol) -> list[float]:
    """π itself, which has no half tangent."""
    return [] if relation.subs({symbol: pi}) else [math.pi]

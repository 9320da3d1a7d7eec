"""Shorter quotients for print: 1/cos θ for cos θ/(1 - sin²θ)."""

from __future__ import annotations

from math import prod

from polhode.algebra._expression import Expr
from polhode.algebra._forms import traded
from polhode.algebra._half_angles import lowest
from polhode.algebra._ring import Generator, Polynomial, Ring

Quotient = tuple[Polynomial, Polynomial]

#: Products of terms above which extending by a conjugate takes longer than a shorter form is worth;
#: as the extended numerator has up to as many terms, it is hardly ever shorter.
_MOST_PRODUCTS = 4000


def shortest_quotient(expression: Expr) -> Quotient:
    """Numerator and denominator, with cosines and roots in the denominator where shorter."""
    ring, best = expression.ring, (expression.num, expression.den)
    if expression.is_polynomial:
        return best
    cancelled = lowest(expression)
    if cancelled is not None:
        best = _cancelled(cancelled.num, prod(factor**e for factor, e in cancelled.factors))
    for rewrite in (_conjugated, _over_cosines):
        for generator in ring.generators:
            if generator.depth:
                best = min(best, rewrite(ring, best, generator), key=_bulk)
    return best


def _bulk(quotient: Quotient) -> int:
    return sum(
        1 + sum(1 for power in monomial if power)
        for polynomial in quotient
        for monomial in polynomial.monoms()
    )


def _conjugated(ring: Ring, quotient: Quotient, generator: Generator) -> Quotient:
    """Extended by a conjugate so that the generator leaves the numerator."""
    num, den = quotient
    position = ring.index[generator]
    if num.degrees()[position] != 1:
        return quotient
    even, odd = ring.split(num, position)
    variable = ring.variable(generator)
    conjugate = even - odd * variable if even != 0 else variable
    if len(conjugate) * max(len(num), len(den)) > _MOST_PRODUCTS:
        return quotient
    above, below = ring.reduce(num * conjugate), ring.reduce(den * conjugate)
    return _cancelled(above, below) if above != 0 else quotient


def _over_cosines(ring: Ring, quotient: Quotient, generator: Generator) -> Quotient:
    partner = generator.partner()
    if partner is None or quotient[1].degrees()[ring.index[partner[0]]] < 2:
        return quotient
    num, den = (traded(ring, polynomial, generator) for polynomial in quotient)
    return _cancelled(num, den)


def _cancelled(num: Polynomial, den: Polynomial) -> Quotient:
    common = num.gcd(den)
    return num / common, den / common

"""Shorter forms for print: 1/cos θ for cos θ/(1 - sin²θ), and functions of sums of angles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from math import prod
from operator import le, sub

from polhode.algebra._expression import Expr
from polhode.algebra._forms import traded
from polhode.algebra._functions import CIRCULAR, Even
from polhode.algebra._half_angles import lowest
from polhode.algebra._ring import Generator, Monomial, Polynomial, Ring, ring_of
from polhode.algebra.printing._order import factor_rank

Quotient = tuple[Polynomial, Polynomial]


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


# -- cos(α - β) for cos α cos β + sin α sin β ------------------------------------------------------

#: Longer polynomials are printed as they are.
_LONGEST = 80


@dataclass(frozen=True)
class _Exchange:
    """An identity: `short`, a single term, equals `long`, whose leading monomial is `sign`."""

    short: Polynomial
    long: Polynomial
    sign: Monomial

    def applied(self, ring: Ring, polynomial: Polynomial) -> Iterator[Polynomial]:
        """The polynomial after each use of the identity that makes it shorter."""
        for monomial, coefficient in polynomial.to_dict().items():
            if not all(map(le, self.sign, monomial)):
                continue
            rest = tuple(map(sub, monomial, self.sign))
            factor = ring.context.from_dict({rest: coefficient / self.long[self.sign]})
            other = polynomial - ring.reduce(factor * self.long)
            if len(other) + 1 < len(polynomial):
                yield other + factor * self.short


def in_sums_of_angles(ring: Ring, polynomial: Polynomial) -> tuple[Ring, Polynomial]:
    """The shortest form found, in a ring that has the functions needed; in general not reduced."""
    if len(polynomial) > _LONGEST:
        return ring, polynomial
    degrees = polynomial.degrees()
    angles = [  # that occur by their cosines or sines
        g
        for g in ring.generators
        if isinstance(g, Even)
        and g.family is CIRCULAR
        and g.base.symbol is not None
        and (degrees[ring.index[g]] or degrees[ring.index[g.partner()[0]]])
    ]
    for first, second in combinations(sorted(angles, key=factor_rank), 2):
        wider = ring_of(frozenset(ring.generators) | set(_functions(first, second)))
        exchanges = list(_exchanges(wider, first, second))
        shorter = wider.lift(ring, polynomial)
        # greedy: the replacement that saves most is made first, until none saves anything
        while found := [p for e in exchanges for p in e.applied(wider, shorter)]:
            shorter = min(found, key=len)
        if len(shorter) < len(polynomial):
            ring, polynomial = wider, shorter
    return ring, polynomial


def _functions(first: Even, second: Even) -> Iterator[Even]:
    x, y = first.argument, second.argument
    for argument in (x - y, x + y):
        yield Even(CIRCULAR, argument, Fraction(1))


def _exchanges(ring: Ring, first: Even, second: Even) -> Iterator[_Exchange]:
    """Single functions of the difference and of the sum, and their products of two."""
    c1, s1, c2, s2 = (ring.variable(g) for e in (first, second) for g in (e, e.partner()[0]))
    for even, sign in zip(_functions(first, second), (1, -1), strict=True):
        cosine, sine = ring.variable(even), ring.variable(even.partner()[0])
        pairs = [(cosine, c1 * c2 + sign * s1 * s2), (sine, s1 * c2 - sign * c1 * s2)]
        (c, long_c), (s, long_s) = pairs
        squares = [(c**2, long_c**2), (s**2, long_s**2), (s * c, long_s * long_c)]
        for short, long in (*squares, *pairs):
            reduced = ring.reduce(long)
            yield _Exchange(short, reduced, max(reduced.monoms(), key=sum))

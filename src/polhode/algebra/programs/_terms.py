"""Polynomials as lists of terms, which are taken apart faster than in their ring.

A ring of a long system has many generators, of which each term has few: a monomial lists only those
that occur in it.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd, lcm
from typing import Any, NamedTuple, TypeAlias

from flint import fmpq

from polhode.algebra._ring import Polynomial, Ring

Number: TypeAlias = int | Fraction
#: Pairs (-position, power) of the generators that occur, in the order of their positions. Compared
#: as tuples, monomials are thus in lexicographic order.
Monomial: TypeAlias = tuple[tuple[int, int], ...]
Term: TypeAlias = tuple[Monomial, Number]
#: Terms in descending lexicographic order.
Terms: TypeAlias = Sequence[Term]


def terms_of(polynomial: Polynomial) -> Terms:
    """The terms of a polynomial."""
    occurring = [i for i, degree in enumerate(polynomial.degrees()) if degree > 0]
    return [
        (tuple([(-i, p) for i in occurring if (p := int(monomial[i]))]), _number(coefficient))
        for monomial, coefficient in polynomial.terms()
    ]


def _number(rational: Any) -> Number:
    above, below = int(rational.p), int(rational.q)
    return above if below == 1 else Fraction(above, below)


def polynomial_of(ring: Ring, terms: Terms) -> Polynomial:
    """The polynomial with these terms."""
    table = {}
    for monomial, number in terms:
        powers = [0] * len(ring.generators)
        for place, power in monomial:
            powers[-place] = power
        table[tuple(powers)] = fmpq(number.numerator, number.denominator)
    return ring.context.from_dict(table)


class Extracted(NamedTuple):
    """number · Π generator^power · rest.

    Attributes:
        number: whose sign is that of the first term.
        common: what all terms share.
        rest: with whole coefficients without a common factor; a single 1 for one term.
    """

    number: Number
    common: Monomial
    rest: Terms


def extracted(terms: Terms) -> Extracted:
    """With the number and the generators common to all terms taken out; of at least one term."""
    if len(terms) == 1:
        ((monomial, number),) = terms
        return Extracted(number, monomial, [((), 1)])
    number = _content([coefficient for _, coefficient in terms])
    if terms[0][1] < 0:
        number = -number
    shared = dict(terms[0][0])
    for monomial, _ in terms[1:]:
        if not shared:
            break
        powers = dict(monomial)
        shared = {i: min(p, powers[i]) for i, p in shared.items() if i in powers}
    rest = [(monomial, _quotient(c, number)) for monomial, c in terms] if number != 1 else terms
    if shared:
        rest = [(_divided(monomial, shared), c) for monomial, c in rest]
    return Extracted(number, tuple(shared.items()), rest)


def _content(numbers: Sequence[Number]) -> Number:
    """The largest number of which all are whole multiples."""
    above = gcd(*(n.numerator for n in numbers))
    below = lcm(*(n.denominator for n in numbers))
    return above if below == 1 else Fraction(above, below)


def _quotient(number: Number, content: Number) -> int:
    return number.numerator * content.denominator // (number.denominator * content.numerator)


def _divided(monomial: Monomial, divisor: dict[int, int]) -> Monomial:
    return tuple([(i, left) for i, power in monomial if (left := power - divisor.get(i, 0))])


def scaled(terms: Terms, number: Number) -> Terms:
    """Number times the terms."""
    products = ((monomial, number * c) for monomial, c in terms)
    return [(m, c.numerator if c.denominator == 1 else c) for m, c in products]


def is_plainly_irreducible(terms: Terms) -> bool:
    """Whether, apart from what all terms share, some generator occurs in one of them, linearly.

    In g·m + r, with m a single term and r free of g, one of two factors would be free of g and
    divide both m and r: it is a single term that all terms have in common.
    """
    degrees = dict[int, int]()
    for monomial, _ in terms:
        for i, power in monomial:
            degrees[i] = degrees.get(i, 0) + power
    return 1 in degrees.values()


def most_shared(terms: Terms) -> tuple[int, int, int]:
    """(minus the position, number of terms, lowest power) of the generator most terms share."""
    counts, lowest = dict[int, int](), dict[int, int]()
    for monomial, _ in terms:
        for i, power in monomial:
            if i in counts:
                counts[i] += 1
                lowest[i] = min(power, lowest[i])
            else:
                counts[i], lowest[i] = 1, power
    shared, place = max(((count, i) for i, count in counts.items()), default=(0, 0))
    return place, shared, lowest.get(place, 0)


def split(terms: Terms, place: int, power: int) -> tuple[Terms, Terms]:
    """(Q, R) of the terms Q g^power + R, R free of the generator g."""
    inner, rest = list[Term](), list[Term]()
    for monomial, coefficient in terms:
        for k, (i, own) in enumerate(monomial):
            if i == place:
                left = ((i, own - power),) if own > power else ()
                inner.append(((*monomial[:k], *left, *monomial[k + 1 :]), coefficient))
                break
        else:
            rest.append((monomial, coefficient))
    return inner, rest

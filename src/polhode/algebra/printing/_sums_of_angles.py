"""Functions of sums of angles for print: cos(α - β) for cos α cos β + sin α sin β."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, lru_cache
from itertools import combinations
from operator import le, sub
from typing import Any

from polhode.algebra._expression import Expr
from polhode.algebra._functions import CIRCULAR, Even
from polhode.algebra._ring import Monomial, Polynomial, Ring, Symbol, ring_of
from polhode.algebra.printing._order import factor_rank

#: Longer polynomials are printed as they are.
_LONGEST = 80

#: The powers and the coefficient of every term of a polynomial in cosine and sine of α, of β, and,
#: where they follow, of α - β and of α + β.
PairTerms = tuple[tuple[Monomial, Any], ...]


def in_sums_of_angles(ring: Ring, polynomial: Polynomial) -> tuple[Ring, Polynomial]:
    """The shortest form found, in a ring that has the functions needed; in general not reduced."""
    if len(polynomial) > _LONGEST:
        return ring, polynomial
    angles = [
        g
        for g in ring.generators
        if isinstance(g, Even) and g.family is CIRCULAR and g.base.symbol is not None
    ]
    for first, second in _meeting(ring, polynomial, sorted(angles, key=factor_rank)):
        ring, polynomial = _in_sums_of_two(ring, polynomial, first, second)
    return ring, polynomial


def _meeting(
    ring: Ring, polynomial: Polynomial, angles: Sequence[Even]
) -> Iterator[tuple[Even, Even]]:
    """Pairs of angles whose cosines or sines occur in one term."""
    places = [_positions(ring, [angle]) for angle in angles]
    used = {
        tuple(i for i, (c, s) in enumerate(places) if monomial[c] or monomial[s])
        for monomial in polynomial.monoms()
    }
    pairs = {pair for those in used for pair in combinations(those, 2)}
    return ((angles[i], angles[j]) for i, j in sorted(pairs))


def _in_sums_of_two(
    ring: Ring, polynomial: Polynomial, first: Even, second: Even
) -> tuple[Ring, Polynomial]:
    """With functions of the sum and the difference of two angles where that is shorter.

    Exchanges do not mix terms that differ in their powers of other generators: these groups of
    terms are shortened one by one, and what is found for one serves all that look like it.
    """
    groups = _grouped(polynomial, _positions(ring, (first, second)))
    found = {cofactor: _shortened(terms) for cofactor, (terms, _) in groups.items()}
    if not any(found.values()):
        return ring, polynomial
    sums = [Even(CIRCULAR, argument, Fraction(1)) for argument in _sums(first, second)]
    wider = ring_of(frozenset(ring.generators) | set(sums))
    places = _positions(wider, (first, second, *sums))
    kept = [wider.index[g] for g in ring.generators]
    result = dict[Monomial, Any]()
    for cofactor, (terms, scale) in groups.items():
        for powers, coefficient in found[cofactor] or terms:
            monomial = [0] * len(wider.generators)
            for place, power in (
                *zip(kept, cofactor, strict=True),
                *zip(places, powers, strict=False),
            ):
                monomial[place] += power
            result[tuple(monomial)] = coefficient * scale
    return wider, wider.context.from_dict(result)


def _positions(ring: Ring, functions: Iterable[Even]) -> list[int]:
    """Where a ring has the cosine and sine of each angle."""
    return [ring.index[g] for even in functions for g in (even, even.partner()[0])]


def _sums(first: Even, second: Even) -> tuple[Expr, Expr]:
    x, y = first.argument, second.argument
    return x - y, x + y


def _grouped(
    polynomial: Polynomial, places: Sequence[int]
) -> dict[Monomial, tuple[PairTerms, Any]]:
    """Its terms in the generators at some places, by their cofactors in the others.

    Each group with a common factor, so that its first coefficient is one.
    """
    groups: dict[Monomial, list[tuple[Monomial, Any]]] = defaultdict(list)
    for monomial, coefficient in polynomial.terms():
        rest = list(monomial)
        for place in places:
            rest[place] = 0
        groups[tuple(rest)].append((tuple(int(monomial[p]) for p in places), coefficient))
    scaled = {}
    for cofactor, terms in groups.items():
        terms.sort(key=lambda term: term[0])
        scale = terms[0][1]
        scaled[cofactor] = tuple((powers, number / scale) for powers, number in terms), scale
    return scaled


# -- two angles ------------------------------------------------------------------------------------


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


@lru_cache(maxsize=16384)
def _shortened(terms: PairTerms) -> PairTerms | None:
    """A shorter form with functions of the sum and the difference; None where there is none."""
    if len(terms) < 2:
        return None
    ring, places, exchanges = _two_angles()
    width = len(ring.generators)

    def monomial(powers: Monomial) -> Monomial:
        table = dict(zip(places, powers, strict=False))
        return tuple(table.get(i, 0) for i in range(width))

    polynomial = ring.context.from_dict({monomial(powers): c for powers, c in terms})
    # greedy: the replacement that saves most is made first, until none saves anything
    while found := [p for e in exchanges for p in e.applied(ring, polynomial)]:
        polynomial = min(found, key=len)
    if len(polynomial) == len(terms):
        return None
    return tuple((tuple(int(m[p]) for p in places), c) for m, c in polynomial.terms())


@cache
def _two_angles() -> tuple[Ring, list[int], list[_Exchange]]:
    """A ring for two angles, the places of the functions in it, and the identities."""
    first, second = (Even(CIRCULAR, Expr.generator(Symbol(n)), Fraction(1)) for n in "xy")
    sums = [Even(CIRCULAR, argument, Fraction(1)) for argument in _sums(first, second)]
    ring = ring_of(frozenset((first, second, *sums)))
    places = _positions(ring, (first, second, *sums))
    return ring, places, list(_exchanges(ring, [ring.context.gen(place) for place in places]))


def _exchanges(ring: Ring, functions: Sequence[Polynomial]) -> Iterator[_Exchange]:
    """Single functions of the difference and of the sum, and their products of two."""
    c1, s1, c2, s2, *of_sums = functions
    for cosine, sine, sign in ((*of_sums[:2], 1), (*of_sums[2:], -1)):
        pairs = [(cosine, c1 * c2 + sign * s1 * s2), (sine, s1 * c2 - sign * c1 * s2)]
        (c, long_c), (s, long_s) = pairs
        squares = [(c**2, long_c**2), (s**2, long_s**2), (s * c, long_s * long_c)]
        for short, long in (*squares, *pairs):
            reduced = ring.reduce(long)
            yield _Exchange(short, reduced, max(reduced.monoms(), key=sum))

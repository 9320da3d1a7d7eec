"""Rows without factors that say nothing: 7 (R − a) v̈ + … for (R − a) cos v (7 (R − a) v̈ + …)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from math import gcd, lcm, prod

from polhode.algebra import (
    ONE,
    Expr,
    Generator,
    Length,
    Symbol,
    SymbolKind,
    factors_of_numerator,
    lowest_numerator,
)

#: Terms above which factors of several terms are not looked for.
_LONGEST = 60

_PLACES = (SymbolKind.PARAMETER, SymbolKind.COORDINATE)


def without_idle_factors(row: Expr) -> Expr:
    """Numerator without the factors common to all terms in which nothing moves; over lengths.

    These are numbers, parameters, sines, and sums of them and of coordinates. The quotient vanishes
    on every motion where they are not zero, and by continuity elsewhere. A coordinate that is a
    factor by itself stays: r of r (r φ̈ + 2 ṙ φ̇) makes it the rate of an angular momentum.
    """
    numerator = lowest_numerator(row)
    terms = list(numerator.terms())
    if not terms:
        return row
    idle = _common(
        (powers for powers, _ in terms),
        lambda g: not isinstance(g, Symbol) or g.kind is SymbolKind.PARAMETER,
    )
    above = gcd(*(abs(c.numerator) for _, c in terms))
    below = lcm(*(c.denominator for _, c in terms))
    lengths = _common(
        (powers for powers, _ in row.denominator.terms()), lambda g: isinstance(g, Length)
    )
    shortened = numerator * below / above / Expr.product(idle)
    return _without_idle_sums(shortened) / Expr.product(lengths)


def _without_idle_sums(polynomial: Expr) -> Expr:
    if not 2 < len(polynomial.num) <= _LONGEST:
        return polynomial
    number, powers = factors_of_numerator(polynomial)
    kept = {factor: power for factor, power in powers.items() if not _is_idle(factor)}
    if not kept or len(kept) == len(powers):
        return polynomial
    return prod((factor**power for factor, power in kept.items()), start=ONE * number)


def _is_idle(factor: Expr) -> bool:
    """Whether nothing moves in it, and it is no coordinate by itself."""
    if len(factor.num) == 1 and any(isinstance(g, Symbol) for g in factor.generators):
        return False
    return all(s.kind in _PLACES and not s.order for s in factor.symbols())


def _common(
    terms: Iterable[Mapping[Generator, int]], wanted: Callable[[Generator], bool]
) -> dict[Generator, int]:
    """The powers of the wanted generators that all terms have in common."""
    first, *others = terms
    chosen = (g for g in first if wanted(g))
    return {g: min(powers.get(g, 0) for powers in (first, *others)) for g in chosen}

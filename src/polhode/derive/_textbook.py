"""Equations as a text prints them: without factors that say nothing."""

from __future__ import annotations

from math import gcd, lcm

from polhode.algebra import Expr, Symbol, SymbolKind, lowest_numerator


def without_idle_factors(row: Expr) -> Expr:
    """Numerator without the number, parameters and sines common to all terms.

    What is left vanishes wherever the sine does not, and by continuity there too.
    """
    numerator = lowest_numerator(row)
    terms = list(numerator.terms())
    if not terms:
        return row
    shared = {
        g: min(powers.get(g, 0) for powers, _ in terms)
        for g in terms[0][0]
        if not isinstance(g, Symbol) or g.kind is SymbolKind.PARAMETER
    }
    above = gcd(*(abs(c.numerator) for _, c in terms))
    below = lcm(*(c.denominator for _, c in terms))
    result = numerator * below / above
    for generator, power in shared.items():
        result = result / Expr.generator(generator) ** power
    return result

"""Expressions as plain numbers and generators: what is pickled."""

from __future__ import annotations

from flint import fmpq

from polhode.algebra._expression import Expr
from polhode.algebra._generators import Generator
from polhode.algebra._ring import Polynomial, ring_of

#: Powers over the generators, numerator and denominator of the coefficient, for each term.
Plain = tuple[tuple[tuple[int, ...], int, int], ...]


def plain(expression: Expr, polynomial: Polynomial) -> Plain:
    """The terms of a polynomial over the generators of the expression."""
    positions = [expression.ring.index[g] for g in expression.generators]
    return tuple(
        (tuple(monomial[p] for p in positions), int(c.p), int(c.q))
        for monomial, c in polynomial.terms()
    )


def rebuilt(generators: tuple[Generator, ...], num: Plain, den: Plain) -> Expr:
    """The expression that was taken apart."""
    ring = ring_of(frozenset(generators))
    positions = [ring.index[g] for g in generators]

    def polynomial(terms: Plain) -> Polynomial:
        table = {}
        for powers, p, q in terms:
            monomial = [0] * len(ring.generators)
            for position, power in zip(positions, powers, strict=True):
                monomial[position] = power
            table[tuple(monomial)] = fmpq(p, q)
        return ring.context.from_dict(table)

    return Expr(ring, polynomial(num), polynomial(den))

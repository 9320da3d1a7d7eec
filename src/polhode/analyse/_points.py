"""Exact evaluation at random rational points, with sines and cosines on the unit circle."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from random import Random
from typing import Any

from flint import fmpq

from polhode.algebra import Expr, Generator, Symbol
from polhode.base import NumericError

Rational = Any  # flint.fmpq
Values = Mapping[Symbol, Rational]


class Point:
    """A rational value for every symbol, and what generators are there.

    sin x → 2x/(1 + x²) and cos x → (1 - x²)/(1 + x²) stand in for the sine and cosine: other
    points, but with every algebraic relation intact, which is all that identities ask for.
    """

    def __init__(self, values: Values) -> None:
        self._known: dict[Generator, Rational] = dict(values.items())
        self._in_ring: dict[object, list[Rational]] = {}

    def __call__(self, expression: Expr) -> Rational:
        """The exact value of an expression."""
        ring = expression.ring
        if ring not in self._in_ring:
            self._in_ring[ring] = [self._value(generator) for generator in ring.generators]
        values = self._in_ring[ring]
        above = fmpq(expression.num(*values))
        return above if expression.is_polynomial else above / fmpq(expression.den(*values))

    def all(self, expressions: Iterable[Expr]) -> list[Rational]:
        """The exact values of several expressions."""
        return [self(expression) for expression in expressions]

    def _value(self, generator: Generator) -> Rational:
        if generator not in self._known:
            self._known[generator] = self._function(generator)
        return self._known[generator]

    def _function(self, generator: Generator) -> Rational:
        even = next((g for g in generator.companions() if g.partner()), None)
        partner = even.partner() if even is not None else None
        if partner is None:
            if isinstance(generator, Symbol):
                return fmpq(1)  # in the ring, but not in the expression
            raise NumericError(
                "a square root or an exponential in a search for integrals",
                expected="equations in polynomials, sines and cosines",
                advice="the named candidates are still tried",
            )
        sign = partner[1]
        x = self(generator.arguments[0])
        above = 1 + sign * x * x if generator == even else 2 * x
        return above / (1 - sign * x * x)


def random_values(symbols: Sequence[Symbol], random: Random) -> dict[Symbol, Rational]:
    """Rational numbers between 0 and 1, where no sine or cosine vanishes."""
    return {s: fmpq(random.randint(2, 97), random.randint(101, 197)) for s in symbols}

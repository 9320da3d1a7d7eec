"""Polynomial rings: an ordered set of generators, with the relations between them.

A ring is the bridge to python-flint. Polynomials are kept reduced: no algebraic generator occurs
with a power above one. Fractions are kept with denominators free of algebraic generators. With
numerator and denominator coprime and the denominator monic that form is unique, so that "is it
zero" is decided and never guessed.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Any

from flint import Ordering, fmpq_mpoly_ctx

from polhode.algebra._generators import Generator
from polhode.base import DeclarationError, NumericError

_MOST_PRODUCTS = 2 * 10**6  # of terms; beyond, what comes out is of no use and fills the memory
_FEW = 16  # terms up to which it is quicker to put the variables in one by one
Polynomial = Any  # flint.fmpq_mpoly: python-flint ships no usable type information
Monomial = tuple[int, ...]


class Ring:
    """Q[generators] modulo the squares of the algebraic ones; made by `ring_of` only."""

    __slots__ = ("_algebraic", "context", "generators", "has_parts", "index", "one", "zero")

    def __init__(self, generators: tuple[Generator, ...]) -> None:
        self.generators = generators
        self.index = {generator: i for i, generator in enumerate(generators)}
        names = tuple(generator.key for generator in generators)
        self.context = fmpq_mpoly_ctx.get(names, Ordering.lex)
        self.zero: Polynomial = self.context.constant(0)
        self.one: Polynomial = self.context.constant(1)
        self._algebraic: tuple[tuple[int, Polynomial], ...] | None = None
        self.has_parts = any(generator.is_part for generator in generators)

    @property
    def algebraic(self) -> tuple[tuple[int, Polynomial], ...]:
        """Position and square of every algebraic generator, the highest in the tower first."""
        if self._algebraic is None:
            tower = sorted(
                (g for g in self.generators if g.depth), key=lambda g: g.depth, reverse=True
            )
            self._algebraic = tuple((self.index[g], g.square(self)) for g in tower)
        return self._algebraic

    def variable(self, generator: Generator) -> Polynomial:
        """The generator as a polynomial."""
        return self.context.gen(self.index[generator])

    def lift(self, ring: Ring, polynomial: Polynomial) -> Polynomial:
        """A polynomial of a smaller ring as one of this ring."""
        if ring is self:
            return polynomial
        if not ring.generators:
            number = polynomial.leading_coefficient() if polynomial != 0 else 0
            return self.context.constant(number)
        if len(polynomial) > _FEW:
            return polynomial.project_to_context(self.context)
        return polynomial.compose(*_places(ring, self), ctx=self.context)

    def reduce(self, polynomial: Polynomial) -> Polynomial:
        """The same element with no algebraic generator squared."""
        if not self.algebraic:
            return polynomial
        degrees = polynomial.degrees()
        for position, square in self.algebraic:
            if degrees[position] > 1:
                polynomial = self._fold(polynomial, position, square)
                degrees = polynomial.degrees()
        return polynomial

    def _fold(self, polynomial: Polynomial, position: int, square: Polynomial) -> Polynomial:
        by_power: dict[int, dict[Monomial, Any]] = defaultdict(dict)
        for monomial, coefficient in polynomial.to_dict().items():
            power, rest = divmod(monomial[position], 2)
            by_power[power][_with(monomial, position, rest)] = coefficient
        return sum(
            (self.context.from_dict(part) * square**power for power, part in by_power.items()),
            self.zero,
        )

    def grouped(
        self, polynomial: Polynomial, positions: Sequence[int]
    ) -> dict[Monomial, Polynomial]:
        """Its coefficients over the generators at `positions`, by the powers of those."""
        parts: dict[Monomial, dict[Monomial, Any]] = defaultdict(dict)
        for monomial, coefficient in polynomial.to_dict().items():
            rest = list(monomial)
            for position in positions:
                rest[position] = 0
            parts[tuple(monomial[p] for p in positions)][tuple(rest)] = coefficient
        return {powers: self.context.from_dict(part) for powers, part in parts.items()}

    def split(self, polynomial: Polynomial, position: int) -> tuple[Polynomial, Polynomial]:
        """(C, D) of a reduced polynomial C + D g, g the generator at `position`."""
        parts = self.grouped(polynomial, (position,))
        return parts.get((0,), self.zero), parts.get((1,), self.zero)

    def rationalise(self, num: Polynomial, den: Polynomial) -> tuple[Polynomial, Polynomial]:
        """The same fraction with a denominator free of algebraic generators."""
        if den.is_constant():
            return num, den
        for position, _ in self.algebraic:
            if den.degrees()[position]:
                even, odd = self.split(den, position)
                conjugate = even - odd * self.context.gen(position)
                _refuse_if_hopeless(max(len(num), len(den)) * len(conjugate))
                num, den = self.reduce(num * conjugate), self.reduce(den * conjugate)
                if den == 0:
                    raise ZeroDivisionError("the denominator vanishes identically")
        return num, den

    def cancel(self, num: Polynomial, den: Polynomial) -> tuple[Polynomial, Polynomial]:
        """Lowest terms, with a monic denominator; `den` free of algebraic generators."""
        if den.is_constant():
            return num / den.leading_coefficient(), self.one
        common = den
        for part in self._over_transcendentals(num):
            common = common.gcd(part)
            if common.is_constant():
                break
        else:
            num, den = num / common, den / common
        lead = den.leading_coefficient()
        return num / lead, den / lead

    def _over_transcendentals(self, num: Polynomial) -> Iterable[Polynomial]:
        """Coefficients of `num` over the monomials of the algebraic generators."""
        positions = [position for position, _ in self.algebraic]
        return self.grouped(num, positions).values() if positions else (num,)


def _refuse_if_hopeless(products: int) -> None:
    """Each unlike cosine or root in a denominator squares the number of terms that it grows to."""
    if products > _MOST_PRODUCTS:
        raise NumericError(
            f"a denominator with sines, exponentials or roots of too many unlike arguments: "
            f"{products:.0e} products to bring it to its unique form",
            expected=f"at most {_MOST_PRODUCTS:.0e}",
            advice="give some of its symbols values, or multiply the denominator out",
        )


def _with(monomial: Monomial, position: int, power: int) -> Monomial:
    return (*monomial[:position], power, *monomial[position + 1 :])


def ring_of(generators: frozenset[Generator]) -> Ring:
    """The ring with these generators and their companions."""
    return _ring_of(generators, frozenset(g.key for g in generators if g.positive))


@lru_cache(maxsize=4096)
def _ring_of(generators: frozenset[Generator], positive: frozenset[str]) -> Ring:
    # generators are equal whether or not their sign is known: `positive` keeps those rings apart
    closure = set(generators)
    pending = list(generators)
    while pending:
        needed = set(pending.pop().companions()) - closure
        pending += needed
        closure |= needed
    if len(closure) > len(generators):
        return ring_of(frozenset(closure))
    return Ring(_ordered(closure))


def _ordered(generators: set[Generator]) -> tuple[Generator, ...]:
    symbols = sorted(frozenset().union(*(g.symbols() for g in generators)), key=lambda s: s.key)
    for first, second in pairwise(symbols):
        if first.key == second.key:
            raise DeclarationError(
                f"two different quantities are both called {first.key!r}",
                expected="one meaning for one name",
                advice="rename one of them",
            )
    return tuple(sorted(generators, key=lambda g: g.key))


@lru_cache(maxsize=16384)
def union(*rings: Ring) -> Ring:
    """The smallest ring that holds them all."""
    generators = (generator for ring in rings for generator in ring.generators)
    known_first = sorted(generators, key=lambda g: not g.positive)
    return ring_of(frozenset(known_first))


@lru_cache(maxsize=16384)
def _places(ring: Ring, larger: Ring) -> tuple[Polynomial, ...]:
    """The variables of one ring in another that holds them."""
    return tuple(map(larger.variable, ring.generators))


CONSTANTS = ring_of(frozenset())

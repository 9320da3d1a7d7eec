"""Generators and the polynomial rings over them.

A generator is a symbol, or a function of symbols such as sin θ or √a. A ring is an ordered set of
generators with the relations between them, and the bridge to python-flint. Polynomials are kept
reduced: no algebraic generator occurs with a power above one. Fractions are kept with denominators
free of algebraic generators. With numerator and denominator coprime and the denominator monic that
form is unique, so that "is it zero" is decided and never guessed.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from functools import cached_property, lru_cache
from hashlib import blake2b
from typing import Any

from flint import Ordering, acb, arb, fmpq, fmpq_mpoly_ctx

from polhode.algebra._residues import FieldPoint, Residue, element, evaluated
from polhode.base import DeclarationError, NumericError

_MOST_PRODUCTS = 2 * 10**6  # of terms; a longer result is useless and fills the memory
_SHORT = 16  # terms, up to which composition is faster than projection, which compares names
_MEMORY = 65536  # values of generators that are remembered

Polynomial = Any  # flint.fmpq_mpoly: python-flint ships no usable type information
Ball = Any  # flint.acb, likewise
Monomial = tuple[int, ...]
#: Powers over some generators, numerator and denominator of the coefficient, for each term.
PlainTerms = tuple[tuple[tuple[int, ...], int, int], ...]


# -- generators ------------------------------------------------------------------------------------


class Generator(ABC):
    """One variable of a polynomial ring: a symbol, or a function such as sin θ of an expression.

    A generator is *algebraic* when its square is a polynomial in simpler generators
    (cos² = 1 - sin², a square root); every other one is transcendental.
    """

    #: Unique name; fixes the order of generators everywhere.
    key: str
    #: Whether its value is known to be positive.
    positive: bool = False
    #: Whether it stands for a longer expression that is not multiplied out.
    is_part: bool = False

    @property
    def depth(self) -> int:
        """Height in the tower of algebraic generators; 0 for a transcendental one."""
        return 0

    def square(self, ring: Ring) -> Polynomial:
        """What the square of an algebraic generator equals, in a ring that holds it."""
        return ring.variable(self) ** 2

    def companions(self) -> tuple[Generator, ...]:
        """Generators that its square, or another form of it, is written with."""
        return ()

    def partner(self) -> tuple[Generator, int] | None:
        """The odd function and the sign with which this one's square is 1 + sign · odd²."""
        return None

    @property
    def arguments(self) -> tuple[Any, ...]:
        """The expressions that it is a function of; their class, `Expr`, is built on rings."""
        return ()

    @abstractmethod
    def symbols(self) -> frozenset[Symbol]:
        """The symbols it depends on."""

    @property
    def varies(self) -> bool:
        """Whether a coordinate, a speed, a reaction or a function of time occurs in it."""
        return any(symbol.kind.varies for symbol in self.symbols())

    @abstractmethod
    def ball(self, state: int) -> Ball:
        """Its value at one of the random states of `Ring.ball`."""

    @abstractmethod
    def residue(self, point: FieldPoint) -> Residue:
        """Its value at a random point of a prime field."""


class SymbolKind(Enum):
    """What a symbol stands for; decides what its time derivative is."""

    PARAMETER = "parameter"
    COORDINATE = "coordinate"
    SPEED = "speed"
    FUNCTION = "function"
    REACTION = "reaction"
    TIME = "time"

    @property
    def varies(self) -> bool:
        """Whether the time derivative is a further symbol."""
        return self not in (SymbolKind.PARAMETER, SymbolKind.TIME)


_DOTS = ("", "_dot", "_ddot", "_dddot")


@dataclass(frozen=True)
class Symbol(Generator):
    """A named quantity, or one of its time derivatives.

    `positive` says that its sign is known, so that √(x²) = x; it does not count in comparisons.
    """

    name: str
    kind: SymbolKind = SymbolKind.PARAMETER
    order: int = 0
    positive: bool = field(default=False, compare=False)

    @cached_property
    def published(self) -> str:
        """ASCII name as scripts know it: `theta`, `theta_dot`, `omega_3_dot`."""
        if self.order < len(_DOTS):
            return self.name + _DOTS[self.order]
        return f"{self.name}_d{self.order}"

    @cached_property
    def key(self) -> str:  # type: ignore[override]
        return self.published if self.kind is not SymbolKind.TIME else "t"

    def derivative(self) -> Symbol:
        """The symbol of the time derivative."""
        return _derivative(self)

    def base(self) -> Symbol:
        """The quantity this is a time derivative of."""
        if not self.order:
            return self
        return Symbol(self.name, self.kind, 0, self.positive)

    def __hash__(self) -> int:
        return hash(self.key)

    def __repr__(self) -> str:
        return self.published

    def symbols(self) -> frozenset[Symbol]:
        return frozenset((self,))

    def ball(self, state: int) -> Ball:
        if self == PI:
            return acb.pi()
        # Hashed rather than drawn: a symbol has the same value in every ring and every process, so
        # that verdicts are reproducible. A polynomial that is not identically zero vanishes at such
        # a point with negligible probability (Schwartz, J. ACM 27 (1980) 701). Values keep away
        # from zero where the sign is known, so that no root or quotient of parameters fails.
        digest = blake2b(f"{state} {self.key}".encode(), digest_size=16).digest()
        drawn = fmpq(1, 8) + fmpq(int.from_bytes(digest, "big"), 2**128)  # from 1/8 to 9/8
        return acb(arb(drawn if self.positive else drawn - fmpq(1, 2)))

    def residue(self, point: FieldPoint) -> Residue:
        return Residue(point.drawn(self.key), 1)


@lru_cache(maxsize=4096)
def _derivative(symbol: Symbol) -> Symbol:
    return Symbol(symbol.name, symbol.kind, symbol.order + 1)


#: The ratio of a circle's circumference to its diameter.
PI = Symbol("pi", SymbolKind.PARAMETER, 0, positive=True)


def as_fraction(number: Any) -> Fraction:
    """A FLINT rational as a Python one."""
    return Fraction(int(number.p), int(number.q))


# -- rings -----------------------------------------------------------------------------------------


class Ring:
    """Q[generators] modulo the squares of the algebraic ones; made by `ring_of` only."""

    __slots__ = (
        "_algebraic",
        "_relations",
        "context",
        "generators",
        "has_parts",
        "index",
        "one",
        "zero",
    )

    def __init__(self, generators: tuple[Generator, ...]) -> None:
        self.generators = generators
        self.index = {generator: i for i, generator in enumerate(generators)}
        # FLINT takes ASCII alone, and the unit "kg m²" that a text prints is a name too.
        names = tuple(g.key.encode("ascii", "backslashreplace").decode() for g in generators)
        self.context = fmpq_mpoly_ctx.get(names, Ordering.lex)
        self.zero: Polynomial = self.context.constant(0)
        self.one: Polynomial = self.context.constant(1)
        self._algebraic: tuple[tuple[int, Polynomial], ...] | None = None
        self._relations: dict[int, Polynomial | None] = {}
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

    def _relation(self, position: int, square: Polynomial) -> Polynomial | None:
        """g² - `square` for the generator g at a position, if g² leads it; else None."""
        if position not in self._relations:
            relation = self.context.gen(position) ** 2 - square
            leads = [2 * int(i == position) for i in range(len(self.generators))]
            leading = list(relation.monoms()[0]) == leads
            self._relations[position] = relation if leading else None
        return self._relations[position]

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
        if len(polynomial) > _SHORT:
            return polynomial.project_to_context(self.context)
        return polynomial.compose(*_variables(ring, self), ctx=self.context)

    def reduce(self, polynomial: Polynomial) -> Polynomial:
        """The same element with no algebraic generator squared."""
        if not self.algebraic:
            return polynomial
        degrees = polynomial.degrees()
        for position, square in self.algebraic:
            if degrees[position] > 1:
                relation = self._relation(position, square)
                if relation is None:
                    polynomial = self.folded(polynomial, position, square)
                else:  # the remainder is the same, and takes a fiftieth of the time
                    polynomial = polynomial % relation
                degrees = polynomial.degrees()
        return polynomial

    def folded(self, polynomial: Polynomial, position: int, square: Polynomial) -> Polynomial:
        """With every square of the generator at `position` replaced by `square`."""
        by_power: dict[int, dict[Monomial, Any]] = defaultdict(dict)
        for monomial, coefficient in polynomial.to_dict().items():
            power, rest = divmod(monomial[position], 2)
            by_power[power][(*monomial[:position], rest, *monomial[position + 1 :])] = coefficient
        return sum(
            (self.context.from_dict(part) * square**power for power, part in by_power.items()),
            self.zero,
        )

    def grouped(
        self, polynomial: Polynomial, positions: Sequence[int]
    ) -> dict[Monomial, Polynomial]:
        """Its coefficients as a polynomial in the generators at `positions`, by their powers."""
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
        # (C + D g)(C - D g) = C² - D² g² is free of g, as g² is a polynomial in generators lower in
        # the tower. From the top down, no generator that has been removed can come back.
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
        # The products of algebraic generators are linearly independent over the denominators, which
        # are free of them. So a factor cancels exactly where it divides the coefficient of each:
        # where it divides the polynomial in which these generators count as independent.
        common = num.gcd(den)
        if not common.is_constant():
            num, den = num / common, den / common
        lead = den.leading_coefficient()
        return num / lead, den / lead

    def ball(self, polynomial: Polynomial, state: int) -> Ball:
        """Its value at a random state in the working precision, as a rigorous enclosure.

        At one state a generator has the same value in every ring.
        """
        total = acb(0)
        for monomial, coefficient in polynomial.terms():
            term = acb(arb(fmpq(coefficient)))
            for generator, power in zip(self.generators, monomial, strict=True):
                if power:
                    term *= _ball(generator, state) ** int(power)
            total += term
        return total

    def residue(self, polynomial: Polynomial, point: FieldPoint) -> Residue:
        """Its value at a random point of a prime field."""
        if polynomial == 0:
            return Residue(element(0))
        degrees = [int(power) for power in polynomial.degrees()]
        pairs = zip(self.generators, degrees, strict=True)
        found = [point.of(generator) if power else _ABSENT for generator, power in pairs]
        value = evaluated(polynomial, [one.value for one in found])
        degree = sum(one.degree * power for one, power in zip(found, degrees, strict=True))
        roots = frozenset().union(*(one.roots for one in found))
        return Residue(value, degree, roots)

    def plain(self, generators: Sequence[Generator], polynomial: Polynomial) -> PlainTerms:
        """The terms of a polynomial over some generators, among them all that occur in it."""
        positions = [self.index[g] for g in generators]
        return tuple(
            (tuple(monomial[p] for p in positions), int(c.p), int(c.q))
            for monomial, c in polynomial.terms()
        )

    def polynomial(self, generators: Sequence[Generator], terms: PlainTerms) -> Polynomial:
        """The polynomial that has these plain terms."""
        positions = [self.index[g] for g in generators]
        table = {}
        for powers, p, q in terms:
            monomial = [0] * len(self.generators)
            for position, power in zip(positions, powers, strict=True):
                monomial[position] = power
            table[tuple(monomial)] = fmpq(p, q)
        return self.context.from_dict(table)


_ABSENT = Residue(element(0))  # of a generator that does not occur


@lru_cache(maxsize=16384)
def _variables(ring: Ring, larger: Ring) -> tuple[Polynomial, ...]:
    """The generators of a ring as polynomials of a larger one."""
    return tuple(map(larger.variable, ring.generators))


@lru_cache(_MEMORY)
def _ball(generator: Generator, state: int) -> Ball:
    return generator.ball(state)


class OutgrownError(NumericError):
    """An exact solution that has grown too long to be of use."""


def _refuse_if_hopeless(products: int) -> None:
    """Each further cosine or root in a denominator can square its number of terms."""
    if products > _MOST_PRODUCTS:
        raise OutgrownError(
            f"a denominator with sines, exponentials or roots of too many different arguments: "
            f"{products:.0e} products to bring it to normal form",
            expected=f"at most {_MOST_PRODUCTS:.0e}",
            advice="give some of its symbols values, or multiply the denominator out",
        )


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
    symbols = frozenset[Symbol]().union(*(g.symbols() for g in closure))
    names = {symbol.key for symbol in symbols}
    if len(names) < len(symbols):
        shared = [n for n in sorted(names) if sum(s.key == n for s in symbols) > 1]
        raise DeclarationError(
            f"two different quantities are both called {shared[0]!r}",
            expected="one meaning for one name",
            advice="rename one of them",
        )
    return Ring(tuple(sorted(closure, key=lambda g: g.key)))


@lru_cache(maxsize=16384)
def union(*rings: Ring) -> Ring:
    """The smallest ring that holds them all."""
    generators = (generator for ring in rings for generator in ring.generators)
    # of equal symbols a set keeps the first, which should be the one whose sign is known
    known_first = sorted(generators, key=lambda g: not g.positive)
    return ring_of(frozenset(known_first))


CONSTANTS = ring_of(frozenset())

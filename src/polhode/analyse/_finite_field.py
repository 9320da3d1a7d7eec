"""Evaluation at random points of a prime field: identities and independence without expansion.

sin x → 2h/(1 + h²) and cos x → (1 - h²)/(1 + h²) with a random h stand in for sine and cosine, and
square roots are taken within the field. These are not points of real space, but every algebraic
relation holds at them. An expression that vanishes at random points of a large field vanishes
identically, with a probability of error of the order of its degree over 2³¹ (J. T. Schwartz,
1980; R. Zippel, 1979).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice
from random import Random

from flint import fmpq, fmpz, nmod_mat

from polhode.algebra import Expr, Generator, Symbol, under_name
from polhode.base import NumericError

#: Primes p = 3 mod 4 from here downwards: in their fields d^((p + 1)/4) is a root of a square d.
#: Products of two residues fit into 64 bits.
_LARGEST = 2**31 - 1
#: How many fields are tried, each until so many points in a row have no value. A constant such as
#: √3 has a value in half of all fields, several independent ones in few.
_FIELDS = 4000
_MISSES = 64


class _NoValueError(Exception):
    """A denominator that vanishes at a point, or a radicand without a root there."""


@dataclass(frozen=True)
class Field:
    """Numbers modulo a prime, with one value for everything that does not vary.

    Attributes:
        prime: the modulus.
        random: source of the values.
        varying: symbols with another value at every point.
        fixed: values of the others and of the functions of these alone.
    """

    prime: int
    random: Random
    varying: frozenset[Symbol]
    fixed: dict[Generator, int] = field(default_factory=dict)

    def inverse(self, number: int) -> int:
        """One over a number."""
        if number % self.prime == 0:
            raise _NoValueError
        return pow(number, -1, self.prime)

    def root(self, square: int) -> int:
        """A square root."""
        found = pow(square, (self.prime + 1) // 4, self.prime)
        if (found * found - square) % self.prime:
            raise _NoValueError
        return found


class SamplePoint:
    """A random value for every symbol, and the values of generators that follow from them."""

    def __init__(self, among: Field) -> None:
        self.field = among
        self._own: dict[Generator, int] = {}
        self._values: dict[Generator, int] = {}
        self._in_ring: dict[object, list[int]] = {}

    def __call__(self, expression: Expr) -> int:
        """The value of an expression."""
        ring = expression.ring
        if ring not in self._in_ring:
            for generator in ring.generators:
                if generator not in self._values:
                    self._values[generator] = self._value(generator)
            self._in_ring[ring] = [self._values[generator] for generator in ring.generators]
        values, residues = self._in_ring[ring], []
        for part in (expression.num, expression.den):
            number = fmpq(part(*values))
            residues.append(int(number.p) * self.field.inverse(int(number.q)))
        return residues[0] * self.field.inverse(residues[1]) % self.field.prime

    def all(self, expressions: Iterable[Expr]) -> list[int]:
        """The values of several expressions."""
        return [self(expression) for expression in expressions]

    def has(self, expressions: Iterable[Expr]) -> bool:
        """Whether all expressions have a value here."""
        try:
            self.all(expressions)
        except _NoValueError:
            return False
        return True

    def _value(self, generator: Generator) -> int:
        """The value of a generator: cos and sin, or cosh and sinh, by one random h for both."""
        even = next(
            (g for g in generator.companions() if generator.arguments and g.partner()), None
        )
        partner = even.partner() if even is not None else None
        if partner is not None and generator in (even, partner[0]):
            half, sign = self._drawn(partner[0]), partner[1]
            above = 1 + sign * half * half if generator == even else 2 * half
            return above * self.field.inverse(1 - sign * half * half) % self.field.prime
        meaning = under_name(generator)
        if meaning is not None:
            return self(meaning)
        if generator.depth:
            return self.field.root(self(generator.arguments[0]))
        return self._drawn(generator)  # a symbol or an exponential, independent of all others

    def _drawn(self, generator: Generator) -> int:
        varies = not generator.symbols().isdisjoint(self.field.varying)
        known = self._own if varies else self.field.fixed
        if generator not in known:
            known[generator] = self.field.random.randrange(2, self.field.prime)
        return known[generator]


def points(
    expressions: Sequence[Expr], varying: Iterable[Symbol], count: int, seed: int
) -> list[SamplePoint]:
    """Random points of one field at which all expressions have a value.

    Args:
        expressions: those to be evaluated.
        varying: symbols with a new value at every point; all others have the same at all points.
        count: number of points.
        seed: of the random values.

    Raises `NumericError` where no such points are found.
    """
    random, changing = Random(seed), frozenset(varying)
    primes = (n for n in range(_LARGEST, 3, -4) if fmpz(n).is_probable_prime())
    for prime in islice(primes, _FIELDS):
        found = list(islice(_regular(Field(prime, random, changing), expressions), count))
        if len(found) == count:
            return found
    raise NumericError(
        "integrals of expressions that have no value at random points",
        expected="expressions that are defined somewhere",
    )


def _regular(among: Field, expressions: Sequence[Expr]) -> Iterator[SamplePoint]:
    misses = 0
    while misses < _MISSES:
        point = SamplePoint(among)
        if point.has(expressions):
            misses = 0
            yield point
        misses += 1


_SEED = 20261121


class Independent:
    """A growing set of functionally independent functions of the state.

    Decided by the rank of their gradients (Jacobi's criterion) at one random point, where it is
    lower than elsewhere only by coincidence.
    """

    def __init__(self, state: Iterable[Symbol]) -> None:
        self._state = tuple(state)
        self._gradients: list[list[Expr]] = []

    def takes(self, expression: Expr) -> bool:
        """Add an expression if it is independent of those taken before."""
        gradients = [*self._gradients, [expression.diff(symbol) for symbol in self._state]]
        entries = [entry for gradient in gradients for entry in gradient]
        (point,) = points(entries, self._state, 1, _SEED)
        table = nmod_mat(len(gradients), len(self._state), point.all(entries), point.field.prime)
        if table.rank() < len(gradients):
            return False
        self._gradients = gradients
        return True

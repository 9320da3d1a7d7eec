"""Lengths that are kept as they stand: ρ = |r₁ − r₂| is one quantity, as on paper.

A distance or a slip speed ρ obeys ρ² = Σ c², so that an expression in which it occurs could be
multiplied out and its denominator freed of the root. That makes it long: 1/ρ³ becomes ρ over the
square of a sum of squares. It also costs digits: (x₁ − x₂)² is exact to rounding however far from
the origin both points are, and x₁² − 2 x₁ x₂ + x₂² is not. So lengths are named parts here, and so
are the components that they are made of.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from hashlib import blake2b
from math import prod
from typing import Any

from polhode.algebra._expression import ZERO, Expr, Rate, total
from polhode.algebra._parts import NamedPart
from polhode.algebra._ring import Generator, Symbol
from polhode.algebra._roots import SquareRoot, factors, sqrt
from polhode.algebra._vector import Vector

_MEMORY = 16384  # meanings that are remembered
RHO = "rho"


@dataclass(frozen=True, eq=False)
class KeptSum(NamedPart):
    """A sum that is not multiplied out, such as the difference of two coordinates."""

    is_hidden = False

    @cached_property
    def key(self) -> str:  # type: ignore[override]
        return f"sum {_digest(self.meaning.key)}"

    def __eq__(self, other: object) -> bool:
        return NamedPart.__eq__(self, other)

    def __hash__(self) -> int:
        return hash(self.key)

    def __reduce__(self) -> tuple[Any, ...]:
        return KeptSum, (self.meaning,)

    def chain(self, rate: Rate) -> Expr:
        return self.meaning.chain(rate)

    def replaced(self, image: Rate) -> Expr:
        return kept_sum(self.meaning.replaced(image))

    def remade(self, inside: Expr) -> Expr:
        return kept_sum(inside)


@dataclass(frozen=True, eq=False)
class Length(NamedPart):
    """The length of a vector.

    Attributes:
        components: of the vector along directions at right angles to each other, as they are kept.
        letter: of the vector for a velocity, as in |v_c|, else of the length, as in ρ.
        of_velocity: whether it is printed as an absolute value.
    """

    components: tuple[Expr, ...]
    letter: str
    of_velocity: bool
    positive = True
    is_hidden = False
    has_letter = True

    @cached_property
    def key(self) -> str:  # type: ignore[override]
        return f"length {self.letter} {_digest(self.meaning.key)}"

    def __eq__(self, other: object) -> bool:
        return NamedPart.__eq__(self, other)

    def __hash__(self) -> int:
        return hash(self.key)

    def __reduce__(self) -> tuple[Any, ...]:
        return Length, (self.meaning, self.components, self.letter, self.of_velocity)

    def chain(self, rate: Rate) -> Expr:
        # ρ ρ̇ = Σ c ċ
        speeds = (c * c.chain(rate) for c in self.components)
        return total(speeds) / Expr.generator(self)

    def replaced(self, image: Rate) -> Expr:
        components = [c.replaced(image) for c in self.components]
        return kept_length(components, self.letter, of_velocity=self.of_velocity)

    def remade(self, inside: Expr) -> Expr:
        return inside


def _digest(key: str) -> str:
    return blake2b(key.encode(), digest_size=10).hexdigest()


def kept_sum(expression: Expr) -> Expr:
    """A polynomial whose factors with several terms are kept as they stand."""
    if not expression.is_polynomial or len(expression.num) < 2:
        return expression
    number, powers = factors(expression)
    kept = (_kept(factor) ** power for factor, power in powers.items())
    return prod(kept, start=Expr.constant(number))


def _kept(factor: Expr) -> Expr:
    if len(factor.num) < 2:
        return factor
    if _first_coefficient(factor) < 0:  # a − b and b − a are one quantity
        return -_kept(-factor)
    return Expr.generator(KeptSum(factor.trimmed()))


def shorter(expression: Expr) -> Expr:
    """An expression with kept sums multiplied out where that leaves fewer terms.

    Only sums are, of which no term grows with a distance from the origin: their differences lose no
    digits.
    """
    images = {g: g.meaning for g in expression.generators if _is_bounded(g)}
    if not images:
        return expression
    written = expression.recast(images)
    is_shorter = _bulk(written) < _bulk(expression)
    return written if is_shorter else expression


def _bulk(expression: Expr) -> int:
    """Terms, and those of the sums in them."""
    inside = (len(g.meaning.num) for g in expression.generators if isinstance(g, KeptSum))
    return len(expression.num) + sum(inside)


def _is_bounded(generator: Generator) -> bool:
    """Whether it is a sum without lengths in which coordinates and speeds occur as angles only."""
    if not isinstance(generator, KeptSum) or generator.meaning.ring.has_parts:
        return False
    return not any(isinstance(g, Symbol) and g.varies for g in generator.meaning.generators)


def _first_coefficient(expression: Expr) -> Fraction:
    """That of a length, as in ρ − l, or else of the shortest term, as in v − a ω."""

    def rank(term: tuple[dict[Generator, int], Fraction]) -> tuple[bool, int]:
        powers, _ = term
        return not any(isinstance(g, Length) for g in powers), sum(powers.values())

    return min(expression.terms(), key=rank)[1]


def with_letters(expression: Expr, letters: Mapping[str, str]) -> Expr:
    """An expression whose lengths have other letters, by the keys of what they stand for."""
    images = {g: _lettered(g, letters) for g in expression.generators if isinstance(g, NamedPart)}
    return expression.recast({g: image for g, image in images.items() if image is not None})


def _lettered(part: NamedPart, letters: Mapping[str, str]) -> Expr | None:
    if isinstance(part, Length):
        letter = letters.get(part.meaning.key, part.letter)
        return Expr.generator(replace(part, letter=letter))
    inside = with_letters(part.meaning, letters)
    return part.remade(inside) if inside != part.meaning else None


def kept_sums(vector: Vector) -> Vector:
    """A vector whose components are kept as they stand."""
    return Vector(tuple(map(kept_sum, vector.components)), vector.triad)


def kept_length(
    components: Sequence[Expr], letter: str = RHO, *, of_velocity: bool = False
) -> Expr:
    """The length of a vector with these components along directions at right angles.

    What comes out of the root does so: of l sin θ and l cos θ the length is l. Only a root that is
    left of a sum is kept under a name.

    Args:
        components: polynomials.
        letter: with which the length, or the vector, is printed.
        of_velocity: whether it is the length of a velocity.
    """
    plain = [lengths_written_out(c) for c in components]
    found = sqrt(total(c * c for c in plain))
    left = [g for g in found.generators if isinstance(g, SquareRoot) and len(g.radicand.num) > 1]
    if len(left) != 1 or left[0].plain is not None or len(found.num) > 1:
        return found
    outside = found / Expr.generator(left[0])
    inside = [kept_sum(c / outside) for c in plain]
    if not all(c.is_polynomial for c in inside):
        return found
    square = total(c * c for c in inside)
    meaning = Expr.generator(SquareRoot(square.trimmed()))
    return outside * Expr.generator(Length(meaning, tuple(inside), letter, of_velocity))


def lengths_in(expressions: Iterable[Expr]) -> tuple[Length, ...]:
    """Every length that occurs, in the order of use."""
    found = (g for e in expressions for g in e.generators if isinstance(g, Length))
    return tuple(dict.fromkeys(found))


def lengths_written_out(expression: Expr) -> Expr:
    """The same in normal form: lengths as roots, and everything multiplied out."""
    if not expression.ring.has_parts:
        return expression
    images = {g: m for g in expression.generators if (m := _written(g)) is not None}
    return expression.recast(images) if images else expression


@lru_cache(_MEMORY)
def _written(generator: Generator) -> Expr | None:
    match generator:
        case Length():
            squares = (lengths_written_out(c) ** 2 for c in generator.components)
            return sqrt(sum(squares, ZERO))
        case KeptSum():
            return lengths_written_out(generator.meaning)
    return None

"""Lengths that are kept as they stand: ρ = |r₁ − r₂| is one quantity, as on paper.

A distance or a slip speed ρ obeys ρ² = Σ c², so that an expression in which it occurs could be
multiplied out and its denominator freed of the root. That makes it long: 1/ρ³ becomes ρ over the
square of a sum of squares. It also costs digits: (x₁ − x₂)² is exact to rounding however far from
the origin both points are, and x₁² − 2 x₁ x₂ + x₂² is not. So lengths are named parts here, and so
are the components that they are made of.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from hashlib import blake2b
from math import prod
from typing import Any

from polhode.algebra._expression import ONE, Composite, Expr, Rate, total
from polhode.algebra._parts import NamedPart, lettered_parts
from polhode.algebra._ring import Generator, Symbol, union
from polhode.algebra._roots import SquareRoot, factors, sqrt
from polhode.algebra._vector import Triad, Vector, length_with_square

_MEMORY = 16384  # meanings that are remembered


@dataclass(frozen=True)
class LengthLetter:
    """How a length is printed: as the letter of a length, or |v| with the letter of a velocity."""

    name: str
    of_velocity: bool = False


RHO = LengthLetter("rho")

_DISTANCES = ("rho", "r", "d", "distance")


def distance_letters(keys: Iterable[str], taken: Iterable[str]) -> dict[str, LengthLetter]:
    """Letters for distances by the keys of what they stand for: ρ, or ρ₁, ρ₂, … of several.

    Another letter is used if one of the names that are taken begins with ρ.
    """
    stems = {name.partition("_")[0] for name in taken}
    letter = next(letter for letter in _DISTANCES if letter not in stems)
    return {key: LengthLetter(name) for key, name in numbered(letter, keys)}


def numbered(letter: str, keys: Iterable[str]) -> Iterator[tuple[str, str]]:
    """A name for each key: the letter, numbered where they are several."""
    each = list(dict.fromkeys(keys))
    for i, key in enumerate(each, 1):
        yield key, letter if len(each) == 1 else f"{letter}_{i}"


@dataclass(frozen=True, eq=False)
class KeptSum(NamedPart):
    """A sum that is not multiplied out, such as the difference of two coordinates."""

    is_hidden = False

    @property
    def is_bounded(self) -> bool:
        """Whether it has no lengths, and cannot be a small difference of large terms.

        That is x + l cos θ, but neither x₁ − x₂ nor x − a.
        """
        if any(g.is_part for g in self.meaning.generators):
            return False
        return sum(map(_may_be_large, self.meaning.terms())) <= 1

    @cached_property
    def key(self) -> str:  # type: ignore[override]
        return f"sum {_digest(self.meaning)}"

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
        components: of the vector along directions at right angles to each other, as they are kept;
            none where only the sum of their squares is known.
        letter: with which it is printed.
    """

    components: tuple[Expr, ...]
    letter: LengthLetter
    positive = True
    is_hidden = False
    has_letter = True

    @cached_property
    def key(self) -> str:  # type: ignore[override]
        return f"length {self.letter.name} {_digest(self.meaning)}"

    @property
    def squared(self) -> Expr:
        """Its square."""
        (root,) = (g for g in self.meaning.generators if isinstance(g, SquareRoot))
        return root.radicand

    def __reduce__(self) -> tuple[Any, ...]:
        return Length, (self.meaning, self.components, self.letter)

    def chain(self, rate: Rate) -> Expr:
        # ρ ρ̇ = Σ c ċ, which is half the rate of ρ²
        half = total(c * c.chain(rate) for c in self.components)
        if not self.components:
            half = self.squared.chain(rate) / 2
        return half / Expr.generator(self)

    def replaced(self, image: Rate) -> Expr:
        if self.components:
            return kept_length([c.replaced(image) for c in self.components], self.letter)
        found = sqrt(self.squared.replaced(image))
        roots = [g for g in found.generators if isinstance(g, SquareRoot) and g.plain is None]
        return _with_length(found, roots[0], self.letter) if len(roots) == 1 else found

    def remade(self, inside: Expr) -> Expr:
        return inside


def _may_be_large(term: tuple[dict[Generator, int], Fraction]) -> bool:
    """Whether a term is more than a sine or cosine times parameters."""
    powers, _ = term
    return all(isinstance(g, Symbol) for g in powers)


def _digest(meaning: Expr) -> str:
    """A short name; with the signs that are known, on which what comes out of a root depends."""
    signs = sorted(s.key for s in meaning.symbols() if s.positive)
    return blake2b(" ".join((meaning.key, *signs)).encode(), digest_size=10).hexdigest()


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


def with_fewer_terms(expression: Expr) -> Expr:
    """An expression with kept sums multiplied out where that leaves fewer terms.

    Only sums are that cannot be small differences of large terms.
    """
    sums = (g for g in expression.generators if isinstance(g, KeptSum))
    images: dict[Generator, Expr] = {g: g.meaning for g in sums if g.is_bounded}
    if not images:
        return expression
    written = expression.recast(images)
    is_shorter = _bulk(written) < _bulk(expression)
    return written if is_shorter else expression


def _bulk(expression: Expr) -> int:
    """Terms, and those of the sums in them."""
    inside = (len(g.meaning.num) for g in expression.generators if isinstance(g, KeptSum))
    return len(expression.num) + sum(inside)


def _first_coefficient(expression: Expr) -> Fraction:
    """That of a length, as in ρ − l, or else of the shortest term, as in v − a ω."""

    def rank(term: tuple[dict[Generator, int], Fraction]) -> tuple[bool, int]:
        powers, _ = term
        return not any(isinstance(g, Length) for g in powers), sum(powers.values())

    return min(expression.terms(), key=rank)[1]


def with_letters(expression: Expr, letters: Mapping[str, LengthLetter]) -> Expr:
    """An expression with these letters for its lengths, by the keys of what they stand for.

    Square roots that have a letter become lengths.
    """
    roots = [g for g in expression.generators if isinstance(g, SquareRoot) and g.key in letters]
    for root in roots:
        expression = _with_length(expression, root, letters[root.key])
    return _recast(expression, lambda generator: _lettered(generator, letters))


def _lettered(part: Generator, letters: Mapping[str, LengthLetter]) -> Expr | None:
    if not isinstance(part, NamedPart):
        return None
    if isinstance(part, Length):
        letter = letters.get(part.meaning.key, part.letter)
        return Expr.generator(replace(part, letter=letter)) if letter != part.letter else None
    inside = with_letters(part.meaning, letters)
    return part.remade(inside) if inside != part.meaning else None


def _with_length(expression: Expr, root: SquareRoot, letter: LengthLetter) -> Expr:
    """With a length ρ for the root √R, and for R where it is a factor of the denominator."""
    rho = Expr.generator(Length(Expr.generator(root), (), letter))
    number, powers = factors(expression.denominator)
    below = Expr.constant(number)
    for factor, power in powers.items():
        ratio = (factor / root.radicand).rational
        below = below * (factor if ratio is None else ratio * rho**2) ** power
    ring = expression.ring
    plain, odd = ring.split(expression.num, ring.index[root])
    above = [_in_squares(Expr(ring, part, ring.one), root.radicand, rho) for part in (plain, odd)]
    return (above[0] + above[1] * rho) / below


def divided(polynomial: Expr, divisor: Expr) -> tuple[Expr, Expr]:
    """The quotient and the rest of a polynomial by another."""
    ring = union(polynomial.ring, divisor.ring)
    whole, by = (ring.lift(e.ring, e.num) for e in (polynomial, divisor))
    quotient, rest = divmod(whole, by)
    return Expr(ring, quotient, ring.one), Expr(ring, rest, ring.one)


def _in_squares(polynomial: Expr, radicand: Expr, rho: Expr) -> Expr:
    """A polynomial with ρ² for the radicand, where that is shorter."""
    quotient, rest = divided(polynomial, radicand)
    if len(quotient.num) + len(rest.num) >= len(polynomial.num):
        return polynomial
    return quotient * rho**2 + rest


def kept_sums(vector: Vector, other: Triad) -> Vector:
    """A vector whose components are kept as they stand, along another triad where shorter."""
    along = min((vector, vector.express(other)), key=_terms)
    return along.mapped(kept_sum)


def _terms(vector: Vector) -> int:
    return sum(len(component.num) for component in vector.components)


def kept_length(components: Sequence[Expr], letter: LengthLetter | None = None) -> Expr:
    """The length of a vector with these components along directions at right angles.

    What comes out of the root does so: of l sin θ and l cos θ the length is l. Only a root that is
    left of a sum is kept under a name.

    Args:
        components: polynomials.
        letter: with which the length is printed, by default ρ.
    """
    plain = [lengths_written_out(c) for c in components]
    squared = total(c * c for c in plain)
    found = sqrt(squared)
    left = [g for g in found.generators if isinstance(g, SquareRoot) and len(g.radicand.num) > 1]
    if len(left) != 1 or left[0].plain is not None or len(found.num) > 1:
        return length_with_square(squared)
    outside = found.recast({left[0]: ONE})
    inside = [kept_sum(c / outside) for c in plain]
    if not all(c.is_polynomial for c in inside):
        return length_with_square(squared)
    square = total(c * c for c in inside)
    meaning = Expr.generator(SquareRoot(square.trimmed()))
    return outside * Expr.generator(Length(meaning, tuple(inside), letter or RHO))


def lengths_in(expressions: Iterable[Expr]) -> tuple[Length, ...]:
    """Every length that occurs, also within functions and other parts, in the order of use."""
    return tuple(part for part in lettered_parts(expressions) if isinstance(part, Length))


def keeps_lengths(expressions: Iterable[Expr]) -> bool:
    """Whether a length, or a sum that is kept as it stands, occurs in some of them."""
    return any(isinstance(g, KeptSum | Length) for e in expressions for g in e.generators)


def lengths_written_out(expression: Expr) -> Expr:
    """The same in normal form: lengths as roots, and everything multiplied out."""
    return _recast(expression, _written)


def lengths_in_parts(expression: Expr) -> Expr:
    """The same with lengths and kept sums as named parts like any others."""
    return _recast(expression, _in_parts)


def _recast(expression: Expr, image: Callable[[Generator], Expr | None]) -> Expr:
    """With the images of its generators; the same object where none has one."""
    images = {g: found for g in expression.generators if (found := image(g)) is not None}
    return expression.recast(images) if images else expression


def _in_parts(generator: Generator) -> Expr | None:
    if not isinstance(generator, Composite):
        return None
    inside = lengths_in_parts(generator.inside)
    if isinstance(generator, NamedPart) and not generator.is_hidden:
        return Expr.generator(NamedPart(inside))
    return None if inside is generator.inside else generator.remade(inside)


def _written(generator: Generator) -> Expr | None:
    if isinstance(generator, NamedPart) and not generator.is_hidden:
        return _written_part(generator)
    if not isinstance(generator, Composite):
        return None
    inside = lengths_written_out(generator.inside)
    return None if inside is generator.inside else generator.remade(inside)


@lru_cache(_MEMORY)
def _written_part(part: NamedPart) -> Expr:
    if isinstance(part, Length):
        return length_with_square(lengths_written_out(part.squared))
    return lengths_written_out(part.meaning)

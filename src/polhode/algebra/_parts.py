"""Named parts: long expressions under one name each, which are not multiplied out.

Arithmetic treats a part as a symbol, so results stay short, but no longer have a normal form:
whether one is zero is decided by its values (`Expr.is_zero`). Derivatives, substitution, programs
and printing look inside a part, once however often it occurs.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from hashlib import blake2b
from math import prod
from typing import Any

from polhode.algebra._expression import ONE, ZERO, Composite, Expr, Rate, chained, total
from polhode.algebra._residues import FieldPoint, Residue
from polhode.algebra._ring import Ball, Generator, OutgrownError, Symbol
from polhode.algebra._roots import factors

_SHORT = 3  # terms up to which an expression costs no more written out than under a name
_MOST_TERMS = 50_000  # of an expression that is written out
_MEMORY = 65536  # derivatives and substitutions that are remembered


@dataclass(frozen=True, eq=False)
class NamedPart(Composite):
    """A name for an expression."""

    meaning: Expr
    is_part = True
    arguments = ()
    #: Whether it is printed as a numbered letter that says nothing about what it stands for.
    is_hidden = True
    #: Whether it is printed with a letter of its own.
    has_letter = False

    @cached_property
    def key(self) -> str:  # type: ignore[override]
        return f"part {self._digest}"

    @property
    def _digest(self) -> str:
        return blake2b(self.meaning.key.encode(), digest_size=10).hexdigest()

    def __eq__(self, other: object) -> bool:
        # A key has the names of symbols: what is a constant elsewhere may be a coordinate here.
        return self is other or (
            isinstance(other, NamedPart)
            and other.key == self.key
            and other.symbols() == self.symbols()
        )

    def __hash__(self) -> int:
        return hash(self.key)

    def __reduce__(self) -> tuple[Any, ...]:
        return NamedPart, (self.meaning,)

    def slope(self, generator: Generator) -> Expr:
        """Partial derivative of its meaning with respect to one of its generators."""
        if generator not in self._slopes:
            self._slopes[generator] = named(self.meaning.partial(generator))
        return self._slopes[generator]

    @cached_property
    def _slopes(self) -> dict[Generator, Expr]:
        return {}

    def chain(self, rate: Rate) -> Expr:
        return _chained(self, rate)

    def replaced(self, image: Rate) -> Expr:
        return _replaced(self, image)

    @property
    def inside(self) -> Expr:
        return self.meaning

    def remade(self, inside: Expr) -> Expr:
        return named(inside)

    def ball(self, state: int) -> Ball:
        return self.meaning.ball(state)

    def residue(self, point: FieldPoint) -> Residue:
        return self.meaning.residue(point)


@dataclass(frozen=True, eq=False)
class Lettered(NamedPart):
    """A quantity under a letter that somebody chose."""

    letter: str
    is_hidden = False
    has_letter = True

    @cached_property
    def key(self) -> str:  # type: ignore[override]
        return f"letter {self.letter} {self._digest}"

    def __reduce__(self) -> tuple[Any, ...]:
        return Lettered, (self.meaning, self.letter)

    def chain(self, rate: Rate) -> Expr:
        return self.meaning.chain(rate)

    def replaced(self, image: Rate) -> Expr:
        return self.meaning.replaced(image)

    def remade(self, inside: Expr) -> Expr:
        return inside


@lru_cache(_MEMORY)
def _chained(part: NamedPart, rate: Rate) -> Expr:
    slopes = ((g, part.slope(g)) for g in part.meaning.generators)
    return named(total(slope * named(chained(g, rate)) for g, slope in slopes))


@lru_cache(_MEMORY)
def _replaced(part: NamedPart, image: Rate) -> Expr:
    return named(part.meaning.replaced(image))


def named(expression: Expr, visible: Iterable[Symbol] = ()) -> Expr:
    """An expression with its long coefficients and its denominators' factors under names.

    Args:
        expression: any.
        visible: symbols in which it is a polynomial, and remains one explicitly.
    """
    ring = expression.ring
    open_ = [symbol for symbol in visible if symbol in ring.index]
    places = [ring.index[symbol] for symbol in open_]
    groups = ring.grouped(expression.num, places) if places else {(): expression.num}
    below = ONE
    if not expression.is_polynomial:
        number, powers = factors(expression.denominator)
        inverses = (_part(1 / factor) ** power for factor, power in powers.items())
        below = prod(inverses, start=Expr.constant(1 / number))
    terms = []
    for exponents, part in groups.items():
        product = (Expr.generator(s) ** int(p) for s, p in zip(open_, exponents, strict=True) if p)
        terms.append(prod(product, start=_named(Expr(ring, part, ring.one) * below)))
    return total(terms)


def _named(expression: Expr) -> Expr:
    if expression.is_zero:
        return ZERO
    if len(expression.num) <= _SHORT:
        return expression
    if expression.num.leading_coefficient() < 0:  # f and -f share one name
        return -_part(-expression)
    return _part(expression)


def _part(meaning: Expr) -> Expr:
    return Expr.generator(NamedPart(meaning.trimmed()))


def under_name(generator: Generator) -> Expr | None:
    """What a named part stands for; None for any other generator."""
    return generator.meaning if isinstance(generator, NamedPart) else None


def has_parts(expression: Expr) -> bool:
    """Whether a named part occurs in it, also within functions."""
    return any(map(_hides, expression.generators))


def written_out(expression: Expr) -> Expr:
    """An expression with what its named parts stand for multiplied out.

    Raises:
        OutgrownError: where it would have too many terms.
    """
    images = {g: _written_meaning(g) for g in expression.generators if _hides(g)}
    if not images:
        return expression
    sizes = {g: max(len(image.num), 1) for g, image in images.items()}
    terms = (powers.items() for powers, _ in expression.terms())
    most = sum(prod(sizes.get(g, 1) ** power for g, power in term) for term in terms)
    if most > _MOST_TERMS:
        raise OutgrownError(
            f"an expression with named parts that has up to {most:.0e} terms when written out",
            expected=f"at most {_MOST_TERMS:.0e}",
            advice="give values of more of its symbols",
        )
    return expression.recast(images)


@lru_cache(_MEMORY)
def _written_meaning(generator: Composite) -> Expr:
    written = written_out(generator.inside)
    return written if generator.is_part else generator.remade(written)


def under_letters(
    expressions: Sequence[Expr], known: Iterable[Symbol] = ()
) -> tuple[tuple[Expr, ...], dict[Symbol, Generator]]:
    """Expressions to print, with a symbol z_1, z_2, ... for every part, and the parts themselves.

    Another letter is used if a symbol in them, or one of `known`, already uses z.
    """
    parts = dict.fromkeys(g for e in expressions for g in e.generators if _hides(g))
    symbols = {*known, *(s for e in expressions for s in e.symbols())} if parts else set()
    taken = {s.name.partition("_")[0] for s in symbols}
    letter = next(letter for letter in ("z", "Z", "zeta", "part") if letter not in taken)
    letters = {part: Symbol(f"{letter}_{i}") for i, part in enumerate(parts, 1)}
    images = {part: Expr.generator(symbol) for part, symbol in letters.items()}

    def written(expression: Expr) -> Expr:
        hidden = {g: images[g] for g in expression.generators if g in images}
        return expression.recast(hidden) if hidden else expression

    return tuple(map(written, expressions)), {symbol: part for part, symbol in letters.items()}


def under_defined_letters(
    expressions: Sequence[Expr], known: Iterable[Symbol] = ()
) -> tuple[tuple[Expr, ...], dict[Generator, Expr]]:
    """The same with what every letter stands for, in order of use, by letters that come later.

    Lengths have letters of their own, and are defined last.
    """
    parts = dict.fromkeys(g for e in expressions for g in e.generators if _hides(g))
    pending = list(parts)
    for part in pending:  # which grows
        new = [g for g in _within(part).generators if _hides(g) and g not in parts]
        parts |= dict.fromkeys(new)
        pending += new
    meanings = [_within(part) for part in parts]
    written, letters = under_letters((*expressions, *meanings), known)
    inside = dict(zip(parts, written[len(expressions) :], strict=True))
    defined: dict[Generator, Expr] = {
        symbol: inside[part] if part.is_part else _remade(part, inside[part])
        for symbol, part in letters.items()
    }
    lengths = lettered_parts([*written[: len(expressions)], *defined.values()])
    return written[: len(expressions)], defined | {part: part.meaning for part in lengths}


def definitions(expression: Expr) -> dict[str, Expr]:
    """What every letter of a part stands for, in the order of use."""
    _, defined = under_defined_letters([expression])
    return {str(Expr.generator(letter)): meaning for letter, meaning in defined.items()}


def lettered_parts(expressions: Iterable[Expr]) -> Iterator[NamedPart]:
    """The parts that have letters of their own, also within functions and other parts."""
    seen: set[Generator] = set()
    pending = [g for e in expressions for g in e.generators]
    for generator in pending:  # which grows
        if generator in seen or not isinstance(generator, Composite):
            continue
        seen.add(generator)
        pending += generator.inside.generators
        if isinstance(generator, NamedPart) and generator.has_letter:
            yield generator


def _within(generator: Generator) -> Expr:
    """The expression that a part stands for, or that a function of one is taken of."""
    if not isinstance(generator, Composite):
        raise TypeError(f"{generator} hides no expression")
    return generator.inside


def _remade(generator: Generator, inside: Expr) -> Expr:
    return generator.remade(inside) if isinstance(generator, Composite) else inside


def _hides(generator: Generator) -> bool:
    if isinstance(generator, NamedPart):
        return generator.is_hidden
    return any(_hides(g) for argument in generator.arguments for g in argument.generators)

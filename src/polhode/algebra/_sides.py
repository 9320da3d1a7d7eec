"""Absolute values on one side of where their arguments vanish, where they are smooth.

|x| is x on one side of zero and −x on the other. Put in, the sign cancels wherever it can: x/|x|
becomes 1 or −1, and 1/(1 + |x|) loses the denominator 1 − x² of its normal form.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from polhode.algebra._expression import Expr
from polhode.algebra._functions import Even, Exponential, Odd, exp
from polhode.algebra._generators import Generator
from polhode.algebra._parts import NamedPart, named
from polhode.algebra._roots import SquareRoot, sqrt


def roots_in(expressions: Iterable[Expr]) -> tuple[SquareRoot, ...]:
    """Every square root that occurs, also within functions and named parts; inner ones first."""
    found: dict[SquareRoot, None] = {}
    seen: set[Generator] = set()
    for expression in expressions:
        found |= dict.fromkeys(_roots(expression, seen))
    return tuple(found)


def _roots(expression: Expr, seen: set[Generator]) -> Iterator[SquareRoot]:
    for generator in expression.generators:
        if generator in seen:
            continue
        seen.add(generator)
        for argument in _inside(generator):
            yield from _roots(argument, seen)
        if isinstance(generator, SquareRoot):
            yield generator


def _inside(generator: Generator) -> tuple[Expr, ...]:
    return (generator.meaning,) if isinstance(generator, NamedPart) else generator.arguments


def with_roots(expression: Expr, images: Mapping[SquareRoot, Expr]) -> Expr:
    """An expression with some of its square roots replaced, also within functions and parts.

    Roots that appear only once others are replaced, as |x − 1| in ||x| − 1|, are replaced too.
    """
    if not images:
        return expression
    return _Replacement(images).of(expression)


class _Replacement:
    """Replaces roots; remembers what became of each function and part."""

    def __init__(self, images: Mapping[SquareRoot, Expr]) -> None:
        self._known: dict[Generator, Expr | None] = {r: e for r, e in images.items()}  # noqa: C416

    def of(self, expression: Expr) -> Expr:
        """The expression with its images; the same object where nothing changes."""
        images = {g: image for g in expression.generators if (image := self._image(g)) is not None}
        return expression.recast(images) if images else expression

    def _image(self, generator: Generator) -> Expr | None:
        """What a generator becomes; None where it stays as it is."""
        if generator not in self._known:
            inside = _inside(generator)
            new = [self.of(argument) for argument in inside]
            same = all(a is b for a, b in zip(new, inside, strict=True))
            self._known[generator] = None if same else self.of(_remade(generator, new[0]))
        return self._known[generator]


def _remade(generator: Generator, argument: Expr) -> Expr:
    """The same function of another argument."""
    match generator:
        case SquareRoot():
            return sqrt(argument)
        case Exponential():
            return exp(argument)
        case Even():
            return generator.family.of(argument)[0]
        case Odd():
            return generator.family.of(argument)[1]
        case _:
            return named(argument)

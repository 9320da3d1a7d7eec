"""States with simple exact numbers, at which expressions have exact values."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import atan
from random import Random

from polhode.algebra import Expr, Generator, Symbol, SymbolKind, sqrt, under_name
from polhode.base import NumericError

_SIMPLE = [Fraction(n, d) for d in (1, 2, 3) for n in range(1, 8) if n % d or d == 1]
_HALF_TANGENTS = [Fraction(n, d) for d in range(2, 8) for n in range(1, d) if d % n or n == 1]
_PI = Symbol("pi")


@dataclass(frozen=True)
class ExactPoint:
    """Exact values of symbols; angles by the tangent of their half, so that sines are rational.

    Attributes:
        numbers: value of every symbol that is no angle, SI.
        half_tangents: of the symbols that sines and cosines are taken of.
    """

    numbers: Mapping[Symbol, Fraction]
    half_tangents: Mapping[Symbol, Fraction]

    def __call__(self, expression: Expr) -> Expr:
        """The exact value of an expression: rational, or a root of rationals.

        Raises `NumericError` where it has no exact value of that sort, and `ZeroDivisionError`.
        """
        return expression.recast({g: self._value(g) for g in expression.generators})

    def _value(self, generator: Generator) -> Expr:
        if isinstance(generator, Symbol):
            return self._number(generator)
        meaning = under_name(generator)
        if meaning is not None:
            return self(meaning)
        partner = generator.partner() or _odd(generator)
        if generator.depth and generator.partner() is None:
            return sqrt(self(generator.arguments[0]))
        angle, part = _angle(generator)
        tangent = self.half_tangents.get(angle)
        if partner is None or partner[1] > 0 or tangent is None:
            raise _not_exact(generator)
        cosine = Expr.of((1 - tangent**2) / (1 + tangent**2))
        sine = Expr.of(2 * tangent / (1 + tangent**2))
        if part == Fraction(1, 2):
            sine, cosine = sqrt((1 - cosine) / 2), sqrt((1 + cosine) / 2)
        elif part != 1:
            raise _not_exact(generator)
        return cosine if generator.partner() else sine

    def _number(self, symbol: Symbol) -> Expr:
        if symbol == _PI:
            return Expr.generator(symbol)
        if symbol not in self.numbers:
            raise _not_exact(symbol)
        return Expr.constant(self.numbers[symbol])

    def floats(self) -> dict[Symbol, float]:
        """All values as numbers, angles in radians."""
        angles = {s: 2 * atan(tangent) for s, tangent in self.half_tangents.items()}
        return {**{s: float(v) for s, v in self.numbers.items()}, **angles}

    def described(self) -> dict[str, str]:
        """All values as text under their published names."""
        plain = {s.published: str(v) for s, v in self.numbers.items()}
        angles = {s.published: f"2*atan({t})" for s, t in self.half_tangents.items()}
        return dict(sorted({**plain, **angles}.items()))


def points(expressions: Iterable[Expr], symbols: Iterable[Symbol], seed: int) -> ExactPoint:
    """A point with simple values for all symbols, those under a sine or cosine being angles."""
    random = Random(seed)
    angles = {a for e in expressions for g in e.generators for a in _angles(g)}
    wanted = sorted({*symbols} - {_PI}, key=lambda s: s.published)
    draw = _draws(random, _SIMPLE)
    tilt = _draws(random, _HALF_TANGENTS)
    numbers = {s: draw(s) for s in wanted if s not in angles}
    return ExactPoint(numbers, {s: tilt(s) for s in wanted if s in angles})


def _draws(random: Random, pool: list[Fraction]) -> Callable[[Symbol], Fraction]:
    left: list[Fraction] = []

    def draw(symbol: Symbol) -> Fraction:
        if not left:
            left.extend(random.sample(pool, len(pool)))
        value = left.pop()
        free = symbol.kind is not SymbolKind.PARAMETER and not symbol.positive
        return -value if free and symbol.order and random.random() < 1 / 3 else value

    return draw


@lru_cache(maxsize=1024)
def _angles(generator: Generator) -> tuple[Symbol, ...]:
    """Symbols that the generator takes a sine or cosine of, also under roots."""
    meaning = under_name(generator)
    if meaning is not None:
        return tuple(dict.fromkeys(a for g in meaning.generators for a in _angles(g)))
    odd = _odd(generator)
    if odd is not None and odd[1] < 0:
        angle = _angle(generator)[0]
        return () if angle == _PI else (angle,)
    inner = (g for argument in generator.arguments for g in argument.generators)
    return tuple(a for g in inner for a in _angles(g))


def _odd(generator: Generator) -> tuple[Generator, int] | None:
    """The odd function and sign of the family of a sine or cosine."""
    pairs = (g.partner() for g in generator.companions() if g.depth)
    own = generator.partner()
    found = own or next((pair for pair in pairs if pair and pair[0] == generator), None)
    return found


def _angle(generator: Generator) -> tuple[Symbol, Fraction]:
    """Symbol and factor of the argument of a sine or cosine."""
    argument = generator.arguments[0]
    symbols = argument.symbols()
    if len(symbols) != 1:
        raise _not_exact(generator)
    (symbol,) = symbols
    factor = (argument / Expr.generator(symbol)).rational
    if factor is None:
        raise _not_exact(generator)
    return symbol, factor


def _not_exact(generator: Generator) -> NumericError:
    return NumericError(
        f"{Expr.generator(generator)} at a point of exact numbers",
        expected="polynomials, roots, and sines and cosines of single angles",
    )

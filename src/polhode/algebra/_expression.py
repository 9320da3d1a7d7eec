"""Exact expressions: rational functions of generators, each in one unique form."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from functools import cached_property, lru_cache
from numbers import Rational
from typing import Any, TypeAlias, Union

from flint import fmpq

from polhode.algebra._generators import Generator, Rate, Symbol
from polhode.algebra._given import decimal, is_numpy_scalar
from polhode.algebra._ring import CONSTANTS, Polynomial, Ring, ring_of, union
from polhode.algebra.printing._printed import Printed
from polhode.base import DeclarationError, NumericError

#: What is accepted wherever an expression is wanted: also SymPy's expressions.
ExprLike: TypeAlias = Union["Expr", int, float, Fraction, Any]


#: Beyond it a power is taken for a slip that would fill the memory.
_LARGEST_POWER = 1000


class Expr(Printed):
    """An exact expression; immutable, hashable, picklable, with a decided equality.

    Made from `symbols`, `coordinates`, `speeds`, numbers and functions by ordinary arithmetic.
    Floats are read as the decimal they print as (0.1 is one tenth).
    """

    def __init__(self, ring: Ring, num: Polynomial, den: Polynomial) -> None:
        """Internal: `num` and `den` must already be in normal form; see `fraction`."""
        self.ring = ring
        self.num = num
        self.den = den

    # -- making ---------------------------------------------------------------------------------

    @classmethod
    def of(cls, value: ExprLike) -> Expr:
        """The expression a number, an expression or a SymPy expression stands for."""
        if isinstance(value, Expr):
            return value
        if type(value) is int:
            return cls.constant(value)
        if isinstance(value, Rational):
            return cls.constant(Fraction(int(value.numerator), int(value.denominator)))
        if isinstance(value, float):
            return cls.constant(decimal(value))
        if type(value).__module__.startswith("sympy"):
            from polhode.algebra._sympy import from_sympy

            return from_sympy(value)
        if is_numpy_scalar(value):
            return cls.of(value.item())  # type: ignore[union-attr]
        raise NumericError(
            f"{value!r} of type {type(value).__name__} is no expression",
            expected="a number, a symbol or an expression of symbols",
            advice="declare names with symbols, coordinates or speeds",
        )

    @staticmethod
    def reads(value: object) -> bool:
        """Whether `of` takes values of this type."""
        if isinstance(value, Expr) or type(value) is int:
            return True
        plain = isinstance(value, Rational | float) or is_numpy_scalar(value)
        return plain or type(value).__module__.startswith("sympy")

    @classmethod
    def constant(cls, value: Fraction | int) -> Expr:
        """A rational number."""
        number = fmpq(int(value.numerator), int(value.denominator))
        return cls(CONSTANTS, CONSTANTS.context.constant(number), CONSTANTS.one)

    @classmethod
    def generator(cls, generator: Generator) -> Expr:
        """A symbol, or one function of symbols, as an expression."""
        ring = ring_of(frozenset((generator,)))
        return cls(ring, ring.variable(generator), ring.one)

    @classmethod
    def fraction(cls, ring: Ring, num: Polynomial, den: Polynomial) -> Expr:
        """Any fraction of reduced polynomials, brought to normal form."""
        if den == 0:
            raise ZeroDivisionError("division of an expression by zero")
        num, den = ring.rationalise(num, den)
        return cls(ring, *ring.cancel(num, den))

    # -- looking --------------------------------------------------------------------------------

    @property
    def is_zero(self) -> bool:
        """Whether it vanishes identically; decided, up to the branch of a root.

        With named parts, which are not multiplied out, it is evaluated instead: see `vanishes`.
        """
        return bool(self.num == 0) or (self.ring.has_parts and self._vanishes)

    @cached_property
    def _vanishes(self) -> bool:
        from polhode.algebra._balls import vanishes

        return vanishes(self)

    @property
    def is_polynomial(self) -> bool:
        """Whether the denominator is a number."""
        return self.den is self.ring.one or bool(self.den.is_constant())

    @property
    def rational(self) -> Fraction | None:
        """Its value if it is a rational number."""
        if not (self.num.is_constant() and self.den.is_constant()):
            return None
        value = self.num.leading_coefficient() if self.num != 0 else fmpq(0)
        return Fraction(int(value.p), int(value.q))

    @property
    def symbol(self) -> Symbol | None:
        """The symbol, if the expression is just one."""
        found = self.generators
        if len(found) == 1 and isinstance(found[0], Symbol) and self == Expr.generator(found[0]):
            return found[0]
        return None

    @cached_property
    def generators(self) -> tuple[Generator, ...]:
        """The generators that occur, in their fixed order."""
        used = zip(self.num.degrees(), self.den.degrees(), strict=True)
        pairs = zip(self.ring.generators, used, strict=True)
        return tuple(g for g, (above, below) in pairs if above > 0 or below > 0)

    def trimmed(self) -> Expr:
        """The same expression in the smallest ring that holds it."""
        ring = ring_of(frozenset(self.generators))
        num = self.num.project_to_context(ring.context)
        return Expr(ring, num, self.den.project_to_context(ring.context))

    def symbols(self) -> frozenset[Symbol]:
        """Every symbol it depends on, also inside functions."""
        return self._symbols

    @cached_property
    def _symbols(self) -> frozenset[Symbol]:
        return frozenset().union(*(g.symbols() for g in self.generators))

    def terms(self) -> Iterator[tuple[dict[Generator, int], Fraction]]:
        """Powers and coefficient of each term of the numerator."""
        for monomial, coefficient in self.num.terms():
            pairs = zip(self.ring.generators, monomial, strict=True)
            powers = {generator: int(power) for generator, power in pairs if power}
            yield powers, Fraction(int(coefficient.p), int(coefficient.q))

    @property
    def numerator(self) -> Expr:
        """The numerator, over a monic denominator."""
        return Expr(self.ring, self.num, self.ring.one)

    @property
    def denominator(self) -> Expr:
        """The denominator: monic, free of cosines and roots."""
        return Expr(self.ring, self.den, self.ring.one)

    # -- arithmetic -----------------------------------------------------------------------------

    def __add__(self, other: ExprLike) -> Expr:
        other = Expr.of(other)
        if self.num == 0 or other.num == 0:
            return other if self.num == 0 else self
        a, b, ring = _together(self, other)
        if a.is_polynomial and b.is_polynomial:
            return Expr(ring, a.num + b.num, ring.one)
        if a.den == b.den:
            return Expr(ring, *ring.cancel(a.num + b.num, a.den))
        num = ring.reduce(a.num * b.den + b.num * a.den)
        return Expr(ring, *ring.cancel(num, a.den * b.den))

    def __mul__(self, other: ExprLike) -> Expr:
        if not Expr.reads(other):
            return NotImplemented  # a vector knows how to multiply itself
        other = Expr.of(other)
        if other.ring is CONSTANTS:
            return self._scaled(other.num)
        if self.ring is CONSTANTS:
            return other._scaled(self.num)
        a, b, ring = _together(self, other)
        num = ring.reduce(a.num * b.num)
        if a.is_polynomial and b.is_polynomial:
            return Expr(ring, num, ring.one)
        return Expr(ring, *ring.cancel(num, a.den * b.den))

    def _scaled(self, number: Polynomial) -> Expr:
        if number == 0:
            return ZERO
        return Expr(self.ring, self.num * number.leading_coefficient(), self.den)

    def __neg__(self) -> Expr:
        return Expr(self.ring, -self.num, self.den)

    def __pos__(self) -> Expr:
        return self

    def __sub__(self, other: ExprLike) -> Expr:
        return self + (-Expr.of(other))

    def __truediv__(self, other: ExprLike) -> Expr:
        return self * Expr.of(other).reciprocal()

    def reciprocal(self) -> Expr:
        """One over this expression."""
        return Expr.fraction(self.ring, self.den, self.num)

    def __pow__(self, exponent: int | Fraction | Expr) -> Expr:
        power = exponent if type(exponent) is int else Expr.of(exponent).rational
        if power is None or power.denominator > 2:
            raise NumericError(
                f"power {exponent!s}", expected="an integer or half-integer power", advice=""
            )
        if power.denominator == 2:
            from polhode.algebra._roots import sqrt

            return sqrt(self) ** power.numerator
        ring, times = self.ring, abs(int(power))
        if times > _LARGEST_POWER:
            raise NumericError(f"power {power}", expected=f"at most the power {_LARGEST_POWER}")
        base = self if power >= 0 else self.reciprocal()
        if times == 1:
            return base
        return Expr(ring, *ring.cancel(ring.reduce(base.num**times), base.den**times))

    __radd__ = __add__
    __rmul__ = __mul__

    def __rsub__(self, other: ExprLike) -> Expr:
        return Expr.of(other) - self

    def __rtruediv__(self, other: ExprLike) -> Expr:
        return Expr.of(other) / self

    # -- identity -------------------------------------------------------------------------------

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Expr):
            if not isinstance(other, Rational | float):
                return NotImplemented
            other = Expr.of(other)
        if self.ring is other.ring:
            return bool(self.num == other.num and self.den == other.den)
        try:
            a, b, _ = _together(self, other)
        except DeclarationError:  # a coordinate and a parameter of one name are not equal
            return False
        return bool(a.num == b.num and a.den == b.den)

    @cached_property
    def key(self) -> str:
        """Unique text of the normal form; equal expressions in like units have equal keys."""
        return str(self.num) if self.is_polynomial else f"({self.num})/({self.den})"

    @cached_property
    def _hash(self) -> int:
        value = self.rational
        return hash(value) if value is not None else hash(self.key)

    def __hash__(self) -> int:
        return self._hash

    def __bool__(self) -> bool:
        return not self.is_zero

    def __reduce__(self) -> tuple[Any, ...]:
        from polhode.algebra._plain import plain, rebuilt

        return rebuilt, (self.generators, plain(self, self.num), plain(self, self.den))

    # -- calculus: thin faces of their own rooms ------------------------------------------------

    def chain(self, rate: Rate) -> Expr:
        """Derivative along a direction in which every symbol changes at its `rate`."""
        return self._chain(self.generators, rate)

    def _chain(self, changing: Iterable[Generator], rate: Rate) -> Expr:
        slopes = ((g, self.partial(g)) for g in changing)
        return total(slope * g.chain(rate) for g, slope in slopes if slope)

    def partial(self, generator: Generator) -> Expr:
        """Partial derivative by a generator, all others held."""
        ring, position = self.ring, self.ring.index[generator]
        above = ring.reduce(self.num.derivative(position))
        if self.is_polynomial:
            return Expr(ring, above, ring.one)
        below = self.den.derivative(position)
        num = ring.reduce(above * self.den - self.num * below)
        return Expr(ring, *ring.cancel(num, self.den**2))

    def diff(self, symbol: Expr | Symbol) -> Expr:
        """Partial derivative with respect to a symbol."""
        wanted = as_symbol(symbol)
        changing = (g for g in self.generators if wanted in g.symbols())
        return self._chain(changing, _along(wanted))

    def dt(self) -> Expr:
        """Time derivative: coordinates, speeds and functions of time change, parameters do not."""
        if not self.ring.has_parts:
            return self.chain(time_rate)
        changing = sorted(self.symbols(), key=lambda symbol: symbol.key)  # their rates stay visible
        return total(self.diff(s) * rate for s in changing if (rate := time_rate(s)))

    def subs(self, images: Mapping[Any, ExprLike]) -> Expr:
        """With symbols replaced, all at once, also inside functions."""
        table = {as_symbol(symbol): Expr.of(image) for symbol, image in images.items()}
        if not table.keys() & self.symbols():
            return self

        def image(symbol: Symbol) -> Expr:
            return table[symbol] if symbol in table else Expr.generator(symbol)

        changed = (g for g in self.generators if not table.keys().isdisjoint(g.symbols()))
        return self.recast({g: g.replaced(image) for g in changed})

    def replaced(self, image: Rate) -> Expr:
        """With every symbol replaced by its image."""
        return self.recast({g: g.replaced(image) for g in self.generators})

    def recast(self, images: Mapping[Generator, Expr]) -> Expr:
        """With whole generators replaced by expressions."""
        from polhode.algebra._substituted import substituted

        num = substituted(self.numerator, images)
        return num if self.is_polynomial else num / substituted(self.denominator, images)


def total(expressions: Iterable[Expr]) -> Expr:
    """Their sum; of many polynomials at once, which is quicker than one by one."""
    terms = tuple(expressions)
    if len(terms) < 3 or not all(term.is_polynomial for term in terms):
        return sum(terms, ZERO)
    ring = union(*(term.ring for term in terms))
    if _refinements(ring):
        return sum(terms, ZERO)
    return Expr(ring, sum((_lifted(term, ring).num for term in terms), ring.zero), ring.one)


def as_symbol(value: Expr | Symbol) -> Symbol:
    """The symbol that an expression is."""
    symbol = value if isinstance(value, Symbol) else Expr.of(value).symbol
    if symbol is None:
        raise NumericError(f"{value}", expected="a single symbol", advice="")
    return symbol


def time_rate(symbol: Symbol) -> Expr:
    """Time derivative of a symbol."""
    if symbol.kind.varies:
        return Expr.generator(symbol.derivative())
    return ONE if symbol.kind.value == "time" else ZERO


@lru_cache(maxsize=1024)
def _along(wanted: Symbol) -> Rate:
    """The same function for the same symbol, so that what it gave of a part is known again."""
    return lambda symbol: ONE if symbol == wanted else ZERO


def _together(first: Expr, second: ExprLike) -> tuple[Expr, Expr, Ring]:
    """Both in one ring; in one unit where one has sin θ and the other sin θ/2."""
    other = Expr.of(second)
    if first.ring is other.ring:
        return first, other, first.ring
    ring = union(first.ring, other.ring)
    coarse = _refinements(ring)
    if coarse:
        first, other = first.recast(coarse), other.recast(coarse)
        ring = union(first.ring, other.ring)
    return _lifted(first, ring), _lifted(other, ring), ring


@lru_cache(maxsize=16384)
def _refinements(ring: Ring) -> dict[Generator, Expr]:
    functions = tuple(g for g in ring.generators if g.arguments)
    pairs = ((g, g.refined(functions)) for g in functions)
    return {g: finer for g, finer in pairs if finer is not None}


def _lifted(expression: Expr, ring: Ring) -> Expr:
    if expression.ring is ring:
        return expression
    num = ring.lift(expression.ring, expression.num)
    if expression.is_polynomial:
        return Expr(ring, num, ring.one)
    return Expr(ring, num, ring.lift(expression.ring, expression.den))


ZERO = Expr.constant(0)
ONE = Expr.constant(1)

"""Exact expressions: rational functions of generators, each in one normal form.

Equal expressions have equal numerators and denominators, so comparison needs no simplification:
`_ring` states the normal form and why it decides whether an expression is zero.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import compress
from math import comb, isfinite, prod
from numbers import Rational
from typing import Any, ClassVar, TypeAlias, Union

from flint import ctx, fmpq

from polhode.algebra._residues import FieldPoint, NoResidueError, Residue, vanishing
from polhode.algebra._ring import (
    CONSTANTS,
    Ball,
    Generator,
    PlainTerms,
    Polynomial,
    Ring,
    Symbol,
    as_fraction,
    ring_of,
    union,
)
from polhode.base import DeclarationError, NumericError, Shown

#: Accepted wherever an expression is expected; SymPy expressions too.
ExprLike: TypeAlias = Union["Expr", int, float, Fraction, Any]


#: The derivative, or the image, of every symbol.
Rate = Callable[[Symbol], "Expr"]

#: Higher powers are refused as mistakes that would exhaust memory.
_LARGEST_POWER = 1000
_MOST_TERMS = 1_000_000

_STATES = (1, 2)  # random states at which expressions with named parts are compared with zero
_BITS = 448  # precision of the values there, 134 decimal digits


class Composite(Generator):
    """A generator made of an expression: a function of it such as a sine, or a name for it."""

    @property
    @abstractmethod
    def inside(self) -> Expr:
        """The expression it is made of."""

    @abstractmethod
    def remade(self, inside: Expr) -> Expr:
        """The same function of another expression."""

    @abstractmethod
    def chain(self, rate: Rate) -> Expr:
        """Derivative, given the derivative of every symbol."""

    def replaced(self, image: Rate) -> Expr:
        """The same with every symbol replaced by its image."""
        return self.remade(self.inside.replaced(image))

    def refined(self, others: tuple[Generator, ...]) -> Expr | None:
        """The same in terms of a finer unit that occurs among `others`, if one does."""
        return None

    @property
    def arguments(self) -> tuple[Expr, ...]:
        return (self.inside,)

    def symbols(self) -> frozenset[Symbol]:
        return self.inside.symbols()


@dataclass(frozen=True)
class Facilities:
    """Functions of modules built on `Expr`, offered as its methods without importing them here."""

    square_root: Callable[[Expr], Expr]
    from_sympy: Callable[[Any], Expr]
    text: Callable[[Expr], str]
    pretty: Callable[[Expr], str]
    latex: Callable[[Expr], str]
    mathml: Callable[[str], str]
    definitions: Callable[[Expr], dict[str, Expr]]


class Expr(Shown):
    """An exact expression; immutable, hashable, picklable, with a decided equality.

    Made from `symbols`, `coordinates`, `speeds`, numbers and functions by ordinary arithmetic.
    Floats are read as the decimal they print as (0.1 is one tenth). A notebook shows expressions
    as MathML, which needs no script from a network.
    """

    #: Roots, printing and SymPy; set where `polhode.algebra` is imported.
    facilities: ClassVar[Facilities]

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
            if not isfinite(value):
                raise NumericError(f"the number {value}", expected="a finite number", advice="")
            return cls.constant(Fraction(repr(float(value))))  # the decimal that it prints as
        if type(value).__module__.startswith("sympy"):
            return cls.facilities.from_sympy(value)
        if _is_numpy_scalar(value):
            return cls.of(value.item())  # type: ignore[union-attr]
        raise NumericError(
            f"{value!r} of type {type(value).__name__} is not an expression",
            expected="a number, a symbol or an expression of symbols",
            advice="declare names with symbols, coordinates or speeds",
        )

    @staticmethod
    def reads(value: object) -> bool:
        """Whether `of` takes values of this type."""
        if isinstance(value, Expr) or type(value) is int:
            return True
        plain = isinstance(value, Rational | float) or _is_numpy_scalar(value)
        return plain or type(value).__module__.startswith("sympy")

    @classmethod
    def constant(cls, value: Fraction | int) -> Expr:
        """A rational number."""
        number = fmpq(int(value.numerator), int(value.denominator))
        return cls(CONSTANTS, CONSTANTS.context.constant(number), CONSTANTS.one)

    @classmethod
    def generator(cls, generator: Generator) -> Expr:
        """A symbol, or one function of symbols, as an expression."""
        return _of_generator(generator, generator.positive)

    @classmethod
    def product(cls, powers: Mapping[Generator, int], number: Fraction | int = 1) -> Expr:
        """A number times powers of generators, as `terms` gives them."""
        return prod((cls.generator(g) ** p for g, p in powers.items()), start=cls.constant(number))

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
        """Whether it vanishes identically; decided exactly, up to the branch of a root.

        With named parts, which are not multiplied out, it is evaluated at a random point of a prime
        field instead, where a wrong answer is less likely than 10⁻²⁰. Where roots leave it without
        a value there, it is evaluated in balls at random states: if all contain zero, to more than
        a hundred digits, it is taken to vanish.
        """
        if not self.ring.has_parts:
            return bool(self.num == 0)
        # in a product of generators none vanishes: a part is made of what does not
        return len(self.num) != 1 and (bool(self.num == 0) or self._vanishes)

    @cached_property
    def _vanishes(self) -> bool:
        try:
            return vanishing(self.residue, _point).is_zero
        except NoResidueError:
            return all(self.ball(state).contains(0) for state in _STATES)

    def residue(self, point: FieldPoint) -> Residue:
        """Its value at a random point of a prime field; `ZeroDivisionError` at a pole."""
        above = self.ring.residue(self.num, point)
        if self.is_polynomial:
            return above
        below = self.ring.residue(self.den, point)
        if below.value == 0:  # python-flint 0.9 returns 0 for 0/0 in a prime field
            raise ZeroDivisionError("a pole at a point of a prime field")
        roots = above.roots | below.roots
        return Residue(above.value / below.value, above.degree + below.degree, roots)

    def ball(self, state: int) -> Ball:
        """Its value at one of the random states of `Ring.ball`."""
        with ctx.workprec(_BITS):
            return self.ring.ball(self.num, state) / self.ring.ball(self.den, state)

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
        return as_fraction(value)

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
        used = [degree > 0 for degree in self.num.degrees()]
        if not self.is_polynomial:
            used = [
                above or degree > 0 for above, degree in zip(used, self.den.degrees(), strict=True)
            ]
        return tuple(compress(self.ring.generators, used))

    def trimmed(self) -> Expr:
        """The same expression in the smallest ring that holds it."""
        ring = ring_of(frozenset(self.generators))
        if ring is self.ring:
            return self
        num = self.num.project_to_context(ring.context)
        if self.is_polynomial:
            return Expr(ring, num, ring.one)
        return Expr(ring, num, self.den.project_to_context(ring.context))

    def symbols(self) -> frozenset[Symbol]:
        """Every symbol it depends on, also inside functions."""
        return self._symbols

    @cached_property
    def _symbols(self) -> frozenset[Symbol]:
        return frozenset().union(*(g.symbols() for g in self.generators))

    @property
    def varies(self) -> bool:
        """Whether a coordinate, a speed, a reaction or a function of time occurs in it."""
        return any(symbol.kind.varies for symbol in self._symbols)

    def terms(self) -> Iterator[tuple[dict[Generator, int], Fraction]]:
        """Powers and coefficient of each term of the numerator."""
        for monomial, coefficient in self.num.terms():
            pairs = zip(self.ring.generators, monomial, strict=True)
            powers = {generator: int(power) for generator, power in pairs if power}
            yield powers, as_fraction(coefficient)

    def summands(self) -> Iterator[Expr]:
        """The terms of the numerator as expressions."""
        return (Expr.product(powers, coefficient) for powers, coefficient in self.terms())

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
            return NotImplemented  # left to the other operand, such as a vector
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
            return self.facilities.square_root(self) ** power.numerator
        ring, times = self.ring, abs(int(power))
        if times > _LARGEST_POWER:
            raise NumericError(f"power {power}", expected=f"at most the power {_LARGEST_POWER}")
        base = self if power >= 0 else self.reciprocal()
        for count in map(len, (base.num, base.den)):
            terms = comb(count + times - 1, times) if times > 2 else 0
            if terms > _MOST_TERMS:
                raise NumericError(
                    f"the power {power} of a sum of {count} terms, which has {terms:.0e}",
                    expected=f"at most {_MOST_TERMS} terms",
                )
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
        if self.key == other.key and self.generators == other.generators:
            return self._signs == other._signs
        try:
            a, b, _ = _together(self, other)
        except DeclarationError:  # a coordinate and a parameter with the same name differ
            return False
        # Whether √(x²) = x depends on the sign of x, and results are cached by expressions.
        return bool(a.num == b.num and a.den == b.den) and self._signs == other._signs

    @cached_property
    def _signs(self) -> frozenset[str]:
        """The symbols that are known to be positive."""
        return frozenset(s.key for s in self.symbols() if s.positive)

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
        generators = self.generators
        parts = (self.ring.plain(generators, part) for part in (self.num, self.den))
        return _rebuilt, (generators, *parts)

    # -- printing -------------------------------------------------------------------------------

    def __repr__(self) -> str:
        return str(self)

    def __str__(self) -> str:
        return self.facilities.text(self)

    def pretty(self) -> str:
        """One line with Greek letters, dots and superscripts."""
        return self.facilities.pretty(self)

    def latex(self) -> str:
        """LaTeX as a textbook would print it."""
        return self.facilities.latex(self)

    def mathml(self) -> str:
        """Presentation MathML."""
        return self.facilities.mathml(self.latex())

    def definitions(self) -> dict[str, Expr]:
        """What letters stand for that are printed and are no symbols, by letters that come later.

        They are lengths such as rho, letters given to `shorter`, and z_1, z_2, ... for expressions
        that are too long to be written out.
        """
        return self.facilities.definitions(self)

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex()}$"

    # -- derivatives and substitution -----------------------------------------------------------

    def chain(self, rate: Rate) -> Expr:
        """Derivative along a direction in which every symbol changes at its `rate`."""
        return self._chain(self.generators, rate)

    def _chain(self, changing: Iterable[Generator], rate: Rate) -> Expr:
        slopes = ((g, self.partial(g)) for g in changing)
        return total(slope * chained(g, rate) for g, slope in slopes if slope)

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
        # symbol by symbol, so that rates stay outside the named parts and results linear in them
        changing = sorted(self.symbols(), key=lambda symbol: symbol.key)
        return total(self.diff(s) * rate for s in changing if (rate := time_rate(s)))

    def subs(self, images: Mapping[Any, ExprLike]) -> Expr:
        """With symbols replaced simultaneously, inside functions too."""
        table = {as_symbol(symbol): Expr.of(image) for symbol, image in images.items()}
        if not table.keys() & self.symbols():
            return self

        def image(symbol: Symbol) -> Expr:
            return table[symbol] if symbol in table else Expr.generator(symbol)

        changed = (g for g in self.generators if not table.keys().isdisjoint(g.symbols()))
        return self.recast({g: _replaced(g, image) for g in changed})

    def replaced(self, image: Rate) -> Expr:
        """With every symbol replaced by its image."""
        return self.recast({g: _replaced(g, image) for g in self.generators})

    def recast(self, images: Mapping[Generator, Expr]) -> Expr:
        """With whole generators replaced by expressions."""
        num = _substituted(self.numerator, images)
        return num if self.is_polynomial else num / _substituted(self.denominator, images)


@lru_cache(maxsize=4096)
def _of_generator(generator: Generator, positive: bool) -> Expr:
    # generators are equal whether or not their sign is known: `positive` keeps them apart
    ring = ring_of(frozenset((generator,)))
    return Expr(ring, ring.variable(generator), ring.one)


def _rebuilt(generators: tuple[Generator, ...], num: PlainTerms, den: PlainTerms) -> Expr:
    """The expression that was pickled."""
    ring = ring_of(frozenset(generators))
    return Expr(ring, ring.polynomial(generators, num), ring.polynomial(generators, den))


@lru_cache(maxsize=64)
def _point(number: int) -> FieldPoint:
    """The points at which expressions with named parts are compared with zero."""
    return FieldPoint(f"point {number}")


def _is_numpy_scalar(value: object) -> bool:
    """Whether it is a NumPy scalar, without importing NumPy."""
    return getattr(value, "shape", None) == () and hasattr(value, "item")


def chained(generator: Generator, rate: Rate) -> Expr:
    """Derivative of a generator, given the derivative of every symbol."""
    if isinstance(generator, Composite):
        return generator.chain(rate)
    assert isinstance(generator, Symbol)
    return rate(generator)


def _replaced(generator: Generator, image: Rate) -> Expr:
    if isinstance(generator, Composite):
        return generator.replaced(image)
    assert isinstance(generator, Symbol)
    return image(generator)


def _substituted(polynomial: Expr, images: Mapping[Generator, Expr]) -> Expr:
    """A polynomial with generators replaced by their images; others stay as they are."""
    ring, used = polynomial.ring, polynomial.generators
    changed = tuple(g for g in used if g in images)
    if not changed:
        return polynomial
    kept = ring_of(frozenset(used).difference(images))
    if all(images[g].is_polynomial and len(images[g].num) < 2 for g in changed):
        composed = _composed(polynomial, {g: images[g] for g in changed}, kept)
        if composed is not None:
            return composed
    num = polynomial.num
    fixed = {
        ring.index[g]: fmpq(n.numerator, n.denominator)
        for g in changed
        if (n := images[g].rational) is not None
    }
    if fixed:  # numbers are put in at once: most terms of a series vanish at 0
        num = num.subs(fixed)
        changed = tuple(g for g in changed if ring.index[g] not in fixed)
    known = dict[tuple[Generator, int], Expr]()  # no image is raised to the same power twice

    def raised(generator: Generator, power: int) -> Expr:
        if (generator, power) not in known:
            known[generator, power] = images[generator] ** power
        return known[generator, power]

    terms = []
    positions = [ring.index[generator] for generator in changed]
    for powers, part in ring.grouped(num, positions).items():
        factors = (raised(g, int(p)) for g, p in zip(changed, powers, strict=True) if p)
        product = prod(factors, start=Expr.constant(1))
        terms.append(product * Expr(kept, part.project_to_context(kept.context), kept.one))
    return total(terms)


def _composed(polynomial: Expr, images: Mapping[Generator, Expr], kept: Ring) -> Expr | None:
    """The same where every image has one term; None where angles have to be divided first."""
    ring = union(kept, *(image.ring for image in images.values()))
    if _refinements(ring):
        return None
    values = (
        _lifted(images[g], ring).num
        if g in images
        else ring.variable(g)
        if g in kept.index
        else ring.zero
        for g in polynomial.ring.generators
    )
    num = polynomial.num.compose(*values, ctx=ring.context)
    return Expr(ring, ring.reduce(num), ring.one)


def total(expressions: Iterable[Expr]) -> Expr:
    """Their sum; many polynomials are added in one common ring, which is faster than in pairs."""
    terms = tuple(expressions)
    if len(terms) < 3 or not all(term.is_polynomial for term in terms):
        return sum(terms, ZERO)
    ring = union(*(term.ring for term in terms))
    if _refinements(ring):
        return sum(terms, ZERO)
    return Expr(ring, sum((_lifted(term, ring).num for term in terms), ring.zero), ring.one)


def length(expression: Expr) -> int:
    """Terms above and below the bar."""
    return len(expression.num) + len(expression.den)


def variables(expressions: Iterable[Expr]) -> frozenset[Symbol]:
    """Every symbol that occurs."""
    return frozenset().union(*(e.symbols() for e in expressions))


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
    """One function object per symbol: the derivatives of named parts are cached by it."""
    return lambda symbol: ONE if symbol == wanted else ZERO


def _together(first: Expr, second: ExprLike) -> tuple[Expr, Expr, Ring]:
    """Both in one ring.

    Where one has sin θ and the other sin θ/2, both are written in the smaller angle: sin θ and
    sin θ/2 are algebraically dependent, and normal forms over both would not be unique.
    """
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
    functions = (g for g in ring.generators if not g.is_part)
    composites = tuple(g for g in functions if isinstance(g, Composite))
    pairs = ((g, g.refined(composites)) for g in composites)
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

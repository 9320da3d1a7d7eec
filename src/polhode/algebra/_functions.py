"""Sines, cosines, exponentials and hyperbolic functions of expressions.

The argument is taken apart into terms; each term is a whole multiple of a *unit*, so that sin 2θ,
sin(θ + φ) and sin θ/2 become polynomials in the functions of few units, and every identity
follows from cos² = 1 - sin² and cosh² = 1 + sinh².
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache, reduce
from math import gcd, lcm

from polhode.algebra._arctangent import Arctangent
from polhode.algebra._expression import ONE, ZERO, Composite, Expr, ExprLike, Rate
from polhode.algebra._residues import Element, FieldPoint, NoResidueError, Residue, element
from polhode.algebra._ring import PI, Ball, Generator, Polynomial, Ring, Symbol
from polhode.algebra._roots import sqrt
from polhode.base import NumericError

pi = Expr.generator(PI)
"""The ratio of a circle's circumference to its diameter, exactly."""

#: Multiples up to this one are expanded (sin 4θ); the terms of an expansion double with each step,
#: so that a larger multiple is a unit in itself until it meets functions of the same angle.
_LARGEST_MULTIPLE = 8
_LARGEST_RATIO = 64  # between multiples of one angle that are still written in a common unit

#: Values in a prime field are those of multiples of this part of an angle, here a 5040th.
FINEST_UNITS = 5040

Pair = tuple[Expr, Expr]


@dataclass(frozen=True)
class FunctionPair:
    """An even and an odd function with an addition theorem: even² = 1 + sign · odd²."""

    even: str
    odd: str
    sign: int

    def unit(self, base: Expr, unit: Fraction) -> Pair:
        """(even, odd) of one unit of the argument."""
        if self.sign < 0 and unit == 1 and (arc := _arctangent(base)) is not None:
            return arc.pair
        return (
            Expr.generator(Even(self, base, unit)),
            Expr.generator(Odd(self, base, unit)),
        )

    def multiple(self, base: Expr, unit: Fraction, times: int) -> Pair:
        """(even, odd) of a whole number of units."""
        one = self.unit(base, unit)
        even, odd = reduce(self.sum, [one] * abs(times), (ONE, ZERO))
        return (even, odd) if times >= 0 else (even, -odd)

    def sum(self, first: Pair, second: Pair) -> Pair:
        """(even, odd) of the sum of two arguments."""
        (c1, s1), (c2, s2) = first, second
        return c1 * c2 + self.sign * s1 * s2, s1 * c2 + c1 * s2

    def of(self, argument: ExprLike) -> Pair:
        """(even, odd) of any expression."""
        parts = (self._term(base, factor) for base, factor in _terms(Expr.of(argument)))
        return reduce(self.sum, parts, (ONE, ZERO))

    @lru_cache(maxsize=4096)  # noqa: B019 - families are two immortal constants
    def _term(self, base: Expr, factor: Fraction) -> Pair:
        if base == pi and self.sign < 0:
            half_pi = Fraction(1, 2)
            return _cosine_of_turn(factor), _cosine_of_turn(half_pi - factor)
        unit, times = _unit(factor)
        return self.multiple(base, unit, times)

    def steps(self, tangent: Element, times: int) -> tuple[Element, Element]:
        """(even, odd) of a whole number of steps, from the tangent of half a step.

        With sign -1 the half step has the tangent t = tan, else tanh: even = (1 + sign t²) / (1 -
        sign t²) and odd = 2t / (1 - sign t²).
        """
        below = 1 - self.sign * tangent**2
        step = (1 + self.sign * tangent**2) / below, 2 * tangent / below
        found = (element(1), element(0))
        for bit in f"{times:b}":
            found = self.sum(found, found)
            if bit == "1":
                found = self.sum(found, step)
        return found


CIRCULAR = FunctionPair("cos", "sin", -1)
HYPERBOLIC = FunctionPair("cosh", "sinh", +1)


@dataclass(frozen=True)
class Elementary(Composite):
    """One function of `unit` times `base`."""

    family: FunctionPair
    base: Expr
    unit: Fraction

    @property
    def name(self) -> str:
        """The function's name."""
        return self.family.odd

    @cached_property
    def key(self) -> str:  # type: ignore[override]
        return f"{self.name}({self.unit}*{self.base.key})"

    def __hash__(self) -> int:
        return hash(self.key)

    @cached_property
    def kin(self) -> tuple[int, str]:
        """The same for all functions whose arguments may have a common unit."""
        return self.family.sign, self.base.key

    @property
    def argument(self) -> Expr:
        """The argument of the function."""
        return self.base * self.unit

    @property
    def inside(self) -> Expr:
        return self.argument

    def symbols(self) -> frozenset[Symbol]:
        return self.base.symbols()

    def ball(self, state: int) -> Ball:
        return getattr(self.argument.ball(state), self.name)()

    def residue(self, point: FieldPoint) -> Residue:
        steps = self.unit * FINEST_UNITS
        if steps.denominator != 1:
            raise NoResidueError(f"{self.name} of {self.unit} times an angle")
        drawn = point.drawn(f"{self.kin}")
        return Residue(self.at(self.family.steps(drawn, int(steps))), 2 * int(steps))

    @abstractmethod
    def at(self, pair: tuple[Element, Element]) -> Element:
        """Its value, from those of the even and the odd function of its argument."""

    def companions(self) -> tuple[Generator, ...]:
        return self._both

    @cached_property
    def _both(self) -> tuple[Odd, Even]:
        same = self.family, self.base, self.unit
        return Odd(*same), Even(*same)

    def pair(self) -> Pair:
        """The even and the odd function of the same argument."""
        return self.family.unit(self.base, self.unit)

    def chain(self, rate: Rate) -> Expr:
        return self.pair()[0] * self.argument.chain(rate)

    def remade(self, inside: Expr) -> Expr:
        return self.family.of(inside)[1]

    def finest(self, others: tuple[Generator, ...]) -> Fraction:
        """The largest unit of which this and the like functions in `others` are whole multiples.

        Multiples without a common unit of reasonable size are treated as unrelated.
        """
        units = {g.unit for g in others if isinstance(g, Elementary) and g.kin == self.kin}
        if units <= {self.unit}:
            return self.unit
        return next(unit for group, unit in _related(units | {self.unit}) if self.unit in group)

    def refined(self, others: tuple[Generator, ...]) -> Expr | None:
        finest = self.finest(others)
        if finest == self.unit:
            return None
        return self.in_units(finest, int(self.unit / finest))

    def in_units(self, unit: Fraction, times: int) -> Expr:
        """The same function, in terms of a smaller unit."""
        return self.family.multiple(self.base, unit, times)[1]


class Odd(Elementary):
    """Sine or hyperbolic sine."""

    def at(self, pair: tuple[Element, Element]) -> Element:
        return pair[1]


class Even(Elementary):
    """Cosine or hyperbolic cosine: algebraic over the sine."""

    @property
    def name(self) -> str:
        return self.family.even

    @property
    def depth(self) -> int:
        return 1

    @property
    def positive(self) -> bool:  # type: ignore[override]
        return self.family.sign > 0

    def partner(self) -> tuple[Generator, int]:
        return self._both[0], self.family.sign

    def square(self, ring: Ring) -> Polynomial:
        odd, sign = self.partner()
        return 1 + sign * ring.variable(odd) ** 2

    def chain(self, rate: Rate) -> Expr:
        return self.family.sign * self.pair()[1] * self.argument.chain(rate)

    def remade(self, inside: Expr) -> Expr:
        return self.family.of(inside)[0]

    def in_units(self, unit: Fraction, times: int) -> Expr:
        return self.family.multiple(self.base, unit, times)[0]

    def at(self, pair: tuple[Element, Element]) -> Element:
        return pair[0]


class Exponential(Elementary):
    """exp: kept apart from cosh + sinh until both occur together."""

    positive = True

    def at(self, pair: tuple[Element, Element]) -> Element:
        return pair[0] + pair[1]

    @property
    def name(self) -> str:
        return "exp"

    def companions(self) -> tuple[Generator, ...]:
        return ()

    def chain(self, rate: Rate) -> Expr:
        return Expr.generator(self) * self.argument.chain(rate)

    def remade(self, inside: Expr) -> Expr:
        return exp(inside)

    def refined(self, others: tuple[Generator, ...]) -> Expr | None:
        # beside cosh and sinh of the same argument it must be written as cosh + sinh: the three are
        # linearly dependent
        kin = [g for g in others if isinstance(g, Even | Odd) and g.base == self.base]
        if any(g.family == HYPERBOLIC for g in kin):
            finest = self.finest(others)
            even, odd = HYPERBOLIC.multiple(self.base, finest, int(self.unit / finest))
            return even + odd
        return super().refined(others)

    def in_units(self, unit: Fraction, times: int) -> Expr:
        return Expr.generator(Exponential(HYPERBOLIC, self.base, unit)) ** times


def cos(x: ExprLike) -> Expr:
    """Cosine of an angle in radians."""
    return CIRCULAR.of(x)[0]


def sin(x: ExprLike) -> Expr:
    """Sine of an angle in radians."""
    return CIRCULAR.of(x)[1]


def tan(x: ExprLike) -> Expr:
    """Tangent of an angle in radians."""
    even, odd = CIRCULAR.of(x)
    return odd / even


def cosh(x: ExprLike) -> Expr:
    """Hyperbolic cosine."""
    return HYPERBOLIC.of(x)[0]


def sinh(x: ExprLike) -> Expr:
    """Hyperbolic sine."""
    return HYPERBOLIC.of(x)[1]


def tanh(x: ExprLike) -> Expr:
    """Hyperbolic tangent."""
    even, odd = HYPERBOLIC.of(x)
    return odd / even


def sech(x: ExprLike) -> Expr:
    """Hyperbolic secant."""
    return 1 / cosh(x)


def exp(x: ExprLike) -> Expr:
    """Exponential function."""
    result = ONE
    for base, factor in _terms(Expr.of(x)):
        unit, times = _unit(factor)
        result = result * Expr.generator(Exponential(HYPERBOLIC, base, unit)) ** times
    return result


def _arctangent(base: Expr) -> Arctangent | None:
    """The arctangent, if an expression is one."""
    found = base.generators
    alone = found[0] if len(found) == 1 and base == Expr.generator(found[0]) else None
    return alone if isinstance(alone, Arctangent) else None


def _terms(argument: Expr) -> Iterator[tuple[Expr, Fraction]]:
    for powers, coefficient in argument.terms():
        yield Expr.product(powers) / argument.denominator, coefficient


def is_unit_argument(family: FunctionPair, base: Expr) -> bool:
    """Whether functions of multiples of `base` are written in units of `base` alone."""
    exact = family.sign < 0 and base == pi
    return not exact and list(_terms(base)) == [(base, Fraction(1))]


def _unit(factor: Fraction) -> tuple[Fraction, int]:
    if abs(factor.numerator) > _LARGEST_MULTIPLE:
        return abs(factor), (1 if factor > 0 else -1)
    return Fraction(1, factor.denominator), factor.numerator


def _related(units: set[Fraction]) -> list[tuple[set[Fraction], Fraction]]:
    """Units in groups, each with the unit that all in it are small multiples of."""
    groups: list[tuple[set[Fraction], Fraction]] = []
    for unit in sorted(units, reverse=True):
        for i, (group, common) in enumerate(groups):
            below = lcm(common.denominator, unit.denominator)
            finer = Fraction(gcd(int(common * below), int(unit * below)), below)
            if max(group) / finer <= _LARGEST_RATIO:
                groups[i] = (group | {unit}, finer)
                break
        else:
            groups.append(({unit}, unit))
    return groups


def _cosine_of_turn(multiple: Fraction) -> Expr:
    """cos(multiple · π), exact for multiples of π/12."""
    multiple = abs(multiple) % 2
    if multiple > 1:
        multiple = 2 - multiple
    if multiple > Fraction(1, 2):
        return -_cosine_of_turn(1 - multiple)
    twelfths = multiple * 12
    if twelfths.denominator > 1:
        raise NumericError(
            f"the angle {multiple}*pi inside a sine or cosine",
            expected="a multiple of pi/12 (15 degrees), whose sine is a square root",
            advice="use a symbol for the angle and give it its value as a number",
        )
    # cos(π/12) = (√6 + √2)/4 = √2 (√3 + 1)/4, and so on in steps of π/12
    root2, root3 = sqrt(2), sqrt(3)
    table = (
        ONE,
        root2 * (root3 + 1) / 4,
        root3 / 2,
        root2 / 2,
        ONE / 2,
        root2 * (root3 - 1) / 4,
        ZERO,
    )
    return table[int(twelfths)]


def exponentials(expression: Expr) -> list[tuple[Expr, Expr]] | None:
    """An expression as a sum of factors times exp(exponent).

    None if no exponential occurs outside of functions, or if its denominator has terms with
    different exponents.
    """
    if not any(isinstance(g, Exponential) for g in expression.generators):
        return None
    below = _exponent_of(expression.denominator)
    if below is None:
        return None
    divisor, taken = below
    parts: dict[Expr, Expr] = {}
    for powers, coefficient in expression.terms():
        rest, exponent = _without_exponentials(powers)
        key = exponent - taken
        parts[key] = parts.get(key, ZERO) + rest * Expr.constant(coefficient)
    return [(factor / divisor, exponent) for exponent, factor in parts.items()]


def _exponent_of(denominator: Expr) -> tuple[Expr, Expr] | None:
    """A denominator without the exponential common to its terms, and the exponent of that."""
    terms = [(*_without_exponentials(p), c) for p, c in denominator.terms()]
    exponents = {exponent for _, exponent, _ in terms}
    if len(exponents) != 1:
        return None
    rest = sum((factor * Expr.constant(c) for factor, _, c in terms), ZERO)
    return rest, exponents.pop()


def _without_exponentials(powers: dict[Generator, int]) -> tuple[Expr, Expr]:
    """A product without its exponentials, and the sum of their exponents."""
    rest = {g: power for g, power in powers.items() if not isinstance(g, Exponential)}
    exponents = (g.argument * p for g, p in powers.items() if isinstance(g, Exponential))
    return Expr.product(rest), sum(exponents, ZERO)

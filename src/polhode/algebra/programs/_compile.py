"""From exact expressions to straight-line programs with few operations."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache, reduce
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

from polhode.algebra._expression import ONE, ZERO, Expr, length
from polhode.algebra._forms import Factors, shortest
from polhode.algebra._functions import CIRCULAR, Elementary, exponentials
from polhode.algebra._half_angles import lowest
from polhode.algebra._parts import NamedPart
from polhode.algebra._ring import (
    PI,
    Generator,
    Polynomial,
    Ring,
    Symbol,
    SymbolKind,
    as_fraction,
    union,
)
from polhode.algebra._roots import SquareRoot, factors
from polhode.algebra._vector import Matrix, Row
from polhode.algebra.programs._program import Op, Program
from polhode.algebra.programs._tape import Tape, Value, solve_on
from polhode.algebra.programs._terms import (
    Monomial,
    Number,
    Term,
    Terms,
    extracted,
    is_plainly_irreducible,
    most_shared,
    polynomial_of,
    scaled,
    split,
    terms_of,
)
from polhode.base import DeclarationError, NumericError


@dataclass(frozen=True)
class LinearSolve:
    """Symbols defined as the solution of `matrix` @ unknowns = `right`.

    The solution is unrolled into steps: LDLᵀ for a symmetric matrix (a positive definite mass
    matrix needs no pivoting), LU otherwise. No inverse is ever written out.
    """

    unknowns: tuple[Symbol, ...]
    matrix: Matrix
    right: tuple[Expr, ...]

    @property
    def solution(self) -> tuple[Expr, ...]:
        """The unknowns as expressions."""
        return tuple(Expr.generator(unknown) for unknown in self.unknowns)


_LONG = 100  # terms above which the steps of an expression are cached for all programs

#: The terms of polynomials with their powers.
_Factors: TypeAlias = list[tuple[Terms, int]]

Definitions: TypeAlias = Callable[[Symbol], Expr | None]


def compile_program(
    expressions: Iterable[Expr],
    arguments: Sequence[Symbol],
    where: Definitions = lambda symbol: None,
    solves: Iterable[LinearSolve] = (),
    turned: Mapping[Symbol, Symbol] = MappingProxyType({}),
) -> Program:
    """The program that computes the expressions from the arguments.

    Args:
        expressions: what to compute, in the order of the outputs.
        arguments: the symbols whose values will be given, in their order.
        where: the meaning of a further symbol, as an expression in others and the arguments, or
            None where it is not known; a dictionary's `get` will do.
        solves: further symbols, defined by systems of linear equations.
        turned: for angles that can grow large, the argument that holds the angle less whole turns:
            the sine of 10⁶ rad has lost six digits.

    Raises:
        DeclarationError: for a symbol that is neither given nor defined.
        NumericError: for linear equations that are singular whatever the values.
    """
    writer = _TapeWriter(tuple(arguments), where, tuple(solves), turned)
    outputs = [writer.expression(expression) for expression in expressions]
    return writer.tape.program(writer.arguments, outputs)


class _Fraction(NamedTuple):
    """One way of writing an expression, its denominator as powers of factors."""

    ring: Ring
    num: Polynomial
    below: Factors

    @property
    def generators(self) -> Iterator[Generator]:
        """Those that occur."""
        degrees = [part.degrees() for part in (self.num, *(factor for factor, _ in self.below))]
        for generator, powers in zip(self.ring.generators, zip(*degrees, strict=True), strict=True):
            if max(powers) > 0:
                yield generator


class _TapeWriter:
    """Writes expressions on a tape, and remembers the value of every symbol and function."""

    def __init__(
        self,
        arguments: tuple[Symbol, ...],
        where: Definitions,
        solves: tuple[LinearSolve, ...],
        turned: Mapping[Symbol, Symbol],
    ) -> None:
        self.tape = Tape()
        self.arguments = arguments
        self._where = where
        self._turned = turned
        self._solves = {unknown: solve for solve in solves for unknown in solve.unknowns}
        self._values: dict[Generator, Value] = {
            symbol: self.tape.argument(i) for i, symbol in enumerate(arguments)
        }

    def know(self, values: Mapping[Generator, Value]) -> None:
        """Record the values of generators."""
        self._values.update(values)

    def expression(self, expression: Expr) -> Value:
        """Write an expression."""
        merged = exponentials(expression)
        if merged is not None:
            return reduce(self.tape.add, [self._exponential(*part) for part in merged])
        if expression.ring.has_parts or length(expression) > _LONG:
            return self._replayed(expression)
        return self.written(expression)

    def _replayed(self, expression: Expr) -> Value:
        """By steps that are compiled once for all programs."""
        trimmed = expression.trimmed()
        for generator in trimmed.ring.generators:
            self._prepare(generator)
        values = [self._values[generator] for generator in trimmed.ring.generators]
        return self.tape.replay(_steps_of(trimmed), values)

    def written(self, expression: Expr) -> Value:
        """The same in the form of fewest steps, with each exponential as a separate value.

        That is also the form that loses fewest digits: of a thin rod that lies almost flat, it has
        l² sin² θ, where another has l² - l² cos² θ.
        """
        forms = list(_forms(expression))
        for form in forms:
            for generator in form.generators:
                self._prepare(generator)
        start, costs, value = len(self.tape), list[int](), self.tape.zero
        for form in forms:
            self.tape.rewind(start)
            value = self._fraction(form)
            costs.append(len(self.tape) - start)
        best = costs.index(min(costs))
        if best == len(forms) - 1:
            return value
        self.tape.rewind(start)
        return self._fraction(forms[best])

    def _exponential(self, factor: Expr, exponent: Expr) -> Value:
        """Factor times one exp; separately, exp(a) may overflow where exp(−b) underflows."""
        if exponent.is_zero:
            return self.expression(factor)
        near = _centred(factor, exponent)
        if near is not None:
            self._values[near.distance] = self.expression(near.meaning)
        value = self.expression(factor if near is None else near.expression)
        return self.tape.multiply(value, self.tape.call(Op.EXP, self.expression(exponent)))

    # -- symbols and functions ------------------------------------------------------------------

    def _prepare(self, generator: Generator) -> None:
        if generator not in self._values:
            self._values[generator] = self._generator(generator)

    def _generator(self, generator: Generator) -> Value:
        match generator:
            case Symbol():
                return self._symbol(generator)
            case SquareRoot():
                return self.tape.call(Op.SQRT, self.expression(generator.radicand))
            case Elementary():
                return self.tape.call(Op(generator.name), self._argument(generator))
            case NamedPart():
                return self._replayed(generator.meaning)
            case _:
                raise NumericError(
                    f"the function {generator.key}", expected="one with a numeric value"
                )

    def _argument(self, function: Elementary) -> Value:
        angle = function.base.symbol
        periodic = function.family == CIRCULAR and function.unit.denominator == 1
        if periodic and angle is not None and angle in self._turned:
            return self.expression(Expr.generator(self._turned[angle]) * function.unit)
        return self.expression(function.argument)

    def _symbol(self, symbol: Symbol) -> Value:
        if symbol in self._solves:
            solve = self._solves[symbol]
            matrix, column = _divided(solve)
            rows = [[self.expression(entry) for entry in row] for row in matrix.rows]
            right = [self.expression(entry) for entry in column]
            values = solve_on(self.tape, rows, right, symmetric=matrix == matrix.T)
            self._values.update(zip(solve.unknowns, values, strict=True))
            return self._values[symbol]
        meaning = self._where(symbol)
        if meaning is not None:
            return self.expression(meaning)
        if symbol == PI:
            return self.tape.pi()
        raise DeclarationError(
            f"{symbol.published} has no value",
            expected="a value for every symbol that occurs",
            advice=f"give {symbol.published} or define it",
        )

    # -- polynomials ----------------------------------------------------------------------------

    def _fraction(self, form: _Fraction) -> Value:
        content, above = _factored(form.ring, terms_of(form.num))
        below: _Factors = []
        for part, exponent in form.below:
            divisor, factors = _factored(form.ring, terms_of(part))
            if divisor != 1:
                content = content / Fraction(divisor) ** exponent
            below += [(factor, power * exponent) for factor, power in factors]
        num = self._product(form.ring, above, content)
        return self.tape.divide(num, self._product(form.ring, below, 1))

    def _product(self, ring: Ring, factors: _Factors, number: Number) -> Value:
        if len(factors) == 1 and factors[0][1] == 1 and len(factors[0][0]) > 1:
            return self._scaled(ring, factors[0][0], number)
        product = self.tape.product([self.tape.power(self._sum(ring, f), e) for f, e in factors])
        return self.tape.multiply(self.tape.constant(number), product)

    def _scaled(self, ring: Ring, terms: Terms, number: Number) -> Value:
        """A number times a sum, the number multiplied in where that saves steps."""
        if abs(number) != 1:
            inside = sum(abs(c * number) != 1 for _, c in terms)
            outside = sum(abs(c) != 1 for _, c in terms) + 1
            if inside < outside:
                return self._sum(ring, scaled(terms, number))
        return self.tape.multiply(self.tape.constant(number), self._sum(ring, terms))

    def _sum(self, ring: Ring, terms: Terms) -> Value:
        """Greedy Horner form: the generator that most terms share is taken out first.

        Ceberio and Kreinovich, Greedy algorithms for optimizing multivariate Horner schemes,
        SIGSAM Bulletin 38 (2004).
        """
        if len(terms) == 1:
            return self._term(ring, *terms[0])
        place, shared, power = most_shared(terms)
        if shared < 2:
            return self.tape.total([self._term(ring, m, c) for m, c in terms])
        inner, rest = split(terms, place, power)
        factor = self.tape.power(self._values[ring.generators[-place]], power)
        value = self.tape.multiply(self._polynomial(ring, inner), factor)
        return self.tape.add(value, self._polynomial(ring, rest)) if rest else value

    def _polynomial(self, ring: Ring, terms: Terms) -> Value:
        content, factors = _factored(ring, terms)
        return self._product(ring, factors, content)

    def _term(self, ring: Ring, monomial: Monomial, coefficient: Number) -> Value:
        product = self.tape.product(
            [self.tape.power(self._values[ring.generators[-i]], e) for i, e in monomial]
        )
        if coefficient == 1:
            return product
        return self.tape.multiply(self.tape.constant(coefficient), product)


@lru_cache(maxsize=16384)
def _steps_of(expression: Expr) -> Program:
    """The steps to an expression from the generators of its ring."""
    writer = _TapeWriter((), lambda symbol: None, (), {})
    generators = expression.ring.generators
    writer.know({g: writer.tape.argument(i) for i, g in enumerate(generators)})
    return writer.tape.program((), [writer.written(expression)])


def _divided(solve: LinearSolve) -> tuple[Matrix, Row]:
    """The same equations; those in one unknown are brought to lowest terms."""
    rows, right = list(solve.matrix.rows), list(solve.right)
    for i, row in enumerate(rows):
        occurring = [entry for entry in row if entry]
        if len(occurring) == 1:
            below, right[i] = _lowest_terms(occurring[0], right[i])
            rows[i] = tuple(below if entry else ZERO for entry in row)
    return Matrix(tuple(rows)), tuple(right)


def _lowest_terms(divisor: Expr, value: Expr) -> tuple[Expr, Expr]:
    """The equation divisor · unknown = value, divided by what would be 0/0 somewhere.

    By the divisor itself where that is shorter: the normal form of a quotient grows with every
    cosine below the bar, to thousands of terms for a robot arm of three links.
    """
    angles = sum(1 for generator in divisor.generators if generator.depth)
    if angles <= 1 or len(divisor.num) == 1:
        quotient = value / divisor
        if length(quotient) <= length(value) + length(divisor):
            return ONE, quotient
    if not (divisor.is_polynomial and value.is_polynomial):
        return divisor, value
    ring = union(divisor.ring, value.ring)
    above, below = (ring.lift(e.ring, e.num) for e in (value, divisor))
    common = above.gcd(below)
    if common.is_constant():
        return divisor, value
    return Expr(ring, below / common, ring.one), Expr(ring, above / common, ring.one)


def _forms(expression: Expr) -> Iterator[_Fraction]:
    ring, num, den = expression.ring, expression.num, expression.den
    if ring.has_parts:
        yield _Fraction(ring, num, [(den, 1)])
        return
    cancelled = lowest(expression)
    if cancelled is not None:
        yield _Fraction(ring, shortest(ring, cancelled.num), cancelled.factors)
        return
    yield _Fraction(ring, num, [(den, 1)])
    above, below = shortest(ring, num), shortest(ring, den)
    if above is num and below is den:
        return
    common = above.gcd(below)
    yield _Fraction(ring, above / common, [(below / common, 1)])


def _factored(ring: Ring, terms: Terms) -> tuple[Number, _Factors]:
    if not terms:
        return 0, []
    if ring.has_parts or len(terms) > _LONG or is_plainly_irreducible(terms):
        # only what all terms have in common: with many generators, factorising rarely pays
        content, common, rest = extracted(terms)
        powers: _Factors = [([(((place, 1),), 1)], power) for place, power in common]
        return content, [*powers, (rest, 1)] if len(rest) > 1 else powers
    content, factors = _irreducible(ring, tuple(terms))
    return content, list(factors)


@lru_cache(maxsize=1024)  # each form is written twice, once to count its steps
def _irreducible(ring: Ring, terms: tuple[Term, ...]) -> tuple[Number, _Factors]:
    number, factors = polynomial_of(ring, terms).factor()
    return as_fraction(number), [(terms_of(factor), int(power)) for factor, power in factors]


# -- sums about the centre of an exponent ----------------------------------------------------------
#
# The second derivative of exp(−(t − c)²/w²) has the factor 2(t − c)² − w². Multiplied out, as
# 2t² − 4ct + 2c² − w², it loses as many digits by cancellation as t²/w² has.


class _Centred(NamedTuple):
    """An expression written with a distance.

    Attributes:
        expression: with the distance as a symbol.
        distance: that symbol.
        meaning: what the distance is.
    """

    expression: Expr
    distance: Symbol
    meaning: Expr


def _centred(factor: Expr, exponent: Expr) -> _Centred | None:
    """The factor of an exp, written with a distance that is a factor of the exponent.

    None where that is not shorter.
    """
    ways = []
    for meaning, power in factors(exponent)[1].items():
        if power <= 0 or len(meaning.num) < 2:
            continue
        # In a fixed order: of equally short ways the first is taken, whatever the hash seed is.
        for symbol in sorted(meaning.symbols(), key=lambda s: s.published):
            slope = meaning.diff(symbol)
            if slope.generators:
                continue  # not linear in the symbol with a numeric coefficient
            distance = Symbol(f"({meaning.key})", SymbolKind.PARAMETER)
            image = Expr.generator(symbol) + (Expr.generator(distance) - meaning) / slope
            ways.append(_Centred(factor.subs({symbol: image}), distance, meaning))
    best = min(ways, key=lambda way: length(way.expression), default=None)
    return best if best is not None and length(best.expression) < length(factor) else None

"""Exact values of parameters and start, and numbers worked out from them to any precision."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache, partial
from typing import Any

from polhode.algebra import (
    ZERO,
    Arithmetic,
    Compiled,
    Expr,
    Program,
    Symbol,
    as_symbol,
    compile_program,
    pi,
    read_value,
    sin,
    variables,
)
from polhode.base import TIME, DeclarationError, Dimension, NumericError, look_up
from polhode.derive import Equations

Name = str | Symbol | Expr

#: Digits carried beyond those asked for, so that short formulas come out correct to rounding.
SPARE = 50
#: How many times the digits are tried, before a number lost in rounding is given up.
_REFINEMENTS = (1, 2, 4, 8, 16, 32)


#: Stands for π where its multiples have no sine that can be written down.
_ANY = Symbol("any_angle", positive=True)


class Tools:
    """Contexts of several precisions, and expressions compiled for them, kept for many values."""

    def __init__(self) -> None:
        self._functions: dict[tuple[Expr, tuple[Symbol, ...], int], Compiled] = {}
        self._contexts: dict[int, Any] = {}

    def context(self, digits: int) -> Any:
        """The mpmath context of so many digits."""
        if digits not in self._contexts:
            import mpmath

            self._contexts[digits] = mpmath.MPContext()
            self._contexts[digits].dps = digits
        return self._contexts[digits]

    def value(self, expression: Expr, numbers: Mapping[Symbol, Any], digits: int) -> Any:
        """An expression of numbers, worked out with so many digits."""
        key = (expression, tuple(numbers), digits)
        if key not in self._functions:
            context = self.context(digits)
            arithmetic = Arithmetic.of(context, partial(_fraction, context))
            self._functions[key] = _program(expression, key[1]).function(arithmetic)
        return self._functions[key](*numbers.values())[0]


@dataclass(frozen=True)
class Data:
    """Exact values of symbols, and any expression of them as a number.

    Attributes:
        values: a constant expression for every symbol.
        digits: decimal digits that numbers are wanted to.
        tools: shared by like data.
    """

    values: Mapping[Symbol, Expr]
    digits: int
    tools: Tools = field(default_factory=Tools, repr=False, compare=False)
    _seen: dict[Any, Any] = field(default_factory=dict, repr=False, compare=False)

    @property
    def context(self) -> Any:
        """The mpmath context of all numbers, with digits to spare."""
        return self.tools.context(self.digits + SPARE)

    def number(self, expression: Expr) -> Any:
        """An expression's value, correct to all digits of the context; zero only if it is zero.

        Raises `NumericError` where it is singular, or too small to be told from zero.
        """
        if expression not in self._seen:
            self._seen[expression] = self._number(expression)
        return self._seen[expression]

    def changed(self, values: Mapping[Symbol, Expr]) -> Data:
        """The same with other values for some symbols."""
        return Data({**self.values, **values}, self.digits, self.tools)

    def _number(self, expression: Expr) -> Any:
        approximations = self._approximations(expression)
        coarse = next(approximations)
        for fine in approximations:
            if fine and abs(fine - coarse) <= abs(fine) * self.context.eps:
                return self.context.convert(fine)
            if self._vanishes(expression):
                return self.context.zero
            coarse = fine
        raise NumericError(
            f"{expression} is smaller than any number of {_REFINEMENTS[-1] * self.digits} digits",
            expected="values for which it is zero or not",
        )

    def _vanishes(self, expression: Expr) -> bool:
        """Whether it is zero exactly; an angle whose sine is no square root may be any angle."""
        if "generic" not in self._seen:
            self._seen["generic"] = {s: _generic(value) for s, value in self.values.items()}
        with suppress(NumericError):  # a sine that cannot be written down
            return expression.subs(self._seen["generic"]).is_zero
        return False

    def _approximations(self, expression: Expr) -> Iterator[Any]:
        for times in _REFINEMENTS:
            digits = times * (self.digits + SPARE) + 5
            try:
                yield self.tools.value(expression, self._numbers(expression, digits), digits)
            except ZeroDivisionError as error:
                raise NumericError(
                    f"{expression} is not defined at the start",
                    expected="a start where the equations are regular",
                    advice="start away from the singular position (such as theta = 0)",
                ) from error

    def _numbers(self, expression: Expr, digits: int) -> dict[Symbol, Any]:
        found = {}
        for symbol in sorted(expression.symbols() & self.values.keys(), key=_name):
            if (symbol, digits) not in self._seen:
                self._seen[symbol, digits] = self._constant(self.values[symbol], digits)
            found[symbol] = self._seen[symbol, digits]
        return found

    def _constant(self, value: Expr, digits: int) -> Any:
        number = value.rational
        if number is None:
            return self.tools.value(value, {}, digits)
        return _fraction(self.tools.context(digits), number)


@lru_cache(maxsize=1024)
def _program(expression: Expr, arguments: tuple[Symbol, ...]) -> Program:
    return compile_program([expression], arguments)


def exact_data(
    equations: Equations, parameters: Mapping[Any, Any], start: Mapping[Any, Any], digits: int
) -> Data:
    """What is given, exactly; coordinates and speeds not given are zero.

    Text is the decimal it spells ("0.1" is a tenth, "80 deg" is 4π/9); a float is its binary value,
    so that a simulation from the same floats is compared with the motion it stands for.

    Raises:
        DeclarationError: for a name that is not known, or a sign that contradicts a declaration.
        UnitError: for a value that cannot be read or has the wrong dimension.
    """
    constants = {*equations.parameters, *_of_bodies(equations)}
    state = (*equations.coordinates, *equations.speeds)
    dimensions = equations.dimensions
    given = _read(parameters, constants, "parameter", dimensions)
    begun = _read(start, state, "coordinate or independent speed", dimensions)
    at_rest = dict.fromkeys(state, ZERO)
    data = Data({**at_rest, **{s: v.subs(given) for s, v in begun.items()}, **given}, digits)
    for symbol, value in data.values.items():
        _check_constant(symbol, value)
    for symbol in (s for s in data.values if s.positive):
        _check_positive(data, Expr.generator(symbol))
    return data


def _of_bodies(equations: Equations) -> frozenset[Symbol]:
    bodies = equations.system.bodies
    return variables(e for body in bodies for e in (body.mass, *sum(body.inertia.rows, ())))


def _check_constant(symbol: Symbol, value: Expr) -> None:
    loose = sorted(s.published for s in value.symbols() - pi.symbols())
    if loose:
        raise DeclarationError(
            f"{symbol.published} = {value}, without a value for {', '.join(loose)}",
            expected="numbers for all that it is made of",
            advice=f"give {loose[0]} among the parameters",
        )


def _check_positive(data: Data, quantity: Expr) -> None:
    value = data.number(quantity)
    if value <= 0:
        raise DeclarationError(
            f"{quantity} = {float(value):g}",
            expected="a positive value, as it was declared",
            advice=f"check the sign of {quantity}",
        )


def _read(
    given: Mapping[Any, Any],
    known: Iterable[Symbol],
    what: str,
    dimensions: Mapping[Symbol, Dimension],
) -> dict[Symbol, Expr]:
    by_name = {symbol.published: symbol for symbol in known}
    found = dict[Symbol, Expr]()
    for key, value in given.items():
        name = key if isinstance(key, str) else as_symbol(key).published
        symbol = look_up(name, by_name, what)
        base = dimensions.get(symbol.base())
        dimension = None if base is None else base / TIME**symbol.order
        found[symbol] = read_value(name, value).in_dimension(dimension).exact()
    return found


def _generic(value: Expr) -> Expr:
    """A value in which multiples of π are those of any number, if their sines are no roots."""
    try:
        sin(value)
    except NumericError:
        return value.subs({as_symbol(pi): Expr.generator(_ANY)})
    return value


def _fraction(context: Any, number: Fraction) -> Any:
    return context.mpf(number.numerator) / number.denominator


def _name(symbol: Symbol) -> str:
    return symbol.published

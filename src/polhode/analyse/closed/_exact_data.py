"""Exact values of parameters and start, and numbers computed from them to any precision."""

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

#: Digits carried beyond those requested, so that short formulas are correct to rounding.
SPARE = 50
#: Multiples of the digits that are tried to tell a small number from zero.
_REFINEMENTS = (1, 2, 4, 8, 16, 32)


#: Replaces π where the sine of its multiple cannot be written in square roots.
_ANY = Symbol("any_angle", positive=True)


class Tools:
    """Contexts of several precisions, and expressions compiled for them, kept for many values."""

    def __init__(self) -> None:
        self._functions: dict[tuple[Expr, tuple[Symbol, ...], int], Compiled] = {}
        self._contexts: dict[int, Any] = {}

    def context(self, digits: int) -> Any:
        """The mpmath context of a number of decimal digits."""
        if digits not in self._contexts:
            import mpmath

            self._contexts[digits] = mpmath.MPContext()
            self._contexts[digits].dps = digits
        return self._contexts[digits]

    def value(self, expression: Expr, numbers: Mapping[Symbol, Any], digits: int) -> Any:
        """An expression of numbers, evaluated to a number of digits."""
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
        digits: decimal digits of the results.
        tools: shared by similar data.
    """

    values: Mapping[Symbol, Expr]
    digits: int
    tools: Tools = field(default_factory=Tools, repr=False, compare=False)
    _seen: dict[Any, Any] = field(default_factory=dict, repr=False, compare=False)

    @property
    def context(self) -> Any:
        """The mpmath context of all numbers, with spare digits."""
        return self.tools.context(self.digits + SPARE)

    def number(self, expression: Expr) -> Any:
        """An expression's value, correct to all digits of the context; zero only if it is zero.

        Raises `NumericError` where it is singular, or too small to be distinguished from zero.
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
            # two precisions that agree to all digits: cancellation has cost none of them
            if fine and abs(fine - coarse) <= abs(fine) * self.context.eps:
                return self.context.convert(fine)
            if self._vanishes(expression):
                return self.context.zero
            coarse = fine
        raise NumericError(
            f"{expression} is neither zero nor resolved in {_REFINEMENTS[-1] * self.digits} digits",
            expected="values for which it is exactly zero or clearly not",
        )

    def _vanishes(self, expression: Expr) -> bool:
        """Whether it is exactly zero; an angle whose sine is not a root counts as a free symbol."""
        if "generic" not in self._seen:
            self._seen["generic"] = {s: _generic(value) for s, value in self.values.items()}
        with suppress(NumericError):  # a sine that cannot be written in square roots
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
        """Values of the symbols of an expression, to a number of digits."""
        found = {}
        used = expression.symbols() & self.values.keys()
        for symbol in sorted(used, key=lambda symbol: symbol.published):
            if (symbol, digits) not in self._seen:
                value, context = self.values[symbol], self.tools.context(digits)
                self._seen[symbol, digits] = (
                    self.tools.value(value, {}, digits)
                    if value.rational is None
                    else _fraction(context, value.rational)
                )
            found[symbol] = self._seen[symbol, digits]
        return found


@lru_cache(maxsize=1024)
def _program(expression: Expr, arguments: tuple[Symbol, ...]) -> Program:
    return compile_program([expression], arguments)


def exact_data(
    equations: Equations, parameters: Mapping[Any, Any], start: Mapping[Any, Any], digits: int
) -> Data:
    """The given values exactly; coordinates and speeds not given are zero.

    Text is the decimal it spells ("0.1" is a tenth, "80 deg" is 4π/9); a float is its binary value,
    so that a simulation from the same floats is compared with the motion it stands for.

    Raises:
        DeclarationError: for a name that is not known, or a sign that contradicts a declaration.
        UnitError: for a value that cannot be read or has the wrong dimension.
    """
    bodies = equations.system.bodies
    parts = [e for body in bodies for e in (body.mass, *sum(body.inertia.rows, ()))]
    constants = {*equations.parameters, *variables(parts)}
    state = (*equations.coordinates, *equations.speeds)
    dimensions = equations.dimensions
    given = _read(parameters, constants, "parameter", dimensions)
    initial = _read(start, state, "coordinate or independent speed", dimensions)
    at_rest = dict.fromkeys(state, ZERO)
    data = Data({**at_rest, **{s: v.subs(given) for s, v in initial.items()}, **given}, digits)
    for symbol, value in data.values.items():
        missing = sorted(s.published for s in value.symbols() - pi.symbols())
        if missing:
            raise DeclarationError(
                f"{symbol.published} = {value}, without a value for {', '.join(missing)}",
                expected="numbers for all the quantities in it",
                advice=f"give {missing[0]} among the parameters",
            )
    for symbol in (s for s in data.values if s.positive):
        quantity = Expr.generator(symbol)
        number = data.number(quantity)
        if number <= 0:
            raise DeclarationError(
                f"{quantity} = {float(number):g}",
                expected="a positive value, as it was declared",
                advice=f"check the sign of {quantity}",
            )
    return data


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
    """A value with π replaced by a free symbol where its sine is not a root of rationals."""
    try:
        sin(value)
    except NumericError:
        return value.subs({as_symbol(pi): Expr.generator(_ANY)})
    return value


def _fraction(context: Any, number: Fraction) -> Any:
    return context.mpf(number.numerator) / number.denominator

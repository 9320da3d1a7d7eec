"""Conversion to SymPy expressions and back, without loss."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from math import prod
from typing import Any

from polhode.algebra import _functions as functions
from polhode.algebra._expression import ZERO, Expr
from polhode.algebra._parts import has_parts
from polhode.algebra._ring import Symbol
from polhode.algebra._roots import absolute, sqrt
from polhode.algebra._symbols import coordinate, symbol, time
from polhode.algebra.printing._layout import layout
from polhode.algebra.printing._nodes import PrintNode
from polhode.base import DeclarationError, NumericError

Names = Mapping[str, Expr]


def to_sympy(expression: Expr, names: Mapping[str, Any] | None = None) -> Any:
    """The SymPy expression, in the form that is printed.

    Args:
        expression: what to convert.
        names: SymPy objects for published names; any other becomes a `sympy.Symbol`.

    Raises:
        NumericError: for an expression in named parts.
    """
    if has_parts(expression):
        raise NumericError(
            f"{expression} for SymPy, whose numbered letters stand for long expressions",
            expected="an expression that is written out",
            advice="evaluate it with compile_program",
        )
    return layout(expression).drawn(_SymPy(names or {}))


def from_sympy(value: Any, names: Names | None = None) -> Expr:
    """The exact expression that a SymPy expression stands for.

    Args:
        value: of numbers, symbols, +, *, powers by halves of whole numbers, circular and
            hyperbolic functions, exp, sqrt, Abs and dynamicsymbols with their derivatives.
        names: the meaning of names. Any other symbol becomes a parameter, and any other
            dynamicsymbol a coordinate.

    Raises:
        NumericError: for anything else, which the message names.
    """
    return _SympyReader(names or {}).read(value)


class _SymPy:
    """The style of `to_sympy`."""

    def __init__(self, names: Mapping[str, Any]) -> None:
        import sympy

        self._sympy = sympy
        self._names = {"pi": sympy.pi, **names}

    def number(self, value: int) -> Any:
        return self._sympy.Integer(value)

    def name(self, symbol: Symbol) -> Any:
        name = symbol.published
        return self._names[name] if name in self._names else self._sympy.Symbol(name)

    def call(self, function: str, argument: PrintNode) -> Any:
        return getattr(self._sympy, _SYMPY_NAMES.get(function, function))(argument.drawn(self))

    def power(self, base: PrintNode, exponent: int) -> Any:
        return base.drawn(self) ** exponent

    def product(self, factors: tuple[PrintNode, ...]) -> Any:
        return self._sympy.Mul(*(f.drawn(self) for f in factors))

    def sum(self, terms: tuple[PrintNode, ...]) -> Any:
        return self._sympy.Add(*(t.drawn(self) for t in terms))

    def fraction(self, above: PrintNode, below: PrintNode) -> Any:
        return above.drawn(self) / below.drawn(self)

    def radical(self, radicand: PrintNode) -> Any:
        return self._sympy.sqrt(radicand.drawn(self))

    def letter(self, letter: PrintNode, meaning: PrintNode) -> Any:
        return meaning.drawn(self)


_SYMPY_NAMES = {"abs": "Abs"}

_DERIVATIVES = {"_dot": 1, "_ddot": 2, "_dddot": 3}


class _SympyReader:
    """Reads one SymPy expression, by the names of its classes so that SymPy is not imported."""

    def __init__(self, names: Names) -> None:
        self._names = names
        self._readers: dict[str, Callable[[Any], Expr]] = {
            "AppliedUndef": self._dynamic,
            "Derivative": self._derivative,
            "Symbol": lambda value: self._symbol(value.name, value.is_positive is True),
            "Rational": lambda value: Expr.constant(Fraction(int(value.p), int(value.q))),
            "Float": lambda value: Expr.of(float(value)),
            "Pi": lambda value: functions.pi,
            "Exp1": lambda value: functions.exp(1),
            "Add": lambda value: sum(map(self.read, value.args), ZERO),
            "Mul": lambda value: prod(map(self.read, value.args), start=Expr.constant(1)),
            "Pow": self._power,
        }

    def read(self, value: Any) -> Expr:
        """Any accepted expression."""
        kinds = [kind.__name__ for kind in type(value).__mro__]
        for kind in kinds if "AppliedUndef" not in kinds else ["AppliedUndef"]:
            if kind in self._readers:
                return self._readers[kind](value)
            if kind in _FUNCTIONS:
                return _FUNCTIONS[kind](self.read(value.args[0]))
        raise _unreadable(value)

    def _power(self, value: Any) -> Expr:
        base, exponent = value.args
        if type(base).__name__ == "Exp1":
            return functions.exp(self.read(exponent))
        return self.read(base) ** self.read(exponent)

    def _symbol(self, name: str, positive: bool) -> Expr:
        if name in self._names:
            return self._names[name]
        if name == "t":
            return time
        base, _, suffix = name.rpartition("_")
        if base in self._names and f"_{suffix}" in _DERIVATIVES:
            return _rate(self._names[base], _DERIVATIVES[f"_{suffix}"])
        try:
            return symbol(name, positive=positive)
        except DeclarationError as error:
            raise NumericError(
                f"the SymPy symbol {name!r}", expected=error.expected, advice=error.advice
            ) from error

    def _dynamic(self, value: Any) -> Expr:
        if [argument.name for argument in value.free_symbols] != ["t"] or len(value.args) != 1:
            raise _unreadable(value)
        name = value.func.__name__
        return self._names[name] if name in self._names else coordinate(name)

    def _derivative(self, value: Any) -> Expr:
        inner, *variables = value.args
        if [variable.name for variable, _ in variables] != ["t"]:
            raise _unreadable(value)
        return _rate(self.read(inner), int(variables[0][1]))


def _rate(quantity: Expr, order: int) -> Expr:
    for _ in range(order):
        quantity = quantity.dt()
    return quantity


_FUNCTIONS: dict[str, Callable[[Expr], Expr]] = {
    "sin": functions.sin,
    "cos": functions.cos,
    "tan": functions.tan,
    "cot": lambda x: functions.cos(x) / functions.sin(x),
    "sec": lambda x: 1 / functions.cos(x),
    "csc": lambda x: 1 / functions.sin(x),
    "exp": functions.exp,
    "sinh": functions.sinh,
    "cosh": functions.cosh,
    "tanh": functions.tanh,
    "sech": functions.sech,
    "Abs": absolute,
    "sqrt": sqrt,
}


def _unreadable(value: Any) -> NumericError:
    return NumericError(
        f"the SymPy object {value} of type {type(value).__name__}",
        expected="numbers, symbols, sums, products, half-integer powers and elementary functions",
        advice="evaluate or substitute it beforehand",
    )

"""Values given for exact analysis: expressions, numbers, and text or pairs with a unit."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Any

from polhode.algebra import Expr, ExprLike, Symbol, as_symbol, pi
from polhode.base import (
    PURE,
    TIME,
    Dimension,
    Quantity,
    UnitError,
    Value,
    look_up,
    read_quantity,
    read_unit,
    to_si,
)
from polhode.derive import Equations

#: What may stand for a value: also text such as "70 deg" and pairs such as (12, "mm").
Given = ExprLike | Value

#: Angles in these fractions of π have sines that are square roots; others are kept as decimals.
_EXACT_FRACTION = 12


def values_given(equations: Equations, at: Mapping[Any, Given] | None) -> dict[Symbol, Expr]:
    """Exact values of coordinates, their rates, speeds and parameters, by symbol.

    Args:
        equations: of the system they belong to.
        at: values by published name or by symbol.

    Raises:
        DeclarationError: for a name the system does not have.
        UnitError: for a value that cannot be read or has the wrong dimension.
    """
    rates = (q.derivative() for q in equations.coordinates)
    everything = (*equations.coordinates, *rates, *equations.speeds, *equations.parameters)
    what = f"quantity of {equations.system.name}"
    named = _by_symbol(at or {}, everything, what)
    return {s: exact_value(value, s, equations.dimensions) for s, value in named.items()}


def images_given(expression: Expr, about: Mapping[Any, Given] | None) -> dict[Symbol, Expr]:
    """The same for the symbols of an expression, of whose dimensions nothing is known."""
    named = _by_symbol(about or {}, expression.symbols(), "symbol of the expression")
    return {s: exact_value(value, s, {}) for s, value in named.items()}


def _by_symbol(given: Mapping[Any, Given], known: Iterable[Symbol], what: str) -> dict[Symbol, Any]:
    names = {s.published: s for s in known}
    return {
        look_up(key, names, what) if isinstance(key, str) else as_symbol(key): value
        for key, value in given.items()
    }


def exact_value(value: Given, symbol: Symbol, dimensions: Mapping[Symbol, Dimension]) -> Expr:
    """One value as an expression; text is the decimal it spells, but for angles.

    An angle is exact where its sine is a square root, in multiples of 15 degrees; any other is the
    decimal that it prints as in radians.

    Raises `UnitError` for a value that cannot be read or has the wrong dimension.
    """
    if isinstance(value, Expr):
        return value
    exact = measured(value, symbol, dimensions)
    return Expr.of(value) if exact is None else _workable(exact)


def measured(value: Any, symbol: Symbol, dimensions: Mapping[Symbol, Dimension]) -> Quantity | None:
    """What text or a pair with a unit says exactly; None for anything else.

    Raises `UnitError` for what cannot be read or has the wrong dimension.
    """
    stated = _stated(value)
    if stated is None:
        return None
    base = dimensions.get(symbol.base())
    wanted = stated.dimension or PURE if base is None else base / TIME**symbol.order
    to_si(value, wanted, symbol.published)
    return stated


def _stated(value: Any) -> Quantity | None:
    match value:
        case str():
            return read_quantity(value)
        case (magnitude, str(unit)):
            scale = read_unit(unit)
            number = Expr.of(magnitude).rational
            if number is None:
                raise UnitError(f"{value!r} is not a value", expected="a number and its unit")
            return Quantity(number * scale.coefficient, scale.pi_power, scale.dimension)
    return None


def _workable(quantity: Quantity) -> Expr:
    is_turn = quantity.pi_power == 1 and quantity.dimension in (PURE, None)
    if is_turn and _EXACT_FRACTION % quantity.coefficient.denominator:
        return Expr.of(Fraction(repr(quantity.value)))
    return Expr.of(quantity.coefficient) * pi**quantity.pi_power

"""Values exactly as they were given, so that they can be rounded to any precision."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from polhode.algebra import Arithmetic, Expr, Symbol, compile_program, pi
from polhode.base import Quantity, read_quantity, read_unit
from polhode.simulate._names import Name, by_name, published
from polhode.simulate.integrate._number_types import fraction_of, ratio


def exact_values(
    given: Mapping[Name, Any], symbols: Iterable[Symbol], known: Mapping[Symbol, Expr]
) -> dict[Symbol, Expr]:
    """Constant expressions for values that have already been read as doubles, and checked.

    Text is the decimal it spells, a float its binary value.

    Args:
        given: numbers, texts with a unit, or expressions of `known` symbols.
        symbols: what may be given.
        known: their values.
    """
    names = by_name(symbols)
    return {names[published(n)]: exact_value(value, known) for n, value in given.items()}


def exact_value(value: Any, known: Mapping[Symbol, Expr]) -> Expr:
    """A value in SI units as a constant expression."""
    match value:
        case Expr():
            return value.subs(dict(known))
        case str():
            return _of_quantity(read_quantity(value))
        case (magnitude, str(unit)):
            scale = read_unit(unit)
            number = Expr.constant(fraction_of(magnitude) * scale.coefficient)
            return number * pi**scale.pi_power
        case _:
            return Expr.constant(fraction_of(value))


def evaluated(expressions: Sequence[Expr], values: Mapping[Symbol, Any], context: Any) -> list[Any]:
    """Expressions of symbols with a value, in the numbers of an mpmath context."""
    return list(compile_program(expressions, tuple(values)).function(on(context))(*values.values()))


def on(context: Any) -> Arithmetic:
    """The arithmetic of an mpmath context, one value at a time."""
    return Arithmetic.of(context, lambda number: ratio(context, number))


def _of_quantity(quantity: Quantity) -> Expr:
    return Expr.constant(quantity.coefficient) * pi**quantity.pi_power

"""Values as people type them: numbers with a unit, or exact expressions of other quantities."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TypeVar

from polhode.algebra import (
    FLOATS,
    Expr,
    Symbol,
    compile_program,
    dimension_of,
    pi,
    read_expression,
)
from polhode.base import (
    PURE,
    Dimension,
    ParseError,
    UnitError,
    read_quantity,
    to_si,
)

Refused = TypeVar("Refused", ParseError, UnitError)

_NUMBER_THEN_UNIT = re.compile(
    r"""\s*[+\-−]?\s*(?:
        (?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?\s*[^\W\d_]
      | (?:nan|inf|infinity)\s*$
      | .*°
    )""",
    re.VERBOSE | re.IGNORECASE,
)


def read_value(name: str, text: str, symbols: Mapping[str, Symbol]) -> Expr | str:
    """An exact expression, or the text of a number with its unit as it came.

    A unit follows its number directly, as in ``0.2m``; after ``*`` or ``/`` the names of `symbols`
    come first, so that ``2*m`` is twice the mass m.

    Raises:
        ParseError: for text that is neither; UnitError for a unit that is not known.
    """
    if _NUMBER_THEN_UNIT.match(text):
        return _checked(name, text)
    names = {known: Expr.generator(symbol) for known, symbol in symbols.items()}
    try:
        return read_expression(text, names)
    except ParseError as unread:
        try:
            return _checked(name, text)
        except UnitError:
            raise _about(name, unread) from unread


def in_si(
    name: str,
    value: Expr | str,
    dimension: Dimension | None,
    dimensions: Mapping[Symbol, Dimension],
    known: Mapping[Symbol, float],
) -> float:
    """A value that was read, in SI units.

    Args:
        name: what it is the value of, for messages.
        value: from `read_value`.
        dimension: what it must be; None takes it at its word.
        dimensions: of the quantities that expressions may hold.
        known: their values, SI.

    Raises:
        UnitError: for another dimension, or a value that is not finite.
    """
    if isinstance(value, str):
        stated = read_quantity(value).dimension or PURE
        return to_si(value, stated if dimension is None else dimension, name)
    try:
        found = dimension_of(value, dimensions)
    except UnitError as error:
        raise _about(name, error) from error
    if dimension is not None and found not in (None, dimension):
        raise UnitError(
            f"{name} = {value} is in {found}",
            expected=f"an expression in {dimension}",
            advice=f"check the formula for {name}",
        )
    return to_si(_evaluated(name, value, known), PURE, name)


def _checked(name: str, text: str) -> str:
    try:
        read_quantity(text)
    except UnitError as error:
        raise _about(name, error) from error
    return text


def _evaluated(name: str, value: Expr, known: Mapping[Symbol, float]) -> float:
    symbols = tuple(value.symbols() - pi.symbols())
    try:
        program = compile_program([value], symbols).function(FLOATS)
        return float(program(*(known[symbol] for symbol in symbols))[0])
    except (ArithmeticError, ValueError) as error:
        raise UnitError(
            f"{name} = {value} has no finite value", expected="a formula that can be evaluated"
        ) from error


def _about(name: str, error: Refused) -> Refused:
    return type(error)(f"{name}: {error.given}", expected=error.expected, advice=error.advice)

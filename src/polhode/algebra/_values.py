"""The one reader of values: numbers, text with a unit, and formulas, read once to exact numbers.

They are rounded to doubles only where an integrator starts; higher precisions are computed from
the same exact numbers.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from math import isfinite
from types import MappingProxyType
from typing import Any, TypeVar

from polhode.algebra._expression import Expr
from polhode.algebra._functions import pi
from polhode.algebra._homogeneity import dimension_of
from polhode.algebra._reading import read_expression
from polhode.algebra._ring import Symbol
from polhode.algebra.programs._compile import compile_program
from polhode.algebra.programs._program import FLOATS, Compiled
from polhode.base import (
    Dimension,
    ParseError,
    Quantity,
    UnitError,
    check_dimension,
    quantity_of,
    read_quantity,
    read_unit,
)

Refusal = TypeVar("Refusal", ParseError, UnitError)

_NONE: Mapping[Symbol, Any] = MappingProxyType({})

_NUMBER_THEN_UNIT = re.compile(
    r"""\s*[+\-−]?\s*(?:
        (?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?\s*[^\W\d_]
      | (?:nan|inf|infinity)\s*$
      | .*°
    )""",
    re.VERBOSE | re.IGNORECASE,
)


@dataclass(frozen=True, slots=True)
class GivenValue:
    """The value that was given for a quantity, exactly, in SI units.

    Attributes:
        name: of the quantity, for messages.
        given: the value as it was written.
        number: a number with the dimension of its unit, or an expression of other quantities.
        double: the number in double precision; None for an expression. The power of π and its
            coefficient are rounded separately, so the last digit can differ from that of `exact`.
    """

    name: str
    given: Any
    number: Quantity | Expr
    double: float | None = None

    @property
    def symbols(self) -> frozenset[Symbol]:
        """The quantities that occur in it, if it is an expression."""
        return (
            self.number.symbols() - pi.symbols() if isinstance(self.number, Expr) else frozenset()
        )

    def in_dimension(
        self, dimension: Dimension | None, dimensions: Mapping[Symbol, Dimension] | None = None
    ) -> GivenValue:
        """The same value, after a check of its dimension.

        Args:
            dimension: the one it must have; any if None.
            dimensions: of the quantities in an expression, which is not checked without them.

        Raises:
            UnitError: for another dimension.
        """
        if isinstance(self.number, Quantity):
            if dimension is not None:
                check_dimension(self.number, dimension, self.name, self.given)
            return self
        if dimensions is None:
            return self
        try:
            found = dimension_of(self.number, dimensions)
        except UnitError as error:
            raise _about(self.name, error) from error
        if dimension is not None and found not in (None, dimension):
            raise UnitError(
                f"{self.name} = {self.number} is in {found}",
                expected=f"an expression in {dimension}",
                advice=f"check the formula for {self.name}",
            )
        return self

    def rounded(self, known: Mapping[Symbol, float] = _NONE) -> float:
        """The value in double precision.

        An expression is evaluated in doubles from the rounded values of its quantities, so the
        last digit can differ from that of the exact value.

        Raises:
            DeclarationError: for an expression of quantities that are not `known`.
            UnitError: for an expression without a finite value.
        """
        if self.double is not None:
            return self.double
        assert isinstance(self.number, Expr)
        used = tuple(sorted(self.symbols & known.keys(), key=lambda symbol: symbol.published))
        try:
            (value,) = _function(self.number, used)(*(known[symbol] for symbol in used))
        except (ArithmeticError, ValueError):
            value = float("nan")
        if not isfinite(value):
            raise UnitError(
                f"{self.name} = {self.number} has no finite value",
                expected="a formula that can be evaluated",
            )
        return float(value)

    def exact(self, known: Mapping[Symbol, Expr] = _NONE) -> Expr:
        """The exact value, with the exact values of the quantities in it substituted."""
        if isinstance(self.number, Expr):
            return self.number.subs(dict(known))
        return Expr.constant(self.number.coefficient) * pi**self.number.pi_power


def read_value(name: str, value: Any, names: Mapping[str, Symbol] | None = None) -> GivenValue:
    """Read the value of a quantity; a `GivenValue` is returned unchanged.

    Numbers are SI; text is the decimal that it spells, a float its binary value.

    Args:
        name: of the quantity, for messages.
        value: a number, text with a unit, a magnitude with its unit, a pint quantity, or an
            expression.
        names: of quantities that text may be a formula of; without it text is a number. A unit
            follows its number directly, as in ``0.2m``; after ``*`` or ``/`` these names come
            first, so that ``2*m`` is twice the mass m.

    Raises:
        ParseError: for text that is neither a formula nor a number with a unit.
        UnitError: for a value that cannot be read or is not finite.
    """
    if isinstance(value, GivenValue):
        return value
    if isinstance(value, Expr):
        return GivenValue(name, value, value)
    if isinstance(value, str) and names is not None and not _NUMBER_THEN_UNIT.match(value):
        return GivenValue(
            name,
            value,
            number := _formula(name, value, names),
            number.value if isinstance(number, Quantity) else None,
        )
    quantity = quantity_of(value, name)
    return GivenValue(name, value, _unrounded(quantity, value), quantity.value)


def _formula(name: str, text: str, names: Mapping[str, Symbol]) -> Quantity | Expr:
    """What a text spells: a formula, or else a number with a unit, such as ``2*kg``."""
    try:
        return read_expression(text, {n: Expr.generator(symbol) for n, symbol in names.items()})
    except ParseError as unread:
        try:
            return read_quantity(text)
        except UnitError:
            raise _about(name, unread) from unread


def _unrounded(quantity: Quantity, value: Any) -> Quantity:
    """A quantity with its magnitude exact where that is not a double, such as a third.

    Its `double` remains that of the rounded magnitude in its unit.
    """
    match value:
        case (magnitude, str(unit)) if Fraction(float(magnitude)) != fraction_of(magnitude):
            exact = fraction_of(magnitude) * read_unit(unit).coefficient
            return replace(quantity, coefficient=exact)
        case str() | float():
            return quantity
        case _ if quantity.dimension is None:
            return replace(quantity, coefficient=fraction_of(value))
    return quantity


@lru_cache(maxsize=256)
def _function(expression: Expr, symbols: tuple[Symbol, ...]) -> Compiled:
    return compile_program([expression], symbols).function(FLOATS)


def fraction_of(value: Any) -> Fraction:
    """A finite number of any type as an exact fraction."""
    if hasattr(value, "_mpf_"):  # mpmath: sign, mantissa, exponent of two, bits of the mantissa
        sign, mantissa, exponent, _ = value._mpf_
        size = Fraction(int(mantissa)) * Fraction(2) ** int(exponent)
        return -size if sign else size
    if hasattr(value, "as_integer_ratio"):
        return Fraction(*(int(part) for part in value.as_integer_ratio()))
    return Fraction(int(value)) if hasattr(value, "__index__") else Fraction(float(value))


def _about(name: str, error: Refusal) -> Refusal:
    return type(error)(f"{name}: {error.given}", expected=error.expected, advice=error.advice)

"""Values as people write them, read to SI: ``"80 deg"``, ``0.2``, ``(12, "mm")``."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Protocol, SupportsFloat, TypeAlias, runtime_checkable

from polhode.base._errors import UnitError
from polhode.base._units import PURE, Dimension, Unit, read_unit


@runtime_checkable
class PintQuantity(Protocol):
    """The part of a pint quantity that is used, so that pint need not be imported."""

    @property
    def magnitude(self) -> Any: ...
    @property
    def dimensionality(self) -> Mapping[str, Any]: ...
    def to(self, other: str, /) -> Any: ...


Value: TypeAlias = SupportsFloat | str | tuple[SupportsFloat, str] | PintQuantity
"""A bare SI number, text such as ``"80 deg"``, a magnitude with its unit, or a pint quantity."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """An exact value in SI units, ``coefficient * pi**pi_power``.

    `dimension` is None where no unit was written: a bare number is in the SI unit of its quantity.
    π is kept as a power, so that 80 deg is exact.
    """

    coefficient: Fraction
    pi_power: int
    dimension: Dimension | None

    @property
    def value(self) -> float:
        """The value in SI units, to double precision."""
        return float(self.coefficient) * math.pi**self.pi_power


def read_quantity(text: str) -> Quantity:
    """Read a number, perhaps with a unit: ``80deg``, ``-0.2 m``, ``pi/2``, ``3000 rpm``.

    Decimals are taken as the exact fraction they spell, so ``80deg`` is 4 pi/9.

    Raises:
        UnitError: if the text is not a finite number with a known unit.
    """
    match = _NUMBER.match(text)
    assert match is not None  # every part of the pattern is optional
    if match.end() > _LONGEST:
        raise UnitError(
            f"a number of {match.end()} characters", expected=f"one of at most {_LONGEST}"
        )
    divisor = Fraction(match["divisor"] or 1)
    if not (match["factor"] or match["pi"]) or divisor == 0:
        raise _unreadable(match.string)
    number = Fraction(match["factor"] or 1) / divisor
    if match["sign"] in ("-", "−"):
        number = -number
    unit_text = text[match.end() :].strip()
    unit = read_unit(unit_text.removeprefix("*")) if unit_text else Unit()
    quantity = Quantity(
        number * unit.coefficient,
        unit.pi_power + bool(match["pi"]),
        unit.dimension if unit_text else None,
    )
    return _finite(quantity, text)


def to_si(value: Value, dimension: Dimension, name: str) -> float:
    """The value of the quantity `name` in the SI unit of `dimension`.

    Args:
        value: a number (taken as SI), text with a unit, a magnitude and its unit, or a pint
            quantity.
        dimension: what the quantity must be; an angle is `PURE`.
        name: of the quantity, for messages.

    Raises:
        UnitError: if the value cannot be read, is not finite or has another dimension.
    """
    quantity = quantity_of(value, name)
    check_dimension(quantity, dimension, name, value)
    return quantity.value


def quantity_of(value: Value, name: str) -> Quantity:
    """The value of the quantity `name`, with the dimension of its unit.

    A magnitude that is not text is rounded to a double first, then its unit is applied.

    Raises:
        UnitError: if the value cannot be read or is not finite.
    """
    try:
        return _quantity(value)
    except UnitError as error:
        raise UnitError(
            f"{name}: {error.given}", expected=error.expected, advice=error.advice
        ) from error


def check_dimension(quantity: Quantity, dimension: Dimension, name: str, given: object) -> None:
    """Check that a quantity, written as `given`, has this dimension; bare numbers pass.

    Raises:
        UnitError: if it has another one.
    """
    if quantity.dimension not in (None, dimension):
        raise UnitError(
            f"{name} = {_shown(given)} is {_described(quantity.dimension)}",
            expected=_described(dimension),
            advice=f"give {name} as a bare SI number or in a unit of that dimension",
        )


_LONGEST = 2000  # characters; Python itself reads no more than 4300 digits
_DECIMAL = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3}(?![0-9]))?"
_NUMBER = re.compile(
    rf"""\s*(?P<sign>[+\-−]?)\s*
    (?P<factor>{_DECIMAL})?
    (?P<pi>\s*\*?\s*(?:pi(?![A-Za-z])|π))?
    (?:\s*/\s*(?P<divisor>{_DECIMAL}))?""",
    re.VERBOSE,
)


def _quantity(value: Value) -> Quantity:
    match value:
        case str():
            return read_quantity(value)
        case (magnitude, str(unit_text)):
            number, unit = _exact(magnitude), read_unit(unit_text)
            quantity = Quantity(number * unit.coefficient, unit.pi_power, unit.dimension)
            return _finite(quantity, value)
        case PintQuantity():
            return _from_pint(value)
        case _:
            return Quantity(_exact(value), 0, None)


def _exact(number: Any) -> Fraction:
    try:
        size = float(number)
    except OverflowError:
        size = math.inf
    except (TypeError, ValueError) as error:
        raise _unreadable(number) from error
    if not math.isfinite(size):
        raise _unreadable(size)
    return Fraction(size)


_PINT_BASES = {"[mass]": "kilogram", "[length]": "meter", "[time]": "second"}


def _from_pint(value: PintQuantity) -> Quantity:
    powers = {base: Fraction(power) for base, power in value.dimensionality.items()}
    if not powers.keys() <= _PINT_BASES.keys():
        raise UnitError(
            f"{value} has a dimension other than mass, length and time",
            expected="a mechanical quantity",
        )
    dimension = Dimension(*(powers.get(base, Fraction(0)) for base in _PINT_BASES))
    unit = " * ".join(f"{_PINT_BASES[base]}**({power})" for base, power in powers.items())
    return Quantity(_exact(value.to(unit).magnitude), 0, dimension)


def _finite(quantity: Quantity, given: object) -> Quantity:
    try:
        finite = math.isfinite(quantity.value)
    except OverflowError:
        finite = False
    if not finite:
        raise _unreadable(given)
    return quantity


def _unreadable(given: object) -> UnitError:
    return UnitError(
        f"{_shown(given)} is not a value",
        expected="a finite number, perhaps with a unit",
        advice="write it as 0.2, '12 mm', '80 deg' or '3000 rpm'",
    )


def _shown(given: object) -> str:
    text = repr(given) if isinstance(given, str | tuple) else str(given)
    return text if len(text) <= 80 else f"{text[:77]}..."


def _described(dimension: Dimension | None) -> str:
    return "a pure number or an angle" if dimension == PURE else f"a quantity in {dimension}"

"""Sliders: the quantity, unit and range of each."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from polhode.algebra import Expr, Symbol
from polhode.base import LENGTH, MASS, PURE, TIME, Dimension, read_quantity
from polhode.derive import Equations

_PLAIN = re.compile(r"\s*([+\-−]?[0-9]*\.?[0-9]+(?:[eE][+-]?[0-9]+)?)\s*([^\d\s*/(+\-][^*(+]*)?")
_DECADE = 10.0  # a slider of a positive parameter spans a decade to either side
_SIGNED = (PURE, PURE / TIME)  # may be negative, unless the symbol is assumed positive
_ANGLES = {"deg": (180.0, 10.0), "rad": (3.0, 0.2)}  # range, and the size of a small one
_USUAL: Mapping[Dimension, float] = {  # typical size in SI units, where no default is declared
    PURE: 1.0,
    LENGTH: 0.2,
    MASS: 1.0,
    LENGTH / TIME: 0.5,
    PURE / TIME: 10.0,
    LENGTH / TIME**2: 9.81,
    MASS * LENGTH**2: 1e-3,
}
_UNITS: Mapping[Dimension, str] = {
    PURE: "",
    LENGTH: "m",
    MASS: "kg",
    LENGTH / TIME: "m/s",
    PURE / TIME: "rad/s",
    LENGTH / TIME**2: "m/s^2",
    MASS * LENGTH**2: "kg m^2",
}


@dataclass(frozen=True)
class Control:
    """A slider with its field.

    Attributes:
        name: published name.
        symbol: MathML.
        meaning: in words.
        text: the default value, as a user would type it.
        value: the same in `unit`.
        unit: of the slider.
        size: of that unit, in SI units.
        si: the SI unit, in which formulas are evaluated.
        low: left end of the slider.
        high: right end.
        ratio: whether the scale is logarithmic.
        extra: whether it is rarely needed, and therefore hidden at first.
    """

    name: str
    symbol: str
    meaning: str
    text: str
    value: float
    unit: str
    size: float
    si: str
    low: float
    high: float
    ratio: bool
    extra: bool


def is_plain(text: str) -> bool:
    """Whether a value is a number, with or without a unit, rather than a formula."""
    return _PLAIN.fullmatch(text) is not None


def unit_in(text: str) -> str:
    """The unit that a number was written with; empty if it has none."""
    plain = _PLAIN.fullmatch(text)
    return (plain[2] or "").strip() if plain else ""


def may_be_negative(dimension: Dimension) -> bool:
    """Whether parameters of a dimension have a sign, unless they are assumed positive."""
    return dimension in _SIGNED


def usual_size(dimension: Dimension) -> float:
    """A typical size of quantities of a dimension, in its SI unit."""
    return _USUAL.get(dimension, 1.0)


def plain_unit(dimension: Dimension) -> str:
    """The SI unit of a dimension as it is typed."""
    return _UNITS.get(dimension, dimension.unit)


def state_unit(symbol: Symbol, equations: Equations) -> str:
    """The SI unit of a coordinate, speed or rate; rad/s for a rate of turning."""
    base = equations.dimensions.get(symbol.base(), PURE)
    dimension = base / TIME**symbol.order
    return "rad" if dimension == PURE else plain_unit(dimension)


def control(
    symbol: Symbol, text: str, unit: str, meaning: str, value: float, *, positive: bool
) -> Control:
    """A slider in the unit that the text is in."""
    shown = unit_in(text) or unit
    one = read_quantity(f"1 {shown}") if shown else read_quantity("1")
    si = "rad" if shown in _ANGLES else _UNITS.get(one.dimension or PURE, "")
    scaled = float(f"{value / one.value:.12g}")  # without the rounding error of the change of unit
    low, high, ratio = _range(scaled, shown, positive=positive)
    letter = Expr.generator(symbol).mathml()
    return Control(
        name=symbol.published,
        symbol=letter,
        meaning=meaning,
        text=text,
        value=scaled,
        unit=shown,
        size=one.value,
        si=si,
        low=low,
        high=high,
        ratio=ratio,
        extra=False,
    )


def _range(value: float, unit: str, *, positive: bool) -> tuple[float, float, bool]:
    if unit in _ANGLES:
        wide, slight = _ANGLES[unit]
        if 0 < abs(value) <= slight:
            return -3 * slight, 3 * slight, False
        return (0.0 if value > 0 else -wide), wide, False
    if positive and value > 0:
        return value / _DECADE, value * _DECADE, True
    size = 2 * abs(value)
    return -size, size, False


def widened(control: Control, dimension: Dimension, others: Sequence[Control]) -> Control:
    """A slider whose value is zero, given the range of others of the same unit."""
    if control.high > 0:
        return control
    same_unit = [other.high for other in others if other.unit == control.unit]
    size = max(same_unit, default=0.0) or 2 * usual_size(dimension)
    return replace(control, low=-size, high=size)

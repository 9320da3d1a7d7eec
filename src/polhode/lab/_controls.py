"""The sliders of a system: the quantity, unit and range of each."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.base import LENGTH, MASS, PURE, TIME, Dimension, read_quantity
from polhode.catalogue import CatalogueEntry, numbers_of
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


def unit_of(symbol: Symbol, equations: Equations) -> str:
    """The SI unit of a coordinate, speed or rate; rad/s for a rate of turning."""
    base = equations.dimensions.get(symbol.base(), PURE)
    dimension = base / TIME**symbol.order
    return "rad" if dimension == PURE else _UNITS.get(dimension, dimension.unit)


def with_usual_numbers(entry: CatalogueEntry, equations: Equations) -> CatalogueEntry:
    """An entry with default numbers of the right dimension where it has none."""
    usual = {
        s.published: _USUAL.get(d, 1.0)
        for s, d in _with_dimensions(equations, equations.parameters)
    }
    parameters = (
        p if p.default else replace(p, default=f"{usual[p.name]:g} {p.unit}".strip())
        for p in entry.all_parameters(equations)
    )
    start = dict(entry.start) or {
        s.published: "1 rad" for s in equations.coordinates if equations.dimensions.get(s) == PURE
    }
    forcing = {s.published: "0" for s in equations.functions} | dict(entry.forcing)
    return replace(
        entry,
        parameters=tuple(parameters),
        values={},
        start=start,
        forcing=forcing,
        duration=entry.duration or "10 s",
    )


def parameters_of(entry: CatalogueEntry, equations: Equations) -> list[Control]:
    """Sliders of the parameters, in the order of the entry."""
    values = numbers_of(entry, equations).parameters
    signed = {s for s, d in _with_dimensions(equations, equations.parameters) if d in _SIGNED}
    positive = {p.name for p in entry.parameters} - {s.published for s in signed if not s.positive}
    found: list[Control] = []
    for p in entry.parameters:
        value = values.get(p.name)
        if value is None and _PLAIN.fullmatch(p.default):  # in no equation
            value = read_quantity(p.default).value
        if value is not None:
            symbol = Symbol(p.name.rstrip("_"))
            is_positive = p.name in positive
            made = _control(symbol, p.default, p.unit, p.meaning, value, positive=is_positive)
            found.append(replace(made, name=p.name))
    return found


def start_of(entry: CatalogueEntry, equations: Equations) -> list[Control]:
    """Sliders of coordinates and speeds at the start, those of the usual start first."""
    values = numbers_of(entry, equations).start
    found: list[Control] = []
    states = (*equations.coordinates, *equations.speeds)
    for symbol, dimension in _with_dimensions(equations, states):
        name = symbol.published
        text = entry.start.get(name, "0")
        unit = _UNITS.get(dimension, dimension.unit)
        if dimension == PURE and "deg" not in text:
            unit = "rad" if name in entry.start else "deg"
        made = _control(symbol, text, unit, "", values.get(name, 0.0), positive=False)
        is_extra = (
            name not in entry.start and symbol.kind is SymbolKind.COORDINATE and not symbol.order
        )
        found.append(replace(_widened(made, dimension, found), extra=is_extra))
    return sorted(found, key=lambda control: control.name not in entry.start)


def _with_dimensions(
    equations: Equations, symbols: tuple[Symbol, ...]
) -> Iterator[tuple[Symbol, Dimension]]:
    for symbol in symbols:
        base = equations.dimensions.get(symbol.base(), PURE)
        yield symbol, base / TIME**symbol.order


def _control(
    symbol: Symbol, text: str, unit: str, meaning: str, value: float, *, positive: bool
) -> Control:
    """A slider in the unit that the text is in."""
    plain = _PLAIN.fullmatch(text)
    shown = (plain[2] or unit).strip() if plain else unit
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


def _widened(control: Control, dimension: Dimension, others: list[Control]) -> Control:
    """A slider whose value is zero, given the range of others of the same unit."""
    if control.high > 0:
        return control
    same_unit = [other.high for other in others if other.unit == control.unit]
    size = max(same_unit, default=0.0) or 2 * _USUAL.get(dimension, 1.0)
    return replace(control, low=-size, high=size)

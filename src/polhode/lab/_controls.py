"""The sliders of a system: the quantity, unit and range of each."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from polhode.algebra import Symbol, SymbolKind
from polhode.base import PURE, TIME, Dimension, read_quantity
from polhode.catalogue import CatalogueEntry, numbers_of
from polhode.derive import Equations
from polhode.view import (
    Control,
    control,
    is_plain,
    may_be_negative,
    plain_unit,
    usual_size,
    widened,
)


def with_usual_numbers(entry: CatalogueEntry, equations: Equations) -> CatalogueEntry:
    """An entry with default numbers of the right dimension where it has none."""
    usual = {
        s.published: usual_size(d) for s, d in _with_dimensions(equations, equations.parameters)
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
    signed = {s for s, d in _with_dimensions(equations, equations.parameters) if may_be_negative(d)}
    positive = {p.name for p in entry.parameters} - {s.published for s in signed if not s.positive}
    found: list[Control] = []
    for p in entry.parameters:
        value = values.get(p.name)
        if value is None and is_plain(p.default):  # in no equation
            value = read_quantity(p.default).value
        if value is not None:
            symbol = Symbol(p.name.rstrip("_"))
            is_positive = p.name in positive
            made = control(symbol, p.default, p.unit, p.meaning, value, positive=is_positive)
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
        unit = plain_unit(dimension)
        if dimension == PURE and "deg" not in text:
            unit = "rad" if name in entry.start else "deg"
        made = control(symbol, text, unit, "", values.get(name, 0.0), positive=False)
        is_extra = (
            name not in entry.start and symbol.kind is SymbolKind.COORDINATE and not symbol.order
        )
        found.append(replace(widened(made, dimension, found), extra=is_extra))
    return sorted(found, key=lambda control: control.name not in entry.start)


def _with_dimensions(
    equations: Equations, symbols: tuple[Symbol, ...]
) -> Iterator[tuple[Symbol, Dimension]]:
    for symbol in symbols:
        base = equations.dimensions.get(symbol.base(), PURE)
        yield symbol, base / TIME**symbol.order

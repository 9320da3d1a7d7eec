"""The numbers of one run: catalogue values, what was asked for instead, and what follows."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from graphlib import CycleError, TopologicalSorter
from types import MappingProxyType
from typing import Any

from polhode.algebra import Expr, Symbol, SymbolKind, dimension_of, pi
from polhode.base import (
    PURE,
    TIME,
    DeclarationError,
    Dimension,
    UnitError,
    look_up,
    read_quantity,
    read_unit,
)
from polhode.catalogue._entry import CatalogueEntry
from polhode.catalogue._values import in_si, read_value
from polhode.derive import Equations

_NOTHING: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True)
class RunNumbers:
    """What `simulate` is given, by published name and in SI units.

    Attributes:
        parameters: those that the motion or the bodies depend on.
        forcing: prescribed functions, as expressions of time and parameters.
        start: coordinates and speeds that were chosen; the rest is assumed.
        duration: s.
    """

    parameters: Mapping[Any, Any]
    forcing: Mapping[Any, Expr]
    start: Mapping[Any, Any]
    duration: Any


def numbers_of(
    entry: CatalogueEntry,
    equations: Equations,
    settings: Mapping[str, str] = _NOTHING,
    start: Mapping[str, str] = _NOTHING,
    duration: str = "",
    flight: Equations | None = None,
) -> RunNumbers:
    """The numbers of a run.

    Values are numbers with a unit or exact expressions of parameters: a default such as
    ``m*a**2/2`` follows the m that was set. A start that is given is given for all speeds: those
    it does not name are at rest. Coordinates it does not name keep their catalogue value.

    Args:
        entry: the system, with its defaults.
        equations: derived from it.
        settings: parameters and prescribed functions in place of the defaults.
        start: coordinates and speeds in place of the defaults.
        duration: in place of the default.
        flight: equations of the mode in which nothing touches: a start may name heights of theirs.

    Raises:
        DeclarationError: for a name the system does not have, and for values that are missing or
            depend on themselves.
        ParseError: for text that is no value.
        UnitError: for a value of the wrong dimension, or without a finite one.
    """
    constants = _constants(entry, equations)
    functions = {symbol.published: symbol for symbol in equations.functions}
    for name in settings:
        look_up(name, constants | functions, f"parameter of {entry.name}")
    dimensions = _dimensions(entry, equations, constants)
    chosen = {**_defaults(entry), **settings}
    values = _resolved({n: chosen[n] for n in constants if n in chosen}, constants, dimensions)
    missing = [symbol.published for symbol in equations.parameters if symbol not in values]
    missing += [name for name in functions if name not in chosen]
    if missing:
        raise _missing(missing)
    forcing = {name: _forced(name, chosen[name], constants) for name in functions}
    wanted = _wanted(equations, forcing.values())
    return RunNumbers(
        parameters={s.published: value for s, value in values.items() if s in wanted},
        forcing=forcing,
        start=_start(
            (equations, flight or equations),
            _asked(entry, equations, start),
            constants,
            dimensions,
            values,
        ),
        duration=_duration(duration or entry.duration),
    )


def exactly(
    entry: CatalogueEntry,
    equations: Equations,
    numbers: RunNumbers,
    settings: Mapping[str, str] = _NOTHING,
    start: Mapping[str, str] = _NOTHING,
    duration: str = "",
) -> RunNumbers:
    """The same numbers as constant expressions, each the decimal that was written.

    Args:
        numbers: from `numbers_of`, which has checked them.
        entry, equations, settings, start, duration: what it was given.
    """
    constants = _constants(entry, equations)
    chosen = {**_defaults(entry), **settings}
    read = {n: read_value(n, chosen[n], constants) for n in constants if n in chosen}
    values: dict[Any, Expr] = {}
    for name in _in_order(read):
        values[constants[name]] = _constant(read[name], values)
    asked = _asked(entry, equations, start)
    texts = {name: read_value(name, text, constants) for name, text in asked.items()}
    wanted = read_value("duration", duration or entry.duration, {})
    return replace(
        numbers,
        parameters={name: values[constants[name]] for name in numbers.parameters},
        start={name: _constant(text, values) for name, text in texts.items()},
        duration=_constant(wanted, {}),
    )


def _constant(value: Expr | str, known: Mapping[Any, Expr]) -> Expr:
    if isinstance(value, Expr):
        return value.subs(dict(known))
    quantity = read_quantity(value)
    return Expr.of(quantity.coefficient) * pi**quantity.pi_power


def _constants(entry: CatalogueEntry, equations: Equations) -> dict[str, Symbol]:
    """All that has a value, also what only other values are made of."""
    named = {p.name: Symbol(p.name) for p in entry.parameters}
    return named | {symbol.published: symbol for symbol in equations.parameters}


def _defaults(entry: CatalogueEntry) -> dict[str, str]:
    return {p.name: p.default for p in entry.parameters} | dict(entry.forcing)


def _dimensions(
    entry: CatalogueEntry, equations: Equations, constants: Mapping[str, Symbol]
) -> dict[Symbol, Dimension]:
    stated = {
        constants[p.name]: read_unit(p.unit).dimension if p.unit else PURE for p in entry.parameters
    }
    return {**equations.dimensions, **stated}


def _resolved(
    texts: Mapping[str, str],
    constants: Mapping[str, Symbol],
    dimensions: Mapping[Symbol, Dimension],
) -> dict[Symbol, float]:
    """Values of parameters, each after those that it is an expression of."""
    read = {name: read_value(name, text, constants) for name, text in texts.items()}
    values: dict[Symbol, float] = {}
    for name in _in_order(read):
        _refuse_unvalued(name, read[name], values)
        symbol = constants[name]
        values[symbol] = in_si(name, read[name], dimensions.get(symbol), dimensions, values)
    return {constants[name]: values[constants[name]] for name in texts}


def _in_order(read: Mapping[str, Expr | str]) -> list[str]:
    needs = {name: {symbol.published for symbol in _used(value)} for name, value in read.items()}
    try:
        order = list(TopologicalSorter(needs).static_order())
    except CycleError as error:
        circle = " needs ".join(reversed(error.args[1]))
        raise DeclarationError(
            f"values that depend on one another: {circle}", expected="one of them as a number"
        ) from error
    return [name for name in order if name in read]


def _used(value: Expr | str) -> frozenset[Symbol]:
    return frozenset() if isinstance(value, str) else value.symbols() - {Symbol("pi")}


def _refuse_unvalued(name: str, value: Expr | str, values: Mapping[Symbol, float]) -> None:
    for symbol in _used(value):
        if symbol.kind is SymbolKind.TIME:
            raise DeclarationError(f"{name} = {value} varies", expected="a constant value")
        if symbol not in values:
            raise _missing([symbol.published])


def _forced(name: str, text: str, constants: Mapping[str, Symbol]) -> Expr:
    """A prescribed function of time; its bare numbers are SI."""
    value = read_value(name, text, constants)
    return Expr.of(in_si(name, value, None, {}, {})) if isinstance(value, str) else value


def _wanted(equations: Equations, forcing: Iterable[Expr]) -> set[Symbol]:
    bodies = equations.system.bodies
    parts = [e for b in bodies for e in (b.mass, *sum(b.inertia.rows, ()))]
    return set(equations.parameters).union(*(e.symbols() for e in (*parts, *forcing)))


def _asked(entry: CatalogueEntry, equations: Equations, start: Mapping[str, str]) -> dict[str, str]:
    if not start:
        return dict(entry.start)
    places = {symbol.published for symbol in equations.coordinates}
    return {name: text for name, text in entry.start.items() if name in places} | dict(start)


def _start(
    modes: Sequence[Equations],
    texts: Mapping[str, str],
    constants: Mapping[str, Symbol],
    dimensions: Mapping[Symbol, Dimension],
    values: Mapping[Symbol, float],
) -> dict[str, float]:
    known = {
        s.published: (s, e)
        for e in reversed(modes)
        for s in (*e.coordinates, *e.speeds, *e.kinematics, *e.dependent)
    }
    found = {}
    for name, text in texts.items():
        system = modes[0].system.name
        symbol, equations = look_up(name, known, f"coordinate or speed of {system}")
        value = read_value(name, text, constants)
        _refuse_unvalued(name, value, values)
        dimension = _dimension_of_state(symbol, equations, dimensions)
        found[name] = in_si(name, value, dimension, dimensions, values)
    return found


def _dimension_of_state(
    symbol: Symbol, equations: Equations, dimensions: Mapping[Symbol, Dimension]
) -> Dimension | None:
    stated = {**equations.dimensions, **dimensions}
    if symbol.base() in stated:
        return stated[symbol.base()] / TIME**symbol.order
    meaning = equations.dependent.get(symbol)
    return None if meaning is None else dimension_of(meaning, dimensions)


def _duration(text: str) -> float:
    if not text:
        raise DeclarationError(
            "no duration",
            expected="how long to run",
            advice="give one, such as 10 s",
            option="duration",
        )
    duration = in_si("duration", read_value("duration", text, {}), TIME, {}, {})
    if duration <= 0:
        raise UnitError(f"a duration of {duration:g} s", expected="a positive one")
    return duration


def _missing(names: list[str]) -> DeclarationError:
    return DeclarationError(
        f"no value for {', '.join(names)}",
        expected="a value for every parameter and prescribed function",
        advice=f"give {names[0]} one: a number in SI units or with a unit",
        option="set",
    )

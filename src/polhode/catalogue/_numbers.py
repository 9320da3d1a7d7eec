"""The numbers of one run: values given by the user, and the catalogue's for the rest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from types import MappingProxyType
from typing import Any

from polhode.algebra import Expr, GivenValue, Symbol, SymbolKind, dimension_of, read_value
from polhode.base import PURE, TIME, DeclarationError, Dimension, UnitError, look_up, read_unit
from polhode.catalogue._entry import CatalogueEntry
from polhode.derive import Equations
from polhode.model import declared_parameters

_NOTHING: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True)
class ExactNumbers:
    """Arguments of `simulate` for more than double precision: constant expressions, SI.

    Attributes:
        parameters, start, duration: as in `RunNumbers`, each exactly the decimal that was written.
    """

    parameters: Mapping[Any, Expr]
    start: Mapping[Any, Expr]
    duration: Expr


@dataclass(frozen=True)
class RunNumbers:
    """Arguments of `simulate`, by published name, in SI units and double precision.

    Attributes:
        parameters: those that the motion or the bodies depend on.
        forcing: prescribed functions, as expressions of time and parameters.
        start: coordinates and speeds that were chosen; the rest is assumed.
        duration: s.
        exact: the same numbers exactly.
    """

    parameters: Mapping[Any, Any]
    forcing: Mapping[Any, Expr]
    start: Mapping[Any, Any]
    duration: Any
    exact: ExactNumbers


def exact_values(
    equations: Equations, texts: Mapping[str, str], entry: CatalogueEntry | None = None
) -> dict[Symbol, Expr]:
    """Exact values of coordinates, speeds and parameters, by symbol, from text such as "pi/2".

    Args:
        equations: of the system they belong to.
        texts: expressions of parameters, or numbers with a unit, by published name.
        entry: whose parameters these expressions may contain even if the equations do not, such as
            a radius on which moments of inertia depend.

    Raises:
        DeclarationError: for a name the system does not have.
        ParseError: for text that is not a value; UnitError for one of the wrong dimension.
    """
    further = {name: Symbol(name, positive=True) for name in entry.defaults} if entry else {}
    constants = further | {symbol.published: symbol for symbol in equations.parameters}
    from polhode.analyse import values_given  # deferred: a check loads this module without it

    return values_given(equations, texts, constants)


def numbers_of(
    entry: CatalogueEntry,
    equations: Equations,
    settings: Mapping[str, str] = _NOTHING,
    start: Mapping[str, str] = _NOTHING,
    duration: str = "",
    flight: Equations | None = None,
) -> RunNumbers:
    """The numbers of a run.

    Values are numbers with a unit or expressions of parameters: a default such as ``m*a**2/2``
    follows the m that was set. If any start value is given, speeds that are not named are zero;
    coordinates that are not named keep their catalogue value.

    Args:
        entry: the system, with its defaults.
        equations: derived from it.
        settings: parameters and prescribed functions in place of the defaults.
        start: coordinates and speeds in place of the defaults.
        duration: in place of the default.
        flight: equations of the mode without contact, whose coordinates a start may name too;
            without them an entry that starts in flight has the start that contact leaves of it.

    Raises:
        DeclarationError: for a name the system does not have, and for values that are missing or
            depend on one another in a circle.
        ParseError: for text that is not a value.
        UnitError: for a value of the wrong dimension, or without a finite one.
    """
    named = {name: Symbol(name) for name in entry.defaults}
    # also parameters that occur only in the values of others, such as a radius
    known = (*equations.parameters, *declared_parameters(entry.build()))
    constants = named | {symbol.published: symbol for symbol in known}
    functions = {symbol.published: symbol for symbol in equations.functions}
    states = _states((equations, flight or equations))
    for name in settings:
        if name in states:
            raise DeclarationError(
                f"{name} as a parameter", expected="a start value", option="start"
            )
        look_up(name, constants | functions, f"parameter of {entry.name}")
    stated = {
        constants[p.name]: read_unit(p.unit).dimension if p.unit else PURE for p in entry.parameters
    }
    dimensions = {**equations.dimensions, **stated}
    chosen = {**entry.defaults, **entry.forcing, **settings}
    values = _parameters({n: chosen[n] for n in constants if n in chosen}, constants, dimensions)
    missing = [symbol.published for symbol in equations.parameters if symbol not in values.doubles]
    missing += [name for name in functions if name not in chosen]
    if missing:
        raise _missing(missing)
    forcing = {name: _forced(name, chosen[name], constants) for name in functions}
    needed = {*known}.union(*(value.symbols() for value in forcing.values()))
    used = {s.published: s for s in values.doubles if s in needed}
    texts = _chosen_start(entry, equations, start)
    if flight is None and not states.keys() >= entry.start.keys():
        free = {s.published for s in (*equations.coordinates, *equations.speeds)}
        texts = {name: text for name, text in texts.items() if name in free or name in start}
    initial = _start(entry.name, states, texts, constants, dimensions, values)
    time = _duration(duration or entry.duration)
    return RunNumbers(
        parameters={name: values.doubles[symbol] for name, symbol in used.items()},
        forcing=forcing,
        start={name: value.rounded(values.doubles) for name, value in initial.items()},
        duration=time.rounded(),
        exact=ExactNumbers(
            {name: values.exact[symbol] for name, symbol in used.items()},
            {name: value.exact(values.exact) for name, value in initial.items()},
            time.exact(),
        ),
    )


@dataclass(frozen=True)
class _Parameters:
    """Values by symbol, in double precision and exactly."""

    doubles: Mapping[Symbol, float]
    exact: Mapping[Symbol, Expr]


def _parameters(
    texts: Mapping[str, str],
    constants: Mapping[str, Symbol],
    dimensions: Mapping[Symbol, Dimension],
) -> _Parameters:
    """Values of parameters, evaluated in an order in which each needs only earlier ones."""
    given = {name: read_value(name, text, constants) for name, text in texts.items()}
    doubles, exact = dict[Symbol, float](), dict[Symbol, Expr]()
    needs = {name: {symbol.published for symbol in v.symbols} for name, v in given.items()}
    try:
        order = list(TopologicalSorter(needs).static_order())
    except CycleError as error:
        circle = " needs ".join(reversed(error.args[1]))
        raise DeclarationError(
            f"values that depend on one another: {circle}", expected="a number for one of them"
        ) from error
    for name in (name for name in order if name in given):
        symbol = constants[name]
        _refuse_unvalued(given[name], doubles)
        value = given[name].in_dimension(dimensions.get(symbol), dimensions)
        doubles[symbol], exact[symbol] = value.rounded(doubles), value.exact(exact)
    return _Parameters({constants[name]: doubles[constants[name]] for name in texts}, exact)


def _refuse_unvalued(value: GivenValue, known: Mapping[Symbol, float]) -> None:
    for symbol in value.symbols:
        if symbol.kind is SymbolKind.TIME:
            raise DeclarationError(
                f"{value.name} = {value.number} varies in time", expected="a constant value"
            )
        if symbol not in known:
            raise _missing([symbol.published])


def _forced(name: str, text: str, constants: Mapping[str, Symbol]) -> Expr:
    """A prescribed function of time; its bare numbers are SI."""
    value = read_value(name, text, constants)
    return value.number if isinstance(value.number, Expr) else Expr.of(value.rounded())


def _chosen_start(
    entry: CatalogueEntry, equations: Equations, start: Mapping[str, str]
) -> dict[str, str]:
    if not start:
        return dict(entry.start)
    # Default speeds would contradict a start that the user gives in terms of other speeds.
    coordinates = {symbol.published for symbol in equations.coordinates}
    return {name: text for name, text in entry.start.items() if name in coordinates} | dict(start)


def _states(modes: Sequence[Equations]) -> dict[str, tuple[Symbol, Equations]]:
    """Coordinates and speeds, keyed by name, each with the first mode that has it."""
    return {
        s.published: (s, e)
        for e in reversed(modes)
        for s in (*e.coordinates, *e.speeds, *e.kinematics, *e.dependent)
    }


def _start(
    system: str,
    states: Mapping[str, tuple[Symbol, Equations]],
    texts: Mapping[str, str],
    constants: Mapping[str, Symbol],
    dimensions: Mapping[Symbol, Dimension],
    values: _Parameters,
) -> dict[str, GivenValue]:
    initial = {}
    for name, text in texts.items():
        if name in constants:
            raise DeclarationError(f"{name} as a start value", expected="a parameter", option="set")
        symbol, equations = look_up(name, states, f"coordinate or speed of {system}")
        value = read_value(name, text, constants)
        _refuse_unvalued(value, values.doubles)
        dimension = _dimension_of_state(symbol, equations, dimensions)
        initial[name] = value.in_dimension(dimension, dimensions)
    return initial


def _dimension_of_state(
    symbol: Symbol, equations: Equations, dimensions: Mapping[Symbol, Dimension]
) -> Dimension | None:
    stated = {**equations.dimensions, **dimensions}
    if symbol.base() in stated:  # each derivative divides by a time
        return stated[symbol.base()] / TIME**symbol.order
    meaning = equations.dependent.get(symbol)
    return None if meaning is None else dimension_of(meaning, dimensions)


def _duration(text: str) -> GivenValue:
    if not text:
        raise DeclarationError(
            "no duration",
            expected="the length of the motion",
            advice="give one, such as 10 s",
            option="duration",
        )
    duration = read_value("duration", text, {}).in_dimension(TIME, {})
    if duration.rounded() <= 0:
        raise UnitError(f"a duration of {duration.rounded():g} s", expected="a positive one")
    return duration


def _missing(names: list[str]) -> DeclarationError:
    return DeclarationError(
        f"no value for {', '.join(names)}",
        expected="a value for every parameter and prescribed function",
        advice=f"give {names[0]} a number in SI units or with a unit",
        option="set",
    )

"""Mistakes that affect all members of an ensemble, refused before any is simulated."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import chain, product
from typing import Any

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.base import TIME, DeclarationError, Dimension, NumericError, look_up, to_si
from polhode.derive import Automaton, Equations
from polhode.simulate import constants, quantity_names, refuse_missing, slip_symbols
from polhode.study._columns import Column, published_names
from polhode.study._ensemble_runner import EnsembleSpec
from polhode.study._outputs import EventCount, EventTime

# -- values ----------------------------------------------------------------------------------------


def refuse_values(
    modes: Iterable[Equations], parameters: Mapping[str, Any], start: Mapping[str, Any]
) -> None:
    """Refuse values that are wrong for every member: impossible, or of the wrong dimension.

    Args:
        modes: contact modes in which the quantities occur.
        parameters: a `Column` where members differ, else the one value of all.
        start: likewise.

    Raises:
        DeclarationError: for a common parameter that has to be positive and is not, or one that is
            an expression of unknown quantities.
        UnitError: for a unit of the wrong dimension, or a common value that cannot be read.
    """
    known, positive = dict[str, Dimension](), set[str]()
    for equations in modes:
        known |= dict(_dimensions(equations))
        positive |= {s.published for s in equations.parameters if s.positive}
    for name, value in {**parameters, **start}.items():
        for text in _to_check(value):
            number = to_si(text, known[name], name) if name in known else 1.0
            if name in positive and number <= 0 and not isinstance(value, Column):
                raise DeclarationError(
                    f"{name} = {number:g} for every member",
                    expected="a positive value, as it was declared",
                    advice=f"check the sign of {name}",
                )
    _refuse_unknown(parameters, ())
    _refuse_unknown(start, parameters)


def _dimensions(equations: Equations) -> Iterator[tuple[str, Dimension]]:
    """Dimensions of parameters, coordinates, speeds and rates, as far as they are known."""
    own = (*equations.coordinates, *equations.speeds)
    moving = (*own, *equations.kinematics, *equations.dependent)
    for symbol in (*equations.parameters, *moving):
        base = equations.dimensions.get(symbol.base())
        if base is not None:
            yield symbol.published, base / TIME**symbol.order


def _to_check(value: Any) -> Iterator[Any]:
    """Values to read as a check: every different text, one number with the unit, or the value."""
    match value:
        case Column() if value.values.dtype.kind == "U":
            yield from sorted(set(value.values.tolist()))
        case Column() if value.unit:
            yield (1.0, value.unit)
        case Expr() | Column():
            return
        case _:
            yield value


def _refuse_unknown(values: Mapping[str, Any], known: Collection[str]) -> None:
    """Refuse expressions of quantities that have no value."""
    for name, value in values.items():
        for symbol in constants([value]) if isinstance(value, Expr) else ():
            if symbol.published not in known:
                raise DeclarationError(
                    f"{name} = {value} without a value for {symbol.published}",
                    expected="a number, or an expression of parameters for a start value",
                )


# -- everything that members share -----------------------------------------------------------------


def refuse_mistakes(
    spec: EnsembleSpec, parameters: Mapping[str, Any], start: Mapping[str, Any]
) -> None:
    """Refuse values, names and options with which no member can be simulated.

    Args:
        parameters: a `Column` where members differ, else the one value of all.
        start: likewise.

    Raises:
        DeclarationError: for unknown names, and parameters without a value.
        NumericError: for a `near_flat` that is not the sine of a small angle, or a support whose
            motion is not smooth.
        UnitError: for a unit of the wrong dimension, or a common value that cannot be read.
    """
    known = parameter_names(spec)
    moving = dict.fromkeys(start_names(spec))
    for name in parameters:
        look_up(name, dict.fromkeys(sorted(known)), "parameter of this system")
    for name in start:
        look_up(name, moving, "coordinate or speed of this system")
    missing = [s.published for s in spec.derived.parameters if s.published not in parameters]
    refuse_missing(missing)
    refuse_values(_modes(spec.derived), parameters, start)
    _refuse_quantities(spec)
    kinds = dict.fromkeys(spec.legend.kinds)
    until = spec.options.get("until") or ()
    for kind in (until,) if isinstance(until, str) else until:
        look_up(kind, kinds, "event of this system")
    contacts = spec.derived.system.contacts
    pulls = {f"{contact.name} pulls": None for contact in contacts}
    for output in spec.outputs.values():
        if isinstance(output, EventTime | EventCount):
            look_up(output.kind, kinds | pulls, "event of this system")
    functions = dict.fromkeys(s.published for s in spec.derived.functions)
    for name in published_names(spec.options.get("forcing") or {}):
        look_up(name, functions, "prescribed function of this system")
    flat = spec.options.get("near_flat", 0.5)
    if not 0 < flat < 1:
        raise NumericError(f"near_flat = {flat}", expected="the sine of a small angle")
    spec.experiment().prepare(dict[Any, Any](parameters))


def _refuse_quantities(spec: EnsembleSpec) -> None:
    """Refuse outputs of quantities that no contact mode has."""
    quantities = [getattr(output, "quantity", None) for output in spec.outputs.values()]
    named = {quantity for quantity in quantities if isinstance(quantity, str)}
    known = dict.fromkeys(sorted(parameter_names(spec)))
    expressions = (
        Expr.of(q)
        for q in [*quantities, *(spec.options.get("events") or {}).values()]
        if isinstance(q, Expr | Symbol)
    )
    for symbol in constants(expressions):
        look_up(symbol.published, known, "parameter of this system")
    # Modes are derived one by one, and only until every name has been found.
    for names in _quantities(spec.derived):
        known |= dict.fromkeys(sorted(names))
        if named <= known.keys():
            return
    for quantity in named:
        look_up(quantity, known, "quantity of this system")


def _quantities(derived: Automaton | Equations) -> Iterator[set[str]]:
    """Names of quantities, mode by mode; the first mode has most of them."""
    if isinstance(derived, Equations):
        yield quantity_names(derived, {})
        return
    yield {s.published for contact in derived.contacts for s in slip_symbols(contact)}
    others = map(derived.mode, product(*derived.options))
    for mode in chain((derived.together, derived.separated), others):
        yield quantity_names(mode.equations, mode.embedding)


def parameter_names(spec: EnsembleSpec) -> set[str]:
    """Names of the parameters, including those of masses and prescribed motions."""
    derived = spec.derived
    bodies = derived.system.bodies
    parts = [e for body in bodies for e in (body.mass, *sum(body.inertia.rows, ()))]
    motions = [m for m in (spec.options.get("forcing") or {}).values() if isinstance(m, Expr)]
    used = (
        s for part in (*parts, *motions) for s in part.symbols() if s.kind is SymbolKind.PARAMETER
    )
    return {s.published for s in (*derived.parameters, *used) if s.name != "pi"}


def start_names(spec: EnsembleSpec) -> Iterator[str]:
    """Names of the coordinates, speeds and rates of any contact mode."""
    derived = spec.derived
    for equations in _modes(derived):
        own = (*equations.coordinates, *equations.speeds)
        for symbol in (*own, *equations.kinematics, *equations.dependent):
            yield symbol.published


def _modes(derived: Automaton | Equations) -> Iterator[Equations]:
    if isinstance(derived, Automaton):
        yield from (derived.together.equations, derived.separated.equations)
    else:
        yield derived

"""What is refused before anybody is followed: mistakes that all members share."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from itertools import chain, product
from typing import Any

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.base import NumericError, look_up
from polhode.derive import Automaton, Equations
from polhode.model import Contact
from polhode.simulate import constants, quantity_names, refuse_missing, slip_symbols
from polhode.study._columns import published_names
from polhode.study._ensemble_runner import EnsembleSpec
from polhode.study._event_outputs import EventCount, EventTime
from polhode.study._refused_values import refuse_values


def refuse_mistakes(
    order: EnsembleSpec, parameters: Mapping[str, Any], start: Mapping[str, Any]
) -> None:
    """Refuse what cannot be asked of any member.

    Args:
        parameters: a `Column` where members differ, else the one value of all.
        start: likewise.

    Raises:
        DeclarationError: for names that are not known, and parameters without a value.
        NumericError: for a limit of flatness that is no sine, or a motion of a support that is
            not smooth.
        UnitError: for a unit of another dimension, or a common value that cannot be read.
    """
    _refuse_names(order, parameters, start)
    refuse_values(_modes(order.derived), parameters, start)
    _refuse_quantities(order)
    _refuse_events(order)
    _refuse_options(order)
    order.experiment().prepare(dict[Any, Any](parameters))


def _refuse_names(order: EnsembleSpec, parameters: Collection[str], start: Collection[str]) -> None:
    """Names that no member can have a value for, and parameters that none has one for."""
    known = parameter_names(order)
    moving = dict.fromkeys(start_names(order))
    for name in parameters:
        look_up(name, dict.fromkeys(sorted(known)), "parameter of this system")
    for name in start:
        look_up(name, moving, "coordinate or speed of this system")
    missing = [s.published for s in order.derived.parameters if s.published not in parameters]
    refuse_missing(missing)


def _refuse_quantities(order: EnsembleSpec) -> None:
    """Outputs of quantities that no contact mode has."""
    asked = [getattr(output, "quantity", None) for output in order.outputs.values()]
    wanted = {quantity for quantity in asked if isinstance(quantity, str)}
    known = dict.fromkeys(sorted(parameter_names(order)))
    _refuse_constants([*asked, *(order.options.get("events") or {}).values()], known)
    for names in _quantities(order.derived):
        known |= dict.fromkeys(sorted(names))
        if wanted <= known.keys():
            return
    for quantity in wanted:
        look_up(quantity, known, "quantity of this system")


def _refuse_constants(asked: Collection[Any], known: Mapping[str, Any]) -> None:
    """Expressions of parameters that the system does not have."""
    for symbol in constants(Expr.of(q) for q in asked if isinstance(q, Expr | Symbol)):
        look_up(symbol.published, known, "parameter of this system")


def _quantities(derived: Automaton | Equations) -> Iterator[set[str]]:
    """Names that can be read, mode after mode: most are known in the first."""
    if isinstance(derived, Equations):
        yield quantity_names(derived, {})
        return
    yield {s.published for contact in derived.contacts for s in slip_symbols(contact)}
    others = map(derived.mode, product(*derived.options))
    for mode in chain((derived.together, derived.apart), others):
        yield quantity_names(mode.equations, mode.lifted)


def _refuse_events(order: EnsembleSpec) -> None:
    """Events that cannot happen to any member."""
    kinds = dict.fromkeys(order.legend.kinds)
    until = order.options.get("until") or ()
    for kind in (until,) if isinstance(until, str) else until:
        look_up(kind, kinds, "event of this system")
    pulls = {f"{name} pulls": None for name in _contacts(order)}
    for output in order.outputs.values():
        if isinstance(output, EventTime | EventCount):
            look_up(output.kind, kinds | pulls, "event of this system")


def _refuse_options(order: EnsembleSpec) -> None:
    """Motions of supports that the system does not have; a limit of flatness that is none."""
    known = dict.fromkeys(s.published for s in order.derived.functions)
    for name in published_names(order.options.get("forcing") or {}):
        look_up(name, known, "prescribed function of this system")
    flat = order.options.get("near_flat", 0.5)
    if not 0 < flat < 1:
        raise NumericError(f"near_flat = {flat}", expected="the sine of a small angle")


def parameter_names(order: EnsembleSpec) -> set[str]:
    """Names that are parameters and not start values."""
    derived = order.derived
    bodies = derived.system.bodies
    parts = [e for body in bodies for e in (body.mass, *sum(body.inertia.rows, ()))]
    motions = [m for m in (order.options.get("forcing") or {}).values() if isinstance(m, Expr)]
    used = (
        s for part in (*parts, *motions) for s in part.symbols() if s.kind is SymbolKind.PARAMETER
    )
    return {s.published for s in (*derived.parameters, *used) if s.name != "pi"}


def start_names(order: EnsembleSpec) -> Iterator[str]:
    """Coordinates, speeds and rates of any contact mode."""
    derived = order.derived
    for equations in _modes(derived):
        own = (*equations.coordinates, *equations.speeds)
        for symbol in (*own, *equations.kinematics, *equations.dependent):
            yield symbol.published


def _modes(derived: Automaton | Equations) -> Iterator[Equations]:
    if isinstance(derived, Automaton):
        yield from (derived.together.equations, derived.apart.equations)
    else:
        yield derived


def _contacts(order: EnsembleSpec) -> list[str]:
    return [e.name for e in order.derived.system.elements if isinstance(e, Contact)]

"""Options for friction, edges, the motion of a sheet, and events."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from polhode.algebra import Expr, reaction, read_expression, symbol
from polhode.base import LENGTH, PURE, DeclarationError, to_si
from polhode.catalogue import CatalogueEntry
from polhode.cli._parser import Parser
from polhode.derive import Equations
from polhode.model import Contact, System, with_edge, with_friction

if TYPE_CHECKING:
    from polhode.simulate import Pieces


def add_friction_options(parser: Parser) -> None:
    """Add `--mu` and `--mu-static`, which `declared` reads."""
    parser.add_option("--mu MU", "coefficient of kinetic friction at the contacts")
    parser.add_option("--mu-static MU", "coefficient of static friction (default: MU)")


def add_slipping_options(parser: Parser) -> None:
    """Add `--mu` and `--mu-static` for exact commands, which `exactly_declared` reads."""
    parser.add_option(
        "--mu MU",
        "take the contacts as slipping with this coefficient of friction: a number, or the "
        "letter mu to leave it open",
    )


def declared(entry: CatalogueEntry, options: Namespace, settings: dict[str, str]) -> System:
    """The declaration of an entry with the friction and the edge given as options."""
    system = entry.build()
    return _rough(system, _given(system, options, settings))


def declared_with_letters(
    entry: CatalogueEntry, options: Namespace, settings: dict[str, str]
) -> tuple[System, dict[str, float]]:
    """The same with letters for the friction and the edge, and their values."""
    system = entry.build()
    values = _given(system, options, settings)
    return _rough(system, {name: symbol(name, positive=True) for name in values}), values


def _given(system: System, options: Namespace, settings: dict[str, str]) -> dict[str, float]:
    """Values of the friction and the edge, which is taken out of the settings, by name."""
    values = dict[str, float]()
    if "edge" in settings and any(isinstance(e, Contact) for e in system.elements):
        values["edge"] = to_si(settings.pop("edge"), LENGTH, "edge")
    if options.mu_static and not options.mu:
        raise DeclarationError(
            "--mu-static without --mu",
            expected="the coefficient of kinetic friction as well",
            advice="for instance --mu 0.2 --mu-static 0.25",
        )
    if options.mu:
        values["mu"] = to_si(options.mu, PURE, "mu")
    if options.mu_static:
        values["mu_static"] = to_si(options.mu_static, PURE, "mu_static")
    return values


def _rough(system: System, given: Mapping[str, Expr] | Mapping[str, float]) -> System:
    """A system with an edge and with friction, as far as they are given."""
    if "edge" in given:
        system = with_edge(system, given["edge"])
    if "mu" in given:
        system = with_friction(system, given["mu"], given.get("mu_static"))
    return system


def exactly_declared(entry: CatalogueEntry, options: Namespace) -> System:
    """The declaration with contacts that slip, if a coefficient of friction is given."""
    system = entry.build()
    if not options.mu:
        return system
    return with_friction(system, read_expression(options.mu, {"mu": symbol("mu", positive=True)}))


def sheet_of(options: Namespace, equations: Equations) -> dict[str, Pieces]:
    """The motion of the sheet read from a file, or that of a case."""
    if options.sheet is None and options.path is None:
        return {}
    names = [symbol.published for symbol in equations.functions]
    if len(names) != 3 or "X" not in names or "Y" not in names:
        raise DeclarationError(
            f"a sheet for {equations.system.name!r}",
            expected="a system whose sheet is moved by X, Y and an angle, such as ball-on-paper",
        )
    (angle,) = (name for name in names if name not in ("X", "Y"))
    from polhode.simulate import read_sheet  # slow to load, and not needed to check a claim

    path = options.path or read_sheet(options.sheet)
    return {"X": path.X, "Y": path.Y, angle: path.angle}


def event_expressions(texts: Sequence[str], equations: Equations) -> dict[str, Expr]:
    """Expressions whose zeros are recorded as events, by their text.

    Reactions are those of whichever contacts are closed, and zero where a contact is open.

    Raises:
        ParseError: for text that is no formula of the system's quantities.
    """
    known = {name: reaction(name) for name in equations.components}
    known |= {
        s.published: Expr.generator(s)
        for s in (*equations.coordinates, *equations.speeds, *equations.dependent)
    }
    known |= {s.published: Expr.generator(s) for s in equations.kinematics}
    known |= {s.published: Expr.generator(s) for s in equations.parameters}
    return {text: read_expression(text, known) for text in texts if text}

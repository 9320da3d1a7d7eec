"""The systems of the catalogue, or one system: names, quantities, parameters, what can be set."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

from polhode.catalogue import CATALOGUE, cases_of
from polhode.cli._parser import NAME_HELP, Parser
from polhode.cli._printing import print_document, wrapped
from polhode.cli._systems import entry_of
from polhode.derive import derive
from polhode.model import Sheet, System


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_argument("name", metavar="NAME", nargs="?", default="", help=NAME_HELP)
    parser.add_json()


def run(options: Namespace) -> int:
    """Print the catalogue."""
    systems = list[dict[str, Any]]()
    for entry in [entry_of(options.name)] if options.name else CATALOGUE.values():
        equations = derive(entry.build())
        systems.append(
            {
                "name": entry.name,
                "title": entry.title,
                "coordinates": [symbol.published for symbol in equations.coordinates],
                "speeds": [symbol.published for symbol in equations.speeds],
                "reactions": list(equations.components),
                "parameters": [asdict(parameter) for parameter in entry.all_parameters(equations)],
                "start": dict(entry.start),
                "forcing": dict(entry.forcing),
                "cases": [{"name": case.name, "asks": case.asks} for case in cases_of(entry)],
                "options": [asdict(option) for option in settable(entry.build())],
            }
        )
    if options.json:
        print_document({"systems": systems})
    else:
        print("\n\n".join("\n".join(_lines(system)) for system in systems))
    return 0


# -- what a run can be given besides the parameters of its system ----------------------------------


@dataclass(frozen=True)
class Settable:
    """Something besides the parameters that a run can be given.

    Attributes:
        name: as in the documents of runs.
        unit: SI unit as text; empty for a number or a file.
        option: as it is written.
        meaning: in words.
    """

    name: str
    unit: str
    option: str
    meaning: str


def settable(system: System) -> tuple[Settable, ...]:
    """What a run of a system can be given besides its parameters: friction, an edge, a path."""
    contacts = system.contacts
    found: list[Settable] = []
    if contacts:
        found += [
            Settable("mu", "", "--mu MU", "kinetic friction at every contact"),
            Settable("mu_static", "", "--mu-static MU", "static friction, mu by default"),
        ]
    if any(isinstance(contact.on, Sheet) for contact in contacts):
        found += [
            Settable("edge", "m", "--set edge=0.3m", "end of the sheet, where x_sheet = edge"),
            Settable("sheet", "", "--sheet FILE.csv", "path of the sheet, columns t,x,y"),
        ]
    return tuple(found)


# -- text ------------------------------------------------------------------------------------------


def _lines(system: dict[str, Any]) -> Iterator[str]:
    yield f"{system['name']:<27} {system['title']}"
    for what in ("coordinates", "speeds", "reactions"):
        yield from wrapped(what, system[what])
    values = (f"{p['name']}={p['default']}".rstrip("=") for p in system["parameters"])
    yield from wrapped("parameters", [f"{value}," for value in values])
    for what in ("start", "forcing"):
        if system[what]:
            yield from wrapped(what, [f"{name}={value}," for name, value in system[what].items()])
    if system["cases"]:
        yield from wrapped("cases", [f"--case {case['name']}," for case in system["cases"]])
    if system["options"]:
        yield from wrapped("options", [f"{option['option']}," for option in system["options"]])

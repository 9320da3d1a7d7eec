"""Options of the commands that print exact results about one system: NAME, --at and --json."""

from __future__ import annotations

from argparse import Namespace

from polhode.algebra import Expr, Symbol
from polhode.catalogue import CatalogueEntry, exact_values
from polhode.cli._parser import Parser, assignments
from polhode.cli._printing import warn_of_radians
from polhode.cli._systems import entry_of
from polhode.derive import Equations, derive


def add_exact_options(parser: Parser) -> None:
    """Add NAME, --at and --json."""
    parser.add_system()
    parser.add_list(
        "--at k=v",
        "put in an exact value of a coordinate, speed or parameter: --at theta=pi/2, --at M=2kg",
    )
    parser.add_json()


def exact_system(options: Namespace) -> tuple[CatalogueEntry, Equations, dict[Symbol, Expr]]:
    """The system that is named, its equations, and the values given with --at."""
    entry = entry_of(options.name)
    equations = derive(entry.build())
    given = assignments(options.at)
    at = dict(exact_values(equations, given, entry))
    warn_of_radians(given, equations)
    return entry, equations, at

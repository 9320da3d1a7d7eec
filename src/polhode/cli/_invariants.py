"""The first integrals of a system, each verified exactly."""

from __future__ import annotations

from argparse import Namespace

from polhode.analyse import invariants
from polhode.cli._parser import Parser
from polhode.cli._printing import print_document, printed
from polhode.cli._systems import NAME_HELP, entry_of
from polhode.derive import derive


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_argument("name", metavar="NAME", help=NAME_HELP)
    parser.add_argument("--json", action="store_true", help="print one JSON document")


def run(options: Namespace) -> int:
    """Find the integrals of one system and print them."""
    entry = entry_of(options.name)
    found = invariants(derive(entry.build()))
    if options.json:
        described = [{"name": i.name, **printed(i.expression), "meaning": i.meaning} for i in found]
        linear = found.linear and {
            "angle": found.linear.angle.published,
            "speeds": [speed.published for speed in found.linear.speeds],
            # d(speed)/d(angle), one slope for each speed
            "slopes": [printed(slope) for slope in found.linear.slopes],
        }
        print_document(
            {
                "system": entry.name,
                "invariants": described,
                "ansatz": found.ansatz,
                "linear": linear,
            }
        )
        return 0
    print(f"Integrals of {entry.name}")
    print(found)
    return 0

"""The linear equations of small departures from each family of steady motions.

The departure of a coordinate q is delta_q; that of its rate is the derivative of delta_q.
"""

from __future__ import annotations

from argparse import Namespace
from typing import Any

from polhode.analyse import Departures, SteadyMotion, departures, steady
from polhode.base import NumericError
from polhode.cli._exact_options import add_exact_options, exact_system
from polhode.cli._parser import Parser
from polhode.cli._printing import in_decimals, print_document, printed, printed_all


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    add_exact_options(parser)


def run(options: Namespace) -> int:
    """Linearise one system about its steady motions and print the equations."""
    entry, equations, at = exact_system(options)
    found = list[tuple[SteadyMotion, Departures | NumericError]]()
    for family in steady(equations, at):
        try:
            found.append((family, departures(family)))
        except NumericError as singular:
            found.append((family, singular))
    if options.json:
        families = [_document(family, one) for family, one in found]
        print_document({"system": entry.name, "families": families})
        return 0
    print(f"Linear equations of {entry.name}")
    for family, one in found:
        text = f"Departures from {family}\n  undecided: {one}"
        print("\n" + in_decimals(str(one) if isinstance(one, Departures) else text))
    return 0


def _document(family: SteadyMotion, found: Departures | NumericError) -> dict[str, Any]:
    document: dict[str, Any] = {
        "latex": family.latex(),
        "sympy": printed_all(family.conditions),
    }
    if isinstance(found, NumericError):
        return document | {"equations": [], "departures": {}, "undecided": str(found)}
    return document | {
        "departures": {symbol.published: printed(value) for symbol, value in found.names.items()},
        "equations": [printed(row) for row in found.equations],
        "constant": [printed(value) for value in found.integrals],
    }

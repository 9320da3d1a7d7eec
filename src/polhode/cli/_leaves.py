"""Where contacts open or slip along a level of the energy, exactly."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from typing import Any

from polhode.algebra import Expr
from polhode.analyse import Opening, leaves
from polhode.catalogue import exact_values
from polhode.cli._exact_options import add_exact_options, exact_system
from polhode.cli._parser import Parser, assignments
from polhode.cli._printing import in_decimals, print_document, printed, warn_of_radians


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    add_exact_options(parser)
    parser.add_list(
        "--from k=v",
        "start from this value of a coordinate or speed: --from theta=60deg; others start at zero",
        dest="start",
    )


def run(options: Namespace) -> int:
    """Follow the reactions of one system along a level of its energy and print what is found."""
    entry, equations, at = exact_system(options)
    given = assignments(options.start)
    warn_of_radians(given, equations)
    start = exact_values(equations, given, entry)
    states = {*equations.coordinates, *equations.speeds}
    constants = {symbol: value for symbol, value in at.items() if symbol not in states}
    start |= {symbol: value for symbol, value in at.items() if symbol in states}
    found = [opening.subs(constants) for opening in leaves(equations, start)]
    if options.json:
        documents = [part for opening in found for part in _documents(opening)]
        print_document({"system": entry.name, "contacts": documents})
        return 0
    lines = [f"Contacts of {entry.name} along a level of its energy"]
    for opening in found:
        lines += ["", *_text(opening)]
    print(in_decimals("\n".join(lines)))
    return 0


def _documents(opening: Opening) -> Iterator[dict[str, Any]]:
    least = None if opening.friction is None else printed(opening.friction)
    more = {"contact": opening.contact, "at": str(opening.coordinate)}
    if not opening.places:
        yield {**more, "what": "opens", **printed(opening.normal), "least_mu": least}
    for what, places in (("opens", opening.places), ("greatest", opening.greatest)):
        for left, value in places:
            relation = {**printed(left - value), "latex": f"{left.latex()} = {value.latex()}"}
            yield {**more, "what": what, **relation, "least_mu": least}
    if opening.friction is not None:
        yield {**more, "what": "slips", **printed(opening.friction), "least_mu": least}


def _text(opening: Opening) -> Iterator[str]:
    yield f"{opening.contact}: N = {opening.normal.pretty()}"
    if not opening.places:
        yield "  opens where this vanishes"
    yield from (f"  opens where {_equation(*place)}" for place in opening.places)
    yield from (f"  N is stationary where {_equation(*place)}" for place in opening.greatest)
    if opening.friction is not None:
        yield f"  slips where the coefficient of friction is {opening.friction.pretty()}"


def _equation(left: Expr, value: Expr) -> str:
    return f"{left.pretty()} = {value.pretty()}"

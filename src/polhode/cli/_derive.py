"""Exact equations of motion and every reaction of a system."""

from __future__ import annotations

import time
from argparse import Namespace
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from polhode.algebra import Expr, Symbol
from polhode.catalogue import CatalogueEntry
from polhode.cli._parser import Parser
from polhode.cli._printing import print_document, printed, printed_by_name, wrapped
from polhode.cli._systems import entry_of
from polhode.derive import Equations, derive, lettered


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_system()
    parser.add_json()


def run(options: Namespace) -> int:
    """Derive one system and print its equations."""
    entry = entry_of(options.name)
    system = entry.build()
    began = time.perf_counter()
    equations = derive(system).in_lengths
    reactions = equations.components
    seconds = time.perf_counter() - began
    if options.json:
        print_document(_document(entry, equations, reactions) | {"seconds": seconds})
    else:
        print("\n".join(_lines(entry, equations)))
        print(f"\nDerived in {seconds:.3f} s.")
    return 0


def _document(
    entry: CatalogueEntry, equations: Equations, reactions: Mapping[str, Expr]
) -> dict[str, Any]:
    return {
        "system": entry.name,
        "coordinates": _names(equations.coordinates),
        "speeds": _names(equations.speeds),
        "motion": [printed(row) for row in equations.motion],
        "reactions": printed_by_name(reactions),
        "kinematics": {s.published: printed(rate) for s, rate in equations.kinematics.items()},
        "dependent": {s.published: printed(speed) for s, speed in equations.dependent.items()},
        "energy": printed(equations.energy),
        "lengths": printed_by_name({k: part.meaning for k, part in equations.lengths.items()}),
        "undetermined": list(equations.undetermined),
        "least": {name: printed(equations.least[name]) for name in equations.undetermined},
        "positive": [printed(sign) for sign in equations.assumed_positive],
        "parameters": _names(equations.parameters),
        "functions": _names(equations.functions),
    }


def _lines(entry: CatalogueEntry, equations: Equations) -> Iterator[str]:
    yield f"{entry.title} ({entry.name})"
    yield from wrapped("coordinates", _names(equations.coordinates))
    yield from wrapped("speeds", _names(equations.speeds))
    yield from wrapped("parameters", _names(equations.parameters))
    if equations.functions:
        yield from wrapped("functions of t", _names(equations.functions))
    yield ""
    yield str(equations)
    if equations.undetermined:
        # Redundant supports leave these open; shown is the choice of smallest sum of squares.
        yield "  of which the least forces are"
        least = {name: equations.least[name] for name in equations.undetermined}
        yield from _assigned(equations, least)
    others = {s: e for s, e in equations.dependent.items() if s not in equations.kinematics}
    if others:
        yield "Speeds that follow from the constraints"
        named = {Expr.generator(symbol).pretty(): value for symbol, value in others.items()}
        yield from _assigned(equations, named)
    yield "Energy"
    yield from _assigned(equations, {"E": equations.energy})
    if equations.assumed_positive:
        yield "Assumed"
        yield from (f"  {sign.pretty()} > 0" for sign in equations.assumed_positive)


def _assigned(equations: Equations, values: Mapping[str, Expr]) -> Iterator[str]:
    written, legend = lettered(equations, values.values())
    yield from (f"  {name} = {value.pretty()}" for name, value in zip(values, written, strict=True))
    yield from (f"  {line}" for line in legend)


def _names(symbols: Iterable[Symbol]) -> list[str]:
    return [symbol.published for symbol in symbols]

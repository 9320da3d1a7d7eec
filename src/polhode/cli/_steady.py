"""Every family of steady motions of a system, with its existence and its stability."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Sequence
from typing import Any

from polhode.algebra import Expr
from polhode.analyse import (
    ALWAYS,
    PROVES,
    Condition,
    Stability,
    SteadyMotion,
    Truth,
    stability,
    steady,
)
from polhode.base import NumericError
from polhode.catalogue import exact_values
from polhode.cli._parser import Parser, assignments
from polhode.cli._printing import in_decimals, print_document, printed, printed_all
from polhode.cli._systems import NAME_HELP, entry_of
from polhode.derive import derive


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_argument("name", metavar="NAME", help=NAME_HELP)
    parser.add_argument(
        "--at",
        action="append",
        default=[],
        metavar="k=v",
        help="fix a coordinate, speed or parameter exactly: --at theta=pi/2",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON document")


def run(options: Namespace) -> int:
    """Find the steady motions of one system and print their existence and stability."""
    entry = entry_of(options.name)
    equations = derive(entry.build())
    at = exact_values(equations, assignments(options.at))
    families = list[tuple[SteadyMotion, Stability | NumericError]]()
    for family in steady(equations, at):
        try:
            families.append((family, stability(family)))
        except NumericError as undecided:  # for instance in singular coordinates
            families.append((family, undecided))
    if options.json:
        described = [_document(family, judged) for family, judged in families]
        print_document({"system": entry.name, "families": described})
    else:
        print(f"Steady motions of {entry.name}")
        for family, judged in families:
            print(in_decimals("\n".join(_lines(family, judged))))
        print(f"\n{PROVES}")
    return 0


def _document(family: SteadyMotion, judged: Stability | NumericError) -> dict[str, Any]:
    exists = family.branches[0].exists if family.branches else ()
    document: dict[str, Any] = {
        "latex": family.latex(),
        "sympy": printed_all(family.conditions),
        "branches": [
            {
                "quantity": printed(branch.quantity),
                **printed(branch.value),
                "exists_when": _inequalities(branch.exists)[0],
            }
            for branch in family.branches
        ],
        "exists_when": _inequalities(exists)[0],
    }
    if isinstance(judged, NumericError):
        document |= {"stable_when": None, "frequencies": [], "growth": [], "loss": None}
        return document | {"undecided": str(judged)}
    return document | {
        "stable_when": _inequalities(judged.conditions),
        "frequencies": [printed(value) for value in judged.frequencies],
        "growth": [printed(value) for value in judged.growth],
        "loss": judged.loss,
        "drifts": judged.drifts,
    }


def _inequalities(conditions: Sequence[Condition]) -> list[dict[str, str]]:
    return [_inequality(condition) for condition in conditions or (ALWAYS,)]


def _inequality(condition: Condition) -> dict[str, str]:
    if condition.truth is not Truth.OPEN:
        word = condition.truth.value
        return {"latex": rf"\mathrm{{{word}}}", "sympy": word}
    left = printed(condition.expression)["sympy"]
    return {"latex": condition.latex(), "sympy": f"StrictGreaterThan({left}, Integer(0))"}


def _lines(family: SteadyMotion, judged: Stability | NumericError) -> Iterator[str]:
    yield f"\n  {family}"
    for branch in family.branches:
        yield f"    {branch.quantity.pretty()} = {branch.value.pretty()}"
    if family.branches:
        yield f"    exists when {' and '.join(map(str, family.branches[0].exists)) or 'always'}"
    if isinstance(judged, NumericError):
        yield f"    undecided: {judged}"
        return
    yield f"    {judged}"
    if judged.frequencies:
        yield f"    frequencies {_listed(judged.frequencies)}"
    if judged.truth is Truth.NEVER and judged.growth:
        yield f"    grows at {_listed(judged.growth)}"
    if judged.loss:
        yield f"    loss: {judged.loss}"


def _listed(values: Sequence[Expr]) -> str:
    return ", ".join(value.pretty() for value in values)

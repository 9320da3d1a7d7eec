"""The closed form of a motion beside its simulation."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import Any

import numpy as np

from polhode.analyse import ClosedForm, closed_form
from polhode.base import NumericError, terminal_progress
from polhode.catalogue import CatalogueEntry, exact_values, numbers_of
from polhode.cli._parser import Parser, assignments
from polhode.cli._printing import print_document, values, wrapped
from polhode.cli._systems import NAME_HELP, entry_of
from polhode.derive import derive
from polhode.simulate import Trajectory, simulate

_EXAMPLES = """examples:
  polhode exact tennis-racquet --duration 60s
  polhode exact gyroscope --start theta=60deg --start omega_1=150rad/s --duration 2s
  polhode exact gyrocompass --set Omega=1rad/s --start omega=-5rad/s --duration 20s
"""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.epilog = _EXAMPLES
    parser.add_argument("name", metavar="NAME", help=NAME_HELP)
    parser.add_argument(
        "--set",
        dest="settings",
        metavar="k=v",
        action="append",
        default=[],
        help="a parameter",
    )
    parser.add_argument(
        "--start",
        metavar="k=v",
        action="append",
        default=[],
        help="a coordinate or speed at the start; with any given, speeds not named are zero",
    )
    parser.add_argument("--duration", metavar="T", default="", help="such as 10s")
    parser.add_argument("--json", action="store_true", help="print one JSON document")


def run(options: Namespace) -> int:
    """Solve one system in closed form, simulate it, and compare."""
    entry = entry_of(options.name)
    equations = derive(entry.build())
    settings, given = assignments(options.settings), assignments(options.start)
    numbers = numbers_of(entry, equations, settings, given, options.duration)
    exactly = {s.published: value for s, value in exact_values(equations, given).items()}
    exact = closed_form(equations, numbers.parameters, {**numbers.start, **exactly})
    motion = simulate(
        equations,
        numbers.parameters,
        numbers.start,
        numbers.duration,
        progress=terminal_progress(),
    )
    document = _document(entry, exact, motion) | {"start": dict(numbers.start)}
    if options.json:
        print_document(document)
    else:
        print("\n".join(_told(entry, document)))
    return 0


def _document(entry: CatalogueEntry, exact: ClosedForm, motion: Trajectory) -> dict[str, Any]:
    solved = exact.at(motion.t)
    differences = {name: _difference(values, motion[name]) for name, values in solved.items()}
    return {
        "system": entry.name,
        "closed_form": exact.name,
        "kind": exact.kind,
        "latex": exact.latex(),
        "duration": motion.duration,
        "parameters": dict(motion.parameters),
        "assumed": dict(motion.assumed),
        "quantities": {
            name: {"final": float(values[-1]), "difference": differences[name]}
            for name, values in solved.items()
        },
        "max_difference": max(differences.values()),
        "period": _period(exact),
        "conditioning": {"data": exact.conditioning, "steps": exact.stepwise_conditioning},
        "figures": {name: float(value) for name, value in exact.figures.items()},
        "drift": motion.drift.as_json(),
    }


def _difference(exact: Any, simulated: Any) -> float:
    """Largest difference, against the largest value where that is above one."""
    scale = max(1.0, float(np.max(np.abs(exact))))
    return float(np.max(np.abs(exact - simulated))) / scale


def _period(exact: ClosedForm) -> float | None:
    with suppress(NumericError):  # steady motions and separatrices have none
        return float(exact.period)
    return None


def _told(entry: CatalogueEntry, document: Mapping[str, Any]) -> Iterator[str]:
    yield f"{entry.title} ({entry.name}), {document['duration']:g} s, in SI units"
    yield from wrapped("closed form", [f"{document['closed_form']},", document["kind"]])
    yield from wrapped("parameters", values(document["parameters"]))
    yield from wrapped("start", values(document["start"]))
    yield from wrapped("assumed", values(document["assumed"]))
    quantities = document["quantities"].items()
    yield from wrapped("final", values({name: value["final"] for name, value in quantities}))
    yield from wrapped("simulated", _differences(document["quantities"]))
    period, conditioning = document["period"], document["conditioning"]
    yield from wrapped("period", ["none" if period is None else f"{period:.15g} s"])
    if period is not None:
        grown = (f"{where} {size:.3g}," for where, size in conditioning.items())
        yield from wrapped("conditioning", grown)
    yield from wrapped("figures", values(document["figures"]))


def _differences(quantities: Mapping[str, Mapping[str, float]]) -> Iterator[str]:
    for name, value in quantities.items():
        yield f"{name} differs by {value['difference']:.1e} at most,"

"""Simulate a system, and report where it ends, how exact that is, and what it took."""

from __future__ import annotations

import time
from argparse import Namespace
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from math import isfinite
from pathlib import Path
from typing import Any

from polhode.algebra import Expr
from polhode.analyse import Ansatz, invariants
from polhode.base import NumericError, terminal_progress
from polhode.catalogue import Entry, numbers_of
from polhode.cli._document import print_document
from polhode.cli._parser import Parser, assignments
from polhode.cli._systems import NAME_HELP, entry_of
from polhode.cli._text import values, wrapped
from polhode.derive import Equations, derive
from polhode.simulate import Trajectory, simulate

_EXAMPLES = """examples:
  polhode run rolling-disk --duration 10s
  polhode run gyroscope --set M=0.4kg --start theta=pi/3 --start omega_1=1500rpm --duration 2s
  polhode run ball-on-paper --set 'X=sin(3*t)/20' --duration 6s --out results
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
        help="a parameter, or a prescribed function as a formula in t",
    )
    parser.add_argument(
        "--start",
        metavar="k=v",
        action="append",
        default=[],
        help="a coordinate or speed at the start; with any given, speeds not named are zero",
    )
    parser.add_argument("--duration", metavar="T", default="", help="such as 10s")
    parser.add_argument("--out", metavar="DIR", type=Path, help="write a table and a figure there")
    parser.add_argument("--json", action="store_true", help="print one JSON document")


def run(options: Namespace) -> int:
    """Simulate one system and print the outcome."""
    entry = entry_of(options.name)
    system = entry.build()
    began = time.perf_counter()
    equations = derive(system)
    seconds = time.perf_counter() - began
    numbers = numbers_of(
        entry,
        equations,
        assignments(options.settings),
        assignments(options.start),
        options.duration,
    )
    trajectory = simulate(
        equations,
        numbers.parameters,
        numbers.start,
        numbers.duration,
        forcing=numbers.forcing,
        invariants=_watched(equations),
        progress=terminal_progress(),
    )
    document = _document(entry, trajectory, numbers.start, seconds)
    _refuse_overflow(document["final"] | document["drift"])
    files = _written(options.out, entry, trajectory) if options.out else []
    if options.json:
        print_document(document | {"files": [str(path) for path in files]})
    else:
        print("\n".join(_told(entry, document, files)))
    return 0


def _watched(equations: Equations) -> dict[str, Expr]:
    """Energy, momenta and speeds that stay constant."""
    with suppress(NumericError):  # systems too large to be solved for their accelerations
        found = invariants(equations, Ansatz(0, 0, 0))
        return {invariant.name: invariant.expression for invariant in found}
    return {}


def _written(folder: Path, entry: Entry, trajectory: Trajectory) -> list[Path]:
    from polhode.cli._output import write_run  # loads matplotlib, which a bare run can do without

    return write_run(folder, entry, trajectory)


def _document(
    entry: Entry, trajectory: Trajectory, start: Mapping[str, float], derived: float
) -> dict[str, Any]:
    return {
        "system": entry.name,
        "duration": trajectory.duration,
        "parameters": dict(trajectory.parameters),
        "start": dict(start),
        "assumed": dict(trajectory.assumed),
        "final": trajectory.final,
        "drift": trajectory.drift.as_json(),
        "events": [event.as_json() for event in trajectory.events],
        "integrator": trajectory.integrator,
        "seconds": {**trajectory.seconds, "derive": derived + trajectory.seconds["derive"]},
    }


def _refuse_overflow(results: Mapping[str, Any]) -> None:
    for name, value in results.items():
        if isinstance(value, float) and not isfinite(value):
            raise NumericError(
                f"{name} has no finite value along the motion",
                expected="numbers that can be squared and summed",
                advice="check the sizes of the parameters and of the start",
            )


def _told(entry: Entry, document: Mapping[str, Any], files: Sequence[Path]) -> Iterator[str]:
    final = {name: value for name, value in document["final"].items() if name != "mode"}
    drift = document["drift"]
    drifts = {"energy": drift["energy"], "constraint": drift["constraint"], **drift["invariants"]}
    yield f"{entry.title} ({entry.name}), {document['duration']:g} s, in SI units"
    yield from wrapped("parameters", values(document["parameters"]))
    yield from wrapped("start", values(document["start"]))
    yield from wrapped("assumed", values(document["assumed"]))
    yield from wrapped("final", values(final))
    yield from wrapped("drift", [f"{name} {size:.1e}," for name, size in drifts.items()])
    yield from wrapped("events", [f"{e['time']:g} s {e['kind']}," for e in document["events"]])
    yield from wrapped("seconds", [f"{what} {s:.2f}," for what, s in document["seconds"].items()])
    if files:
        yield from wrapped("files", [str(path) for path in files])

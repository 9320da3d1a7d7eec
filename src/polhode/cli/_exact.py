"""The closed form of a motion, compared with its simulation."""

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
from polhode.cli._printing import print_document, values, warn_of_radians, wrapped
from polhode.cli._systems import entry_of
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
    parser.add_system()
    parser.add_motion("set a parameter, such as M=0.4kg")
    parser.add_json()


def run(options: Namespace) -> int:
    """Solve one system in closed form, simulate it, and compare."""
    entry = entry_of(options.name)
    equations = derive(entry.build())
    settings, given = assignments(options.settings), assignments(options.start)
    numbers = numbers_of(entry, equations, settings, given, options.duration)
    warn_of_radians(given, equations)
    # Exact start values, such as pi/3, let the closed form recognise special cases: a double
    # near pi/2 does not show that the axle is exactly horizontal.
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
        print("\n".join(_lines(entry, document)))
    return 0


def _document(entry: CatalogueEntry, exact: ClosedForm, motion: Trajectory) -> dict[str, Any]:
    solved = exact.at(motion.t)
    differences = {}
    for name, solution in solved.items():
        # Relative to the largest value, but absolute for quantities that stay below one: the
        # relative error of a quantity that is close to zero throughout says nothing.
        scale = max(1.0, float(np.max(np.abs(solution))))
        differences[name] = float(np.max(np.abs(solution - motion[name]))) / scale
    period = None
    with suppress(NumericError):  # steady motions and separatrices have none
        period = float(exact.period)
    return {
        "system": entry.name,
        "closed_form": exact.name,
        "kind": exact.kind,
        "latex": exact.latex(),
        "duration": motion.duration,
        "parameters": dict(motion.parameters),
        "assumed": dict(motion.assumed),
        "quantities": {
            name: {"final": float(solution[-1]), "difference": differences[name]}
            for name, solution in solved.items()
        },
        "max_difference": max(differences.values()),
        "period": period,
        "conditioning": {"data": exact.conditioning, "steps": exact.stepwise_conditioning},
        "figures": {name: float(value) for name, value in exact.figures.items()},
        "drift": motion.drift.as_json(),
    }


def _lines(entry: CatalogueEntry, document: Mapping[str, Any]) -> Iterator[str]:
    yield f"{entry.title} ({entry.name}), {document['duration']:g} s, in SI units"
    yield from wrapped("closed form", [f"{document['closed_form']},", document["kind"]])
    yield from wrapped("parameters", values(document["parameters"]))
    yield from wrapped("start", values(document["start"]))
    yield from wrapped("assumed", values(document["assumed"]))
    quantities = document["quantities"].items()
    yield from wrapped("final", values({name: value["final"] for name, value in quantities}))
    differences = (f"{name} differs by at most {v['difference']:.1e}," for name, v in quantities)
    yield from wrapped("simulated", differences)
    period, conditioning = document["period"], document["conditioning"]
    yield from wrapped("period", ["none" if period is None else f"{period:.15g} s"])
    if period is not None:
        factors = (f"{where} {size:.3g}," for where, size in conditioning.items())
        yield from wrapped("conditioning", factors)
    yield from wrapped("figures", values(document["figures"]))

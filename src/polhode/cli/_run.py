"""Simulate a system, and report its final state, accuracy and computing time."""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from math import isfinite
from pathlib import Path
from typing import Any

from polhode.algebra import Expr
from polhode.analyse import Ansatz, invariants
from polhode.base import DeclarationError, Exit, NumericError, StoreError
from polhode.catalogue import (
    CatalogueEntry,
    about_with,
    cases_of,
    contact_numbers,
)
from polhode.cli._case_options import period_of
from polhode.cli._contact_options import event_expressions
from polhode.cli._motion import add_motion_options, motion_wanted
from polhode.cli._parser import MOTIONS, PAGES, Parser, refuse_other_endings
from polhode.cli._printing import print_document, values, wrapped
from polhode.cli._systems import entry_of
from polhode.derive import Equations
from polhode.simulate import AS_DECLARED, Event, Trajectory, numbers_for

_SHOWN = 12  # events in a line; a bouncing ball has hundreds
_JUMP = 1e-9  # of a state, relative to the largest: more is no rounding
_EXAMPLES = """examples:
  polhode run rolling-disk --duration 10s
  polhode run gyroscope --set M=0.4kg --start theta=pi/3 --start omega_1=1500rpm --duration 2s
  polhode run ball-on-paper --set 'X=sin(3*t)/20' --duration 6s --out results
  polhode run rolling-disk --page disk.html
  polhode run ball-on-paper --mu 0.2 --sheet pulled.csv --set edge=0.3m --events
  polhode run ball-on-paper --case rolls-off
  polhode run gyroscope --case c --page cusps.html
"""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.epilog = _EXAMPLES
    add_motion_options(parser)
    parser.add_file("--out DIR", "write a table and a figure to this folder")
    parser.add_list(
        "--events FORMULA",
        "list all events; with a formula, also its zero crossings",
        nargs="?",
        const="",
    )
    parser.add_list(
        "--extremes QUANTITY",
        "print the least and the greatest value of a quantity, and when they occur",
    )
    parser.add_option(
        "--period T",
        "count time in this period in figures and events: a time, a formula of parameters "
        "such as '2*pi*sqrt(a/g)', or exact for that of the closed form",
    )
    parser.add_option(
        "--precision P",
        "double (default), extended, quadruple, or a number of decimal digits",
        default="double",
    )
    parser.add_file("--save F.h5", "save the whole motion")
    parser.add_file("--page F.html", "write a web page that plays the motion")
    parser.add_switch("--verdicts", "show on the page which equations of the problem set hold")
    parser.add_json()


def run(options: Namespace) -> int:
    """Simulate one system and print the outcome."""
    refuse_other_endings("--page", options.page, PAGES)
    refuse_other_endings("--save", options.save, MOTIONS)
    _check_precision(options)
    claims = _claims(options)
    wanted = motion_wanted(options)
    entry, options, case = wanted.entry, wanted.options, wanted.case
    equations, numbers = wanted.equations, wanted.numbers
    motion = wanted.followed(
        invariants=_candidates(equations),
        events=event_expressions(options.events, equations),
        precision=options.precision,
    )
    trajectory = _with_conserved(motion, equations)
    document = _document(entry, trajectory, numbers.start, wanted.seconds)
    document["parameters"] = contact_numbers(wanted.system) | document["parameters"]
    _refuse_overflow(document["final"] | document["drift"])
    period = period_of(options.period, equations, numbers)
    doubles = trajectory.rounded() if options.precision != "double" else trajectory
    became = None
    if case or options.extremes:
        from polhode.cli._course import course_of  # deferred: few ask for it

        became = course_of(case, options.extremes, equations, doubles, numbers.start)
    files = _written(options, entry, about_with(entry, wanted.system), trajectory, claims, period)
    if options.json:
        described = (became.as_json() if became else {}) | ({"period": period} if period else {})
        print_document(document | described | {"files": [str(path) for path in files]})
    else:
        print("\n".join(_lines(entry, document, files, trajectory.doubt, options.events, period)))
        if became:
            print("\n".join(became.lines()))
        elif cases := cases_of(entry):
            print("\n".join(wrapped("cases", [f"--case {case.name}," for case in cases])))
    return _code(trajectory)


def _code(trajectory: Trajectory) -> int:
    last = trajectory.events[-1]
    if last.kind != "interrupted":
        return Exit.DONE
    print(f"polhode: interrupted at t = {float(last.time):g} s; kept so far", file=sys.stderr)
    return Exit.INTERRUPTED


def _check_precision(options: Namespace) -> None:
    numbers_for(options.precision)
    if options.precision != "double" and options.save:
        raise StoreError(
            f"--save with --precision {options.precision}: the file holds doubles",
            expected="one or the other",
            advice="write samples with --out, which keeps all digits",
        )


def _claims(options: Namespace) -> tuple[str, ...]:
    """Ids of the claims to judge; an error before the run if there is no page or no claim."""
    if not options.verdicts:
        return ()
    if options.page is None:
        raise DeclarationError(
            "--verdicts without a page",
            expected="--page F.html, which shows the verdicts",
            advice="polhode audit prints verdicts in a table",
        )
    from polhode.cli._run_files import claims_about

    return claims_about(entry_of(options.name))


def _candidates(equations: Equations) -> dict[str, Expr]:
    """Conserved energy, momenta and speeds, whose drift measures the accuracy of the run."""
    with suppress(NumericError):  # equations too large to be solved for the accelerations
        found = invariants(equations, Ansatz(0, 0, 0))
        return {invariant.name: invariant.expression for invariant in found}
    return {}


def _with_conserved(trajectory: Trajectory, together: Equations) -> Trajectory:
    """The motion, keeping only invariants that every contact mode on its way conserves.

    None of them is an invariant of impacts.
    """
    if any(map(_is_impact, trajectory.events)):
        return replace(trajectory, invariants={})
    visited = {id(s.dynamics): s.dynamics.equations for s in trajectory.segments}.values()
    kept = {
        name: expression
        for name, expression in trajectory.invariants.items()
        if all(mode is together or _conserves(mode, expression) for mode in visited)
    }
    return replace(trajectory, invariants=kept)


def _conserves(mode: object, expression: Expr) -> bool:
    """Whether a mode's equations keep an expression; none that cannot be solved in closed form."""
    with suppress(NumericError):
        return isinstance(mode, Equations) and mode.rate(expression).is_zero
    return False


def _is_impact(event: Event) -> bool:
    """Whether speeds jump at an event."""
    before, after = event.state_before or {}, event.state_after or {}
    shared = before.keys() & after.keys()
    size = max((abs(before[name]) for name in shared), default=0.0)
    return any(abs(before[name] - after[name]) > _JUMP * size for name in shared)


def _written(
    options: Namespace,
    entry: CatalogueEntry,
    about: str,
    trajectory: Trajectory,
    claims: tuple[str, ...],
    period: float | None,
) -> list[Path]:
    files = []
    if options.save:
        trajectory.save(options.save)
        files.append(options.save)
    if not (options.out or options.page):
        return files
    from polhode.cli._run_files import write_page, write_run  # deferred: they load the figures

    if options.out:
        files += write_run(options.out, entry, trajectory, period)
    if options.page:
        files.append(write_page(options.page, entry, about, trajectory.rounded(), claims))
    return files


def _document(
    entry: CatalogueEntry, trajectory: Trajectory, start: Mapping[str, float], derived: float
) -> dict[str, Any]:
    return {
        "system": entry.name,
        "duration": float(trajectory.duration),
        "precision": trajectory.precision,
        "parameters": dict(trajectory.parameters),
        "start": dict(start),
        "assumed": dict(trajectory.assumed),
        "final": {name: _plain(value) for name, value in trajectory.final.items()},
        "drift": trajectory.drift.as_json(),
        "events": [event.as_json() | {"time": _plain(event.time)} for event in trajectory.events],
        "integrator": trajectory.integrator,
        "seconds": {**trajectory.seconds, "derive": derived + trajectory.seconds["derive"]},
    }


def _plain(value: Any) -> float | str:
    """A double as it is, finer numbers as text: readers of JSON round numbers to doubles."""
    return value if isinstance(value, float | str) else str(value)


def _refuse_overflow(results: Mapping[str, Any]) -> None:
    for name, value in results.items():
        if isinstance(value, float) and not isfinite(value):
            raise NumericError(
                f"{name} is not finite along the motion",
                expected="numbers small enough to be squared and summed",
                advice="check the sizes of the parameters and of the start",
            )


def _lines(
    entry: CatalogueEntry,
    document: Mapping[str, Any],
    files: Sequence[Path],
    doubt: str,
    formulas: Sequence[str],
    period: float | None,
) -> Iterator[str]:
    final = {name: value for name, value in document["final"].items() if name != "mode"}
    drift = document["drift"]
    drifts = {"energy": drift["energy"], "constraint": drift["constraint"], **drift["invariants"]}
    yield f"{entry.title} ({entry.name}), {document['duration']:g} s, in SI units"
    yield from wrapped("parameters", values(document["parameters"]))
    yield from wrapped("start", values(document["start"]))
    yield from wrapped("assumed", values(document["assumed"]))
    yield from wrapped("final", values(final))
    yield from wrapped("drift", [f"{name} {size:.1e}," for name, size in drifts.items()])
    if doubt:
        yield from wrapped("DOUBT", doubt.split())
    yield from _events(document["events"], formulas, period)
    yield from wrapped("seconds", [f"{what} {s:.2f}," for what, s in document["seconds"].items()])
    if files:
        yield from wrapped("files", [str(path) for path in files])


def _events(
    events: Sequence[Mapping[str, Any]], formulas: Sequence[str], period: float | None
) -> Iterator[str]:
    """The first events in a line, or all in a table where they are asked for."""
    if formulas:
        yield "events"
        for event in events:
            modes = " to ".join(mode for mode in (event["from"], event["to"]) if mode)
            what = f"{event['kind']}: {modes}"
            if event["kind"] in formulas:
                mode = "" if event["to"] == AS_DECLARED else f", {event['to']}"
                what = f"{event['kind']} = 0{mode}"
            time = float(event["time"])
            counted = f"  {time / period:<9.6g} T" if period else ""
            yield f"  {time:<14.9g} s{counted}  {what}"
        return
    shown = [f"{float(event['time']):g} s {event['kind']}," for event in events[:_SHOWN]]
    rest = [f"and {len(events) - _SHOWN} more (--events)"] if len(events) > _SHOWN else []
    yield from wrapped("events", shown + rest)

"""Simulate a system over a grid of values, and keep the outcome of every motion in a store."""

from __future__ import annotations

import time
from argparse import Namespace
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from typing import Any

import numpy as np

from polhode.base import DeclarationError, ParseError, terminal_progress
from polhode.catalogue import CatalogueEntry, RunNumbers, numbers_of
from polhode.cli._contact_options import add_friction_options, declared
from polhode.cli._exit import terminating_like_interrupt
from polhode.cli._parser import Parser, assignments
from polhode.cli._printing import print_document, warn_of_radians, wrapped
from polhode.cli._systems import entry_of
from polhode.derive import Equations, automaton
from polhode.study import Duration, Fate, Final, Output, open_store, sweep

_MOST = 10_000_000  # values along an axis: more is a typing error
_EXAMPLES = """examples:
  polhode sweep rolling-disk --axis theta=10deg:85deg:20 --axis omega_3=0rad/s:60rad/s:20 \\
      --duration 1s --until "lifts off" --out fates
  polhode sweep gyroscope --axis omega_1=500rpm:3000rpm:50 --keep theta --out tilts --workers 2
  polhode sweep rolling-disk --axis theta=10deg:85deg:20 --out fates --resume
"""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.epilog = _EXAMPLES
    parser.add_system()
    parser.add_list(
        "--axis k=FROM:TO:COUNT",
        "vary a parameter or initial value over equally spaced values; repeatable",
        required=True,
    )
    parser.add_file("--out STORE", "folder for the results", required=True)
    parser.add_motion(
        "set a parameter, such as a=30mm",
        "set an initial coordinate or speed, such as theta=80deg",
        "length of each motion, such as 10s",
    )
    add_friction_options(parser)
    parser.add_list("--keep k", "also store the final value of this quantity; repeatable")
    parser.add_list("--until EVENT", 'end each motion at this event, such as "lifts off"')
    parser.add_option("--workers N", "number of worker processes", type=int, default=1)
    parser.add_option("--scheduler A", "address of a Dask scheduler to compute on")
    parser.add_switch("--resume", "continue an interrupted sweep")
    parser.add_json()


def run(options: Namespace) -> int:
    """Sweep one system and print a summary."""
    began = time.perf_counter()
    entry = entry_of(options.name)
    settings = assignments(options.settings)
    modes = automaton(declared(entry, options, settings))
    equations = modes.together.equations
    axes = [_axis(name, text) for name, text in assignments(options.axis).items()]
    numbers = _numbers(entry, equations, options, settings, axes)
    warn_of_radians(assignments(options.start) | {a.name: a.last for a in axes}, equations)
    first, last = ({**n.parameters, **n.start} for n in numbers)
    spread: dict[Any, Any] = {
        axis.name: np.linspace(float(first[axis.name]), float(last[axis.name]), axis.count)
        for axis in axes
    }
    usual: dict[str, Output] = {"fate": Fate(), "duration": Duration()}
    with _resumable(), terminating_like_interrupt() if options.workers > 1 else nullcontext():
        sweep(
            modes,
            spread,
            {name: v for name, v in numbers[0].parameters.items() if name not in spread},
            {name: v for name, v in numbers[0].start.items() if name not in spread},
            numbers[0].duration,
            out=options.out,
            outputs={**usual, **{name: Final(name) for name in options.keep}},
            workers=options.workers,
            address=options.scheduler,
            resume=options.resume,
            forcing=dict(numbers[0].forcing),
            until=options.until or None,
            progress=terminal_progress(),
        )
    store = open_store(options.out)
    document: dict[str, Any] = {
        "members": int(np.prod([axis.count for axis in axes])),
        "failed": store.failed(),
        "store": str(options.out),
        "seconds": time.perf_counter() - began,
    }
    if options.json:
        print_document(document)
    else:
        counts = (f"{document['members']} members,", f"{document['failed']} failed,")
        print("\n".join(wrapped("sweep", [*counts, f"{document['seconds']:.1f} s"])))
        if example := store.failure():
            print("\n".join(wrapped("for instance", example.split())))
        print("\n".join(wrapped("store", [document["store"]])))
    return 0


@contextmanager
def _resumable() -> Iterator[None]:
    """Say in the message of an interrupt how to continue."""
    try:
        yield
    except KeyboardInterrupt as interrupt:
        interrupt.add_note("continue with --resume")
        raise


@dataclass(frozen=True)
class _Axis:
    """Equally spaced values; the ends are texts with their units."""

    name: str
    first: str
    last: str
    count: int


def _axis(name: str, text: str) -> _Axis:
    parts = [part.strip() for part in text.split(":")]
    if len(parts) != 3 or not all(parts) or not parts[2].isdecimal():
        raise ParseError(
            f"the axis {name}={text!r}",
            expected="FROM:TO:COUNT, with units on the ends",
            advice="for instance --axis omega_3=0rad/s:60rad/s:200",
        )
    count = int(parts[2])
    if not 1 <= count <= _MOST:
        raise ParseError(f"{count} values of {name}", expected=f"from 1 to {_MOST}")
    return _Axis(name, parts[0], parts[1], count)


def _numbers(
    entry: CatalogueEntry,
    equations: Equations,
    options: Namespace,
    settings: Mapping[str, str],
    axes: list[_Axis],
) -> tuple[RunNumbers, RunNumbers]:
    """The numbers at the first values of all axes, and at the last."""
    constants = {*entry.defaults, *(s.published for s in equations.parameters)}
    start = assignments(options.start)
    for axis in axes:
        if axis.name in settings or axis.name in start:
            raise ParseError(f"{axis.name} is both an axis and a value", expected="only one")
    # Numbers are resolved with all axes at their first values and again at their last: what
    # differs although it is no axis is a default that follows an axis, such as I = 2 m a²/5.
    ends = []
    for end in ("first", "last"):
        values = {axis.name: getattr(axis, end) for axis in axes}
        varied = {name: text for name, text in values.items() if name in constants}
        initial = {name: text for name, text in values.items() if name not in constants}
        chosen, begin = {**settings, **varied}, {**start, **initial}
        ends.append(numbers_of(entry, equations, chosen, begin, options.duration))
    first, last = ends
    _refuse_dependent(first, last, {axis.name for axis in axes})
    return first, last


def _refuse_dependent(first: RunNumbers, last: RunNumbers, axes: set[str]) -> None:
    """Refuse parameters whose default depends on one that varies along an axis."""
    before, after = ({**n.parameters, **n.start} for n in (first, last))
    for name, value in before.items():
        if name not in axes and value != after[name]:
            raise DeclarationError(
                f"the default of {name} depends on a quantity that varies along an axis",
                expected=f"one value of {name} for all motions, or an axis for {name} too",
                advice=f"add --set {name}=...",
            )

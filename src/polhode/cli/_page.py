"""Write a page that plays a motion, or a live one that computes motions by itself."""

from __future__ import annotations

import re
from argparse import Namespace
from collections.abc import Iterator
from typing import Any

from polhode.algebra import Expr
from polhode.catalogue import about_with, cases_of, numbers_of
from polhode.cli._motion import MotionWanted, add_motion_options, motion_wanted
from polhode.cli._parser import PAGES, Parser, assignments, refuse_other_endings
from polhode.cli._printing import print_document
from polhode.derive import Equations
from polhode.simulate import simulate

_INSTANT = 1e-3  # of the duration of a case, enough to have its start
_ROUNDING = 1e-15

_EXAMPLES = """examples:
  polhode page rolling-disk -o disk.html
  polhode page rolling-disk --live -o disk.html
  polhode page gyroscope --case c --live -o cusps.html
  polhode page rings.py:roll --live --duration 20s -o ring.html
"""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.epilog = _EXAMPLES
    add_motion_options(parser)
    parser.add_switch("--live", "let the page compute motions by itself, with sliders")
    parser.add_file("-o FILE.html", "file to write", dest="file", required=True)
    parser.set_defaults(events=[], period="")
    parser.add_json()


def run(options: Namespace) -> int:
    """Write the page of one system."""
    refuse_other_endings("-o", options.file, PAGES)
    wanted = motion_wanted(options, lettered=options.live)
    entry, motion = wanted.entry, wanted.followed()
    from polhode.cli._run_files import write_page  # deferred: it loads the figures

    about = about_with(entry, wanted.system)
    written = wanted.written if options.live else None
    presets = dict(_presets(wanted)) if options.live else None
    duration = wanted.numbers.duration
    path = write_page(options.file, entry, about, motion, (), written, duration, presets)
    if options.json:
        print_document({"system": entry.name, "live": options.live, "file": str(path)})
    else:
        print(path)
    return 0


def _presets(wanted: MotionWanted) -> Iterator[tuple[str, dict[str, float]]]:
    """The cases of a system that differ from its motion in numbers alone, by what they ask."""
    entry, equations, options = wanted.entry, wanted.equations, wanted.options
    given, known = assignments(options.settings), wanted.numbers.parameters
    for case in cases_of(entry):
        if case.sheet or case.mu != options.mu or not known.keys() >= case.settings.keys():
            continue
        settings = {**given, **case.settings}
        numbers = numbers_of(entry, equations, settings, case.start, case.duration)
        motion = simulate(
            wanted.modes,
            dict[Any, Any](numbers.parameters) | dict(wanted.letters),
            numbers.start,
            numbers.duration * _INSTANT,
            forcing=numbers.forcing,
        )
        state = {k: _without_rounding(v) for k, v in motion.segments[0].state(0.0).items()}
        changed = {k: v for k, v in numbers.parameters.items() if v != known[k]}
        yield _in_letters(case.asks, equations), {**changed, **state, "duration": numbers.duration}


def _without_rounding(value: float) -> float:
    """A start value of which dense output, a series, has left about 1e-16 where it is zero."""
    return value if abs(value) > _ROUNDING else 0.0


def _in_letters(words: str, equations: Equations) -> str:
    """Words with letters in place of the names of coordinates, speeds and parameters."""
    symbols = (*equations.coordinates, *equations.speeds, *equations.dependent)
    for symbol in symbols:
        words = re.sub(rf"\b{symbol.published}\b", Expr.generator(symbol).pretty(), words)
    return words.replace("sqrt(", "√(")

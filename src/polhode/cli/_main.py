"""The program `polhode`: loads and runs the requested command, and reports what failed."""

from __future__ import annotations

import gc
import sys
import warnings
from collections.abc import Sequence
from contextlib import suppress
from importlib import import_module
from types import ModuleType
from warnings import catch_warnings, simplefilter

from polhode.base import DriftWarning, installed_version
from polhode.cli._exit import report
from polhode.cli._parser import Parser

COMMANDS = {
    "list": "the systems of the catalogue",
    "derive": "equations of motion and reactions of a system",
    "run": "simulate a system",
    "steady": "steady motions of a system, and their stability",
    "invariants": "first integrals of a system",
    "exact": "the closed form of a motion, compared with its simulation",
    "check": "judge a published equation against a system",
    "audit": "judge every claim of a document, such as the problem set",
    "lab": "play with a system in the browser",
    "sweep": "simulate a system over a grid of values",
    "map": "draw what a sweep found",
    "tour": "work through the whole catalogue and write a page of it",
    "cache": "the cache of compiled systems",
}


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns its exit code.

    Args:
        argv: the arguments after `polhode`; by default those of the process.
    """
    for stream in (sys.stdout, sys.stderr):
        with suppress(AttributeError):  # a stream that stands in for the terminal's
            stream.reconfigure(errors="replace")  # type: ignore[union-attr]
    arguments = sys.argv[1:] if argv is None else list(argv)
    try:
        with catch_warnings():
            simplefilter("ignore")  # warnings of libraries: what matters comes as an error
            simplefilter("always", DriftWarning)
            warnings.showwarning = _show_warning
            options = _parser(arguments).parse_args(arguments)
            code = int(options.run(options))
        sys.stdout.flush()
    except SystemExit as leaving:  # argparse, after --help and --version
        return int(leaving.code or 0)
    except BaseException as error:
        return report(error)
    return code


def _parser(arguments: Sequence[str]) -> Parser:
    """The parser; only the requested command is loaded."""
    parser = Parser(
        prog="polhode",
        description="Rigid-body mechanics: declare once, derive exactly, check, simulate, look.",
        epilog="See 'polhode COMMAND --help' for one command, and 'polhode list' for the systems.",
    )
    wanted = "--version" in arguments[:1]  # looked up only then: it takes a while
    version = f"polhode {installed_version('polhode') or '(not installed)'}" if wanted else ""
    parser.add_argument("--version", action="version", version=version)
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, summary in COMMANDS.items():
        command = commands.add_parser(name, help=summary)
        if name in arguments[:1]:
            module = _loaded(name)
            command.description = module.__doc__
            module.configure(command)
            command.set_defaults(run=module.run)
    return parser


def _loaded(command: str) -> ModuleType:
    """The module of a command, imported with garbage collection off: nothing becomes garbage."""
    gc.disable()
    try:
        return import_module(f"polhode.cli._{command}")
    finally:
        gc.enable()


def _show_warning(message: Warning | str, *_: object, **__: object) -> None:
    print(f"polhode: warning: {message}", file=sys.stderr)

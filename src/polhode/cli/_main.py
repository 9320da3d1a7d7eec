"""The program `polhode`: loads and runs the requested command, and reports what failed."""

from __future__ import annotations

import gc
import sys
import warnings
from collections.abc import Sequence
from importlib import import_module
from types import ModuleType
from warnings import catch_warnings, simplefilter

from polhode.base import DriftWarning, Exit, ParseError, did_you_mean, installed_version
from polhode.cli._exit import report
from polhode.cli._parser import Parser
from polhode.cli._streams import flush_output, prepare_streams

COMMANDS = {
    "list": "the systems of the catalogue",
    "derive": "equations of motion and reactions of a system",
    "run": "simulate a system",
    "page": "write a page that plays a motion, or computes motions by itself",
    "steady": "steady motions of a system, and their stability",
    "invariants": "first integrals of a system",
    "leaves": "where contacts open or slip along a level of the energy",
    "lagrangian": "Lagrangian, momenta and Lagrange's equations",
    "linearise": "linear equations of small departures from steady motions",
    "vectors": "angular velocity, velocity, momentum and forces along chosen axes",
    "fictitious": "centrifugal, Coriolis and Euler torques in a turning frame",
    "exact": "closed form of a motion, compared with its simulation",
    "solve": "a worked solution in which every formula was judged",
    "exercise": "exercises with numbers drawn from a seed, and their answers marked",
    "export": "equations of motion as NumPy, C, JAX or Julia source",
    "check": "judge a published equation against a system",
    "audit": "judge every claim of a document, such as the problem set",
    "read": "read the formulas of documents: LaTeX, Markdown, notebooks",
    "review": "mark every line of a derivation: a solution, a lecture note, an appendix",
    "serve-marks": "mark the answers of learning platforms",
    "lab": "explore systems in the browser",
    "sweep": "simulate a system over a grid of values",
    "map": "draw the results of a sweep",
    "tour": "work through the whole catalogue and write it up as web pages",
    "cache": "the cache of compiled systems",
}

_OPTIONS = ("-h", "--help", "--version")


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns its exit code.

    Args:
        argv: the arguments after `polhode`; by default those of the process.
    """
    prepare_streams()
    arguments = sys.argv[1:] if argv is None else list(argv)
    if not arguments:
        _parser(arguments).print_help(sys.stderr)
        return Exit.REFUSED
    if arguments[0] == "help":
        arguments = [*arguments[1:2], "--help"]
    try:
        _refuse_unknown(arguments[0])
        with catch_warnings():
            simplefilter("ignore")  # those of libraries; polhode raises errors where it matters
            simplefilter("always", DriftWarning)
            warnings.showwarning = _show_warning
            options = _parser(arguments).parse_args(arguments)
            code = int(options.run(options))
        flush_output()
    except SystemExit as leaving:  # argparse, after --help and --version
        return int(leaving.code or 0)
    except BaseException as error:
        return report(error)
    return code


def _parser(arguments: Sequence[str]) -> Parser:
    """The parser; only the requested command is loaded."""
    parser = Parser(
        prog="polhode",
        description="Rigid-body mechanics: declare a system once; derive its equations exactly, "
        "check\npublished ones against them, simulate, and draw.",
        epilog="See 'polhode COMMAND --help' for the options of a command, and 'polhode list' for "
        "the systems.",
    )
    # Looking up the installed version takes a while, so it is done only if it is to be printed.
    is_asked = "--version" in arguments[:1]
    version = f"polhode {installed_version('polhode') or '(not installed)'}" if is_asked else ""
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


def _refuse_unknown(command: str) -> None:
    if command in COMMANDS or command in _OPTIONS:
        return
    if command.startswith("-"):
        advice = did_you_mean(command, _OPTIONS, 0.6) or "see 'polhode --help'"
        raise ParseError(f"polhode has no option {command}", advice=advice)
    meant = [name for name, summary in COMMANDS.items() if command in summary.split()]
    raise ParseError(
        f"{command!r} is no command",
        expected=f"one of {', '.join(COMMANDS)}",
        advice=f"did you mean {' or '.join(meant)}?" if meant else did_you_mean(command, COMMANDS),
    )


def _loaded(command: str) -> ModuleType:
    """The module of a command; what imports make lasts, and would only cost the collector time."""
    gc.disable()
    try:
        return import_module(f"polhode.cli._{command.replace('-', '_')}")
    finally:
        gc.freeze()
        gc.enable()


def _show_warning(message: Warning | str, *_: object, **__: object) -> None:
    print(f"polhode: warning: {message}", file=sys.stderr)

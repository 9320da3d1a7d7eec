"""Serve marks to learning platforms: an answer or a derivation in, marks and feedback out."""

from __future__ import annotations

import os
from argparse import Namespace

from polhode.base import ParseError
from polhode.cli._parser import NAME_HELP, Parser
from polhode.cli._systems import entry_of
from polhode.judge import Hints
from polhode.judge.service import ServiceSettings, serve_marks

_EPILOG = """\
POST / takes the JSON of lambdafeedback's evaluation functions, PrairieLearn's data.json, or
{"text": ..., "asked": ...}; GET /health tells whether it is up. docs/marking.md has examples.
With the environment variable POLHODE_MARKS_KEY, requests have to show it as a bearer token."""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_option("--system NAME", NAME_HELP, required=True)
    parser.add_option("--port P", "port to listen at (default: 8651)", type=int, default=None)
    parser.add_option(
        "--host H",
        "address to listen at (default: 127.0.0.1, which only this machine can reach)",
        default="127.0.0.1",
    )
    parser.add_argument(
        "--hints",
        choices=[hints.value for hints in Hints],
        default=Hints.WHERE.value,
        help="how much is shown of a wrong line: where it is (default), also the kind of slip, or "
        "also the correction",
    )
    parser.add_option(
        "--seconds S", "that one answer may take (default: 20)", type=float, default=20.0
    )
    parser.add_option(
        "--wait S",
        "that one may wait for a worker before it is turned away (default: 60)",
        type=float,
        default=60.0,
    )
    parser.add_option("--workers N", "answers at a time (default: 2)", type=int, default=2)
    parser.epilog = _EPILOG


def run(options: Namespace) -> int:
    """Serve marks until the command is interrupted."""
    if options.port is not None and not 0 <= options.port < 65536:
        raise ParseError(f"--port {options.port}", expected="a number from 0 to 65535")
    if not 1 <= options.workers <= 64:
        raise ParseError(f"--workers {options.workers}", expected="a number from 1 to 64")
    if not 0.1 <= options.seconds <= 600:
        raise ParseError(f"--seconds {options.seconds:g}", expected="a number from 0.1 to 600")
    if not 0.1 <= options.wait <= 3600:
        raise ParseError(f"--wait {options.wait:g}", expected="a number from 0.1 to 3600")
    settings = ServiceSettings(
        hints=Hints(options.hints),
        seconds=options.seconds,
        workers=options.workers,
        longest_wait=options.wait,
        key=os.environ.get("POLHODE_MARKS_KEY", ""),
    )
    system = entry_of(options.system).build()
    serve_marks(system, settings, host=options.host, port=options.port)
    return 0

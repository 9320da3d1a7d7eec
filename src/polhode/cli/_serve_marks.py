"""Serve marks to learning platforms: an answer or a derivation in, marks and feedback out."""

from __future__ import annotations

import os
from argparse import Namespace

from polhode.base import ParseError
from polhode.cli._parser import Parser
from polhode.cli._systems import NAME_HELP, entry_of
from polhode.review import Hints
from polhode.review.service import ServiceSettings, serve_marks

_EPILOG = """\
POST / takes the JSON of lambdafeedback's evaluation functions, PrairieLearn's data.json, or
{"text": ..., "asked": ...}; GET /health tells whether it is up. docs/marking.md has examples.
With the environment variable POLHODE_MARKS_KEY, requests have to show it as a bearer token."""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_argument("--system", required=True, metavar="NAME", help=NAME_HELP)
    parser.add_argument("--port", type=int, metavar="P", help="port to listen at (default: 8651)")
    parser.add_argument(
        "--host",
        default="127.0.0.1",
        metavar="H",
        help="address to listen at (default: 127.0.0.1, which only this machine can reach)",
    )
    parser.add_argument(
        "--hints",
        choices=[hints.value for hints in Hints],
        default=Hints.WHERE.value,
        help="how much is told of a wrong line: where it is (default), also the kind of slip, or "
        "also the correction",
    )
    parser.add_argument(
        "--seconds",
        type=float,
        default=20.0,
        metavar="S",
        help="that one answer may take (default: 20)",
    )
    parser.add_argument(
        "--workers", type=int, default=2, metavar="N", help="answers at a time (default: 2)"
    )
    parser.epilog = _EPILOG


def run(options: Namespace) -> int:
    """Serve marks until the command is interrupted."""
    if options.port is not None and not 0 <= options.port < 65536:
        raise ParseError(f"--port {options.port}", expected="a number from 0 to 65535")
    if not 1 <= options.workers <= 64:
        raise ParseError(f"--workers {options.workers}", expected="a number from 1 to 64")
    if not 0.1 <= options.seconds <= 600:
        raise ParseError(f"--seconds {options.seconds:g}", expected="a number from 0.1 to 600")
    settings = ServiceSettings(
        hints=Hints(options.hints),
        seconds=options.seconds,
        workers=options.workers,
        key=os.environ.get("POLHODE_MARKS_KEY", ""),
    )
    system = entry_of(options.system).build()
    serve_marks(system, settings, host=options.host, port=options.port)
    return 0

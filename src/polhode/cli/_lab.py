"""Explore systems in the browser with sliders, steady motions and claims; served locally."""

from __future__ import annotations

from argparse import Namespace

from polhode.base import ParseError
from polhode.catalogue import CATALOGUE
from polhode.cli._parser import Parser
from polhode.cli._systems import entry_of
from polhode.lab import Own, serve


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "name",
        metavar="FILE.py:NAME",
        nargs="?",
        default="",
        help="a System of your own, offered along with the catalogue",
    )
    parser.add_option("--port P", "local port (default: 8650)")
    parser.add_switch("--no-browser", "do not open a browser")


def run(options: Namespace) -> int:
    """Serve the lab until it is interrupted."""
    own = None
    if options.name and options.name not in CATALOGUE:
        own = Own.of(entry_of(options.name))
    port = options.port
    digits = port.lstrip("0") or "0"
    # Its length is checked first: int() of thousands of digits would raise.
    is_port = port.isascii() and port.isdigit() and len(digits) < 6 and int(digits) < 65536
    if port and not is_port:
        raise ParseError(f"--port {port}", expected="a number from 0 to 65535, 0 for any free one")
    serve(own, port=int(digits) if port else None, browser=not options.no_browser)
    return 0

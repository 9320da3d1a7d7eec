"""The cache on disk, which keeps compiled systems between runs."""

from __future__ import annotations

from argparse import Namespace

from polhode.base import cache
from polhode.cli._parser import Parser


def configure(parser: Parser) -> None:
    """Add the actions on the cache."""
    parser.add_argument("action", choices=("clear",), help="clear: delete all its entries")


def run(options: Namespace) -> int:
    """Empty the cache."""
    print(f"freed {cache.clear()} bytes in {cache.directory()}")
    return 0

"""Work through the whole catalogue (derive, check, simulate, draw) and write it up as web pages."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from polhode.base import Exit, terminal_progress
from polhode.cli._parser import Parser
from polhode.tour import write_tour


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "directory",
        metavar="DIR",
        nargs="?",
        default="tour",
        help="folder for index.html and its figures (default: tour)",
    )


def run(options: Namespace) -> int:
    """Write the tour and print its checks; exit 1 if one of them fails."""
    progress = terminal_progress()

    def show(text: str) -> None:
        progress.finish()  # clears the progress line; the next step draws it again
        print(text, flush=True)

    report = write_tour(Path(options.directory), progress, show)
    print(f"{report.table()}\n\n{report.audit_table()}")
    print(f"\nwritten to {report.page}")
    return Exit.DONE if report.all_hold else Exit.FAILED

"""Write a page that plays a motion, or a live one that computes motions by itself."""

from __future__ import annotations

from argparse import Namespace

from polhode.catalogue import about_with
from polhode.cli._motion import add_motion_options, motion_wanted
from polhode.cli._parser import PAGES, Parser, refuse_other_endings
from polhode.cli._printing import print_document

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
    duration = wanted.numbers.duration
    path = write_page(options.file, entry, about, motion, (), written, duration)
    if options.json:
        print_document({"system": entry.name, "live": options.live, "file": str(path)})
    else:
        print(path)
    return 0

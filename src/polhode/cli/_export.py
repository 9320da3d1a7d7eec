"""The equations of a system as source code in another language."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from polhode.base import write_whole
from polhode.cli._parser import Parser
from polhode.cli._printing import print_document
from polhode.cli._systems import NAME_HELP, entry_of
from polhode.derive import derive
from polhode.simulate import LANGUAGES, export

_EXAMPLES = """examples:
  polhode export rolling-disk --to c -o disk.c
  polhode export gyroscope --to jax -o gyroscope.py
"""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.epilog = _EXAMPLES
    parser.add_argument("name", metavar="NAME", help=NAME_HELP)
    parser.add_argument(
        "--to", metavar="LANGUAGE", required=True, help=f"one of {', '.join(LANGUAGES)}"
    )
    parser.add_argument(
        "-o", dest="file", metavar="FILE", type=Path, help="file to write (default: print it)"
    )
    parser.add_argument("--json", action="store_true", help="print one JSON document")


def run(options: Namespace) -> int:
    """Write the source code of one system."""
    entry = entry_of(options.name)
    source = export(derive(entry.build()), options.to)
    if options.file is not None:
        write_whole(options.file, source.encode("utf-8"))
    if options.json:
        where = {"file": str(options.file)} if options.file else {"source": source}
        print_document({"system": entry.name, "to": options.to, **where})
    else:
        print(options.file or source)
    return 0

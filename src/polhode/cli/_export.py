"""The equations of a system as source code in another language."""

from __future__ import annotations

from argparse import Namespace

from polhode.base import write_whole
from polhode.cli._parser import Parser
from polhode.cli._printing import print_document
from polhode.cli._systems import entry_of
from polhode.derive import derive
from polhode.simulate import LANGUAGES, export

_EXAMPLES = """examples:
  polhode export rolling-disk --to c -o disk.c
  polhode export gyroscope --to jax -o gyroscope.py
"""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.epilog = _EXAMPLES
    parser.add_system()
    parser.add_option("--to LANGUAGE", f"one of {', '.join(LANGUAGES)}", required=True)
    parser.add_file("-o FILE", "file to write (default: print it)", dest="file")
    parser.add_json()


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

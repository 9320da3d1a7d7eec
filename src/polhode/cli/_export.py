"""The equations of a system as source code in another language, or as a WebAssembly module."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Mapping
from typing import Any

from polhode.base import DeclarationError, write_whole
from polhode.catalogue import CatalogueEntry, numbers_of
from polhode.cli._parser import Parser
from polhode.cli._printing import print_document
from polhode.cli._systems import entry_of
from polhode.derive import Equations, derive
from polhode.simulate import KERNEL, LANGUAGES, export

_EXAMPLES = """examples:
  polhode export rolling-disk --to c -o disk.c
  polhode export gyroscope --to jax -o gyroscope.py
  polhode export rolling-disk --to wasm -o disk.wasm
"""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.epilog = _EXAMPLES
    parser.add_system()
    parser.add_option("--to LANGUAGE", f"one of {', '.join((*LANGUAGES, KERNEL))}", required=True)
    parser.add_file("-o FILE", "file to write (default: print it)", dest="file")
    parser.add_json()


def run(options: Namespace) -> int:
    """Write the source code of one system."""
    entry = entry_of(options.name)
    equations = derive(entry.build())
    if options.to == KERNEL:
        if options.file is None:
            raise DeclarationError(
                "a WebAssembly module, which is no text",
                expected="a file to write it to",
                advice=f"add -o {entry.name.replace('/', '-')}.wasm",
            )
        source: str | bytes = export(equations, KERNEL, *_values(entry, equations))
    else:
        source = export(equations, options.to)
    if options.file is not None:
        write_whole(options.file, source.encode("utf-8") if isinstance(source, str) else source)
    if options.json:
        where = {"file": str(options.file)} if options.file else {"source": source}
        print_document({"system": entry.name, "to": options.to, **where})
    else:
        print(options.file or source)
    return 0


def _values(entry: CatalogueEntry, equations: Equations) -> Iterator[Mapping[Any, Any]]:
    """Parameters, start values and prescribed functions; none for a system without numbers."""
    if entry.parameters or entry.start:
        numbers = numbers_of(entry, equations)
        yield from (numbers.parameters, numbers.start, numbers.forcing)

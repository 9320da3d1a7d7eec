"""Judge every claim of a document, by default all equations of the problem set."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterable
from pathlib import Path

from polhode.base import Exit
from polhode.catalogue import entry_named_in
from polhode.cli._parser import PAGES, Parser, refuse_other_endings
from polhode.cli._printing import print_document
from polhode.cli._systems import entry_of
from polhode.judge import Document, audit, document_of
from polhode.model import System

_EPILOG = """\
A part of a document names a system of the catalogue, or one that --system declares:
  polhode audit heavy-top.toml --system top.py:top
A document states what its letters mean in [part.bindings]. Where it does not, and a letter may be
read in several ways, the reading under which most lines of a part hold is taken for the whole part
and stated above its lines; a line that is true only in another reading is ambiguous.
The answers are explained in 'polhode check --help', the format in docs/claims-format.md."""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "file", nargs="?", type=Path, metavar="FILE", help="a document of claims, in TOML"
    )
    parser.add_list(
        "--only ID",
        "judge only this claim, or these: --only 3 --only 7 or --only 3,7; the others of its "
        "part still count for how an ambiguous letter is read",
    )
    parser.add_list(
        "--system FILE.py:NAME",
        "a System of your own, which parts of the document call NAME; OTHER=FILE.py:NAME if they "
        "call it OTHER; may be repeated. A document itself cannot name a file",
        dest="systems",
    )
    parser.add_file("--html F.html", "also write the report as a web page")
    parser.add_json()
    parser.epilog = _EPILOG


def run(options: Namespace) -> int:
    """Judge all claims and print the report; exit 0 if all hold, 1 if one fails, 2 if one is open.

    Raises:
        DeclarationError: for one that names a system which is not in the catalogue.
        StoreError: for a document that cannot be read, and a page that cannot be written.
    """
    refuse_other_endings("--html", options.html, PAGES)
    document = document_of(options.file)
    systems = dict(map(_own_system, options.systems))
    for part in document.parts:
        if part.system not in systems:
            entry_named_in(str(options.file), part.system, advice="--system FILE.py:NAME")
    report = audit(document, systems=systems, only=_selected(document, options.only))
    if options.html is not None:
        from polhode.judge import audit_page

        audit_page(report, options.html)
    if options.json:
        print_document(report.to_json())
    else:
        print(report)
    if report.left:
        return Exit.INTERRUPTED
    if report.failures:
        return Exit.FAILED
    open_ = report.counts["unread"] or report.counts["ambiguous"]
    return Exit.REFUSED if open_ else Exit.DONE


def _own_system(text: str) -> tuple[str, System]:
    """A system of the command line, with the name that a document has for it."""
    name, equals, path = text.partition("=")
    if not equals:
        name, path = text.rpartition(":")[2], text
    return name.strip(), entry_of(path.strip()).build()


def _selected(document: Document, only: Iterable[str]) -> list[str]:
    """The ids selected; several may stand in one option, unless an id itself has a comma."""
    known = {claim.id for claim in document.claims}
    return [id.strip() for text in only for id in ([text] if text in known else text.split(","))]

"""Read the formulas of documents: LaTeX, Markdown, notebooks, reStructuredText, Typst, Lean."""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Iterable, Iterator
from pathlib import Path

from polhode.base import Exit, PolhodeError, terminal_progress
from polhode.cli._exit import report
from polhode.cli._parser import Parser
from polhode.cli._printing import in_one_line, print_document, printable
from polhode.judge import SourceRelation, read_documents


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "files",
        nargs="+",
        type=Path,
        metavar="FILE",
        help="a document: .tex, .md, .ipynb, .rst, .lean, .typ, or a text with formulas in $...$",
    )
    parser.add_json()


def run(options: Namespace) -> int:
    """Print every relation; exit 0 if all of mechanics were read, 2 if one or a file was not."""
    found: list[SourceRelation] = []
    failed: list[PolhodeError] = []
    progress = terminal_progress()
    progress.begin("reading", len(options.files))
    for document in read_documents(options.files):
        progress.advance()
        found += document.relations
        failed += document.refused
    progress.finish()
    if options.json:
        print_document({"relations": [relation.to_json() for relation in found]})
    elif found or not failed:
        print("\n".join([*_lines(found), _summary(found)]))
    sys.stdout.flush()
    for error in failed:
        report(error)
    is_complete = not failed and all(r.read for r in found if r.in_scope)
    return Exit.DONE if is_complete else Exit.REFUSED


def _lines(relations: Iterable[SourceRelation]) -> Iterator[str]:
    for relation in relations:
        place = f"{relation.file}:{relation.line}:{relation.column}"
        yield printable(f"{place}: {_outcome(relation)}")
        yield f"    {in_one_line(relation.printed or relation.latex)}"


def _outcome(relation: SourceRelation) -> str:
    if not relation.in_scope:
        return relation.why
    if not relation.read:
        return f"unread: {in_one_line(relation.why)}"
    names = ", ".join(relation.undefined)
    return f"read, with {in_one_line(names)} as printed, defined nowhere" if names else "read"


def _summary(relations: list[SourceRelation]) -> str:
    inside = [relation for relation in relations if relation.in_scope]
    read = sum(relation.read for relation in inside)
    beyond = len(relations) - len(inside)
    count = f"{len(relations)} relation{'s' * (len(relations) != 1)}"
    return f"{count}: {read} read, {len(inside) - read} unread, {beyond} out of scope"

"""Review derivations: the lines proved wrong in each, and a mark for every other."""

from __future__ import annotations

import sys
import textwrap
from argparse import Namespace
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from polhode.base import Exit, ParseError, StopRequested, read_whole, terminal_progress
from polhode.catalogue import CatalogueEntry, entry_named_in
from polhode.cli._exit import Interruptible
from polhode.cli._parser import NAME_HELP, Parser
from polhode.cli._printing import WIDEST, in_one_line, print_document, printable
from polhode.cli._review_outputs import add_outputs, refuse_outputs, run_batch, write_outputs
from polhode.cli._systems import entry_of
from polhode.derive import Equations, derive
from polhode.judge import (
    SIGNS,
    TITLES,
    Mark,
    Review,
    ReviewedLine,
    github_annotations,
    message_parts,
    named_system,
    proposed_systems,
    review_files,
)

_COUNTED = {
    **TITLES,
    Mark.ERROR: "wrong",
    Mark.DOUBT: "in doubt",
    Mark.FOLLOWS: "wrong since another is",
    Mark.UNLINKED: "true without following",
    Mark.NEEDS: "in need of a condition",
}
_PLAIN_SIGNS = {
    **SIGNS,
    Mark.TRUE: "+",
    Mark.ERROR: "x",
    Mark.DOUBT: "~",
    Mark.FOLLOWS: ">",
    Mark.NOT_JUDGED: ".",
}
_EPILOG = """\
The marks, one for every relation of the text:
  ✓ true           holds on the model, in the context named
  ✗ error          proved to be wrong by itself: a slip, or terms of different dimensions
  ≟ doubt          does not hold as it was read, but nothing proves that it is a slip
  ↳ follows        wrong only because an earlier line is
  ? does not follow  true, but not implied by the wrong line that it is drawn from
  ! needs          true under a condition that the text has not stated, or in one reading
  · not judged     a definition, an assumption, or not read, for the reason given

A system of the catalogue may also be named in a comment at the top: % polhode: rolling-disk
Exit 0 if no line is proved to be wrong, 1 if one is, 2 for a file that cannot be read or without
a system."""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "files",
        nargs="+",
        type=Path,
        metavar="FILE",
        help="a derivation: .tex, .md, .ipynb or .typ; with --marks also a folder of them",
    )
    parser.add_option(
        "--system NAME",
        f"what it is about: {NAME_HELP}; by default the one named in a comment at its top",
    )
    parser.add_json()
    add_outputs(parser)
    parser.epilog = _EPILOG


def run(options: Namespace) -> int:
    """Print every line with its mark; exit 1 if one is wrong by itself."""
    refuse_outputs(options)
    if options.marks is not None:
        return run_batch(options)
    entry = entry_of(options.system) if options.system else _named(options.files)
    notes = _contradicting(options.files, options.system or entry.name)
    equations = derive(entry.build())
    found, is_whole = _reviewed(options.files, equations)
    found = replace(found, notes=(*found.notes, *notes))
    shown = write_outputs(options, found, equations)
    if options.json:
        print_document(shown.to_json())
    elif options.format == "github":
        print("\n".join(map(printable, github_annotations(shown).split("\n"))))
    else:
        print("\n".join(map(printable, _lines(shown))))
    if not is_whole:
        return Exit.INTERRUPTED
    return Exit.FAILED if found.errors else Exit.DONE


def _reviewed(files: list[Path], equations: Equations) -> tuple[Review, bool]:
    """The review, and whether it is whole: an interrupt keeps the parts that are judged."""
    progress = Interruptible(terminal_progress())
    told = list[ReviewedLine]()

    def tell(line: ReviewedLine) -> None:
        told.append(line)
        progress.advance()

    progress.begin("reviewing")
    try:
        return review_files(files, equations, tell=tell), True
    except StopRequested:
        note = "interrupted: what stands behind these lines was not reviewed"
        names = tuple(map(str, files))
        return Review(equations.system.name, names, tuple(told), notes=(note,)), False
    finally:
        progress.finish()


def _named(files: list[Path]) -> CatalogueEntry:
    """The system that the first text to name one does.

    Raises:
        DeclarationError: for one that is not in the catalogue.
        ParseError: with a proposal, where no text names one.
    """
    texts = [_text(path) for path in files]
    for path, text in zip(files, texts, strict=True):
        if name := named_system([text]):
            return entry_named_in(str(path), name, advice="--system FILE.py:NAME")
    proposed = proposed_systems(texts)
    advice = " or ".join(f"--system {name}" for name in proposed)
    raise ParseError(
        "a text that does not name its system",
        expected="--system NAME, or a comment at the top such as % polhode: rolling-disk",
        advice=f"by its words it may be {advice}" if proposed else "see polhode list",
    )


def _contradicting(files: list[Path], name: str) -> tuple[str, ...]:
    """What to say of texts whose comments name another system than the one that is taken."""
    named = ((path, named_system([_text(path)])) for path in files)
    return tuple(
        f"{path} names {other} in a comment, but was reviewed on {name}"
        for path, other in named
        if other and other != name
    )


def _text(path: Path) -> str:
    return read_whole(path, "a file").decode("utf-8", errors="replace")


# -- the text with its marks -----------------------------------------------------------------------


def _lines(review: Review) -> Iterator[str]:
    file = part = ""
    are_several = len({line.file for line in review.lines}) > 1
    for line in review.lines:
        if line.file != file and are_several:
            file, part = line.file, ""
            yield f"{file}:"
        if line.part and line.part != part:
            part = line.part
            yield f"-- {part} --"
        yield from _of_line(line, review)
    yield ""
    yield from (f"note: {note}" for note in review.notes)
    yield from _summary(review)


def _of_line(line: ReviewedLine, review: Review) -> Iterator[str]:
    yield f"  {_sign(line.mark)} {line.line:4}  {in_one_line(line.latex)}"
    is_plain = line.context in ("motion", "identity") and not line.read_as
    if line.mark is Mark.TRUE and is_plain:
        return
    indent = " " * 10
    for part in message_parts(line, review):
        yield from textwrap.wrap(
            part,
            WIDEST,
            initial_indent=indent,
            subsequent_indent=f"{indent}  ",
            break_long_words=False,
        )


def _sign(mark: Mark) -> str:
    """The sign of a mark, by one of ASCII where standard output has no other: "?" is a mark too."""
    try:
        SIGNS[mark].encode(sys.stdout.encoding or "utf-8")
    except UnicodeEncodeError:
        return _PLAIN_SIGNS[mark]
    return SIGNS[mark]


def _summary(review: Review) -> Iterator[str]:
    total = len(review.lines)
    counts = (f"{count} {_COUNTED[mark]}" for mark, count in review.summary.items() if count)
    of_each = ", ".join(counts) or "nothing to review"
    yield f"{total} relation{'s' * (total != 1)} on {review.system}: {of_each}"
    yield f"{review.judged:.0%} of them judged"
    for line in review.errors[:1]:
        yield f"first error: {line.file}:{line.line}:{line.column}"
    for final in review.finals:
        yield f"final answer, line {final.line}: {TITLES[final.mark]}"

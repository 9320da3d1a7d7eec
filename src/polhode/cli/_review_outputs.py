"""What a review is written to: a page, files for editors and checks, tables of a whole class."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterable
from pathlib import Path

from polhode.base import Exit, ParseError, StoreError, terminal_progress
from polhode.cli._exit import Interruptible
from polhode.cli._parser import PAGES, Parser, refuse_other_endings
from polhode.cli._printing import printable
from polhode.cli._systems import entry_of
from polhode.derive import Equations
from polhode.judge import Hints, Review, with_hints, write_sarif

_TABLES = (".csv",)
_LOGS = (".sarif", ".json")


def add_outputs(parser: Parser) -> None:
    """Add the options that say where marks go, and how much they tell."""
    parser.add_file("--html F.html", "also write a page with the text and its marks")
    parser.add_argument(
        "--hints",
        choices=[hints.value for hints in Hints],
        default=Hints.CORRECTION.value,
        help="how much every output says about a line that is not marked true: where it is, also "
        "the kind of slip with a state that refutes it, or (default) also the correction",
    )
    parser.add_file("--sarif F.sarif", "also write SARIF 2.1.0, for editors and code scanning")
    parser.add_argument(
        "--format",
        choices=["text", "github"],
        default="text",
        help="what is printed: text (default), or workflow commands that annotate lines on GitHub",
    )
    parser.add_file(
        "--report F.html",
        "also write a report for referees: what was read, what holds under which "
        "assumptions, which results survive the errors",
    )
    parser.add_file(
        "--marks F.csv",
        "review each FILE, and each document or folder in a FOLDER, by itself; write tables "
        "by submission, line and slip. A run that was stopped goes on where it was",
    )
    parser.add_option(
        "--workers N", "processes that --marks uses (default: 2)", type=int, default=2
    )


def refuse_outputs(options: Namespace) -> None:
    """Refuse options that contradict one another, before anything is computed.

    Raises:
        ParseError: for such options.
        StoreError: for the name of a file whose ending stands for another format.
    """
    refuse_other_endings("--html", options.html, PAGES)
    refuse_other_endings("--report", options.report, PAGES)
    refuse_other_endings("--sarif", options.sarif, _LOGS)
    refuse_other_endings("--marks", options.marks, _TABLES)
    if options.report is not None and options.hints != Hints.CORRECTION.value:
        raise ParseError(
            f"--report with --hints {options.hints}", expected="one of them: a report tells all"
        )
    folders = [path for path in options.files if path.is_dir()]
    if folders and options.marks is None:
        raise ParseError(
            f"{folders[0]} is a folder", expected="a file", advice="--marks F.csv reviews folders"
        )
    if options.json and options.format != "text":
        raise ParseError(
            f"--json with --format {options.format}", expected="one of them: both print to stdout"
        )
    if options.marks is not None:
        others = ("html", "report", "sarif", "json")
        given = [f"--{name}" for name in others if getattr(options, name)]
        if given or options.format != "text":
            raise ParseError(
                f"--marks with {', '.join(given) or '--format'}",
                expected="--marks alone: its tables are of many submissions",
            )
        if not options.system:
            raise ParseError("--marks without a system", expected="--system NAME")


def write_outputs(options: Namespace, review: Review, equations: Equations) -> Review:
    """Write the files that the options name; returns the review with what may be told.

    Raises:
        StoreError: for a file that cannot be written.
    """
    hints = Hints(options.hints)
    shown = with_hints(review, hints)
    if options.html is not None:
        from polhode.judge import review_page

        review_page(review, options.html, equations, hints)
    if options.report is not None:
        from polhode.judge import referee_report

        referee_report(review, equations, options.report)
    if options.sarif is not None:
        write_sarif(shown, options.sarif)
    return shown


def _refuse_among_submissions(marks: Path, given: Iterable[Path]) -> None:
    """Refuse tables in a folder of submissions.

    The log beside them holds marks that are not computed again: whoever hands in a file of its name
    would write their own.
    """
    for folder in given:
        if folder.is_dir() and marks.resolve().is_relative_to(folder.resolve()):
            raise StoreError(
                f"--marks {marks}, which lies in the folder of submissions {folder}",
                expected="a file outside it: a submission could bring a log with marks of its own",
                advice=f"for instance --marks {marks.name} in another folder",
            )


def run_batch(options: Namespace) -> int:
    """Review submissions one by one and write their marks.

    Exit 1 if a line is wrong by itself, else 2 if a submission could not be reviewed, else 0.

    Raises:
        StoreError: for files that cannot be read or written.
    """
    from polhode.judge.batch import review_batch, submissions, write_marks

    found = submissions(options.files)
    system = entry_of(options.system).build()
    log = options.marks.with_suffix(".jsonl")
    _refuse_among_submissions(options.marks, options.files)
    progress = Interruptible(terminal_progress())
    batch = review_batch(found, system, log, workers=options.workers, progress=progress)
    paths = write_marks(batch, options.marks)
    wrong = sum(record.has_errors for record in batch.records.values())
    unread = [(n, record.problem) for n, record in batch.records.items() if record.problem]
    kept = f", {batch.kept} of them in an earlier run" if batch.kept else ""
    cut_short = f", {len(unread)} not reviewed, or not to the end" if unread else ""
    print(
        f"{len(batch.records)} of {len(found)} submissions done{kept}: "
        f"{wrong} with an error{cut_short}"
    )
    for name, problem in unread:
        print(printable(problem if problem.startswith(name) else f"{name}: {problem}"))
    print(f"written: {', '.join(map(str, paths))}")
    if batch.left:
        print(f"{len(batch.left)} are left; the same command goes on with them")
        return Exit.INTERRUPTED
    if wrong:
        return Exit.FAILED
    return Exit.REFUSED if unread else Exit.DONE

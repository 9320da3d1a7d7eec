"""Marks of many submissions as tables: one row for each of them, each line, and each slip."""

from __future__ import annotations

import csv
import io
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from polhode.base import PolhodeError, write_whole
from polhode.judge._reviewed import Mark
from polhode.judge.batch._batch import Batch
from polhode.judge.latex import read_latex, write_latex

Row = Sequence[object]

_FORMULA = ("=", "+", "-", "@", "\t", "\r")  # with which spreadsheets begin a formula
_SUBMISSIONS = (
    "submission", "relations", *(mark.value for mark in Mark), "final", "first_error_line",
    "first_error", "slip", "correction", "group", "problem", "notes", "seconds",
)  # fmt: skip
_LINES = (
    "submission", "file", "line", "column", "part", "latex", "mark", "of_line", "needs", "context",
    "slip", "correction", "group", "final", "reason",
)  # fmt: skip
_SLIPS = ("group", "submissions", "part", "slip", "written", "correction", "made_by")


@dataclass(frozen=True)
class Slip:
    """A slip, with all who made it.

    Attributes:
        number: the most frequent slip has 1.
        part: of the text, such as "Problem 2 (b)".
        what: the kind of slip; empty where no correction was found.
        correction: the corrected relation; empty where none was found.
        written: what most of them wrote.
        made_by: names of the submissions.
    """

    number: int
    part: str
    what: str
    correction: str
    written: str
    made_by: tuple[str, ...]


SlipKey = tuple[str, str, str]
"""What makes two slips the same: the part of the text, the kind of slip, and the relation."""


def slips(batch: Batch) -> dict[SlipKey, Slip]:
    """The first errors of all submissions, the most frequent ones first.

    Two of them are the same if they stand in the same part and have the same correction, or, where
    none was found, are written the same.
    """
    found: dict[SlipKey, list[tuple[str, Mapping[str, Any]]]] = defaultdict(list)
    for name, record in batch.records.items():
        for line in record.lines:
            if line["mark"] == Mark.ERROR.value:
                found[slip_key(line)].append((name, line))
    ordered = sorted(found.items(), key=lambda item: (-len({n for n, _ in item[1]}), item[0]))
    return {key: _slip(i, key, made) for i, (key, made) in enumerate(ordered, start=1)}


def slip_key(line: Mapping[str, Any]) -> SlipKey:
    """The slip of a line that is wrong by itself."""
    correction = line["correction"] or {"what": "", "latex": line["latex"]}
    return line["part"], correction["what"], _as_read(correction["latex"])


def _as_read(latex: str) -> str:
    """A relation as the reader has it, however it is spaced; as it is if it cannot be read."""
    try:
        relations = read_latex(latex).relations
    except PolhodeError:
        return "".join(latex.split())
    return ", ".join(map(write_latex, relations))


def _slip(number: int, key: SlipKey, made: Sequence[tuple[str, Mapping[str, Any]]]) -> Slip:
    part, what, _ = key
    written, _ = Counter(" ".join(line["latex"].split()) for _, line in made).most_common(1)[0]
    correction = next(
        line["correction"] for _, line in made if " ".join(line["latex"].split()) == written
    )
    names = tuple(dict.fromkeys(name for name, _ in made))
    return Slip(number, part, what, correction["latex"] if correction else "", written, names)


def write_marks(batch: Batch, path: Path) -> tuple[Path, ...]:
    """Write three tables: by submission, and beside it by line and by slip.

    With ``marks.csv`` the others are ``marks.lines.csv`` and ``marks.slips.csv``. A cell that a
    spreadsheet would take for a formula begins with an apostrophe.

    Returns:
        The files.

    Raises:
        StoreError: where they cannot be written.
    """
    found = slips(batch)
    tables = {
        path: (_SUBMISSIONS, _submission_rows(batch, found)),
        path.with_suffix(".lines.csv"): (_LINES, _line_rows(batch, found)),
        path.with_suffix(".slips.csv"): (_SLIPS, _slip_rows(found.values())),
    }
    for place, (header, rows) in tables.items():
        write_whole(place, csv_text(header, rows).encode("utf-8"))
    return tuple(tables)


def csv_text(header: Sequence[str], rows: Iterable[Row]) -> str:
    """A table as RFC 4180 describes it, with nothing that a spreadsheet would compute."""
    stream = io.StringIO()
    writer = csv.writer(stream)
    writer.writerow(header)
    writer.writerows([_cell(value) for value in row] for row in rows)
    return stream.getvalue()


def _cell(value: object) -> object:
    if not isinstance(value, str):
        return "" if value is None else value
    # Names of files may hold bytes that are no text, and null characters end a table for some.
    text = value.encode("utf-8", "replace").decode("utf-8").replace("\0", "\ufffd")
    return f"'{text}" if text.startswith(_FORMULA) else text


def _submission_rows(batch: Batch, found: Mapping[SlipKey, Slip]) -> Iterator[Row]:
    for name, record in batch.records.items():
        counts = Counter(line["mark"] for line in record.lines)
        final = next((line["mark"] for line in reversed(record.lines) if line["final"]), "")
        wrong = [line for line in record.lines if line["mark"] == Mark.ERROR.value]
        first = wrong[0] if wrong else None
        told = (
            (f"line {first['line']}", " ".join(first["latex"].split()), *_slip_cells(first, found))
            if first
            else ("",) * 5
        )
        marks = (counts[mark.value] for mark in Mark)
        seconds = round(record.seconds, 2)
        notes = "; ".join(record.notes)
        yield name, len(record.lines), *marks, final, *told, record.problem, notes, seconds
    for name in batch.left:
        yield name, *("",) * (len(_SUBMISSIONS) - 4), "not reviewed: interrupted", "", ""


def _line_rows(batch: Batch, found: Mapping[SlipKey, Slip]) -> Iterator[Row]:
    for name, record in batch.records.items():
        for line in record.lines:
            of = "" if line["of"] is None else record.lines[line["of"]]["line"]
            place = (line[key] for key in ("file", "line", "column", "part"))
            said = (line["mark"], of, line["needs"], line["context"], *_slip_cells(line, found))
            latex = " ".join(line["latex"].split())
            yield name, *place, latex, *said, "yes" if line["final"] else "", line["reason"]


def _slip_cells(line: Mapping[str, Any], found: Mapping[SlipKey, Slip]) -> tuple[object, ...]:
    """The kind of slip, the correction, and the number of its group."""
    correction = line["correction"] or {"what": "", "latex": ""}
    group = found[slip_key(line)].number if line["mark"] == Mark.ERROR.value else ""
    return correction["what"], correction["latex"], group


def _slip_rows(found: Iterable[Slip]) -> Iterator[Row]:
    for slip in found:
        made = "; ".join(slip.made_by)
        written = (slip.part, slip.what, slip.written, slip.correction)
        yield slip.number, len(slip.made_by), *written, made

"""The path of a sheet, read from a table."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import isfinite
from pathlib import Path

import numpy as np

from polhode.base import ParseError, read_whole
from polhode.simulate.forcing._pieces import Pieces
from polhode.simulate.forcing._spline import sampled
from polhode.simulate.integrate._stepping import Array

_NEEDED = ("t", "x", "y")
_OPTIONAL = ("angle", "segment")
_LARGEST = 1e12  # beyond it a number is taken for a slip, in s, m and rad
_CLOSEST = 1e-9  # of the whole time: rows closer than that are one row twice, with its rounding
_SHOWN = 40  # characters of the file that a message repeats


@dataclass(frozen=True)
class SheetPath:
    """How a sheet is moved: place of its origin in the lab, and the angle it is turned by.

    Attributes:
        X: m.
        Y: m.
        angle: rad.
    """

    X: Pieces
    Y: Pieces
    angle: Pieces


def read_sheet(path: str | Path, *, noise: float = 0.0) -> SheetPath:
    """Read the path of a sheet from a CSV file.

    Its header is `t,x,y`, optionally with `angle` and `segment`; all is in SI units. The sheet is
    at rest before the first row and after the last. It starts from rest and stops at once. Every
    segment is a smooth spline of its own; from one to the next the velocity jumps, at the last row
    of the earlier one. A segment may repeat that row's time: repeated with another place, the
    sheet is shifted in no time. Lines that begin with # are skipped.

    Args:
        path: the file.
        noise: standard deviation of places (m) and angles (rad), which are then smoothed.

    Raises:
        ParseError: for a table that is not such a path, with the number of the line.
        StoreError: for a file that cannot be read.
    """
    lines = _lines(Path(path))
    columns = _columns(next(lines, _Line(1, [])))
    rows = [_row(line, columns) for line in lines]
    starts = _starts(rows)
    _refuse_disorder(rows, starts)
    times = np.array([row.numbers["t"] for row in rows])
    _refuse_gaps(rows, times, starts)

    def curve(name: str) -> Pieces:
        values = np.array([row.numbers.get(name, 0.0) for row in rows])
        return sampled(times, values, starts=starts, noise=noise)

    return SheetPath(curve("x"), curve("y"), curve("angle"))


@dataclass(frozen=True)
class _Line:
    number: int
    cells: list[str]


@dataclass(frozen=True)
class _Row:
    line: int
    numbers: dict[str, float]
    segment: str


def _lines(path: Path) -> Iterator[_Line]:
    """The lines of a table, without comments and without the empty ones at its end."""
    content = read_whole(path, "a file of comma-separated text")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise _bad(line, "bytes that are no text", "a file of comma-separated text") from error
    reader = csv.reader(io.StringIO(text.rstrip(), newline=""), strict=True)
    try:
        for cells in reader:
            if not cells or not cells[0].startswith("#"):
                yield _Line(reader.line_num, [cell.strip() for cell in cells])
    except csv.Error as error:
        raise _bad(
            reader.line_num, f"a line that is no row ({error})", "a row of numbers"
        ) from error


def _columns(header: _Line) -> list[str]:
    names = header.cells
    wrong = [name for name in names if name not in (*_NEEDED, *_OPTIONAL)]
    missing = [name for name in _NEEDED if name not in names]
    if wrong or missing or len(set(names)) < len(names):
        raise _bad(
            header.number,
            f"the header {_shown(','.join(names))}",
            "t,x,y, optionally with angle and segment",
        )
    return names


def _row(line: _Line, columns: Sequence[str]) -> _Row:
    if len(line.cells) != len(columns):
        raise _bad(
            line.number,
            f"{len(line.cells)} cells" if line.cells else "an empty line",
            f"one for each of {','.join(columns)}",
        )
    cells = dict(zip(columns, line.cells, strict=True))
    segment = cells.pop("segment", "only")
    if not segment:
        raise _bad(line.number, "no segment", "the name or number of one")
    numbers = {name: _number(line.number, name, cell) for name, cell in cells.items()}
    return _Row(line.number, numbers, segment)


def _number(line: int, name: str, cell: str) -> float:
    if not cell:
        raise _bad(line, f"no {name}", "a value in every row")
    try:
        value = float(cell.replace("_", "?"))
    except ValueError:
        raise _bad(line, f"{name} = {_shown(cell)}", "a number in SI units") from None
    if not isfinite(value) or abs(value) > _LARGEST:
        raise _bad(line, f"{name} = {_shown(cell)}", f"a number not beyond {_LARGEST:g}")
    return value


def _starts(rows: Sequence[_Row]) -> tuple[int, ...]:
    """Which rows begin a segment, besides the first."""
    if len(rows) < 2:
        raise ParseError(f"a sheet with {len(rows)} rows", expected="at least two rows to move by")
    starts = [i for i in range(1, len(rows)) if rows[i].segment != rows[i - 1].segment]
    known = {rows[0].segment}
    for i in starts:
        if rows[i].segment in known:
            raise _bad(
                rows[i].line,
                f"segment {_shown(rows[i].segment)} once more",
                "all rows of a segment together",
            )
        known.add(rows[i].segment)
    for first, stop in pairwise((0, *starts, len(rows))):
        if stop - first < 2:
            shown = _shown(rows[first].segment)
            raise _bad(rows[first].line, f"segment {shown} with one row", "at least two")
    return tuple(starts)


def _refuse_disorder(rows: Sequence[_Row], starts: Sequence[int]) -> None:
    least = _CLOSEST * abs(rows[-1].numbers["t"] - rows[0].numbers["t"])
    for i, (before, row) in enumerate(pairwise(rows), start=1):
        earlier, now = before.numbers["t"], row.numbers["t"]
        if now < earlier or (now == earlier and i not in starts):
            raise _bad(row.line, f"t = {now:.9g} after {earlier:.9g}", "times that increase")
        if now - earlier < least and i not in starts:
            raise _bad(
                row.line,
                f"t = {now:.17g} right after {earlier:.17g}",
                f"rows at least {least:.1g} s apart, a billionth of the whole",
            )


def _refuse_gaps(rows: Sequence[_Row], times: Array, starts: Sequence[int]) -> None:
    """Between segments nothing is known of the path; a step of the rows is bridged, no more."""
    bounds = (0, *starts, len(rows))
    for first, start, stop in zip(bounds[:-2], bounds[1:-1], bounds[2:], strict=True):
        gap = times[start] - times[start - 1]
        longest = max(np.diff(times[first:start]).max(), np.diff(times[start:stop]).max())
        if gap > longest * (1 + 1e-6):
            raise _bad(
                rows[start].line,
                f"{gap:.6g} s without a row before segment {_shown(rows[start].segment)}",
                "a segment that starts when the one before it ends",
            )


def _bad(line: int, given: str, expected: str) -> ParseError:
    return ParseError(
        f"line {line} of the sheet: {given}", expected=expected, advice="see docs/forcing.md"
    )


def _shown(text: str) -> str:
    return repr(text if len(text) <= _SHOWN else f"{text[:_SHOWN]}…")

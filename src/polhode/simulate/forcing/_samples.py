"""Functions of time from samples: smooth curves through or near them, and sheet files."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import isfinite
from pathlib import Path

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import ArrayLike

from polhode.base import NumericError, ParseError, read_whole
from polhode.simulate.forcing._pieces import Pieces
from polhode.simulate.forcing._splines import spline_near, spline_through
from polhode.simulate.integrate._stepping import Array

_LEAST_TO_SMOOTH = 3  # samples: two are joined by a straight line, which has no curvature
# Decades of the penalty on curvature, for a time in mean steps between samples: from a curve
# through all samples to a straight line.
_SOFTEST, _STIFFEST = -12.0, 12.0
_STIFFNESS = 1e-4  # to which the power of ten of a stiffness is found


def sampled(
    times: ArrayLike,
    values: ArrayLike,
    *,
    starts: Sequence[int] = (),
    noise: float = 0.0,
) -> Pieces:
    """A function of time from samples: cubic splines with continuous acceleration.

    It is constant before the first sample, starts from rest there and stops abruptly at the last.
    Its rate jumps where a new segment starts. A segment continues from the end of the previous
    one; if its first sample repeats that time with another value, the value jumps.

    Args:
        times: s, increasing within a segment.
        values: one for each time.
        starts: indices of the samples that begin a new segment, apart from the first.
        noise: standard deviation of the values. The curve is then the smoothest one at that root
            mean square distance from them, and its value never jumps.

    Raises:
        NumericError: for times that do not increase, values that are not finite, a noise that is
            negative, and segments with too few samples.
    """
    t, x = np.asarray(times, dtype=float), np.asarray(values, dtype=float)
    _refuse(t, x, starts, noise)
    knots, tables, corners = t[:1], list[Array](), list[int]()
    for first, stop in pairwise((0, *starts, len(t))):
        own, through = t[first:stop], x[first:stop]
        if first:
            corners.append(len(knots) - 1)
            own, through = _joined(own, through, knots, tables[-1], noise)
        with np.errstate(all="ignore"):  # `Pieces` refuses what overflows
            clamped = not first  # only the first segment starts from rest
            if noise:
                tables.append(_near(own, through, noise, clamped))
            else:
                tables.append(_through(own, through, clamped))
        knots = np.concatenate([knots, own[1:]])
    return Pieces(knots, np.vstack(tables), tuple(corners))


def _joined(
    own: Array, through: Array, knots: Array, table: Array, noise: float
) -> tuple[Array, Array]:
    """The samples of a segment, preceded by the end of the previous one."""
    ended = polynomial.polyval(knots[-1] - knots[-2], table[-1])
    if own[0] > knots[-1]:
        return np.concatenate([knots[-1:], own]), np.concatenate([[ended], through])
    return own, np.concatenate([[ended], through[1:]]) if noise else through


def _through(t: Array, x: Array, clamped: bool) -> Array:
    """Coefficients of the interpolating spline, clamped or not-a-knot at its ends."""
    if len(t) == 2:
        rate, bend = (x[1] - x[0]) / (t[1] - t[0]), 0.0
        if clamped:
            rate, bend = 0.0, rate / (t[1] - t[0])
        return np.array([[x[0], rate, bend, 0.0]])
    return spline_through(t, x, (clamped, False))


def _near(t: Array, x: Array, noise: float, clamped: bool) -> Array:
    """Coefficients of the smoothest curve whose r.m.s. distance from the samples is the noise.

    The samples are reflected to earlier times: as an even function for a start from rest, as an
    odd one about the first sample otherwise. Symmetry then makes the rate or the displacement of
    the curve zero at the first sample.
    """
    step = float(t[-1] - t[0]) / (len(t) - 1)
    since = (t - t[0]) / step
    sign = 1.0 if clamped else -1.0
    begin = 0.0 if clamped else x[0]
    mirrored = np.concatenate([-since[:0:-1], since])
    samples = np.concatenate([sign * (x[:0:-1] - begin), x - begin])
    table = _discrepant(mirrored, samples, noise)[len(t) - 1 :]
    table = table / step ** np.arange(4)
    table[0, 1 if clamped else 0] = 0.0
    table[:, 0] += begin
    return table


def _discrepant(t: Array, x: Array, noise: float) -> Array:
    """The smoothing spline at a given r.m.s. distance from its samples (Reinsch 1967)."""

    def excess(stiffness: float) -> float:
        _, values = spline_near(t, x, 10.0**stiffness)
        return float(np.sqrt(np.mean((values - x) ** 2))) - noise

    # it grows with the stiffness
    softest, stiffest = _SOFTEST, _STIFFEST
    if excess(softest) > 0:
        stiffest = softest
    elif excess(stiffest) < 0:
        softest = stiffest
    while stiffest - softest > _STIFFNESS:
        middle = (softest + stiffest) / 2
        softest, stiffest = (middle, stiffest) if excess(middle) < 0 else (softest, middle)
    return spline_near(t, x, 10.0 ** ((softest + stiffest) / 2))[0]


def _refuse(t: Array, x: Array, starts: Sequence[int], noise: float) -> None:
    if t.ndim != 1 or t.shape != x.shape:
        raise NumericError(
            f"samples of shape {x.shape} at times of shape {t.shape}",
            expected="one value for each time",
        )
    if not (np.all(np.isfinite(t)) and np.all(np.isfinite(x))):
        raise NumericError("samples that are not finite", expected="numbers")
    if not (isfinite(noise) and noise >= 0):
        raise NumericError(f"a noise of {noise:g}", expected="a standard deviation, or 0 for none")
    least = _LEAST_TO_SMOOTH if noise else 2
    bounds = (0, *starts, len(t))
    if min(stop - first for first, stop in pairwise(bounds)) < least:
        raise NumericError(
            f"{len(t)} samples in segments that begin at samples {bounds[:-1]}",
            expected=f"increasing indices, and at least {least} samples in every segment",
        )
    allowed = np.isin(np.arange(1, len(t)), starts)  # a segment may begin when the last one ends
    wrong = np.flatnonzero((np.diff(t) < 0) | ((np.diff(t) == 0) & ~allowed))
    if len(wrong):
        raise NumericError(
            f"the sample at {t[wrong[0] + 1]:g} s after the one at {t[wrong[0]]:g} s",
            expected="times that increase",
        )


# -- the path of a sheet, read from a table --------------------------------------------------------

_NEEDED = ("t", "x", "y")
_OPTIONAL = ("angle", "segment")
_LARGEST = 1e12  # s, m and rad; a larger number is taken for a mistake
_CLOSEST = 1e-9  # of the whole time: closer rows are taken for a repeated row
_SHOWN = 40  # characters of the file that a message repeats


@dataclass(frozen=True)
class SheetPath:
    """Motion of a sheet: position of its origin in the lab, and the angle it is turned by.

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
    at rest before the first row and after the last. It starts from rest and stops abruptly. Every
    segment is a smooth spline; between two segments the velocity jumps, at the last row of the
    earlier one. If a segment repeats the time of that row with another position, the sheet is
    displaced instantaneously. Lines that begin with # are skipped.

    Args:
        path: the file.
        noise: standard deviation of positions (m) and angles (rad), which are then smoothed.

    Raises:
        ParseError: for a table that is not such a path, with the line number.
        StoreError: for a file that cannot be read.
    """
    lines = _lines(Path(path))
    columns = _columns(next(lines, _Line(1, [])))
    rows = [_row(line, columns) for line in lines]
    starts = _starts(rows)
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
    """The lines of a table, without comments and trailing empty lines."""
    content = read_whole(path, "a file of comma-separated text")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise _bad(
            line, "bytes that are not UTF-8 text", "a file of comma-separated text"
        ) from error
    reader = csv.reader(io.StringIO(text.rstrip(), newline=""), strict=True)
    try:
        for cells in reader:
            if not cells or not cells[0].startswith("#"):
                yield _Line(reader.line_num, [cell.strip() for cell in cells])
    except csv.Error as error:
        raise _bad(reader.line_num, f"a malformed row ({error})", "a row of numbers") from error


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
    numbers = dict[str, float]()
    for name, cell in cells.items():
        if not cell:
            raise _bad(line.number, f"no {name}", "a value in every row")
        try:
            value = float(cell.replace("_", "?"))
        except ValueError:
            given = f"{name} = {_shown(cell)}"
            raise _bad(line.number, given, "a number in SI units") from None
        if not isfinite(value) or abs(value) > _LARGEST:
            expected = f"a number not beyond {_LARGEST:g}"
            raise _bad(line.number, f"{name} = {_shown(cell)}", expected)
        numbers[name] = value
    return _Row(line.number, numbers, segment)


def _starts(rows: Sequence[_Row]) -> tuple[int, ...]:
    """Indices of the rows that begin a segment, besides the first."""
    if len(rows) < 2:
        raise ParseError(f"a sheet with {len(rows)} rows", expected="at least two rows to move by")
    starts = [i for i in range(1, len(rows)) if rows[i].segment != rows[i - 1].segment]
    known = {rows[0].segment}
    for i in starts:
        if rows[i].segment in known:
            raise _bad(
                rows[i].line,
                f"segment {_shown(rows[i].segment)} again",
                "all rows of a segment together",
            )
        known.add(rows[i].segment)
    for first, stop in pairwise((0, *starts, len(rows))):
        if stop - first < 2:
            shown = _shown(rows[first].segment)
            raise _bad(rows[first].line, f"segment {shown} with one row", "at least two")
    return tuple(starts)


def _refuse_gaps(rows: Sequence[_Row], times: Array, starts: Sequence[int]) -> None:
    """Refuse gaps between segments longer than the steps within them: the path there is unknown."""
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

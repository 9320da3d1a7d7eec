"""The tour's report on the terminal."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain, groupby
from pathlib import Path
from textwrap import shorten, wrap

from polhode.tour._claims import JudgedClaim, counted
from polhode.tour._formulas import power_of_ten
from polhode.tour._work import Worked


@dataclass(frozen=True)
class Row:
    """One system in the closing table.

    Attributes:
        system: name in the catalogue.
        equations: number of equations of motion.
        reactions: number of reaction components.
        passed: checks that hold.
        checks: checks made.
        energy_drift: largest along the run, relative to the energy.
        constraint_drift: largest along the run, m.
        seconds: spent on deriving, checking, running and drawing.
        judged: formulas displayed in its solution, every one judged.
    """

    system: str
    equations: int
    reactions: int
    passed: int
    checks: int
    energy_drift: float
    constraint_drift: float
    seconds: float
    judged: int = 0

    @property
    def cells(self) -> tuple[str, ...]:
        """As printed."""
        return (
            self.system,
            str(self.judged),
            str(self.equations),
            str(self.reactions),
            f"{self.passed} of {self.checks}",
            power_of_ten(self.energy_drift),
            power_of_ten(self.constraint_drift, "m"),
            f"{self.seconds:.1f}",
        )


_WIDEST = 100  # characters of a correction or reason
_BELOW = " " * 7  # indent of the lines below a claim
HEADER = (
    "system",
    "judged",
    "equations",
    "reactions",
    "checks",
    "energy drift",
    "constraint drift",
    "s",
)


@dataclass(frozen=True)
class TourReport:
    """The results of the tour.

    Attributes:
        page: the front page.
        rows: one for each system.
        claims: with their verdicts.
    """

    page: Path
    rows: tuple[Row, ...]
    claims: tuple[JudgedClaim, ...] = ()

    @property
    def all_hold(self) -> bool:
        """Whether every check of every system holds."""
        return all(row.passed == row.checks for row in self.rows)

    def table(self) -> str:
        """The rows under their header, aligned."""
        lines = [HEADER, *(row.cells for row in self.rows)]
        first, *widths = (max(map(len, column)) for column in zip(*lines, strict=True))
        return "\n".join(
            "  ".join(
                [
                    f"{name:<{first}}",
                    *(f"{cell:>{width}}" for cell, width in zip(cells, widths, strict=True)),
                ]
            )
            for name, *cells in lines
        )

    def audit_table(self) -> str:
        """Verdicts on the claims about each problem, then those that fail, with corrections."""
        grouped: dict[str, list[JudgedClaim]] = {}
        for claim in self.claims:
            grouped.setdefault(claim.problem, []).append(claim)
        width = max(map(len, grouped), default=0)
        counts = [f"{problem:<{width}}  {counted(found)}" for problem, found in grouped.items()]
        failed = [claim for claim in self.claims if claim.answer == "fails"]
        lines = [
            line
            for (part, convention), found in groupby(failed, lambda claim: claim.place)
            for line in (*_heading(part, convention), *chain(*map(_failure, found)))
        ]
        return "\n".join([*self._said(), *counts, "", *lines])

    def _said(self) -> Iterator[str]:
        """How many formulas the solutions display."""
        judged = [row.judged for row in self.rows if row.judged]
        if judged:
            yield f"{sum(judged)} formulas displayed in {len(judged)} solutions, every one judged"
            yield ""


def _heading(part: str, convention: str) -> Iterator[str]:
    """A part of the text and its convention."""
    if part:
        yield part
    yield from wrap(convention, _WIDEST, initial_indent="  ", subsequent_indent="  ")


def _failure(claim: JudgedClaim) -> Iterator[str]:
    said = f"holds as  {claim.correction}" if claim.correction else claim.reason
    yield f"{claim.id:>5}  fails; {shorten(said, _WIDEST, placeholder=' …')}"
    if claim.notes:
        yield f"{_BELOW}printed: {shorten(claim.stated, _WIDEST, placeholder=' …')}"
    for note in claim.notes:
        yield f"{_BELOW}{note.label}: {shorten(note.text, _WIDEST, placeholder=' …')}"
    if claim.readings:
        yield f"{_BELOW}letters: {'; '.join(map(str, claim.readings))}"


def row_of(worked: Worked) -> Row:
    """The row of a system."""
    return Row(
        system=worked.entry.name,
        equations=len(worked.equations.motion),
        reactions=len(worked.equations.components),
        passed=worked.passed,
        checks=len(worked.checks),
        energy_drift=worked.run.drift.energy,
        constraint_drift=worked.constraint_drift,
        seconds=worked.seconds,
        judged=worked.judged,
    )


def text_of(worked: Worked) -> str:
    """A system as the terminal shows it: equations, reactions, checks."""
    entry = worked.entry
    marks = {True: "✓", False: "✗"}
    checks = (f"  {marks[check.passed]} {check.name}: {check.found}" for check in worked.checks)
    title = f"{entry.title} ({entry.name})"
    return "\n".join([title, "─" * len(title), str(worked.equations), "Checks", *checks, ""])

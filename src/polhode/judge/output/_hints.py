"""How much of what was found is shown: where a line is wrong, what kind of slip, the correction."""

from __future__ import annotations

from dataclasses import replace
from enum import Enum

from polhode.judge._reviewed import Mark, Review, ReviewedLine
from polhode.judge._verdict import Correction, Verdict


class Hints(Enum):
    """How much a student is shown of a line that is not simply true."""

    WHERE = "where"
    KIND = "kind"
    CORRECTION = "correction"


def with_hints(review: Review, hints: Hints) -> Review:
    """A review without what is to be withheld, so that nothing made from it can show it.

    With `Hints.WHERE` lines keep their mark alone; with `Hints.KIND` the kind of slip and the state
    that refutes a line remain as well. A line that holds, and the reason why one was not judged,
    are shown in either case.

    Args:
        review: as it was found.
        hints: how much is to be told.
    """
    if hints is Hints.CORRECTION:
        return review
    lines = tuple(_withheld(line, hints) for line in review.lines)
    return replace(review, lines=lines)


def _withheld(line: ReviewedLine, hints: Hints) -> ReviewedLine:
    if line.mark is Mark.TRUE:
        return line
    reason = line.reason if line.mark is Mark.NOT_JUDGED else ""
    line = replace(line, tried=())
    verdict = line.verdict and _without_answer(line.verdict, hints)
    return replace(line, needs="", reason=reason, verdict=verdict)


def _without_answer(verdict: Verdict, hints: Hints) -> Verdict:
    """A verdict with its answer and readings, and perhaps the kind of slip, but no more."""
    bare = Verdict(verdict.answer, verdict.context, readings=verdict.readings)
    if hints is Hints.WHERE:
        return bare
    found = verdict.correction
    return replace(
        bare,
        correction=found and Correction(kind_of_slip(found), ""),
        counterexample=verdict.counterexample,
        confirmation=verdict.confirmation,
    )


def kind_of_slip(correction: Correction) -> str:
    """The kind of slip that a correction mends, without what is right in its place."""
    kinds = (
        "wrong function" if " is right" in what else what for what in correction.what.split("; ")
    )
    return "; ".join(dict.fromkeys(kinds))

"""The report of an audit, with verdicts and consequences of failures, as a table or plain data."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from textwrap import shorten, wrap
from typing import Any

from polhode.base import SCHEMA, Shown
from polhode.judge._verdict import Answer, Verdict, certainty
from polhode.judge.document._document import Claim, Document, Note, Part
from polhode.judge.document._part_readings import PartReading

_WIDEST = 110  # characters of the remark on a claim
_WIDE = 100  # characters of a line of words
_INDENT = "  "
_BELOW = " " * 10  # where the line of a claim names its system
_EXPLAINED = (Answer.AMBIGUOUS, Answer.UNREAD)  # answers of which the reason is the content


@dataclass(frozen=True)
class Judged:
    """One claim with its verdict.

    Attributes:
        claim: of the document.
        system: name of the system it is about.
        verdict: the judgement.
        fed_by: failed claims that it follows from, directly or through others.
        convention: of axes, angles and letters in its part of the text, in words.
    """

    claim: Claim
    system: str
    verdict: Verdict
    fed_by: tuple[str, ...] = ()
    convention: str = ""

    @property
    def answer(self) -> Answer:
        """The answer of its verdict."""
        return self.verdict.answer

    @property
    def notes(self) -> tuple[Note, ...]:
        """How it was read beyond what is printed, and what is to be said with the verdict."""
        remarks = (Note("note", remark) for remark in self.verdict.remarks)
        return (*self.claim.notes, *remarks)


@dataclass(frozen=True)
class Consequence:
    """The claims derived from one that fails.

    Attributes:
        failed: id of that claim.
        feeds: ids of the judged claims derived from it, directly or through others.
        results: those of them from which nothing more is derived.
        surviving: those of the results that hold nevertheless.
        unjudged: those of the results that are definitions, which are not judged.
    """

    failed: str
    feeds: tuple[str, ...]
    results: tuple[str, ...]
    surviving: tuple[str, ...]
    unjudged: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"({self.failed}) {self.summary}"

    @property
    def summary(self) -> str:
        """What it feeds, and which results survive, in words."""
        if not self.feeds:
            return "feeds no other claim"
        lost = [id for id in self.results if id not in (*self.surviving, *self.unjudged)]
        text = f"feeds {_listed(self.feeds)}"
        if self.surviving:
            text += f"; results that survive: {_listed(self.surviving)}"
        if lost:
            text += f"; results that do not: {_listed(lost)}"
        return text + (f"; not judged: {_listed(self.unjudged)}" if self.unjudged else "")


@dataclass(frozen=True, repr=False)
class Report(Shown):
    """The verdicts on the claims of a document, in its order.

    Attributes:
        document: what the text states.
        judged: the claims judged.
        left: ids of claims not reached before an interruption.
        seconds: duration of the audit.
        readings: proposed for letters of several meanings, each for a whole part.
    """

    document: Document
    judged: tuple[Judged, ...]
    left: tuple[str, ...] = ()
    seconds: float = 0.0
    readings: tuple[PartReading, ...] = ()

    @property
    def counts(self) -> dict[str, int]:
        """How many claims got each answer."""
        return counted(self.judged)

    @property
    def failures(self) -> tuple[Judged, ...]:
        """The claims that fail."""
        return tuple(j for j in self.judged if j.answer is Answer.FAILS)

    @property
    def consequences(self) -> tuple[Consequence, ...]:
        """The consequences of every claim that fails."""
        return tuple(self._consequence(j.claim.id) for j in self.failures)

    def _consequence(self, failed: str) -> Consequence:
        verdicts = {j.claim.id: j.verdict for j in self.judged}
        feeds = tuple(id for id in self.document.consequences(failed) if id in verdicts)
        results = tuple(id for id in feeds if not self.document.consequences(id))
        surviving = tuple(id for id in results if verdicts[id].holds)
        defined = tuple(id for id in results if verdicts[id].answer is Answer.DEFINITION)
        return Consequence(failed, feeds, results, surviving, defined)

    def by_part(self) -> tuple[tuple[Part, tuple[Judged, ...]], ...]:
        """The judged claims by part of the text, without empty parts."""
        grouped = (
            (part, tuple(j for j in self.judged if j.claim.part == part.id))
            for part in self.document.parts
        )
        return tuple((part, found) for part, found in grouped if found)

    def conventions(self, part: Part) -> tuple[str, ...]:
        """The convention of axes and angles of a part, and the readings proposed for it."""
        proposed = (str(reading) for reading in self.readings if reading.part == part.id)
        return tuple(filter(None, (part.convention, *proposed)))

    def table(self) -> str:
        """The claims part by part under its convention, then consequences and totals.

        A line for each claim; below it what the text prints and how it was read, where they differ.
        """
        rows: list[str] = []
        for part, found in self.by_part():
            rows.append(part.title or part.id)
            for sentence in self.conventions(part):
                rows += wrap(sentence, _WIDE, initial_indent=_INDENT, subsequent_indent=_INDENT)
            rows += [line for judged in found for line in _lines(judged)]
            rows.append("")
        feeding = [f"  {consequence}" for consequence in self.consequences if consequence.feeds]
        if feeding:
            rows += ["", "Claims derived from those that fail:", *feeding]
        return "\n".join([*rows, "", *self._advice(), self.total(), *self.certainty()])

    def certainty(self) -> tuple[str, ...]:
        """How sure all identities together are that were decided at random points, in a sentence.

        It is the same for nearly all of them, and stands once instead of with every verdict.
        """
        bound = sum(judged.verdict.error_bound or 0.0 for judged in self.judged)
        return (f"All identities together were {certainty(bound)}.",) if bound else ()

    def _advice(self) -> list[str]:
        """How to state a reading, if a verdict depends on one."""
        if not any(j.verdict.option == "read" for j in self.judged):
            return []
        binding = "[part.bindings] '\\mathbf{L}' = \"angular momentum about pivot\""
        return [f"State what an ambiguous letter means in its part of the document: {binding}", ""]

    def short_table(self) -> str:
        """Totals for each part of the text, then the claims that fail, with corrections."""
        grouped = {part.title or part.id: found for part, found in self.by_part()}
        width = max(map(len, grouped), default=0)
        rows = [f"{title:<{width}}  {tally(group)}" for title, group in grouped.items()]
        fails = [line for judged in self.failures for line in _lines(judged)]
        return "\n".join([*rows, *(["", "What fails:", *fails] if fails else []), "", self.total()])

    def total(self) -> str:
        """How many claims got each answer, in a line."""
        count = len(self.judged)
        claims = f"{count or 'no'} claim{'' if count == 1 else 's'}"
        text = f"{claims}: {tally(self.judged)}" if count else f"{claims} judged"
        return text + (f"; {len(self.left)} not reached" if self.left else "")

    def __str__(self) -> str:
        return self.table()

    def __repr__(self) -> str:
        return f"Report on {self.document.title!r}: {self.total()}; print it for all verdicts"

    def to_json(self) -> dict[str, Any]:
        """The report as plain data: claims, counts, consequences, seconds."""
        return {
            "schema": SCHEMA,
            "title": self.document.title,
            "source": self.document.source,
            "claims": [_claim_json(judged) for judged in self.judged],
            "counts": self.counts,
            "consequences": [
                {
                    "failed": c.failed,
                    "feeds": list(c.feeds),
                    "results": list(c.results),
                    "surviving": list(c.surviving),
                }
                for c in self.consequences
            ],
            "readings": [reading.to_json() for reading in self.readings],
            "left": list(self.left),
            "seconds": self.seconds,
        }


def counted(judged: Sequence[Judged]) -> dict[str, int]:
    """How many claims got each answer."""
    found = Counter(j.answer for j in judged)
    return {answer.value: found[answer] for answer in Answer}


def tally(judged: Sequence[Judged]) -> str:
    """How many claims got each answer, in a line."""
    return ", ".join(f"{count} {name}" for name, count in counted(judged).items() if count)


def _lines(judged: Judged) -> Iterator[str]:
    """A claim in one line; below it the reason or correction in full, and how it was read."""
    claim, verdict = judged.claim, judged.verdict
    yield _row(judged)
    if verdict.correction is not None:
        yield f"{_BELOW}holds as: {verdict.correction.latex}"
    if verdict.answer in _EXPLAINED:
        yield from wrap(verdict.reason, _WIDE, initial_indent=_BELOW, subsequent_indent=_BELOW)
    stated = Note("in words" if claim.words else "printed", claim.printed)
    for note in (*([stated] if claim.notes else []), *judged.notes):
        yield f"{_BELOW}{note.label}: {' '.join(note.text.split())}"
    if read := "; ".join(map(str, verdict.shown_readings)):
        yield f"{_BELOW}letters: {read}"


def _row(judged: Judged) -> str:
    claim, verdict = judged.claim, judged.verdict
    start = f"{claim.id:>8}  {judged.system:<25} {verdict.answer.value:<11} "
    remark = "" if verdict.answer in _EXPLAINED else verdict.reason
    if verdict.correction is not None:
        remark = verdict.correction.what
    if verdict.answer in (Answer.FAILS, Answer.UNREAD) and judged.fed_by:
        remark += f" [derived from {_listed(judged.fed_by)}]"
    return start + shorten(remark, _WIDEST, placeholder=" …") if remark else start.rstrip()


def _claim_json(judged: Judged) -> dict[str, Any]:
    claim, verdict = judged.claim, judged.verdict
    correction = verdict.correction
    return {
        "id": claim.id,
        "system": judged.system,
        "context": claim.context,
        "latex": claim.latex or claim.means,
        "words": claim.words,
        "read_as": claim.read_as,
        "verdict": verdict.answer.value,
        "correction": correction and correction.to_json(),
        "reason": verdict.reason,
        "remarks": list(verdict.remarks),
        "readings": [reading.to_json() for reading in verdict.readings],
        "error_bound": verdict.error_bound,
        "follows_from": list(claim.follows_from),
        "fed_by": list(judged.fed_by),
    }


def _listed(ids: Sequence[str]) -> str:
    return ", ".join(f"({id})" for id in ids)

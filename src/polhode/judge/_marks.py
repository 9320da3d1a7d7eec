"""The mark of each line: true, wrong by itself, wrong since another is, or not judged."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from polhode.base import NumericError, PolhodeError, interrupted, within
from polhode.derive import Equations
from polhode.judge._check import OpenVerdict
from polhode.judge._evidence import ClosedLetters, contradicts_itself, evidence
from polhode.judge._reviewed import Mark, ReviewedLine
from polhode.judge._verdict import Answer, Verdict
from polhode.judge.consequences._consequences import Consequences
from polhode.judge.consequences._open_letters import OpenLetters
from polhode.judge.latex._tree import Node
from polhode.judge.lines._hypotheses import is_condition
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.meaning._proposals import FREE
from polhode.judge.processes._limited_check import uncorrected
from polhode.judge.source import SourceRelation

LONGEST = 8.0
"""Seconds of processor time in which a line is judged, and those in which its mark is found."""
_CORRECTION = 5.0  # s of processor time in which the correction of one line is sought
#: Seconds of processor time in which the corrections of all lines of a document are sought.
ALTOGETHER = 12.0
#: Why a line that fails is not judged, where it says which states it is about.
_CONDITION = "a condition, met by some motions and not by others"
#: Headings and labels of problems that have nothing to do with one another.
_PROBLEM = re.compile(r"\W*(?:problem|exercise|question|task|aufgabe|ex\.|q)\s*\d+", re.I)
_FIRST_MEMBER = re.compile(r" (?:in|of) member 1\b")


def marked(
    parts: Iterable[Sequence[JudgedLine | SourceRelation]],
    equations: Equations,
    offset: int,
    seconds: float,
) -> Iterator[ReviewedLine]:
    """The marks of the lines of one document.

    Args:
        parts: its lines, part by part.
        equations: of the system.
        offset: how many lines of other documents stand before it.
        seconds: in which corrections are sought.
    """
    marker = _Marker(equations, seconds, offset)
    index = offset
    for part in parts:
        marker.read(part)
        for entry in part:
            if isinstance(entry, JudgedLine):
                yield marker.marked(entry, index)
            else:
                yield replace(_placed(entry), reason=entry.why)
            index += 1


def _placed(relation: SourceRelation) -> ReviewedLine:
    return ReviewedLine(
        relation.file,
        relation.line,
        relation.column,
        relation.latex,
        Mark.NOT_JUDGED,
        is_display=relation.is_display,
    )


@dataclass(frozen=True)
class _Said:
    """What is said of a line beside its verdict."""

    mark: Mark
    reason: str = ""
    of: int | None = None
    needs: str = ""


class _Marker:
    """Marks the lines of a document in order."""

    def __init__(self, equations: Equations, seconds: float, offset: int) -> None:
        self._left = seconds  # for corrections
        self._seeks_slips = seconds > 0
        self._offset = offset
        self._letters = OpenLetters()
        self._closed = ClosedLetters()
        self._doubted: set[int] = set()
        self._unsure = dict[Node, int]()  # letters by the wrong or doubted line that defines them
        self._accused: set[int] = set()
        self._wrong_parts: set[str] = set()  # problems of the text that have an error
        self._consequences = Consequences(equations, self._letters)

    def read(self, part: Sequence[JudgedLine | SourceRelation]) -> None:
        """Take in a part before its lines are marked: what it shows that letters mean."""
        for entry in part:
            if isinstance(entry, JudgedLine):
                self._closed.confirm(entry)

    def marked(self, judged: JudgedLine, index: int) -> ReviewedLine:
        """One line with its mark."""
        verdict = judged.verdict
        try:
            with interrupted(LONGEST, advice="review a part of the text"):
                said = self._said(judged, index)
        except (PolhodeError, ArithmeticError):  # it is not known what it follows from
            claims = {Answer.HOLDS: Mark.TRUE, Answer.FAILS: Mark.DOUBT}
            mark = claims.get(verdict.answer, Mark.NOT_JUDGED)
            mark = Mark.NOT_JUDGED if judged.stated else mark
            said = _Said(mark, judged.stated or verdict.reason)
        if said.mark is Mark.ERROR:
            verdict = self._corrected(judged)
            said = self._proved(judged, verdict, said)
        elif said.mark is Mark.FOLLOWS and said.of not in self._accused:
            said = self._drawn_from_no_error(judged, said)
        if said.mark in (Mark.ERROR, Mark.FOLLOWS):
            self._accused.add(index)
        self._keep_in_mind(judged, said, index)
        if said.mark is Mark.DOUBT:
            self._doubted.add(index)
            verdict = replace(verdict, counterexample=None, confirmation=None)
        is_first = said.mark is Mark.ERROR and not self._wrong_parts
        if said.mark is Mark.ERROR:
            self._wrong_parts.add(_problem(judged))
        return replace(
            _placed(judged.line.relation),
            mark=said.mark,
            is_first=is_first,
            of=said.of,
            needs=said.needs,
            context="" if said.mark is Mark.NOT_JUDGED else verdict.context,
            reason=said.reason,
            part=judged.line.section.name,
            is_final=judged.line.cues.is_final,
            verdict=verdict,
            read_as=judged.line.read_as,
        )

    def _keep_in_mind(self, judged: JudgedLine, said: _Said, index: int) -> None:
        """Letters that a line defines are as sure as the line."""
        for letter in judged.defines:
            self._unsure.pop(letter, None)
            if said.mark in (Mark.ERROR, Mark.FOLLOWS, Mark.DOUBT):
                self._unsure[letter] = index

    def _proved(self, judged: JudgedLine, verdict: Verdict, said: _Said) -> _Said:
        """What is said of a line that fails, by the evidence for a slip."""
        found = evidence(judged, verdict, self._closed)
        if found.is_proof:
            if _problem(judged) in self._wrong_parts and not contradicts_itself(judged):
                reason = f"{said.reason}; it may be drawn from a wrong line before it"
                return replace(said, mark=Mark.DOUBT, reason=reason)
            return said
        if is_condition(judged):
            return _Said(Mark.NOT_JUDGED, _CONDITION)
        left = self._closed.left_open(judged, FREE)
        if left and self._seeks_slips and not found.slip:  # the text may mean something else
            read = ", ".join(left)
            reason = f"it does not hold with {read}, which no line of the text confirms"
            return _Said(Mark.NOT_JUDGED, reason)
        return replace(said, mark=Mark.DOUBT, reason=f"{said.reason}; {found.lacking}")

    def _drawn_from_no_error(self, judged: JudgedLine, said: _Said) -> _Said:
        """What is said of a line that follows from one that is not accused."""
        if said.of in self._doubted:
            return replace(said, mark=Mark.DOUBT, reason="it follows from a line that is in doubt")
        if is_condition(judged):
            return _Said(Mark.NOT_JUDGED, _CONDITION)
        return replace(said, mark=Mark.DOUBT, reason="it follows from a line that was not judged")

    def _corrected(self, judged: JudgedLine) -> Verdict:
        """The verdict on a line that fails, with a correction within the time that is left."""
        began = _processor_time()
        found = corrected(judged.judgement, min(_CORRECTION, self._left))
        self._left -= _processor_time() - began
        return found

    def _said(self, judged: JudgedLine, index: int) -> _Said:
        verdict = judged.verdict
        if judged.stated:
            self._take_in(judged)
            return _Said(Mark.NOT_JUDGED, judged.stated)
        if verdict.holds and not judged.needs:
            unsure = [self._unsure[n] for n in judged.line.letters if n in self._unsure]
            if unsure:
                reason = "it holds for a letter as a line in doubt, or a wrong one, defines it"
                return _Said(Mark.DOUBT, reason, unsure[0])
            return self._of_true(judged)
        if judged.needs:
            fails = verdict.answer is Answer.FAILS
            without = f"without it {_reason(judged)}" if fails else ""
            return _Said(Mark.NEEDS, without, needs=judged.needs)
        if verdict.answer is Answer.FAILS:
            return self._of_wrong(judged, index)
        if verdict.answer is Answer.AMBIGUOUS:
            return _Said(Mark.NEEDS, verdict.reason, needs="a reading to be chosen")
        return _Said(Mark.NOT_JUDGED, verdict.reason)

    def _take_in(self, judged: JudgedLine) -> None:
        opened = self._letters.opened(judged)
        is_kept = judged.verdict.answer is Answer.DEFINITION or judged.is_assumed
        if opened is not None and is_kept:
            self._consequences.add_true(opened)

    def _of_true(self, judged: JudgedLine) -> _Said:
        opened = self._letters.opened(judged)
        if opened is None:
            return _Said(Mark.TRUE, judged.verdict.reason)
        cited = self._cited(judged)
        against = self._consequences.contradicted(opened, cited)
        self._consequences.add_true(opened)
        if against is None or against.of not in self._accused:
            return _Said(Mark.TRUE, judged.verdict.reason)
        reason = "true, but it would not hold if the wrong line that it is drawn from did"
        return _Said(Mark.UNLINKED, reason, against.of)

    def _cited(self, judged: JudgedLine) -> frozenset[int]:
        """The lines of the review that a line says it is drawn from."""
        return frozenset(self._offset + place for place in judged.line.cited)

    def _of_wrong(self, judged: JudgedLine, index: int) -> _Said:
        opened = self._letters.opened(judged)
        if opened is None:
            return _Said(Mark.ERROR, _reason(judged))
        # Of a chain a = b = c, what is right may serve to draw the rest from a line before.
        right, wrong = opened.parted({each.member for each in judged.verdict.residuals})
        self._consequences.add_true(right)
        source = self._consequences.implied(wrong, judged, self._cited(judged))
        self._consequences.add_wrong(wrong, index, index if source is None else source)
        if source is None:
            return _Said(Mark.ERROR, _reason(judged))
        return _Said(Mark.FOLLOWS, "wrong only since a line before it is", source)


def _processor_time() -> float:
    """Of this process and its copies, s: whatever else runs on the machine, marks stay the same."""
    spent = os.times()
    return spent.user + spent.system + spent.children_user + spent.children_system


def _problem(judged: JudgedLine) -> str:
    """The problem that a line is of, where a text has several: by its heading or its label."""
    section = judged.line.section
    named = (*section.headings, section.within, section.label)
    return next((found[0] for name in named if (found := _PROBLEM.match(name))), "")


def _reason(judged: JudgedLine) -> str:
    """Why a line fails; the members of a claim are counted only where there are several."""
    relation = judged.line.relation.relation
    is_single = relation is None or len(relation.signs) == 1
    return _FIRST_MEMBER.sub("", judged.verdict.reason) if is_single else judged.verdict.reason


def corrected(judgement: OpenVerdict, seconds: float) -> Verdict:
    """The verdict on a line that fails, with a correction if one is found in time."""
    if judgement.corrected is None:
        return judgement.verdict
    correct = judgement.corrected
    if seconds <= 0:
        return judgement.verdict
    try:
        return within(seconds, lambda tell: correct(), advice="judge the line by itself")
    except NumericError:
        return uncorrected(judgement.verdict, seconds)
    except PolhodeError:
        return judgement.verdict

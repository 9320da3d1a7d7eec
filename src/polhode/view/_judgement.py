"""A claim about a system with its verdict, as a page shows it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from polhode.claims import Answer, Read, Verdict
from polhode.view._html import Markup, joined
from polhode.view._mathml import typeset
from polhode.view._published import words_with_published

if TYPE_CHECKING:
    from polhode.claims import Judged


@dataclass(frozen=True)
class NoteShown:
    """A line on how a claim was read.

    Attributes:
        label: such as "read as".
        text: LaTeX, or words.
        formula: in MathML; empty for words.
    """

    label: str
    text: str
    formula: str = ""


@dataclass(frozen=True)
class Judgement:
    """A claim about the system, and the result of checking it.

    Attributes:
        claim: in words, or as its source prints it.
        verdict: holds, ambiguous, approximate, definition, fails or unread.
        reason: in words.
        formula: the claim in MathML; empty where it is in words.
        correction: the corrected claim in MathML; empty for none.
        notes: how it was read, beyond what its source prints.
        convention: of axes, angles and letters where its source states it.
    """

    claim: str
    verdict: str
    reason: str = ""
    formula: str = ""
    correction: str = ""
    notes: tuple[NoteShown, ...] = ()
    convention: str = ""

    @classmethod
    def of(cls, latex: str, verdict: Verdict) -> Judgement:
        """From the verdict of `polhode.check` on an equation."""
        correction = typeset(verdict.correction.latex) if verdict.correction else ""
        notes = (NoteShown("note", detail) for detail in verdict.details)
        letters = "; ".join(map(str, verdict.shown_readings))
        return cls(
            latex,
            verdict.answer.value,
            verdict.reason,
            typeset(latex),
            correction,
            (*notes, *([NoteShown("letters", letters)] if letters else [])),
        )

    @classmethod
    def on(cls, judged: Judged) -> Judgement:
        """From the verdict of `polhode.audit` on a claim of a document."""
        claim, verdict = judged.claim, judged.verdict
        judgement = cls.of(claim.latex, verdict)
        notes = (
            NoteShown(note.label, note.text, typeset(note.text) if note.is_formula else "")
            for note in claim.notes
        )
        return replace(
            judgement,
            claim=f"({claim.id}) {claim.printed}",
            reason="" if verdict.answer is Answer.HOLDS else verdict.reason,
            notes=(*notes, *judgement.notes),
            convention=judged.convention,
        )


def readings_html(readings: Iterable[Read]) -> Markup:
    """The meanings that letters were given, the letters typeset; empty for none."""
    shown = (
        joined([typeset(r.letter) or r.plain, " ", words_with_published(r.words)]) for r in readings
    )
    return joined(shown, "; ")

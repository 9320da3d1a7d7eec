"""A claim about a system with its verdict, as a page shows it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum
from typing import Protocol

from polhode.view._mathml import typeset


class _Corrected(Protocol):
    @property
    def latex(self) -> str: ...


class VerdictShown(Protocol):
    """What is shown of a verdict of `polhode.check`."""

    @property
    def answer(self) -> Enum: ...
    @property
    def reason(self) -> str: ...
    @property
    def correction(self) -> _Corrected | None: ...
    @property
    def details(self) -> Iterable[str]: ...
    @property
    def shown_readings(self) -> Iterable[object]: ...


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
    def of(cls, latex: str, verdict: VerdictShown) -> Judgement:
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

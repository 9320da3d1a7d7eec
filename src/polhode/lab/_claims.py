"""Verdicts on the problem set's claims about a system, and on equations typed in."""

from __future__ import annotations

from functools import cache
from typing import Any

from polhode.catalogue import CATALOGUE
from polhode.derive import Equations, derive
from polhode.judge import Document, Verdict, check, document_of, report_on
from polhode.lab._requests import Question
from polhode.view import typeset

_LONGEST = 1500  # characters shown of a residual


@cache
def _document() -> Document:
    return document_of(None)


@cache
def _equations(system: str) -> Equations:
    return derive(CATALOGUE[system].build())


def claims_about(system: str) -> list[dict[str, Any]]:
    """The problem set's claims about a system, part by part, without verdicts."""
    document = _document()
    about = document.about(system)
    return [
        {
            "id": claim.id,
            "formula": typeset(claim.latex),
            "printed": claim.printed,
            "words": claim.words,
            "context": claim.context,
            "notes": [
                {
                    "label": note.label,
                    "text": note.text,
                    "formula": typeset(note.text) if note.is_formula else "",
                }
                for note in claim.notes
            ],
            "part": part.title,
            "convention": part.convention,
        }
        for part in document.parts
        for claim in about
        if claim.part == part.id
    ]


def judged(id: str) -> dict[str, Any]:
    """The verdict on a claim of the problem set.

    Raises:
        ParseError: for an unknown id.
    """
    found = report_on(_document(), _equations, only=[id]).judged[0]
    return {"id": id, **_verdict_of(found.verdict)}


def answered(question: Question, equations: Equations) -> dict[str, Any]:
    """The verdict on an equation that was typed in.

    Raises:
        ParseError: for an unknown context, and for a reading that a letter does not have.
    """
    verdict = check(question.latex, equations, context=question.context, read=question.read)
    return {"formula": typeset(question.latex), **_verdict_of(verdict)}


def _verdict_of(verdict: Verdict) -> dict[str, Any]:
    correction, example = verdict.correction, verdict.counterexample
    return {
        "verdict": verdict.answer.value,
        "reason": verdict.reason,
        "correction": correction
        and {"what": correction.what, "formula": typeset(correction.latex)},
        "residuals": [str(residual)[:_LONGEST] for residual in verdict.residuals],
        "counterexample": example and example.shown,
        "remarks": list(verdict.notes),
    }

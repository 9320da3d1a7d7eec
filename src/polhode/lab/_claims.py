"""Verdicts on the problem set's claims about a system, and on equations typed in."""

from __future__ import annotations

from functools import cache
from typing import Any

from polhode.catalogue import CATALOGUE, document_of
from polhode.claims import Claim, Document, Note, Part, Verdict, audit, check
from polhode.derive import Equations, derive
from polhode.lab._requests import Question
from polhode.view import typeset

_LONGEST = 1500  # letters of a residual that is shown


@cache
def _document() -> Document:
    return document_of(None)


@cache
def _equations(system: str) -> Equations:
    return derive(CATALOGUE[system].build())


def claims_about(system: str) -> list[dict[str, Any]]:
    """What the problem set states about a system, part by part, without verdicts."""
    document = _document()
    about = document.about(system)
    return [
        _stated(claim, part) for part in document.parts for claim in about if claim.part == part.id
    ]


def judged(id: str) -> dict[str, Any]:
    """The verdict on a claim of the problem set.

    Raises:
        ParseError: for an unknown id.
    """
    found = audit(_document(), _equations, only=[id]).judged[0]
    return {"id": id, **_verdict_of(found.verdict)}


def answered(question: Question, equations: Equations) -> dict[str, Any]:
    """The verdict on an equation that was typed in.

    Raises:
        ParseError: for an unknown context.
    """
    verdict = check(question.latex, equations, context=question.context)
    return {"formula": typeset(question.latex), **_verdict_of(verdict)}


def _stated(claim: Claim, part: Part) -> dict[str, Any]:
    return {
        "id": claim.id,
        "formula": typeset(claim.latex),
        "printed": claim.printed,
        "words": claim.words,
        "context": claim.context,
        "notes": [_noted(note) for note in claim.notes],
        "part": part.title,
        "convention": part.convention,
    }


def _noted(note: Note) -> dict[str, str]:
    formula = typeset(note.text) if note.is_formula else ""
    return {"label": note.label, "text": note.text, "formula": formula}


def _verdict_of(verdict: Verdict) -> dict[str, Any]:
    correction, example = verdict.correction, verdict.counterexample
    return {
        "verdict": verdict.answer.value,
        "reason": verdict.reason,
        "correction": correction
        and {"what": correction.what, "formula": typeset(correction.latex)},
        "residuals": [str(residual)[:_LONGEST] for residual in verdict.residuals],
        "counterexample": example
        and {
            "values": dict(example.values),
            "left": str(example.left)[:_LONGEST],
            "right": str(example.right)[:_LONGEST],
        },
        "remarks": list(verdict.notes),
    }

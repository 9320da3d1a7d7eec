"""A solution that was pasted in, reviewed line by line."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from polhode.derive import Equations
from polhode.judge import SIGNS, TITLES, ReviewedLine, review, sentence, typesettables
from polhode.lab._requests import DerivationRequest
from polhode.view import typeset

_CORRECTING = 10.0  # s in which corrections are sought


def reviewed(solution: DerivationRequest, equations: Equations) -> dict[str, Any]:
    """The lines of a solution with their marks, and how many got each.

    Raises:
        ParseError: for a text that cannot be read.
    """
    found = review(solution.text, equations, format=solution.format, seconds=_CORRECTING)
    formulas = typesettables(found)
    lines = [
        {**_line(line, bare(line.latex)), **_correction(line, bare), "told": sentence(line, found)}
        for line, bare in zip(found.lines, formulas, strict=True)
    ]
    counts = {TITLES[mark]: count for mark, count in found.summary.items() if count}
    return {"lines": lines, "counts": counts}


def _line(line: ReviewedLine, latex: str) -> dict[str, Any]:
    verdict = line.verdict
    example = verdict.counterexample if verdict else None
    return {
        "line": line.line,
        "latex": latex,
        "formula": typeset(latex),
        "mark": line.mark.value,
        "sign": SIGNS[line.mark],
        "title": TITLES[line.mark],
        "context": line.context,
        "part": line.part,
        "of": line.of,
        "final": line.is_final,
        "counterexample": example and example.shown,
    }


def _correction(line: ReviewedLine, bare: Callable[[str], str]) -> dict[str, Any]:
    found = line.verdict.correction if line.verdict else None
    shown = found and {"what": found.what, "formula": typeset(bare(found.latex))}
    return {"correction": shown}

"""Axes that turn with a body, of which a text may speak where the model has none.

The axes of a body of revolution need not spin with it. Components of a vector along axes that do
have the letters of those along axes that do not, and cannot be judged by them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from polhode.algebra import Symbol
from polhode.derive import Equations
from polhode.judge._check import OpenVerdict
from polhode.judge._verdict import Answer
from polhode.judge.lines._judged_line import JudgedLine
from polhode.model import Body

_ALONG_AXIS = re.compile(r"\baxis \S+ of\b")


def with_doubt_about_axes(judged: JudgedLine, equations: Equations) -> JudgedLine:
    """The line, not judged where its components may be along axes that the model does not have."""
    why = "" if judged.stated or judged.needs else doubt_about_axes(judged, equations)
    if not why:
        return judged
    verdict = replace(judged.verdict, answer=Answer.UNREAD, reason=why)
    return replace(judged, judgement=OpenVerdict(verdict))


def doubt_about_axes(judged: JudgedLine, equations: Equations) -> str:
    """Why components in a line that fails may be along axes of which the model has none, or ""."""
    if judged.verdict.answer is not Answer.FAILS:
        return ""
    along = [r for r in judged.verdict.readings if _ALONG_AXIS.search(r.meaning)]
    spinning = list(_spinning(equations))
    if not along or not spinning:
        return ""
    read = f"it was read with {', '.join(map(str, along))}"
    cues, stated = judged.line.cues, judged.line.in_force
    if cues.is_body_fixed or stated.is_body_fixed:
        return f"{read}, but the text speaks of axes fixed in the body, which the model has not"
    turned = _angles_in(judged) & {angle for _, angle in spinning}
    if turned:
        names = ", ".join(sorted(angle.published for angle in turned))
        return f"{read}, but it may mean axes that turn with {names}, which the model has not"
    return ""


def _spinning(equations: Equations) -> Iterator[tuple[Body, Symbol]]:
    """The bodies that spin relative to their axes, with the angle by which they do."""
    for body in equations.system.bodies:
        fixed = body.fixed_axes
        if fixed is not None and fixed != body.axes:
            yield from ((body, angle) for angle in fixed.angle.symbols())


def _angles_in(judged: JudgedLine) -> frozenset[Symbol]:
    claim = judged.claim
    if claim is None:
        return frozenset()
    return frozenset().union(*(c.difference.symbols() for c in claim.components()))

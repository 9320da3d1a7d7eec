"""A line with a slash that may divide by more or by less, read in one way in its context."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.judge._check import OpenVerdict
from polhode.judge._verdict import Answer, Verdict
from polhode.judge.latex import read_latex
from polhode.judge.latex._tree import Relation
from polhode.judge.lines._judge_line import judged_line
from polhode.judge.lines._judged_line import JudgedLine, in_context
from polhode.judge.text._text_line import TextLine

#: 1/2 m v² is half of m v² to all writers; 1/2 π may be either.
_FRACTION = re.compile(r"(?<![\w.}])([0-9]+)/([0-9]+)(?![\w.]|\s*\\pi)")


def in_one_way(ways: Sequence[TextLine], equations: Equations) -> JudgedLine:
    """A line judged in the one of its readings in which all terms are of one dimension.

    Where several are, they have to agree, unless the slashes are those of fractions of two numbers
    and the line holds in no other reading: it is ambiguous otherwise.

    Args:
        ways: the line in each of its readings; one for a line without such slashes.
        equations: of the system.
    """
    if len(ways) == 1:
        return judged_line(ways[0], equations, {})
    told = [replace(way, read_as=f"read as {way.relation.printed}") for way in ways]
    fitting = [way for way in told if in_context(way, equations, {}, "motion").fits] or told
    judged = [judged_line(way, equations, {}) for way in fitting]
    usual = _with_fractions(ways[0].relation.latex)
    as_usual = next((e for e in judged if e.line.relation.relation in usual), None)
    right = [each for each in judged if each.verdict.holds]
    if len(judged) == 1 or (as_usual is not None and right in ([], [as_usual])):
        return as_usual or judged[0]
    answers = {(each.verdict.answer, each.needs) for each in judged}
    if len(answers) == 1 and judged[0].verdict.answer is not Answer.DEFINITION:
        return judged[0]
    said = (f"{e.verdict.answer.value} if it is {e.line.read_as}" for e in judged)
    reason = rf"{'; '.join(said)}; to choose, write \frac or brackets in place of the slash"
    return JudgedLine(ways[0], OpenVerdict(Verdict(Answer.AMBIGUOUS, "motion", reason)))


def _with_fractions(latex: str) -> tuple[Relation, ...]:
    """What a line says if 1/2 m is a half of m; nothing if it has other slashes of two readings."""
    with suppress(PolhodeError):
        return read_latex(_FRACTION.sub(r"\\frac{\1}{\2}", latex)).relations
    return ()

"""Lines judged while they are composed, where it is not known beforehand that they hold."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from polhode.base import PolhodeError
from polhode.claims import Answer, Verdict, check
from polhode.derive import Equations
from polhode.solution._lines import Line
from polhode.solution._setting import PATIENCE


def if_true(lines: Iterable[Line], equations: Equations) -> Iterator[Line]:
    """The lines with their verdicts if all of them hold; otherwise none of them."""
    judged = [replace(line, verdict=_verdict(line, equations)) for line in lines]
    hold = (Answer.HOLDS, Answer.APPROXIMATE)
    if all(line.verdict and line.verdict.answer in hold for line in judged if line.latex):
        yield from judged


def _verdict(line: Line, equations: Equations) -> Verdict | None:
    if not line.latex:
        return None
    try:
        return check(
            line.latex,
            equations,
            context=line.context,
            let=line.let,
            given=line.given,
            small=line.small,
            positive=(*line.positive, *map(str, equations.assumed_positive)),
            seconds=PATIENCE,
        )
    except PolhodeError:
        return None

"""Verdicts on the lines of a solution: one that does not hold ends the build."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import replace

from polhode.algebra import Expr, Symbol
from polhode.base import NumericError, ParseError, PolhodeError
from polhode.derive import Equations
from polhode.judge import (
    Answer,
    Claim,
    Definition,
    Document,
    Part,
    Verdict,
    check,
    report_on,
)
from polhode.solution._letters import lengths_among
from polhode.solution._lines import SolutionLine
from polhode.solution._setting import PATIENCE

_TRUE = (Answer.HOLDS, Answer.APPROXIMATE)


def if_true(lines: Iterable[SolutionLine], equations: Equations) -> Iterator[SolutionLine]:
    """The lines with their verdicts if all of them hold; otherwise none of them."""
    judged_lines = [replace(line, verdict=_verdict(line, equations)) for line in lines]
    if all(line.verdict for line in judged_lines if line.latex):
        yield from judged_lines


def _verdict(line: SolutionLine, equations: Equations) -> Verdict | None:
    """The verdict on a line that holds."""
    if not line.latex:
        return None
    try:
        return judged(line, equations)
    except PolhodeError:
        return None


def judged(line: SolutionLine, equations: Equations) -> Verdict:
    """The verdict on a line.

    Raises `NumericError` for one that does not hold, or is not decided.
    """
    try:
        verdict = _checked(line, equations, ())
    except NumericError as undecided:
        raise NumericError(
            f"a worked solution of {equations.system.name!r}, whose line {line.latex} is not "
            f"decided: {undecided.given}",
            expected="formulas that can be judged while the document is built",
            advice="work on a part of the system, or take another route",
        ) from undecided
    if verdict.answer is Answer.AMBIGUOUS:
        verdict = _as_meant(verdict, equations) or _checked(
            line, equations, tuple(_declared_readings(line, equations))
        )
    if verdict.answer in (Answer.UNREAD, Answer.AMBIGUOUS):
        raise NumericError(
            f"a worked solution of {equations.system.name!r}, whose line {line.latex} cannot be "
            f"judged: {verdict.reason}",
            expected="formulas that can be judged: none is printed that has not been",
            advice="work on a part of the system, or take another route",
        )
    if verdict.answer not in _TRUE:
        raise NumericError(
            f"the line {line.latex} of the solution of {equations.system.name!r}, judged as "
            f"{verdict.answer.value}: {verdict.reason}",
            expected="a formula that holds",
            advice="report it with the declaration",
        )
    return verdict


def _as_meant(verdict: Verdict, equations: Equations) -> Verdict | None:
    """The verdict with ŷ along the axis of the laboratory, as solutions write it, not of a slope.

    None where letters of another kind are unclear.
    """
    axes = f" of {equations.system.root.name}"
    for each in verdict.by_reading:
        meanings = [read.meaning for read in each.chosen.values()]
        if all(m.startswith("declared ") or m.endswith(axes) for m in meanings):
            return each.verdict
    return None


def _checked(line: SolutionLine, equations: Equations, read: tuple[str, ...]) -> Verdict:
    if line.bindings:
        return _bound(line, equations)
    return check(
        line.latex,
        equations,
        context=line.context,
        let=line.let,
        given=line.given,
        small=line.small,
        read=read,
        positive=(*line.positive, *map(str, equations.assumed_positive)),
        seconds=PATIENCE,
    )


def _bound(line: SolutionLine, equations: Equations) -> Verdict:
    """The verdict on a line with letters bound to quantities in words."""
    part = Part(
        "line",
        "",
        equations.system.name,
        bindings=line.bindings,
        definitions=tuple(map(Definition, (*line.let, *_lengths(line, equations)))),
        given=line.given,
        positive=(*line.positive, *(sign.latex() for sign in equations.assumed_positive)),
    )
    claim = Claim("line", "line", line.context, line.latex)
    report = report_on(Document("", "", (part,), (claim,)), lambda name: equations)
    return report.judged[0].verdict


def _lengths(line: SolutionLine, equations: Equations) -> Iterator[str]:
    """Definitions of the lengths whose letters occur in a line."""
    for part in lengths_among([line.latex], equations):
        letter = Expr.generator(Symbol(part.letter.name)).latex()
        yield f"{letter} = {part.meaning.latex()}"


def _declared_readings(line: SolutionLine, equations: Equations) -> Iterator[str]:
    """Letters of the declaration that might also be components: v_y on a slope, F_z along a rod."""
    names = [s.published for s in (*equations.speeds, *equations.coordinates)]
    for name in (*names, *equations.components):
        reading = f"{name} = declared {name}"
        with suppress(ParseError):
            _checked(line, equations, (reading,))
            yield reading

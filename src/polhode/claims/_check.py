"""One claim checked against a model."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import reduce

from polhode.base import ParseError, PolhodeError
from polhode.claims._asked import Asked
from polhode.claims._contexts import CONTEXTS, holds, judge
from polhode.claims._dimensions import dimensions_at_odds
from polhode.claims._notation import Notation
from polhode.claims._read_as import read_as
from polhode.claims._typed import with_given, with_let, with_small
from polhode.claims._verdict import Answer, Correction, Verdict
from polhode.claims._vocabulary import spelled
from polhode.claims.latex import bare_names, read_latex, write_latex
from polhode.claims.latex._tree import Node, Statement
from polhode.derive import Equations


def check(
    latex: str,
    equations: Equations,
    *,
    context: str = "motion",
    let: Iterable[str] = (),
    given: Iterable[str] = (),
    small: Iterable[str] = (),
    tell: Callable[[Verdict], object] = lambda verdict: None,
) -> Verdict:
    r"""Judge a published equation against a model.

    Args:
        latex: the equation, as printed.
        equations: of the system.
        context: where it is to hold: identity, motion, steady, threshold, limit, launch, number.
        let: new symbols of the text, in published names or LaTeX: ``epsilon = theta - pi/2``.
        given: restrictions, such as ``theta = pi/2``.
        small: small quantities with the order to be kept, such as ``epsilon:1``.
        tell: called with a failure as soon as it is found; a correction may take longer.

    Returns:
        The verdict with its evidence; ``unread`` for what cannot be read or bound.

    Raises:
        ParseError: for an unknown context, a `let` of a known symbol, and unreadable restrictions.
    """
    if context not in CONTEXTS:
        raise ParseError(f"context {context!r}", expected=f"one of {', '.join(CONTEXTS)}")
    notation = Notation.of(equations)
    for say, texts in ((with_let, let), (with_given, given), (with_small, small)):
        notation = reduce(say, texts, notation)
    return judged_claim(latex, notation, context, tell=tell)


def judged_claim(
    latex: str,
    notation: Notation,
    context: str,
    when: str = "",
    tell: Callable[[Verdict], object] = lambda verdict: None,
) -> Verdict:
    """The verdict on a claim read in some notation, with a correction where it fails.

    A failure is told as soon as it is found, for a correction may take long.
    """
    try:
        statement = read_latex(latex)
        bound = notation.bound(statement)
        if bound.is_definition:
            return Verdict(Answer.DEFINITION, context, reason=_defined(bound.defined))
        asked = replace(notation.asked(statement, {}), when=when)
    except (PolhodeError, ZeroDivisionError) as error:
        return Verdict(Answer.UNREAD, context, reason=f"{error}{_hint(latex)}")
    verdict = _judged(asked, context)
    if verdict.answer is not Answer.FAILS:
        return verdict
    if understood := read_as(statement, notation.vocabulary):
        verdict = replace(verdict, remarks=(*verdict.remarks, f"read {understood}"))
    tell(verdict)
    return verdict if when else _corrected(verdict, statement, notation)


def _hint(latex: str) -> str:
    """What may be wrong with a formula that cannot be read or bound."""
    bare = bare_names(latex)
    if not bare:
        return ""
    return f"; LaTeX reads {', '.join(bare)} letter by letter, write \\{bare[0]}"


def _judged(asked: Asked, context: str) -> Verdict:
    """The verdict, with terms of different dimensions named where it does not hold."""
    try:
        verdict = judge(asked, context).proved()
        odd = "" if verdict.holds else dimensions_at_odds(asked)
    except (PolhodeError, ZeroDivisionError) as error:
        return Verdict(Answer.UNREAD, context, reason=str(error))
    return replace(verdict, reason=f"{verdict.reason}; {odd}") if odd else verdict


def _defined(letters: Iterable[Node]) -> str:
    names = ", ".join(spelled(letter) for letter in letters)
    return f"defines {names}"


def _corrected(verdict: Verdict, statement: Statement, notation: Notation) -> Verdict:
    from polhode.claims.repair import Repaired, repaired, tidied

    context = verdict.context

    def right(asked: Asked) -> bool:
        return holds(asked, context)

    def correction(repair: Repaired) -> Correction:
        what = "; ".join(dict.fromkeys(change.what for change in repair.changes))
        return Correction(what, write_latex(tidied(repair.statement)))

    try:
        found = repaired(statement, notation, context, right)
    except (PolhodeError, ArithmeticError):
        return verdict
    if not found:
        return verdict
    first, *others = map(correction, found)
    return replace(verdict, correction=first, alternatives=tuple(others))

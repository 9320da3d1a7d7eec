"""One claim checked against a model."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import reduce

from polhode.algebra import under_name
from polhode.base import ParseError, PolhodeError
from polhode.claims._dimensions import dimensions_at_odds
from polhode.claims._notation import Notation
from polhode.claims._typed import with_given, with_let, with_positive, with_small
from polhode.claims._verdict import Answer, Correction, Verdict
from polhode.claims.contexts._contexts import CONTEXTS, holds, judge
from polhode.claims.latex import bare_names, read_latex, write_latex
from polhode.claims.latex._tree import Node, Statement
from polhode.claims.meaning._bindings import Bound
from polhode.claims.meaning._evaluate import UnclearDerivativeError
from polhode.claims.meaning._read_as import read_as
from polhode.claims.meaning._vocabulary import spelled
from polhode.claims.states._asked import Asked
from polhode.derive import Equations


@dataclass(frozen=True)
class Enquiry:
    """A published equation as somebody asks about it; the attributes are the arguments of `check`.

    Attributes:
        latex: the equation, as printed.
        context: where it is to hold.
        let: new symbols of the text.
        given: restrictions.
        small: small quantities with the order to be kept.
        positive: quantities whose sign is stated.
    """

    latex: str
    context: str = "motion"
    let: tuple[str, ...] = ()
    given: tuple[str, ...] = ()
    small: tuple[str, ...] = ()
    positive: tuple[str, ...] = ()

    def judged(
        self, equations: Equations, tell: Callable[[Verdict], object] = lambda verdict: None
    ) -> Verdict:
        """The verdict; a failure is told as soon as it is found, for a correction may take long.

        Raises `ParseError` as `check` does.
        """
        if self.context not in CONTEXTS:
            raise ParseError(f"context {self.context!r}", expected=f"one of {', '.join(CONTEXTS)}")
        notation = Notation.of(equations)
        for say, texts in (
            (with_let, self.let),
            (with_positive, self.positive),
            (with_given, self.given),
            (with_small, self.small),
        ):
            notation = reduce(say, texts, notation)
        verdict = judged_claim(self.latex, notation, self.context, tell=tell)
        signs = (f"taking {text} as positive" for text in self.positive)
        return replace(verdict, remarks=(*verdict.remarks, *signs))


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
    except UnclearDerivativeError as error:
        return _by_readings(latex, notation, context, when, error)
    except (PolhodeError, ZeroDivisionError) as error:
        return Verdict(Answer.UNREAD, context, reason=f"{error}{_hint(latex)}")
    verdict = _assuming(bound, latex, _judged(asked, context))
    if verdict.answer is not Answer.FAILS:
        return verdict
    if understood := read_as(statement, notation.vocabulary):
        verdict = replace(verdict, remarks=(*verdict.remarks, f"read {understood}"))
    tell(verdict)
    if _is_under_names(verdict):
        why = "no correction is looked for where expressions are kept under names"
        return replace(verdict, remarks=(*verdict.remarks, why))
    return verdict if when else _corrected(verdict, statement, notation)


def _is_under_names(verdict: Verdict) -> bool:
    """Whether what is left is too long to be written out, so that every trial takes long."""
    left = (g for r in verdict.residuals for g in r.expression.generators)
    return any(under_name(generator) is not None for generator in left)


def _by_readings(
    latex: str, notation: Notation, context: str, when: str, unclear: UnclearDerivativeError
) -> Verdict:
    """The verdict where every reading of dE/dθ comes to the same; else it stays open."""
    plain = notation.vocabulary
    verdicts = {
        totals: judged_claim(
            latex, replace(notation, vocabulary=replace(plain, totals=totals)), context, when
        )
        for totals in ("partial", "along the motion")
    }
    answers = {verdict.answer for verdict in verdicts.values()}
    if len(answers) == 1:  # a correction would be read in two ways again
        return replace(verdicts["along the motion"], correction=None, alternatives=())
    told = "; ".join(f"read as {how}, {verdict.answer.value}" for how, verdict in verdicts.items())
    return Verdict(Answer.UNREAD, context, reason=f"{unclear}: {told}")


def _assuming(bound: Bound, latex: str, verdict: Verdict) -> Verdict:
    """With the conditions in brackets under which it was judged, and what it merely defines."""
    said = [f"under the condition {latex[slice(*r.span)]}" for r in bound.conditions]
    if bound.defined:
        said.append(_defined(bound.defined))
    return replace(verdict, remarks=(*verdict.remarks, *said))


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
    except ParseError as error:
        return Verdict(Answer.UNREAD, context, reason=str(error))
    except (PolhodeError, ZeroDivisionError) as error:
        return Verdict(Answer.UNREAD, context, reason=f"it was read, but not decided: {error}")
    return replace(verdict, reason=f"{verdict.reason}; {odd}") if odd else verdict


def _defined(letters: Iterable[Node]) -> str:
    names = ", ".join(spelled(letter) for letter in letters)
    return f"defines {names}; not judged, for nothing else says what that is"


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

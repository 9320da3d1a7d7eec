"""One claim checked against a model."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial, reduce

from polhode.algebra import under_name
from polhode.base import ParseError, PolhodeError
from polhode.claims._dimensions import dimensions_at_odds
from polhode.claims._notation import Notation
from polhode.claims._readings import (
    Chosen,
    JudgedReading,
    choices,
    judged_in_every_reading,
    with_readings,
)
from polhode.claims._typed import (
    spoken,
    with_given,
    with_let,
    with_positive,
    with_reading,
    with_small,
)
from polhode.claims._verdict import Answer, Correction, Verdict
from polhode.claims.contexts._contexts import CONTEXTS, holds, judge
from polhode.claims.latex import bare_names, read_latex, write_latex
from polhode.claims.latex._tree import Node, Piece, Statement
from polhode.claims.meaning._bindings import Bound
from polhode.claims.meaning._evaluate import UnclearDerivativeError
from polhode.claims.meaning._spelling import spelled
from polhode.claims.states._bound_claim import BoundClaim
from polhode.derive import Equations


@dataclass(frozen=True)
class CheckRequest:
    """A published equation as somebody asks about it; the attributes are the arguments of `check`.

    Attributes:
        latex: the equation, as printed.
        context: where it is to hold.
        let: new symbols of the text.
        given: restrictions.
        small: small quantities with the order to be kept.
        read: letters of several meanings, each with the one that is meant.
        positive: quantities whose sign is stated.
    """

    latex: str
    context: str = "motion"
    let: tuple[str, ...] = ()
    given: tuple[str, ...] = ()
    small: tuple[str, ...] = ()
    read: tuple[str, ...] = ()
    positive: tuple[str, ...] = ()

    def judged(
        self, equations: Equations, tell: Callable[[Verdict], object] = lambda verdict: None
    ) -> Verdict:
        """The verdict; a failure is told as soon as it is found, for a correction may take long.

        Raises `ParseError` as `check` does.
        """
        if self.context not in CONTEXTS:
            raise ParseError(f"context {self.context!r}", expected=f"one of {', '.join(CONTEXTS)}")
        said = [*self.let, *self.given, *self.small, *self.positive]
        verdict = judged_claim(
            self.latex,
            partial(self._notation, equations),
            self.context,
            spoken=lambda: [piece for text in said for piece in spoken(text)],
            tell=tell,
        )
        signs = (f"taking {text} as positive" for text in self.positive)
        return replace(verdict, remarks=(*verdict.remarks, *signs))

    def _notation(self, equations: Equations, chosen: Chosen) -> Notation:
        """With what is said besides, letters of several meanings read as chosen."""
        notation = reduce(with_reading, self.read, Notation.of(equations)).choosing(chosen)
        for say, texts in (
            (with_let, self.let),
            (with_positive, self.positive),
            (with_given, self.given),
            (with_small, self.small),
        ):
            notation = reduce(say, texts, notation)
        return notation


def judged_claim(
    latex: str,
    notation: Callable[[Chosen], Notation],
    context: str,
    when: str = "",
    spoken: Callable[[], Iterable[Piece]] = tuple,
    tell: Callable[[Verdict], object] = lambda verdict: None,
) -> Verdict:
    """The verdict on a claim in every reading of its letters, with a correction where it fails.

    A failure is told as soon as it is found, for a correction may take long.

    Args:
        latex: the claim.
        notation: of the text, letters of several meanings read as chosen.
        context: where it is to hold.
        when: at which times of a motion.
        spoken: what else is said with the claim, whose letters may be read in several ways too.
        tell: called with a failure.

    Raises `ParseError` where what is said besides cannot be read.
    """
    likeliest = notation({})
    try:
        statement = read_latex(latex)
        ways = choices(likeliest.vocabulary, (statement, *spoken()))
    except (PolhodeError, ZeroDivisionError) as error:
        return Verdict.unread(context, error, _hint(latex))

    def judge(chosen: Chosen) -> JudgedReading:
        return _judged_reading(statement, chosen, notation(chosen), context, when, latex)

    found = judged_in_every_reading(ways, judge)
    if isinstance(found, Verdict):
        return with_readings(found, likeliest.vocabulary, [statement])
    verdict = with_readings(found.verdict, found.notation.vocabulary, [statement])
    if verdict.answer is not Answer.FAILS:
        return verdict
    tell(verdict)
    if _is_under_names(verdict):
        why = "no correction is looked for where expressions are kept under names"
        return replace(verdict, remarks=(*verdict.remarks, why))
    if when or found.notation.vocabulary.totals:  # a correction would be read in two ways again
        return verdict
    return _corrected(verdict, statement, found.notation)


def _judged_reading(
    statement: Statement, chosen: Chosen, notation: Notation, context: str, when: str, latex: str
) -> JudgedReading:
    """The verdict under one reading, without a correction."""
    try:
        bound = notation.bound(statement)
        if bound.is_definition:
            verdict = Verdict(Answer.DEFINITION, context, reason=_defined(bound.defined))
            return JudgedReading(chosen, notation, None, verdict)
        asked = replace(notation.asked(statement, {}), when=when)
    except UnclearDerivativeError as error:
        return _by_derivatives(statement, chosen, notation, context, when, latex, error)
    except (PolhodeError, ZeroDivisionError) as error:
        unread = Verdict.unread(context, error, _hint(latex))
        return JudgedReading(chosen, notation, None, unread)
    verdict = _assuming(bound, latex, _judged(asked, context))
    if verdict.answer in (Answer.HOLDS, Answer.FAILS) and not when:
        verdict = _read_twice(verdict, asked, statement, notation)
    return JudgedReading(chosen, notation, asked, verdict)


def _read_twice(
    verdict: Verdict, asked: BoundClaim, statement: Statement, notation: Notation
) -> Verdict:
    """The verdict, unless a reader that shares nothing with the first one reads otherwise."""
    from polhode.claims.contexts._second_reading import disputed  # NumPy, for what was bound alone

    vocabulary = notation.vocabulary
    phrases = {r.letter: r.phrase for r in vocabulary.readings([statement])} | dict(
        vocabulary.chosen
    )
    points = {
        letter: phrase.partition(" about ")[2]
        for letter, phrase in phrases.items()
        if " about " in phrase or letter in vocabulary.chosen
    }
    dispute = disputed(verdict.answer, asked, verdict.context, statement, vocabulary.told, points)
    if not dispute:
        return verdict
    return Verdict(Answer.UNREAD, verdict.context, reason=f"read in two ways: {dispute}")


def _is_under_names(verdict: Verdict) -> bool:
    """Whether what is left is too long to be written out, so that every trial takes long."""
    left = (g for r in verdict.residuals for g in r.expression.generators)
    return any(under_name(generator) is not None for generator in left)


def _by_derivatives(
    statement: Statement,
    chosen: Chosen,
    notation: Notation,
    context: str,
    when: str,
    latex: str,
    unclear: UnclearDerivativeError,
) -> JudgedReading:
    """The verdict where every reading of dE/dθ comes to the same; else it is ambiguous."""
    plain = notation.vocabulary
    found = {
        totals: _judged_reading(
            statement,
            chosen,
            replace(notation, vocabulary=replace(plain, totals=totals)),
            context,
            when,
            latex,
        )
        for totals in ("partial", "along the motion")
    }
    along = found["along the motion"]
    if len({way.verdict.answer for way in found.values()}) == 1:
        return along
    told = "; ".join(f"{way.verdict.answer.value} if read as {how}" for how, way in found.items())
    return replace(along, verdict=Verdict(Answer.AMBIGUOUS, context, reason=f"{unclear}: {told}"))


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


def _judged(asked: BoundClaim, context: str) -> Verdict:
    """The verdict, with terms of different dimensions named where it does not hold."""
    try:
        verdict = judge(asked, context).proved()
        if (second := verdict.confirmation) is not None and not second.agrees:
            return Verdict(Answer.UNREAD, context, reason=_at_odds(verdict))
        odd = "" if verdict.holds else dimensions_at_odds(asked)
    except ParseError as error:
        return Verdict.unread(context, error)
    except (PolhodeError, ZeroDivisionError) as error:
        return Verdict.undecided(context, error)
    return replace(verdict, reason=f"{verdict.reason}; {odd}") if odd else verdict


def _at_odds(verdict: Verdict) -> str:
    """What two judgements that share nothing say differently; then neither is to be trusted."""
    example, second = verdict.counterexample, verdict.confirmation
    exact = f"{example.left} and {example.right}" if example else "a failure"
    numeric = f"{second.left:.9g} and {second.right:.9g}" if second else "nothing"
    return (
        f"read, but not decided: of the two sides, exact algebra finds {exact}, and "
        f"the numeric balance of every body {numeric}"
    )


def _defined(letters: Iterable[Node]) -> str:
    names = ", ".join(spelled(letter) for letter in letters)
    return f"defines {names}; not judged, for nothing else says what that is"


def _corrected(verdict: Verdict, statement: Statement, notation: Notation) -> Verdict:
    from polhode.claims.repair import Repaired, repaired, tidied

    context = verdict.context

    def right(asked: BoundClaim) -> bool:
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

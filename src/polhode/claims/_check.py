"""One claim checked against a model, in every reading of its letters."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial, reduce

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
    pieces_of,
    with_given,
    with_let,
    with_positive,
    with_reading,
    with_small,
)
from polhode.claims._verdict import Answer, Correction, Verdict
from polhode.claims.contexts._contexts import CONTEXTS, holds, judge
from polhode.claims.latex import bare_names, read_latex, write_latex
from polhode.claims.latex._names import spelled
from polhode.claims.latex._tree import Node, Piece, Statement
from polhode.claims.meaning._evaluate import UnclearDerivativeError
from polhode.claims.states._bound_claim import BoundClaim
from polhode.derive import Equations


@dataclass(frozen=True)
class CheckRequest:
    """A published equation and its options; the attributes are the arguments of `check`.

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
        """The verdict; `tell` is called with a failure before a correction is sought.

        Raises `ParseError` as `check` does.
        """
        if self.context not in CONTEXTS:
            raise ParseError(f"context {self.context!r}", expected=f"one of {', '.join(CONTEXTS)}")
        texts = [*self.let, *self.given, *self.small, *self.positive]
        verdict = judged_claim(
            self.latex,
            partial(self._notation, equations),
            self.context,
            accompanying=lambda: [piece for text in texts for piece in pieces_of(text)],
            tell=tell,
        )
        signs = (f"taking {text} as positive" for text in self.positive)
        return replace(verdict, remarks=(*verdict.remarks, *signs))

    def _notation(self, equations: Equations, chosen: Chosen) -> Notation:
        """The notation with every option applied, and ambiguous letters read as chosen."""
        notation = reduce(with_reading, self.read, Notation.of(equations)).choosing(chosen)
        for extended, texts in (
            # New symbols come first, since restrictions and small quantities may use them.
            (with_let, self.let),
            (with_positive, self.positive),
            (with_given, self.given),
            (with_small, self.small),
        ):
            notation = reduce(extended, texts, notation)
        return notation


def judged_claim(
    latex: str,
    notation: Callable[[Chosen], Notation],
    context: str,
    when: str = "",
    accompanying: Callable[[], Iterable[Piece]] = tuple,
    tell: Callable[[Verdict], object] = lambda verdict: None,
) -> Verdict:
    """The verdict on a claim in every reading of its letters, with a correction where it fails.

    Args:
        latex: the claim.
        notation: of the text, with ambiguous letters read as chosen.
        context: where it is to hold.
        when: at which times of a motion.
        accompanying: formulas stated with the claim, whose letters may be ambiguous too.
        tell: called with a failure before a correction is sought, which may take long.

    Raises `ParseError` where a formula stated with the claim cannot be read.
    """
    likeliest = notation({})
    try:
        statement = read_latex(latex)
        readings = choices(likeliest.vocabulary, (statement, *accompanying()))
    except (PolhodeError, ZeroDivisionError) as error:
        return Verdict.unread(context, error, _hint(latex))
    claim = _PublishedClaim(latex, statement, context, when)
    found = judged_in_every_reading(readings, lambda chosen: claim.judged(chosen, notation(chosen)))
    if isinstance(found, Verdict):
        return with_readings(found, likeliest.vocabulary, [statement])
    verdict = with_readings(found.verdict, found.notation.vocabulary, [statement])
    if verdict.answer is not Answer.FAILS:
        return verdict
    tell(verdict)
    # A corrected statement on a whole motion ("never", "finally") has no residual to be fitted, and
    # one with a total derivative would be ambiguous again.
    if when or found.notation.vocabulary.total_derivative:
        return verdict
    return _corrected(verdict, statement, found.notation)


@dataclass(frozen=True)
class _PublishedClaim:
    """A parsed claim, to be judged under one reading of its letters at a time.

    Attributes:
        latex: as printed.
        statement: its tree.
        context: where it is to hold.
        when: at which times of a motion.
    """

    latex: str
    statement: Statement
    context: str
    when: str

    def judged(self, chosen: Chosen, notation: Notation) -> JudgedReading:
        """The verdict under one reading, without a correction."""
        try:
            bound = notation.bound(self.statement)
            if bound.is_definition:
                verdict = Verdict(Answer.DEFINITION, self.context, reason=_defined(bound.defined))
                return JudgedReading(chosen, notation, None, verdict)
            claim = replace(notation.read_claim(self.statement, {}), when=self.when)
        except UnclearDerivativeError as error:
            return self._by_total_derivatives(chosen, notation, error)
        except (PolhodeError, ZeroDivisionError) as error:
            unread = Verdict.unread(self.context, error, _hint(self.latex))
            return JudgedReading(chosen, notation, None, unread)
        verdict = _judged(claim, self.context)
        # Remarks name the conditions under which the verdict holds, and letters that are defined.
        remarks = [f"under the condition {self.latex[slice(*r.span)]}" for r in bound.conditions]
        if bound.defined:
            remarks.append(_defined(bound.defined))
        verdict = replace(verdict, remarks=(*verdict.remarks, *remarks))
        if verdict.answer in (Answer.HOLDS, Answer.FAILS) and not self.when:
            verdict = self._read_twice(verdict, claim, notation)
        return JudgedReading(chosen, notation, claim, verdict)

    def _by_total_derivatives(
        self, chosen: Chosen, notation: Notation, unclear: UnclearDerivativeError
    ) -> JudgedReading:
        """The verdict if both readings of dE/dθ give the same answer; otherwise ambiguous."""
        plain = notation.vocabulary
        found = {
            how: self.judged(
                chosen, replace(notation, vocabulary=replace(plain, total_derivative=how))
            )
            for how in ("partial", "along the motion")
        }
        along = found["along the motion"]
        if len({way.verdict.answer for way in found.values()}) == 1:
            return along
        answers = "; ".join(
            f"{way.verdict.answer.value} if read as {how}" for how, way in found.items()
        )
        ambiguous = Verdict(Answer.AMBIGUOUS, self.context, reason=f"{unclear}: {answers}")
        return replace(along, verdict=ambiguous)

    def _read_twice(self, verdict: Verdict, claim: BoundClaim, notation: Notation) -> Verdict:
        """The verdict, unless an independent second reader contradicts it."""
        # Deferred: it loads NumPy, which only claims that could be bound need.
        from polhode.claims.contexts._second_reading import disputed

        vocabulary = notation.vocabulary
        phrases = {r.letter: r.phrase for r in vocabulary.readings([self.statement])} | dict(
            vocabulary.chosen
        )
        points = {
            letter: phrase.partition(" about ")[2]
            for letter, phrase in phrases.items()
            if " about " in phrase or letter in vocabulary.chosen
        }
        context, stated = verdict.context, vocabulary.stated
        dispute = disputed(verdict.answer, claim, context, self.statement, stated, points)
        if not dispute:
            return verdict
        return Verdict(Answer.UNREAD, context, reason=f"read in two ways: {dispute}")


def _judged(claim: BoundClaim, context: str) -> Verdict:
    """The verdict; for a failure, it names terms of different dimensions."""
    try:
        verdict = judge(claim, context).proved()
        if (second := verdict.confirmation) is not None and not second.agrees:
            # Exact algebra and the numeric balance contradict each other: trust neither.
            example = verdict.counterexample
            exact = f"{example.left} and {example.right}" if example else "a failure"
            reason = (
                f"it was read, but not decided: exact algebra gives {exact} for the two sides, and "
                f"the numeric balance of every body gives {second.left:.9g} and {second.right:.9g}"
            )
            return Verdict(Answer.UNREAD, context, reason=reason)
        odd = "" if verdict.holds else dimensions_at_odds(claim)
    except ParseError as error:
        return Verdict.unread(context, error)
    except (PolhodeError, ZeroDivisionError) as error:
        return Verdict.undecided(context, error)
    return replace(verdict, reason=f"{verdict.reason}; {odd}") if odd else verdict


def _hint(latex: str) -> str:
    """A likely cause why a formula cannot be read or bound: a function without its backslash."""
    bare = bare_names(latex)
    if not bare:
        return ""
    return f"; LaTeX reads {', '.join(bare)} letter by letter, write \\{bare[0]}"


def _defined(letters: Iterable[Node]) -> str:
    names = ", ".join(spelled(letter) for letter in letters)
    return f"defines {names}; not judged, since nothing else determines it"


def _corrected(verdict: Verdict, statement: Statement, notation: Notation) -> Verdict:
    from polhode.claims.repair import Repaired, repaired, tidied

    context = verdict.context

    def is_right(claim: BoundClaim) -> bool:
        return holds(claim, context)

    def correction(repair: Repaired) -> Correction:
        what = "; ".join(dict.fromkeys(change.what for change in repair.changes))
        return Correction(what, write_latex(tidied(repair.statement)))

    try:
        found = repaired(statement, notation, context, is_right)
    except (PolhodeError, ArithmeticError):
        return verdict
    if not found:
        return verdict
    first, *others = map(correction, found)
    return replace(verdict, correction=first, alternatives=tuple(others))

"""One claim checked against a model, in every reading of its letters."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial, reduce

from polhode.algebra import Expr, Symbol, Vector
from polhode.base import TIME, ParseError, PolhodeError
from polhode.derive import Equations
from polhode.judge._dimensions import (
    FORCE,
    defined_at_odds,
    dimensions_at_odds,
    in_words,
    prints_units,
    would_fit,
)
from polhode.judge._notation import Notation
from polhode.judge._readings import (
    BoundReading,
    Chosen,
    JudgedReading,
    TooManyReadingsError,
    agreed,
    choices,
    dropped,
    every_reading,
    fitting,
    with_readings,
)
from polhode.judge._typed import (
    pieces_of,
    with_given,
    with_let,
    with_positive,
    with_reading,
    with_small,
)
from polhode.judge._verdict import Answer, Correction, Verdict
from polhode.judge.contexts._contexts import CONTEXTS, holds, judge
from polhode.judge.latex import as_latex, bare_names, slash_readings
from polhode.judge.latex._names import spelled
from polhode.judge.latex._tree import Name, Node, Omitted, Piece, Statement, Words, walk
from polhode.judge.meaning._derived_quantities import polar_sines
from polhode.judge.meaning._differentials import unequal_differentials
from polhode.judge.meaning._expanded import expanded
from polhode.judge.meaning._meaning import BindingError
from polhode.judge.meaning._phrases import quantity
from polhode.judge.meaning._proposals import MAGNITUDE
from polhode.judge.meaning._vocabulary import Vocabulary
from polhode.judge.states._bound_claim import BoundClaim
from polhode.judge.states._claim_domain import TrueMotion

#: The angular momentum along the z axis.
_ALONG = ("L_x = 0", "L_y = 0")
#: Letters that always have a meaning, with what texts use them for in systems that lack it.
_OTHERWISE = (
    (
        Name("T"),
        "a kinetic energy",
        (("tension", FORCE), ("period", TIME)),
    ),
)
#: Changes that put a dimension right.
_OF_DIMENSION = frozenset({"missing factor", "extra factor", "wrong power"})
_NEGATING = re.compile(r"\b(?:not|never|unless|except|neither|nor|wrong|incorrect|false)\b", re.I)


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
        constants: further letters that stand for constants, as LaTeX, such as a radius on which
            moments of inertia depend.
    """

    latex: str
    context: str = "motion"
    let: tuple[str, ...] = ()
    given: tuple[str, ...] = ()
    small: tuple[str, ...] = ()
    read: tuple[str, ...] = ()
    positive: tuple[str, ...] = ()
    constants: tuple[str, ...] = ()

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
            as_latex(self.latex),
            partial(self._notation, equations),
            self.context,
            accompanying=lambda: [piece for text in texts for piece in pieces_of(text)],
            declared=lambda: reduce(with_reading, self.read, Notation.of(equations)).vocabulary,
            tell=tell,
        )
        signs = (f"taking {text} as positive" for text in self.positive)
        return replace(verdict, remarks=(*verdict.remarks, *signs))

    def _notation(self, equations: Equations, chosen: Chosen) -> Notation:
        """The notation with every option applied, and ambiguous letters read as chosen."""
        named = Notation.of(equations).with_constants(self.constants)
        # New symbols come first, since restrictions and small quantities may use them.
        read = reduce(with_reading, self.read, named).choosing(chosen)
        notation = reduce(with_let, self.let, read).with_lengths()
        for extended, texts in (
            (with_positive, self.positive),
            (with_given, self.given),
            (with_small, self.small),
        ):
            notation = reduce(extended, texts, notation)
        return notation


@dataclass(frozen=True)
class OpenVerdict:
    """A verdict without a correction, and the search for one.

    Attributes:
        verdict: on the claim; its evidence is complete.
        notation: in which the letters were read; None where they could not be, or are ambiguous.
        corrected: the verdict with a correction where the claim fails and one is found, which may
            take long.
        fits: whether it could be read with all terms of one dimension.
    """

    verdict: Verdict
    notation: Notation | None = None
    corrected: Callable[[], Verdict] | None = None
    fits: bool = False

    def remarked(self, remark: str) -> OpenVerdict:
        """With a remark, in the verdict with a correction too."""

        def corrected() -> Verdict:
            found = self.corrected() if self.corrected is not None else self.verdict
            return replace(found, remarks=(*found.remarks, remark))

        verdict = replace(self.verdict, remarks=(*self.verdict.remarks, remark))
        return replace(self, verdict=verdict, corrected=self.corrected and corrected)


def judged_claim(
    latex: str,
    notation: Callable[[Chosen], Notation],
    context: str,
    when: str = "",
    accompanying: Callable[[], Iterable[Piece]] = tuple,
    declared: Callable[[], Vocabulary] | None = None,
    tell: Callable[[Verdict], object] = lambda verdict: None,
) -> Verdict:
    """The verdict on a claim in every reading of its letters, with a correction where it fails.

    Args:
        latex: the claim.
        notation: of the text, with ambiguous letters read as chosen.
        context: where it is to hold.
        when: at which times of a motion.
        accompanying: formulas stated with the claim, whose letters may be ambiguous too.
        declared: the letters without these formulas, by which the readings are found where the
            formulas cannot be bound in the likeliest one.
        tell: called with a failure before a correction is sought, which may take long.

    Raises `ParseError` where a formula stated with the claim cannot be read.
    """
    found = judgement(latex, notation, context, when, accompanying, declared)
    if found.verdict.answer is Answer.FAILS:
        tell(found.verdict)
    return found.corrected() if found.corrected is not None else found.verdict


def judgement(
    latex: str,
    notation: Callable[[Chosen], Notation],
    context: str,
    when: str = "",
    accompanying: Callable[[], Iterable[Piece]] = tuple,
    declared: Callable[[], Vocabulary] | None = None,
) -> OpenVerdict:
    """The verdict on a claim in every reading of its letters; a correction is sought on request.

    The arguments are those of `judged_claim`.

    Raises `ParseError` where a formula stated with the claim cannot be read.
    """
    try:
        statements = slash_readings(latex)
    except PolhodeError as error:
        return OpenVerdict(Verdict.unread(context, error, _hint(latex)))
    known: dict[frozenset[tuple[Node, str]], Notation] = {}  # each keeps the values of its letters

    def kept(chosen: Chosen) -> Notation:
        key = frozenset(chosen.items())
        if key not in known:
            known[key] = notation(chosen)
        return known[key]

    found = {
        way: _judged_statement(way, statement, kept, context, when, accompanying, declared)
        for way, statement in statements.items()
    }
    agreed_on = _agreed_on_slashes(found)
    if agreed_on.fits or agreed_on.verdict.answer is not Answer.FAILS:
        return agreed_on
    for way, statement in statements.items():
        other = _with_lagrangian(statement, _likeliest(kept, declared))
        if other is not None:
            meant = _judged_statement(way, other, kept, context, when, accompanying, declared)
            if meant.fits:
                return meant.remarked("L is read as the Lagrangian where it stands alone")
    return agreed_on


def may_hold(latex: str, notation: Callable[[Chosen], Notation], context: str) -> bool:
    """Whether a claim may hold, or hold under simple conditions, in a reading of its letters.

    It seeks no evidence for its answer, and so takes less time than `judgement`, whose arguments
    it has.
    """
    try:
        statements = slash_readings(latex)
        vocabulary = notation({}).vocabulary
        ways = [*statements.items()]
        ways += [
            (way, other)
            for way, statement in statements.items()
            if (other := _with_lagrangian(statement, vocabulary)) is not None
        ]
        for way, statement in ways:
            claim = _PublishedClaim(way, expanded(statement, vocabulary), context, "")
            readings = choices(vocabulary, (claim.statement,))
            for reading in fitting([claim.bound(chosen, notation) for chosen in readings]):
                if reading.claim is None or reading.claim.initial.values:
                    return True
                verdict = judge(reading.claim, context)
                if verdict.answer is not Answer.FAILS or verdict.is_conditional:
                    return True
                if context == "limit" and _lacks_only_a_constant(reading.claim):
                    return True
    except (PolhodeError, ArithmeticError):
        return True  # the full judgement says what is wrong
    return False


def _judged_statement(
    latex: str,
    statement: Statement,
    notation: Callable[[Chosen], Notation],
    context: str,
    when: str,
    accompanying: Callable[[], Iterable[Piece]],
    declared: Callable[[], Vocabulary] | None,
) -> OpenVerdict:
    """The verdict on a claim that was parsed, in every reading of its letters."""
    vocabulary = _likeliest(notation, declared)
    try:
        written_out = expanded(statement, vocabulary)
    except BindingError as error:
        return OpenVerdict(Verdict.unread(context, error, _hint(latex)))
    claim = _PublishedClaim(latex, written_out, context, when)
    try:
        readings = choices(vocabulary, (written_out, *accompanying()))
        bound = [claim.bound(chosen, notation) for chosen in readings]
        if all(reading.notation is None for reading in bound) and bound[0].trouble is not None:
            raise bound[0].trouble  # a formula stated with the claim is bad input
        found = agreed([claim.judged(reading) for reading in fitting(bound)])
    except (TooManyReadingsError, ZeroDivisionError) as error:
        return OpenVerdict(Verdict.unread(context, error))
    if isinstance(found, Verdict):
        ambiguous = with_readings(found, vocabulary, [written_out])
        return OpenVerdict(ambiguous, fits=any(reading.fits for reading in bound))
    near = _slip_in_energy(claim, bound) if found.reading.claim is None else None
    return near or _open_verdict(claim, found, bound, vocabulary)


def _open_verdict(
    claim: _PublishedClaim,
    found: JudgedReading,
    bound: Sequence[BoundReading],
    vocabulary: Vocabulary,
) -> OpenVerdict:
    """The verdict in the reading that stands, with the search for a correction."""
    kept, verdict, context = found.reading, found.verdict, claim.context
    if kept.notation is None:
        return OpenVerdict(verdict)
    if verdict.answer is Answer.FAILS and (reason := _meant_otherwise(kept, vocabulary)):
        other = Verdict(Answer.UNREAD, context, reason, option="let", at_odds=verdict.at_odds)
        return OpenVerdict(other, kept.notation)
    verdict = replace(verdict, remarks=(*verdict.remarks, *dropped(bound, kept)))
    if verdict.answer is not Answer.FAILS:
        return OpenVerdict(verdict, kept.notation, fits=kept.fits)
    # A corrected statement with a total derivative would be ambiguous again.
    if any(not isinstance(letter, Name) for letter in kept.chosen):
        return OpenVerdict(verdict, kept.notation, fits=kept.fits)
    correct = partial(_corrected, verdict, claim.latex, claim.statement, kept.notation)
    return OpenVerdict(verdict, kept.notation, correct, kept.fits)


def _slip_in_energy(claim: _PublishedClaim, bound: Iterable[BoundReading]) -> OpenVerdict | None:
    """The failure of what is no definition of a letter: an energy with a factor lost.

    The K of ½(v² + k²ω²) is a kinetic energy without its mass, and that of a cos²θ is the text's
    own: one change of a factor or of a power makes the first hold, with its dimension.
    """
    for reading in bound:
        moving = [m for m in _sides(reading) if m.varies]
        if not moving or reading.fits or not reading.is_of_energies:
            continue
        failing = claim.judged(reading).verdict
        if failing.answer is not Answer.FAILS or not failing.at_odds or reading.notation is None:
            continue
        found = _corrected(failing, claim.latex, claim.statement, reading.notation)
        if found.correction is not None and found.correction.what in _OF_DIMENSION:
            return OpenVerdict(failing, reading.notation, partial(replace, found))
    return None


def _sides(reading: BoundReading) -> Iterator[Expr]:
    """The scalars that the members of a claim set equal."""
    for member in reading.claim.members if reading.claim is not None else ():
        yield from (side for side in (member.left, member.right) if isinstance(side, Expr))


def _with_lagrangian(statement: Statement, vocabulary: Vocabulary) -> Statement | None:
    """A statement with the Lagrangian for an L that stands alone; None without such an L.

    Of a rod of length L, L = T - V speaks of both.
    """
    length, lagrangian = Name("L"), Name("cal L")
    if length not in vocabulary.declared:
        return None
    relations = tuple(
        replace(r, sides=tuple(lagrangian if side == length else side for side in r.sides))
        for r in statement.relations
    )
    return replace(statement, relations=relations) if relations != statement.relations else None


def _meant_otherwise(reading: BoundReading, vocabulary: Vocabulary) -> str:
    """That a letter seems to stand for what the system does not have; empty if none does.

    The T of a cable, which is declared as a support, is no kinetic energy.
    """
    claim = reading.claim
    if claim is None or reading.fits:
        return ""
    known = {*vocabulary.declared, *vocabulary.stated, *vocabulary.chosen, *vocabulary.allowed}
    printed = [member.printed for member in claim.members if member.printed is not None]
    letters = {p for one in printed for side in (one.left, one.right) for p in walk(side)}
    for letter, usual, quantities in _OTHERWISE:
        if letter not in letters - known:
            continue
        if fitting := [what for what, d in quantities if would_fit(claim, letter, d)]:
            return (
                f"{spelled(letter)}, whose dimension here is not that of {usual}; expected a "
                f"quantity of the system; say which {' or '.join(fitting)} it is"
            )
    return ""


def _agreed_on_slashes(ways: Mapping[str, OpenVerdict]) -> OpenVerdict:
    """The verdict on a claim from those in each reading of its slashes.

    Those in which all terms have one dimension count, if there are any.
    """
    fitting = {way: found for way, found in ways.items() if found.fits} or ways
    # What can be judged in one reading defines no letter in another.
    claims = {w: f for w, f in fitting.items() if f.verdict.answer is not Answer.DEFINITION}
    fitting = claims or fitting
    way, found = next(iter(fitting.items()))
    if len(ways) == 1:
        return found
    if len({found.verdict.answer for found in fitting.values()}) == 1:
        return found.remarked(f"read as {way}")
    told = "; ".join(f"{f.verdict.answer.value} if it is read as {w}" for w, f in fitting.items())
    reason = rf"{told}; to choose, write \frac or brackets in place of the slash"
    return OpenVerdict(Verdict(Answer.AMBIGUOUS, found.verdict.context, reason=reason))


def _likeliest(
    notation: Callable[[Chosen], Notation], declared: Callable[[], Vocabulary] | None
) -> Vocabulary:
    """The letters in the likeliest reading, or those declared if that makes no sense."""
    try:
        return notation({}).vocabulary
    except ParseError:
        if declared is None:
            raise
        return declared()


@dataclass(frozen=True)
class _PublishedClaim:
    """A parsed claim, to be judged under one reading of its letters at a time.

    Attributes:
        latex: as printed.
        statement: its tree, with indices and matrices written out.
        context: where it is to hold.
        when: at which times of a motion.
    """

    latex: str
    statement: Statement
    context: str
    when: str

    def bound(self, chosen: Chosen, notation: Callable[[Chosen], Notation]) -> BoundReading:
        """The claim bound under one reading."""
        meaning = None
        try:
            meaning = notation(chosen).at(self.when)
            bound = meaning.bound(self.statement)
            if bound.is_definition:
                return BoundReading(chosen, meaning, bound)
            claim = meaning.claimed(bound)
            claim.components()  # refuses scalars set against vectors
        except (PolhodeError, ZeroDivisionError) as error:
            return BoundReading(chosen, meaning, trouble=error)
        return BoundReading(chosen, meaning, bound, claim)

    def judged(self, reading: BoundReading) -> JudgedReading:
        """The verdict under one reading with what letters mean in it, without a correction."""
        verdict = self._verdict(reading)
        if reading.notation is not None:
            verdict = with_readings(verdict, reading.notation.vocabulary, [self.statement])
        return JudgedReading(reading, verdict)

    def _verdict(self, reading: BoundReading) -> Verdict:
        bound, claim, notation = reading.bound, reading.claim, reading.notation
        if bound is None or notation is None:
            trouble = reading.trouble or ValueError()
            hint = _hint(self.latex) or reading.unfit(getattr(trouble, "symbol", ""))
            return Verdict.unread(self.context, trouble, hint)
        if claim is None:
            equations = notation.vocabulary.mechanics.equations
            reason = f"{_defined(bound.defined)}{reading.unfit(*map(spelled, bound.defined))}"
            unlike = defined_at_odds(equations, bound.defined.values())
            if unlike:
                reason = f"its terms differ in dimension: {in_words(unlike)}"
                return Verdict(Answer.FAILS, self.context, reason=reason, at_odds=unlike)
            return Verdict(Answer.DEFINITION, self.context, reason=reason)
        unclear = self._loose() or self._negated()
        if unclear:
            return Verdict(Answer.UNREAD, self.context, reason=unclear)
        verdict = _judged_from_start(claim, self.context)
        if verdict.holds and (odd := unequal_differentials(self.statement)):
            return Verdict(Answer.FAILS, self.context, reason=odd)
        printed = {sign for relation in self.statement.relations for sign in relation.signs}
        if verdict.holds and any(r.sign == "≤" for r in claim.members) and "≤" not in printed:
            reason = "it was read, but only that no value exceeds the greatest one was tested"
            return Verdict(Answer.UNREAD, self.context, reason=reason)
        # Remarks name the conditions under which the verdict holds, and letters that are defined.
        remarks = [f"under the condition {self.latex[slice(*r.span)]}" for r in bound.conditions]
        if bound.defined:
            remarks.append(_defined(bound.defined))
        remarks += claim.initial.remarks
        stated = notation.vocabulary.positive
        remarks += [
            f"taking {sine} as positive, since a polar angle runs from 0 to pi"
            for sine in polar_sines(notation.vocabulary.mechanics)
            if sine in claim.positive and sine not in stated
        ]
        verdict = replace(verdict, remarks=(*verdict.remarks, *remarks))
        if verdict.answer in (Answer.HOLDS, Answer.FAILS) and not self.when:
            verdict = self._read_twice(verdict, claim, notation)
        if verdict.answer is Answer.FAILS and self._holds_along_momentum(notation):
            reason = (
                f"it holds where the z axis is along the angular momentum, {' and '.join(_ALONG)}"
            )
            advice = "and fails for another; if that axis is meant, state it and write L_z for L"
            reason = f"{reason}, {advice}"
            return Verdict(Answer.AMBIGUOUS, self.context, reason=reason, option="given")
        return verdict

    def _holds_along_momentum(self, notation: Notation) -> bool:
        """Whether it holds if the z axis of a free body is taken along its angular momentum.

        So texts choose it that have φ̇ = L/I₁ for a symmetric body.
        """
        mechanics = notation.vocabulary.mechanics
        sizes = {
            r.letter: r.phrase.removeprefix(MAGNITUDE)
            for r in notation.vocabulary.readings((self.statement,))
            if r.phrase.startswith(f"{MAGNITUDE}angular momentum about ")
        }
        try:
            torque = quantity(mechanics, "torque about cm") if sizes else None
            if not isinstance(torque, Vector) or not torque.is_zero:
                return False
            along = reduce(with_given, _ALONG, notation)
            upwards = {n: quantity(mechanics, f"{p} along axis z") for n, p in sizes.items()}
            along = replace(along, vocabulary=along.vocabulary.stating(upwards))
            claim = along.claimed(along.bound(self.statement))
            if _judged_from_start(claim, self.context).answer is not Answer.HOLDS:
                return False
            # With what is given besides, it may be that nothing moves, and zero is zero.
            states = claim.states(TrueMotion)
            return not all(states.vanishing(c.left).is_zero for c in claim.components())
        except (PolhodeError, ZeroDivisionError):
            return False

    def _loose(self) -> str:
        """Why a piece without a relation sign, beside others that have one, cannot be judged."""
        loose = [
            r
            for r in self.statement.relations
            if not r.signs and not isinstance(r.sides[0], Omitted | Words)
        ]
        if not loose or len(loose) == len(self.statement.relations):
            return ""
        printed = self.latex[slice(*loose[0].span)].strip()
        return (
            f"{printed} has no relation sign, and so states nothing; leave it out, or write the "
            "whole relation"
        )

    def _negated(self) -> str:
        """Why a relation beside words such as "not" cannot be judged as it stands."""
        words = (word for note in self.statement.notes for word in _NEGATING.findall(note))
        word = next(words, "")
        return f"the word {word!r} beside it may take back what it states" if word else ""

    def _read_twice(self, verdict: Verdict, claim: BoundClaim, notation: Notation) -> Verdict:
        """The verdict, unless an independent second reader contradicts it."""
        # Deferred: it loads NumPy, which only claims that could be bound need.
        from polhode.judge.contexts._second_reading import disputed

        vocabulary = notation.vocabulary
        found = every_reading(vocabulary, [self.statement])
        meant = {
            r.letter: r.phrase
            for r in found
            if len(r.phrases) > 1
            or r.letter in (*vocabulary.chosen, *vocabulary.allowed)
            or " about " in r.phrase
        }
        context, stated = verdict.context, vocabulary.stated
        dispute = disputed(verdict.answer, claim, context, self.statement, stated, meant)
        if not dispute:
            return verdict
        return Verdict(Answer.UNREAD, context, reason=f"read in two ways: {dispute}")


def _judged_from_start(claim: BoundClaim, context: str) -> Verdict:
    """The verdict; one that hangs on a start of which the claim says nothing is not certain."""
    verdict, start = _judged(claim, context), claim.initial
    if verdict.answer is not Answer.FAILS:
        return verdict
    if context == "limit" and _lacks_only_a_constant(claim):
        reason = (
            "true but for a constant of integration, since the rates of both sides agree: it "
            "holds on motions that start where it is true, and fails on others; to choose, "
            "judge it in the context launch, and say where the motion starts"
        )
        return Verdict(Answer.AMBIGUOUS, context, reason=reason, option="given")
    if start.values and context == "motion":
        from polhode.judge.contexts._integrated import is_solution  # as contexts are

        solved = is_solution(claim)
        if solved:
            reason = "it meets the equation of motion and the values at the start"
            return Verdict(Answer.HOLDS, context, reason=reason)
        if solved is None:
            reason = "it was read, but of what depends on time only the coordinate itself is judged"
            return Verdict(Answer.UNREAD, context, reason=reason)
    if start.placed:
        names = ", ".join(q.published for q in start.placed)
        reason = f"it was read, but not decided: it depends on the initial value of {names}"
        return Verdict(Answer.UNREAD, context, reason=reason)
    # At rest in one coordinate, as a top is released, or in all that the claim leaves out.
    for rates in dict.fromkeys([*((rate,) for rate in start.free), start.unsaid]):
        if rates and _holds_if_resting(claim, rates, context):
            names = " and ".join(f"{rate.published} = 0" for rate in rates)
            first = Expr.generator(rates[0]).latex()
            reason = (
                f"holds if the motion starts with {names}, of which it says nothing; fails "
                f"otherwise; to choose, restrict it, as in given {first}_0 = 0"
            )
            return Verdict(Answer.AMBIGUOUS, context, reason=reason, option="given", resting=rates)
    return verdict


def _lacks_only_a_constant(claim: BoundClaim) -> bool:
    from polhode.judge.contexts._integrated import lacks_only_a_constant  # as contexts are

    return lacks_only_a_constant(claim)


def _holds_if_resting(claim: BoundClaim, rates: Sequence[Symbol], context: str) -> bool:
    """Whether it holds where these rates vanish at the start, and not because they always do."""
    initial = claim.initial
    resting = tuple(initial.values[rate] for rate in rates)
    started = replace(claim, relations=(*claim.relations, *resting))
    try:
        states = started.states(TrueMotion)
        spoken_of = (rate for rate in rates if rate not in initial.unsaid)
        moves = all(states.on(Expr.generator(rate)) for rate in spoken_of)
        return moves and holds(started, context)
    except (PolhodeError, ZeroDivisionError):
        return False


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
        # A number without a unit is in SI units, whatever it is of.
        is_plain = (verdict.holds or context == "number") and not prints_units(claim)
        odd = () if is_plain else dimensions_at_odds(claim)
        if odd and verdict.holds:
            verdict = Verdict(Answer.FAILS, context, "the numbers agree, but not their units")
    except ParseError as error:
        return Verdict.unread(context, error)
    except (PolhodeError, ZeroDivisionError) as error:
        return Verdict.undecided(context, error)
    if not odd:
        return verdict
    # Where the terms have different dimensions, numbers that make them equal mean nothing.
    remarks = tuple(r for r in verdict.remarks if r != verdict.where_it_holds)
    reason = f"{verdict.reason}; {in_words(odd)}"
    return replace(verdict, reason=reason, remarks=remarks, holds_where=(), at_odds=odd)


def _hint(latex: str) -> str:
    """A likely cause why a formula cannot be read or bound: a function without its backslash."""
    bare = bare_names(latex)
    if not bare:
        return ""
    return f"; LaTeX reads {', '.join(bare)} letter by letter, write \\{bare[0]}"


def _defined(letters: Iterable[Node]) -> str:
    names = ", ".join(spelled(letter) for letter in letters)
    return f"defines {names}; not judged, since nothing else determines it"


def _corrected(verdict: Verdict, latex: str, statement: Statement, notation: Notation) -> Verdict:
    from polhode.judge.repair import Repaired, repaired, spelled

    context = verdict.context

    def is_right(claim: BoundClaim) -> bool:
        return holds(claim, context)

    def correction(repair: Repaired) -> Correction:
        what = "; ".join(dict.fromkeys(change.what for change in repair.changes))
        return Correction(what, spelled(latex, statement, repair.statement))

    try:
        wrong = {residual.member for residual in verdict.residuals}
        found = repaired(statement, notation, context, wrong, is_right)
    except (PolhodeError, ArithmeticError):
        return verdict
    if not found:
        return verdict
    first, *others = map(correction, found)
    return replace(verdict, correction=first, alternatives=tuple(others))

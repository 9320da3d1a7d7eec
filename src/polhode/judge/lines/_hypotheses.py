"""What a line that fails may be meant of: a small, closed family of hypotheses.

Words around a line are hardly asked: whatever they say, a text may mean its line of the state that
a formula near it states, of steady motion, of small departures, or of a motion from a certain
start. Only where its sentence names a position is it tried at the places of symmetry of each angle.
A hypothesis counts only if no printed term vanishes under it, since any factor of what vanishes
would do.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import combinations

from polhode.algebra import PI, ZERO, Expr, Symbol, SymbolKind, as_symbol, time
from polhode.base import NumericError, PolhodeError
from polhode.derive import Equations
from polhode.judge._verdict import Answer, Verdict
from polhode.judge.contexts._equations import at_given_accelerations
from polhode.judge.lines._judged_line import (
    JudgedLine,
    differs_by_a_constant,
    holds_in,
    in_context,
    may_define,
    may_hold_in,
)
from polhode.judge.lines._needs import as_approximate
from polhode.judge.lines._vacuous import is_void, terms
from polhode.judge.meaning._initial_values import initial_value
from polhode.judge.meaning._mechanics import is_acceleration
from polhode.judge.meaning._relations import BoundRelation, ScalarRelation
from polhode.judge.states._bound_claim import EQUALITY, BoundClaim, Small
from polhode.judge.states._claim_domain import TrueMotion
from polhode.judge.states._steady_states import steady_states
from polhode.judge.text._cues import Role
from polhode.judge.text._in_force import InForce
from polhode.judge.text._text_line import TextLine, essential_coordinates

_SENTENCE_END = re.compile(r"[.!?;](?=\s|\Z)|\n\s*\n")
#: A condition behind its claim: in the same sentence, after one of a closed list of words.
_IF = re.compile(
    r"\b(?:if|when|whenever|where|for|provided|at|with|assuming|given|once|while|as)\b[^.]*\Z"
)
#: A sentence that names a position, of which an angle then has a value of symmetry.
_POSITION = re.compile(
    r"\b(?:upright|vertical|horizontal|level|lowest|highest|bottom|top|middle|cent(?:re|er)|inverted"
    r"|straight|sideways|on edge|lies flat)(?:ly)?\b",
    re.I,
)
_MOST_GIVEN = 8  # formulas of a paragraph that are taken as given
_FROM_REST = "a start from rest"
_CENTRES = (ZERO, Expr.generator(PI) / 2, Expr.generator(PI))


@dataclass(frozen=True)
class Hypothesis:
    """What a line may be meant of.

    Attributes:
        words: what it needs, as LaTeX within words.
        line: with what is supposed.
        context: in which it is judged.
        is_approximate: whether = is read as ≈, to the leading order.
        is_said: whether the text states it for the line: in its sentence, or for what comes behind.
    """

    words: str
    line: TextLine
    context: str
    is_approximate: bool = False
    is_said: bool = False

    def judged(self, equations: Equations) -> JudgedLine:
        """The line under it."""
        return JudgedLine(
            self.line, in_context(self.line, equations, {}, self.context, self._latex)
        )

    def may_hold(self, equations: Equations) -> bool:
        """Whether the line may hold under it."""
        return may_hold_in(self.line, equations, {}, self.context, self._latex)

    @property
    def _latex(self) -> str:
        return as_approximate(self.line) if self.is_approximate else ""


def supposed(
    judged: JudgedLine, near: Sequence[JudgedLine], equations: Equations
) -> JudgedLine | None:
    """A line that fails, as it holds under the first hypothesis that says something; or None.

    Args:
        judged: the line.
        near: the other lines of its paragraph.
        equations: of the system.
    """
    claim = judged.claim
    if claim is None or any(member.sign not in (*EQUALITY, "≈") for member in claim.members):
        return None  # an inequality that always holds is no condition of stability
    for hypothesis in _family(judged, near, equations):
        with suppress(PolhodeError, ArithmeticError):
            if not hypothesis.may_hold(equations):
                continue
            found = hypothesis.judged(equations)
            if found.verdict.answer is Answer.AMBIGUOUS and hypothesis.is_said:
                return found  # it holds in one reading of its letters
            if _defines_what_is_claimed(found):
                continue
            if found.verdict.holds and _counts(found, hypothesis.context, equations):
                if not hypothesis.is_said:
                    return replace(found, needs=hypothesis.words)
                said = replace(found.line, read_as=f"with {hypothesis.words}")
                return replace(found, line=said)
    if _solves(judged, equations):
        return replace(judged, needs="a start at which it is so")
    if _is_of_a_start(judged, equations):
        return replace(judged, needs="a start, or a level, at which both sides are equal")
    return None


def _defines_what_is_claimed(found: JudgedLine) -> bool:
    """Whether it holds by taking the letter that it is about as defined there: no hypothesis."""
    relation = found.line.relation.relation
    return relation is not None and may_define(found.verdict, relation.sides[0])


def with_what_stands(judged: JudgedLine, near: Sequence[JudgedLine]) -> JudgedLine:
    """A line in need of a condition, true where the text states just this for what comes behind."""
    stated = (o for o in near if o.line.relation.latex == judged.needs)
    if any(_is_said_of(judged.line, other) for other in stated):
        said, verdict = f"with {judged.needs}", judged.verdict
        holds = Verdict(Answer.HOLDS, verdict.context, said, readings=verdict.readings)
        judgement = replace(judged.judgement, verdict=holds, corrected=None)
        return replace(
            judged, line=replace(judged.line, read_as=said), judgement=judgement, needs=""
        )
    return judged


def _family(
    judged: JudgedLine, near: Sequence[JudgedLine], equations: Equations
) -> Iterator[Hypothesis]:
    line, stated = judged.line, judged.line.in_force
    for words, relations, is_said in _given(near, line):
        there = replace(line, in_force=stated.under(relations))
        yield Hypothesis(words, there, "motion", is_said=is_said)
        yield Hypothesis(f"steady motion with {words}", there, "steady")
        if stated.start:
            yield Hypothesis(words, there, "launch", is_said=is_said)
    yield Hypothesis("steady motion", line, "steady")
    for words, there in _at_places(line, equations):
        yield Hypothesis(words, there, "motion")
        yield Hypothesis(f"steady motion with {words}", there, "steady")
    is_from_rest = line.cues.is_at_rest or stated.is_from_rest
    for words, started in _from_rest(judged, equations):
        is_said = is_from_rest and words == _FROM_REST
        yield Hypothesis(words, replace(line, in_force=started), "launch", is_said=is_said)
    for q in essential_coordinates(equations):
        coordinate, rate = Expr.generator(q), Expr.generator(q.derivative())
        for centre in _CENTRES:
            order = _order(judged, {coordinate: centre, rate: ZERO})
            small = (Small(coordinate - centre, order, q), Small(rate, order, rate.symbol))
            there = replace(line, in_force=replace(stated, small=small))
            yield Hypothesis(f"small {(coordinate - centre).latex()}", there, "limit", True)
    yield from _all_small(judged, equations)


def _at_places(line: TextLine, equations: Equations) -> Iterator[tuple[str, TextLine]]:
    """The line at each place of symmetry, where its sentence names a position in words."""
    if _POSITION.search(" ".join(_sentence_around(line))) is None:
        return
    for q in essential_coordinates(equations):
        value = Expr.generator(q)
        for centre in _CENTRES:
            there = line.in_force.under((BoundRelation(value, "=", centre),))
            yield f"{value.latex()} = {centre.latex()}", replace(line, in_force=there)


def _sentence_around(line: TextLine) -> tuple[str, str]:
    """What stands before a line in its sentence, and what behind it."""
    before = _SENTENCE_END.split(line.relation.before)[-1]
    return before, _SENTENCE_END.split(line.relation.after, maxsplit=1)[0]


def _all_small(judged: JudgedLine, equations: Equations) -> Iterator[Hypothesis]:
    """Every coordinate that matters small, with its rate: oscillations about where all vanish."""
    coordinates = essential_coordinates(equations)
    quantities = [s for q in coordinates for s in (q, q.derivative())]
    if len(coordinates) > 1:
        order = _order(judged, {Expr.generator(s): ZERO for s in quantities})
        small = tuple(Small(Expr.generator(s), order, s) for s in quantities)
        there = replace(judged.line, in_force=replace(judged.line.in_force, small=small))
        words = " and ".join(f"small {Expr.generator(q).latex()}" for q in coordinates)
        yield Hypothesis(words, there, "limit", True)


def _order(judged: JudgedLine, state: Mapping[Expr, Expr]) -> int:
    """The order to which small quantities are kept: 1, or 2 where no side has a linear part.

    Energies, which are of second order in the rates of all coordinates, are kept to that order.
    """
    values = {as_symbol(quantity): value for quantity, value in state.items()}
    claim = judged.claim
    sides = [s for c in claim.components() for s in (c.left, c.right)] if claim is not None else []
    if any(_is_square_in_rates(term) for side in sides for term in terms(side)):
        return 2
    with suppress(PolhodeError, ArithmeticError):
        if any(side.diff(symbol).subs(values) for side in sides for symbol in values):
            return 1
    return 2


def _is_square_in_rates(term: Expr) -> bool:
    """Whether a term is of second order in rates or speeds, as one of a kinetic energy."""
    moving = [s for s in term.symbols() if s.order == 1 or s.kind is SymbolKind.SPEED]
    with suppress(PolhodeError, ArithmeticError):
        return any(term.diff(one).diff(other) for one in moving for other in moving)
    return False


def _from_rest(judged: JudgedLine, equations: Equations) -> Iterator[tuple[str, InForce]]:
    """A motion that starts from rest at a printed θ₀, and places of symmetry that it passes."""
    claim = judged.claim
    sides = [s for c in claim.components() for s in (c.left, c.right)] if claim is not None else []
    printed = {symbol for side in sides for symbol in side.symbols()}
    for q in essential_coordinates(equations):
        if initial_value(q) not in printed:
            continue
        value = Expr.generator(q)
        start = (
            BoundRelation(value, "=", Expr.generator(initial_value(q))),
            *(BoundRelation(Expr.generator(s), "=", ZERO) for s in equations.speeds),
        )
        there = judged.line.in_force.starting(start)
        kept = tuple(
            BoundRelation(Expr.generator(s), "=", ZERO, is_lasting=True)
            for s in _kept_at_zero(equations)
        )
        if kept:
            yield _FROM_REST, there.under(kept)
        for centre in _CENTRES:
            words = f"{value.latex()} = {centre.latex()}, from rest"
            yield words, there.under((BoundRelation(value, "=", centre),))


def _kept_at_zero(equations: Equations) -> frozenset[Symbol]:
    """The speeds that stay zero in every motion in which they are zero at the start."""
    kept = frozenset(equations.speeds)
    while True:
        zero = dict.fromkeys(kept, ZERO)
        still = {s for s in kept if not equations.accelerations[s.derivative()].subs(zero)}
        if still == kept:
            return kept
        kept = frozenset(still)


def is_condition(judged: JudgedLine) -> bool:
    """Whether a line says nothing of a motion, but which states it speaks of: θ̇ = 0, tan θ = μ.

    It relates coordinates and parameters alone, sets one quantity to a constant or a product of
    such quantities to zero, or sets several accelerations to zero.
    """
    claim, notation = judged.claim, judged.judgement.notation
    if claim is None or notation is None:
        return False
    known = {*notation.vocabulary.declared, *notation.vocabulary.stated}
    if (
        any(member.sign not in EQUALITY for member in claim.members)
        or {*judged.line.letters} - known
    ):
        return False  # the T of T = ... has a value on every motion
    components = claim.components()
    return all(map(_chooses_states, components)) or (len(components) > 1 and _stands_still(judged))


def _chooses_states(component: ScalarRelation) -> bool:
    moving = {s for s in component.difference.symbols() if s.kind.varies}
    if moving and all(s.kind is SymbolKind.COORDINATE and not s.order for s in moving):
        return True
    sides = ((component.left, component.right), (component.right, component.left))
    return any(
        (_is_of_state(one) and not other.varies) or (_is_product(one) and not other)
        for one, other in sides
    )


def _is_product(side: Expr) -> bool:
    """Whether a side is one product of quantities of the state, and perhaps parameters."""
    moving = [s for s in side.symbols() if s.kind.varies]
    is_single = len(tuple(terms(side))) == 1 and not side.denominator.varies
    return len(moving) > 1 and is_single and all(_is_of_state(Expr.generator(s)) for s in moving)


def _is_of_state(quantity: Expr) -> bool:
    """Whether a quantity is a coordinate or a speed, which the motion does not determine."""
    symbol = quantity.symbol
    is_state = symbol is not None and symbol.kind in (SymbolKind.COORDINATE, SymbolKind.SPEED)
    return symbol is not None and is_state and not is_acceleration(symbol)


def _stands_still(judged: JudgedLine) -> bool:
    """Whether a line sets accelerations to zero, as of an equilibrium or a turning point."""
    components = judged.claim.components() if judged.claim is not None else ()
    sides = [side for c in components for side in (c.left, c.right) if side]
    return len(sides) > 0 and all(
        side.symbol is not None and is_acceleration(side.symbol) for side in sides
    )


def _given(
    near: Sequence[JudgedLine], line: TextLine
) -> Iterator[tuple[str, tuple[BoundRelation, ...], bool]]:
    """Equations of the paragraph that are no claims on every motion, alone and two together."""
    found = list[tuple[str, tuple[BoundRelation, ...], bool]]()
    for other in near:
        bound = other.bound
        chooses = other.stated or is_condition(other) or _stands_still(other)
        is_wrong = other.verdict.answer is Answer.FAILS and not chooses
        is_claim = other.verdict.holds or is_wrong
        is_excepted = other.line.cues.role is Role.EXCEPTION
        if bound is None or is_claim or is_excepted or bound.defined or len(bound.branches) > 1:
            continue
        relations = bound.relations
        if relations and all(r.sign in EQUALITY for r in relations):
            found.append((other.line.relation.latex, relations, _is_said_of(line, other)))
    found = [each for each in found if each[0] != line.relation.latex][-_MOST_GIVEN:]
    yield from found
    for (one, relations, is_said), (other_one, more, is_other_said) in combinations(found, 2):
        yield f"{one} and {other_one}", (*relations, *more), is_said and is_other_said


def _is_said_of(line: TextLine, condition: JudgedLine) -> bool:
    """Whether a condition stands for a line: one of its sentence, or an assumption before it."""
    latex = condition.line.relation.latex
    before, behind = _sentence_around(line)
    if latex in before:
        return True
    if latex in behind:
        return _IF.search(behind[: behind.index(latex)]) is not None
    is_assumed = condition.stated.startswith("an assumption")
    said = condition.line.cues
    is_lasting = said.role is not Role.CONDITION and not said.is_of_equilibrium
    return is_assumed and is_lasting and latex in line.relation.before


def _counts(found: JudgedLine, context: str, equations: Equations) -> bool:
    """Whether a line that holds under a hypothesis says something there, in each of its terms."""
    claim = found.claim
    if claim is None or (context != "limit" and is_void(found, context, equations)):
        return False
    if context == "limit":  # a single term that is small is close to zero, whatever its factor
        return all(len(tuple(terms(c.difference))) > 1 for c in claim.components())
    return not _has_vanishing_term(claim, context)


def _has_vanishing_term(claim: BoundClaim, context: str) -> bool:
    """Whether a printed side or term vanishes on a claim's states, or in each steady motion.

    Of a side that is said to be zero, none of the terms.
    """
    printed = list[Expr]()
    for component in claim.components():
        sides = (component.left, component.right)
        printed += [term for side in sides for term in _all_terms(side)]
        printed += sides if all(sides) else ()
    try:
        domains = steady_states(claim) if context == "steady" else (claim.states(TrueMotion),)
        return all(any(d.vanishing(each).is_zero for each in printed) for d in domains)
    except NumericError:
        value = at_given_accelerations(claim) if context == "motion" else None
        return value is None or not all(map(value, printed))


def _all_terms(side: Expr) -> Iterator[Expr]:
    """Its terms above the fraction line and below it, where a sum has several."""
    yield from terms(side)
    below = tuple(terms(side.denominator))
    yield from below if len(below) > 1 else ()


def _solves(judged: JudgedLine, equations: Equations) -> bool:
    """Whether a line in the time agrees with the motion but for two constants of integration."""
    relation = judged.line.relation.relation
    # The t of a d/dt alone says nothing: what is constant solves no equation.
    components = judged.claim.components() if judged.claim is not None else ()
    is_of_time = any(as_symbol(time) in c.difference.symbols() for c in components)
    if relation is None or relation.signs != ("=",) or not is_of_time:
        return False
    left, right = re.split(r"=", judged.line.latex, maxsplit=1)
    change = rf"\frac{{d^2}}{{dt^2}}\left({left} - \left({right}\right)\right) = 0"
    return holds_in(judged.line, equations, {}, "motion", change)


def _is_of_a_start(judged: JudgedLine, equations: Equations) -> bool:
    """Whether both sides differ by what is constant along a motion, and no term vanishes there."""
    claim = judged.claim
    if judged.line.in_force.start:
        return False  # the level is that of the start
    if claim is None:
        return False
    if any(is_acceleration(s) for c in claim.components() for s in c.difference.symbols()):
        return False  # an equation of motion, in a system in which accelerations are constant
    if not differs_by_a_constant(judged.line, equations):
        return False
    states = claim.states(TrueMotion)
    if not all(states.on(c.difference).varies for c in claim.components() if c.difference):
        return False  # they differ by as much on every motion
    relations = tuple(c.difference for c in claim.components())
    level = replace(claim, relations=(*claim.relations, *relations))
    with suppress(PolhodeError, ArithmeticError):
        return not _has_vanishing_term(level, "motion")
    return False

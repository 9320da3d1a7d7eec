"""States that a sentence gives in words alone: "when it rolls straight", "at the lowest point"."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from itertools import chain, combinations

from polhode.algebra import PI, ZERO, Expr, Symbol, SymbolKind, is_positive
from polhode.base import PolhodeError
from polhode.claims import Answer, BoundRelation, Verdict
from polhode.claims.building_blocks import (
    Derivative,
    Dots,
    Mechanics,
    OpenVerdict,
    name_of,
    walk,
)
from polhode.derive import Equations
from polhode.review.lines._judge_line import judged_line
from polhode.review.lines._judged_line import JudgedLine, in_context
from polhode.review.lines._vacuous import says_nothing
from polhode.review.text._state_words import StateKind
from polhode.review.text._text_line import TextLine, essential_coordinates

_RIGHT = Expr.generator(PI) / 2
_ANGLES = (ZERO, _RIGHT, -_RIGHT, Expr.generator(PI))


def in_state_of_words(judged: JudgedLine, equations: Equations) -> JudgedLine:
    """A line that fails on motions in general, judged in the state that words near it name.

    It holds if it does in one state that the words may mean, and is not judged if it does in none.
    """
    line, said = judged.line, judged.line.cues.state
    if said is None or judged.stated or judged.needs or not _fails_in_general(judged.verdict):
        return judged
    if any(each.latex in line.cues.sentence for each in line.in_force.conditions):
        return judged  # the sentence gives it in symbols too
    if judged.verdict.context == "threshold":
        return judged  # a condition of stability is judged at the angles that words may mean
    states = list(_states(said.kind, equations))
    for relations in states:
        if _is_of_motion(line, relations):
            continue
        meant = replace(line, in_force=line.in_force.under(relations))
        found = judged_line(meant, equations, {})
        is_of_start = line.in_force.is_from_rest or bool(line.in_force.start)
        if is_of_start and found.verdict.answer is Answer.FAILS and len(states) == 1:
            # Where a motion from a start arrives at the one place that is meant, it is determined.
            there = replace(meant, read_as=_taken(said.words, relations))
            return replace(found, line=there, needs=_sign_of_root(found, equations))
        is_right = found.verdict.holds or found.verdict.option == "positive"
        if is_right and found.claim is not None and not says_nothing(found.claim):
            return replace(found, line=replace(meant, read_as=_taken(said.words, relations)))
    reason = f"its sentence speaks of a state in words that were not read: '{said.words}'"
    verdict = replace(judged.verdict, answer=Answer.UNREAD, reason=reason)
    return replace(judged, judgement=OpenVerdict(verdict))


def _fails_in_general(verdict: Verdict) -> bool:
    """Whether a line fails in whichever way its letters are read, or only defines one of them."""
    ways = [way.verdict.answer for way in verdict.by_reading]
    is_open = verdict.answer is Answer.AMBIGUOUS and Answer.FAILS in ways
    is_open = is_open and set(ways) <= {Answer.FAILS, Answer.DEFINITION, Answer.UNREAD}
    return verdict.answer is Answer.FAILS or is_open


def _sign_of_root(judged: JudgedLine, equations: Equations) -> str:
    """The sign of a speed with which a root that a text gives for it is right; "" for none."""
    claim = judged.claim
    member = claim.members[0] if claim is not None and len(claim.members) == 1 else None
    speed = member.left.symbol if member is not None and isinstance(member.left, Expr) else None
    if member is None or speed is None or member.sign != "=" or not speed.kind.varies:
        return ""
    left, _, right = judged.line.latex.partition("=")
    square = rf"\left({left}\right)^2 = \left({right}\right)^2"
    found = in_context(judged.line, equations, {}, "launch", square)
    return rf"{left.strip()} > 0" if found.verdict.holds else ""


def _is_of_motion(line: TextLine, relations: Iterable[BoundRelation]) -> bool:
    """Whether a line prints a coordinate with a rate: it is no line about one of its values."""
    placed = (r.left.symbol for r in relations if isinstance(r.left, Expr))
    rates = [p.of for p in walk(line.statement) if isinstance(p, Dots | Derivative)]
    letters = list(line.letters)
    for rate in rates:
        letters.remove(rate) if rate in letters else None
    coordinates = (s for s in placed if s is not None and s.kind is SymbolKind.COORDINATE)
    return bool(rates) and any(name_of(q.published) in letters for q in coordinates)


def upright_at_rest(equations: Equations) -> tuple[BoundRelation, ...]:
    """The state at rest in which the potential energy is greatest; empty where several are."""
    places = list(_states(StateKind.HIGHEST, equations))
    return (*places[0], *map(_vanishing, equations.speeds)) if len(places) == 1 else ()


def _taken(words: str, relations: Iterable[BoundRelation]) -> str:
    taken = " and ".join(f"{_latex(r.left)} = {_latex(r.right)}" for r in relations)
    return f"with '{words}' as {taken}"


def _latex(side: object) -> str:
    return side.latex() if isinstance(side, Expr) else ""


def _states(kind: StateKind, equations: Equations) -> Iterator[tuple[BoundRelation, ...]]:
    """The states that words of a kind may mean, as restrictions."""
    match kind:
        case StateKind.STRAIGHT:
            for speeds in chain(*(combinations(equations.speeds, n) for n in (1, 2))):
                yield tuple(_vanishing(s) for s in speeds if not _is_spin(s))
        case StateKind.NO_SPIN:
            yield from ((_vanishing(s),) for s in equations.speeds if _is_spin(s))
        case StateKind.NO_TURNING:
            turning = (q.derivative() for q in equations.coordinates)
            yield from ((_vanishing(s),) for s in turning)
        case _:
            for q in essential_coordinates(equations):
                values = (v for v in _ANGLES if _is_place(kind, q, v, equations))
                yield from ((BoundRelation(Expr.generator(q), "=", value),) for value in values)


def _vanishing(symbol: Symbol) -> BoundRelation:
    return BoundRelation(Expr.generator(symbol), "=", ZERO)


def _is_spin(speed: Symbol) -> bool:
    """Whether a speed is the angular velocity of a body about an axis of its own."""
    return speed.kind is SymbolKind.SPEED and speed.name.startswith("omega")


def _is_place(kind: StateKind, q: Symbol, value: Expr, equations: Equations) -> bool:
    """Whether the potential energy is least or greatest there, for words that say so."""
    if kind is StateKind.UPRIGHT:
        return True
    with suppress(PolhodeError, ArithmeticError):
        slope = Mechanics(equations).potential_energy().diff(q)
        second = slope.diff(q).subs({q: value})
        is_low = kind is StateKind.LOWEST
        return not slope.subs({q: value}) and is_positive(second if is_low else -second)
    return False

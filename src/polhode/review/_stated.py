"""What a line states for those after it: letters, restrictions, small quantities, a start."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import permutations

from polhode.algebra import ZERO, Expr, Symbol, as_symbol
from polhode.base import PolhodeError
from polhode.claims import Answer, BoundRelation
from polhode.claims.building_blocks import (
    EQUALITY,
    MAGNITUDES,
    SENSE,
    Meaning,
    Name,
    Node,
    Small,
    constant,
    name_of,
    restrictions,
    spelled,
)
from polhode.derive import Equations
from polhode.review._cues import Role
from polhode.review._in_force import InForce
from polhode.review._judged_line import JudgedLine

_HENCE = Role.CONSEQUENCE
_EVERYWHERE = (Role.ASSUMPTION, Role.DEFINITION)


def stated_by(judged: JudgedLine, own: InForce, equations: Equations) -> tuple[JudgedLine, InForce]:
    """The line, said to be stated rather than claimed where it is, and what its part states now."""
    said, own = _stated(judged, own, equations)
    return said, _with_small(judged, own, equations)


def _stated(judged: JudgedLine, own: InForce, equations: Equations) -> tuple[JudgedLine, InForce]:
    cues = judged.line.cues
    own = replace(
        own,
        is_steady=own.is_steady or cues.is_steady,
        is_body_fixed=own.is_body_fixed or cues.is_body_fixed,
    )
    ratios = _ratios(judged, equations)
    if ratios and not judged.verdict.holds and cues.role is not _HENCE:
        own = replace(own, small=(*own.small, *ratios))
        return replace(judged, stated="an assumption: it says what is small"), own
    bound, answer = judged.bound, judged.verdict.answer
    if bound is None:
        return _without_meaning(judged, own, equations)
    own = own.defining(bound.defined)
    if answer is Answer.DEFINITION:
        names = ", ".join(spelled(letter) for letter in bound.defined)
        return replace(judged, stated=f"defines {names}"), own
    if answer is not Answer.FAILS:
        return judged, own
    new = _letter_for_speed(judged, equations)
    if new:
        (letter,) = new
        return replace(judged, stated=f"defines {spelled(letter)}"), own.defining(new)
    if _restricts(bound.relations, equations):
        return _restricted(judged, own, bound.relations)
    if any(r.sign in SENSE for r in bound.relations) and judged.line.cues.role is not _HENCE:
        return replace(judged, stated="a condition, met by some motions and not by others"), own
    return judged, own


def _restricted(
    judged: JudgedLine, own: InForce, relations: tuple[BoundRelation, ...]
) -> tuple[JudgedLine, InForce]:
    """A line that chooses among the motions, unless it says that it is drawn from others."""
    cues, relation = judged.line.cues, judged.line.relation
    if cues.role is _HENCE and relation.is_display:
        return judged, own
    if cues.is_launch:
        return replace(judged, stated="an initial value"), own.starting(relations)
    judged = replace(judged, stated="an assumption: it chooses among the motions, or the bodies")
    if cues.role in _EVERYWHERE or (relation.is_display and cues.role is Role.CLAIM):
        return judged, own.under(relations)
    return judged, own.when(relation.latex, relations)


def _without_meaning(
    judged: JudgedLine, own: InForce, equations: Equations
) -> tuple[JudgedLine, InForce]:
    """A line that could not be bound: it may define a deviation, as θ = π/2 + ε does."""
    new = _deviation(judged, equations)
    if new is not None:
        (letter,) = new
        return replace(judged, stated=f"defines {spelled(letter)}"), own.defining(new)
    is_condition = judged.line.cues.role in (Role.CONDITION, Role.ASSUMPTION)
    if is_condition or _is_of_coordinate(judged, equations):
        return judged, own.when_unread(judged.line.relation.latex)
    return judged, own


def _is_of_coordinate(judged: JudgedLine, equations: Equations) -> bool:
    """Whether it is an inline value of a coordinate, such as θ = 90°, in a unit not read."""
    relation = judged.line.relation
    if relation.is_display or relation.relation is None:
        return False
    coordinates = {name_of(q.published) for q in equations.coordinates}
    return relation.relation.sides[0] in coordinates


def _deviation(judged: JudgedLine, equations: Equations) -> dict[Node, Meaning] | None:
    relations = judged.line.statement.relations
    if len(relations) != 1 or relations[0].signs != ("=",):
        return None
    notation = judged.line.in_force.notation(equations, {})
    unknown = {n for n in judged.line.letters if not notation.vocabulary.has(n)}
    if len(unknown) != 1:
        return None
    (letter,) = unknown
    new = constant(letter)
    try:
        left, right = map(notation.stating({letter: new}).value, relations[0].sides)
    except (PolhodeError, ArithmeticError):
        return None
    if not isinstance(left, Expr) or left.symbol not in equations.coordinates:
        return None
    if not isinstance(right, Expr) or right.diff(as_symbol(new)).rational not in (1, -1):
        return None
    slope = right.diff(as_symbol(new))
    return {letter: (left - right.subs({new: ZERO})) / slope}


def _letter_for_speed(judged: JudgedLine, equations: Equations) -> dict[Node, Meaning]:
    """A new letter for an independent speed, such as Ω for that of a steady precession.

    By common usage it may have another meaning in the model, the magnitude of an angular velocity.
    Small letters and those with a label, such as ω₂ and v, are claimed to equal a speed instead.
    """
    relations, notation = judged.line.statement.relations, judged.judgement.notation
    if judged.line.cues.role is _HENCE or notation is None or len(relations) != 1:
        return {}
    if relations[0].signs != ("=",):
        return {}
    for letter, other in permutations(relations[0].sides):
        if not isinstance(letter, Name) or letter.subscript or not letter.letter[:1].isupper():
            continue
        is_new = letter not in judged.line.earlier
        if not is_new or {letter} & {*notation.vocabulary.declared, *notation.vocabulary.stated}:
            continue
        with suppress(PolhodeError, ArithmeticError):
            speed = notation.value(other)
            if isinstance(speed, Expr) and speed.symbol in _speeds(equations):
                return {letter: speed}
    return {}


def _speeds(equations: Equations) -> set[Symbol]:
    rates = {q.derivative() for q in equations.coordinates}
    return set(equations.speeds) | rates


def _ratios(judged: JudgedLine, equations: Equations) -> tuple[Small, ...]:
    """What is small where one side is much smaller than the other; empty for other relations."""
    relation = judged.line.relation.relation
    if relation is None or any(sign not in MAGNITUDES for sign in relation.signs):
        return ()
    found = []
    with suppress(PolhodeError, ArithmeticError):
        notation = judged.line.in_force.notation(equations, {})
        for member in notation.bound(judged.line.statement).relations:
            less, more = member.left, member.right
            if member.sign == "≫":
                less, more = more, less
            if isinstance(less, Expr) and isinstance(more, Expr):
                found.append(Small(less / more))
    return tuple(found)


def _with_small(judged: JudgedLine, own: InForce, equations: Equations) -> InForce:
    known = {small.quantity for small in own.small}
    notation = judged.line.in_force.defining(own.defined).notation(equations, {})
    for latex, order in judged.line.cues.small:
        with suppress(PolhodeError):
            quantity = notation.scalar(latex)
            if quantity not in known and quantity.symbols():
                own = replace(own, small=(*own.small, Small(quantity, order)))
    return own


def _restricts(relations: Sequence[BoundRelation], equations: Equations) -> bool:
    """Whether relations choose among systems or motions, rather than contradict the model.

    They give values to parameters, coordinates or speeds that nothing else determines.
    """
    free = {*equations.coordinates, *equations.speeds, *equations.parameters}
    free |= {q.derivative() for q in equations.coordinates if q.derivative() in equations.speeds}
    if not relations or any(relation.sign not in EQUALITY for relation in relations):
        return False
    try:
        values, vanishing = restrictions(relations)
    except PolhodeError:
        return False
    return not vanishing and all(
        symbol.symbol in free and not _varies(value) for symbol, value in values.items()
    )


def _varies(expression: Expr) -> bool:
    return any(symbol.kind.varies for symbol in expression.symbols())

"""What a line states for those after it: letters, restrictions, small quantities, a start."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from polhode.algebra import Expr
from polhode.base import PolhodeError
from polhode.claims import Answer, BoundRelation
from polhode.claims.latex._names import spelled
from polhode.claims.meaning._bindings import restrictions
from polhode.claims.states._bound_claim import EQUALITY, Small
from polhode.derive import Equations
from polhode.review._cues import Role
from polhode.review._in_force import InForce
from polhode.review._judged_line import JudgedLine

_RESTRICTING = (Role.ASSUMPTION, Role.CONDITION, Role.DEFINITION)


def stated_by(judged: JudgedLine, own: InForce, equations: Equations) -> tuple[JudgedLine, InForce]:
    """The line, said to be stated rather than claimed where it is, and what its part states now."""
    own = _with_small(judged, own, equations)
    notation = judged.judgement.notation
    if notation is None:
        return judged, own
    try:
        bound = notation.bound(judged.line.statement)
    except (PolhodeError, ZeroDivisionError):  # a line that could not be judged states nothing
        return judged, own
    own = own.defining(bound.defined)
    cues, answer = judged.line.cues, judged.verdict.answer
    if answer is Answer.DEFINITION:
        names = ", ".join(spelled(letter) for letter in bound.defined)
        return replace(judged, stated=f"defines {names}"), own
    if answer is not Answer.FAILS or cues.role not in _RESTRICTING:
        return judged, own
    if not _restricts(bound.relations, equations):
        return judged, own
    if cues.is_launch:
        return replace(judged, stated="an initial value"), own.starting(bound.relations)
    judged = replace(judged, stated="an assumption")
    if cues.role is Role.CONDITION:
        return judged, own.when(judged.line.relation.latex, bound.relations)
    return judged, own.under(bound.relations)


def _with_small(judged: JudgedLine, own: InForce, equations: Equations) -> InForce:
    known = {small.quantity for small in own.small}
    notation = judged.line.in_force.notation(equations, {})
    for latex, order in judged.line.cues.small:
        with suppress(PolhodeError):
            quantity = notation.scalar(latex)
            if quantity not in known and quantity.symbols():
                own = replace(own, small=(*own.small, Small(quantity, order)))
    return own


def _restricts(relations: Sequence[BoundRelation], equations: Equations) -> bool:
    """Whether relations choose among the states of a system, rather than contradict it.

    They give values to coordinates or speeds, which nothing else determines.
    """
    state = {*equations.coordinates, *equations.speeds}
    state |= {q.derivative() for q in equations.coordinates}
    if any(relation.sign not in EQUALITY for relation in relations):
        return False
    try:
        values, vanishing = restrictions(relations)
    except PolhodeError:
        return False
    free = state - set(equations.dependent)
    return not vanishing and all(
        symbol.symbol in free and not _varies(value) for symbol, value in values.items()
    )


def _varies(expression: Expr) -> bool:
    return any(symbol.kind.varies for symbol in expression.symbols())

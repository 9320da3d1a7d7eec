"""What a line that fails needs to be true: a simple condition that its text has not stated."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import product

from polhode.algebra import ZERO, Expr, SquareRoot, SymbolKind
from polhode.base import PURE, TIME
from polhode.derive import Equations
from polhode.judge._check import OpenVerdict
from polhode.judge._verdict import Answer, SimpleCondition, Verdict
from polhode.judge.latex import write_latex
from polhode.judge.latex._names import name_of
from polhode.judge.lines._judged_line import (
    JudgedLine,
    differs_by_a_constant,
    in_context,
    may_hold_in,
)
from polhode.judge.lines._near_steady import under_steady_momenta
from polhode.judge.lines._taken_for_granted import conditions
from polhode.judge.lines._vacuous import is_void
from polhode.judge.lines._weaker_meanings import says_that_it_vanishes
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.states._bound_claim import Small
from polhode.judge.text._in_force import Chosen, InForce
from polhode.judge.text._text_line import TextLine

_RATE = PURE / TIME  # of turning


def unstated_condition(
    line: TextLine, found: OpenVerdict, equations: Equations, chosen: Chosen
) -> str:
    """A simple condition under which a line holds that the text has not stated."""
    if said := sign_needed(found.verdict, equations):
        return said
    if found.verdict.answer is not Answer.FAILS:
        return ""
    if said := _approximately(line, equations, chosen):
        return said
    # Of steady motion a text goes on to speak, at the angle that a sentence before has named.
    contexts = ("motion", "steady") if line.is_steady else ("motion",)
    near = line.cues.two_sentences
    taken = conditions(line.tacit, line.in_force, near, equations)
    for (said, relations), context in product(taken, contexts):
        if _sets_to_zero(relations, line):
            continue
        stated = replace(line, in_force=line.in_force.under(relations))
        if not may_hold_in(stated, equations, chosen, context):
            continue
        other = JudgedLine(stated, in_context(stated, equations, chosen, context))
        sign = _in_latex(filter(_are_signs, other.verdict.holds_where[:1]))
        if (other.verdict.holds or sign) and not is_void(other, context, equations):
            return " and ".join(filter(None, (said, sign)))
    if _holds_at_start(line, equations, chosen):
        return "the state at the start"
    is_integral = _relates_coordinates(JudgedLine(line, found))
    if is_integral and differs_by_a_constant(line, equations, chosen):
        return "a constant of integration that is zero"
    return ""


def _relates_coordinates(judged: JudgedLine) -> bool:
    """Whether a line is linear in several coordinates, and prints nothing else that varies."""
    components = judged.claim.components() if judged.claim is not None else []
    moving = {s for c in components for s in c.difference.symbols() if s.kind.varies}
    return len(moving) > 1 and all(
        s.kind is SymbolKind.COORDINATE and not s.order and not c.difference.diff(s).varies
        for c in components
        for s in moving
    )


def _holds_at_start(line: TextLine, equations: Equations, chosen: Chosen) -> bool:
    """Whether it holds at the start of the motion, of which sentences before have spoken."""
    stated = line.in_force
    if not (stated.is_at_start and stated.start):
        return False
    there = replace(line, in_force=stated.under(stated.start))
    found = JudgedLine(there, in_context(there, equations, chosen, "motion"))
    return found.verdict.holds and not is_void(found, "motion", equations)


def _sets_to_zero(relations: tuple[BoundRelation, ...], line: TextLine) -> bool:
    """Whether a line prints a speed that a condition sets to zero, of which it speaks then."""
    speeds = [r.left.symbol for r in relations if isinstance(r.left, Expr) and r.right == ZERO]
    names = {name_of(s.published) for s in speeds if s is not None and s.kind is SymbolKind.SPEED}
    return not names.isdisjoint(line.letters)


def _approximately(line: TextLine, equations: Equations, chosen: Chosen) -> str:
    """What an equation of a text about small departures needs to be true to leading order.

    A speed may have to be small besides, since the steady motion has none of it, and a constant of
    integration may have to be zero.
    """
    order = 1 if says_that_it_vanishes(line) else None
    line = replace(line, in_force=line.in_force.to_order(order))
    relation, stated = line.relation.relation, line.in_force
    departures = () if stated.small else stated.departures.values()
    unsaid = {n: v for n in line.letters for v in departures if stated.defined.get(n) == v}
    stated = replace(stated, small=(*stated.small, *map(Small, dict.fromkeys(unsaid.values()))))
    if not stated.small or relation is None or not {*relation.signs} <= {"=", "≈"}:
        return ""
    line = replace(line, in_force=stated)
    small = [f"small {write_latex(letter)}" for letter in unsaid]
    exact = [] if "≈" in relation.signs else ["≈ in place of =, to leading order in what is small"]
    latex = as_approximate(line)
    for said, more in (("", stated), *_of_departures(line, equations)):
        meant = replace(line, in_force=more)
        if not may_hold_in(meant, equations, chosen, "limit", latex):
            continue
        verdict = in_context(meant, equations, chosen, "limit", latex).verdict
        lacks_constant = verdict.answer is Answer.AMBIGUOUS and verdict.option == "given"
        if verdict.holds or lacks_constant:
            constant = ["a constant of integration that is zero"] if lacks_constant else []
            return " and ".join([*small, *filter(None, [said]), *constant, *exact])
    return ""


def _of_departures(line: TextLine, equations: Equations) -> Iterator[tuple[str, InForce]]:
    """What texts take for granted of the steady motion from which an angle departs.

    Momenta are those of the steady motion. A speed or a rate of turning among the parameters is
    small, or a spin that is conserved and that the line does not contain is zero.
    """
    stated = line.in_force
    yield from (("", near) for near in under_steady_momenta(stated, equations))
    known = {s.base() for small in stated.small for s in small.quantity.symbols()}
    if known.isdisjoint(equations.coordinates):
        return
    turning = (s for s in equations.parameters if equations.dimensions.get(s) == _RATE)
    for symbol in (*equations.speeds, *turning):
        if symbol.base() not in known:
            small = Small(Expr.generator(symbol), 1)
            yield f"small {small.quantity.latex()}", replace(stated, small=(*stated.small, small))
    letters = set(line.letters)
    for symbol in equations.speeds:
        is_spin = symbol.name.startswith("omega") and name_of(symbol.published) not in letters
        if is_spin and not equations.accelerations[symbol.derivative()]:
            spin = BoundRelation(Expr.generator(symbol), "=", ZERO)
            yield f"{Expr.generator(symbol).latex()} = 0", stated.under((spin,))


def as_approximate(line: TextLine) -> str:
    return line.latex.replace("=", r"\approx ")


def sign_needed(verdict: Verdict, equations: Equations) -> str:
    """The signs of the motion or of roots for which a line holds, of which a text may be silent."""
    if verdict.answer is Answer.UNREAD and verdict.option == "positive":
        return _in_latex(filter(_are_signs, verdict.holds_where))
    if verdict.answer is Answer.FAILS and _is_direction(verdict.holds_where, equations):
        return _in_latex(verdict.holds_where[:1])
    return ""


def _are_signs(conditions: SimpleCondition) -> bool:
    """Whether conditions are signs, as that of a velocity of slipping, and no values."""
    return all(each.sign != "=" for each in conditions)


def _is_direction(where: Sequence[SimpleCondition], equations: Equations) -> bool:
    """Whether the first alternative is the sign of a single quantity, or of a sine or cosine.

    Or it is the direction of a slip, as v - Rω > 0. Parameters may have to be of some size besides:
    R - a > 0.
    """
    moving = [each for each in (where[0] if where else ()) if each.left.varies]
    if len(moving) != 1 or not _are_signs(where[0]):
        return False
    left = moving[0].left
    return left in map(Expr.generator, left.generators) or _is_side(left, equations)


def _is_side(expression: Expr, equations: Equations) -> bool:
    """Whether the equations contain the absolute value of an expression."""
    roots = (g for e in equations.motion for g in e.generators if isinstance(g, SquareRoot))
    insides = (root.plain for root in roots if root.plain is not None)
    return any(not (expression / inside).varies for inside in insides)


def _in_latex(where: Iterable[SimpleCondition]) -> str:
    return " or ".join(" and ".join(each.latex() for each in all_) for all_ in where)

"""Conditions under which a force vanishes: "the ladder leaves the wall when cos θ = ⅔ cos θ₀"."""

from __future__ import annotations

import re
from dataclasses import replace

from polhode.algebra import Expr
from polhode.claims import Answer, Bound, BoundRelation, Verdict
from polhode.claims.building_blocks import initial_value, reaction_symbol
from polhode.derive import Equations
from polhode.review._cues import Role
from polhode.review._in_force import InForce
from polhode.review._judged_line import JudgedLine, in_context

_VANISHES = re.compile(
    r"\b(?:vanish\w*|(?:is|becomes|goes to|drops to) zero|leaves?|los(?:es?|ing) contact"
    r"|lifts? off|detach\w*|separat\w+|comes? off|flies off)\b[^.;]*\b(?:when|where|once|if|at)\b",
    re.I,
)


def as_end_of_contact(judged: JudgedLine, equations: Equations) -> JudgedLine:
    """A line after such words, true where a reaction vanishes by it; others as they are.

    It is true of the motion from the start that the text has stated, if it states one.
    """
    line, bound = judged.line, judged.bound
    is_said = line.cues.role is Role.CONDITION and _VANISHES.search(line.cues.sentence)
    if not is_said or bound is None or judged.verdict.answer is not Answer.FAILS:
        return judged
    anywhere = replace(line, in_force=_with_printed_start(line.in_force, bound, equations))
    there = replace(line, in_force=anywhere.in_force.under(bound.relations))
    context = "launch" if anywhere.in_force.start else "motion"
    for name in equations.components:
        claim = f"{Expr.generator(reaction_symbol(name)).latex()} = 0"
        if not in_context(there, equations, {}, context, claim).verdict.holds:
            continue
        if not in_context(anywhere, equations, {}, context, claim).verdict.holds:
            reason, readings = f"{name} vanishes there", judged.verdict.readings
            holds = Verdict(Answer.HOLDS, context, reason, readings=readings)
            return replace(
                judged, judgement=replace(judged.judgement, verdict=holds, corrected=None)
            )
    return judged


def _with_printed_start(stated: InForce, bound: Bound, equations: Equations) -> InForce:
    """With θ = θ₀ at the start for a θ₀ that is printed."""
    sides = [side for r in bound.relations for side in (r.left, r.right) if isinstance(side, Expr)]
    printed = {symbol for side in sides for symbol in side.symbols()}
    start = (
        BoundRelation(Expr.generator(q), "=", Expr.generator(initial_value(q)))
        for q in equations.coordinates
        if initial_value(q) in printed
    )
    return stated.starting(tuple(start))

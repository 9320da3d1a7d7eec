"""Conditions under which a force vanishes: "the ladder leaves the wall when cos θ = ⅔ cos θ₀"."""

from __future__ import annotations

import re
from dataclasses import replace

from polhode.algebra import Expr
from polhode.derive import Equations
from polhode.judge._verdict import Answer, Verdict
from polhode.judge.balance._declared import reaction_symbol
from polhode.judge.lines._judged_line import JudgedLine, holds_in
from polhode.judge.lines._weaker_meanings import with_printed_start
from polhode.judge.text._cues import Role

_VANISHES = re.compile(
    r"\b(?:vanish\w*|(?:is|becomes|goes to|drops to) zero|leaves?|los(?:es?|ing) contact"
    r"|contact (?:with [\w ]{1,30} )?(?:is lost|ends|ceases|breaks?)|lifts? off|detach\w*"
    r"|separat\w+|comes? off|flies off)\b[^.;]*\b(?:when|where|once|if|at)\b",
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
    anywhere = replace(line, in_force=with_printed_start(line.in_force, bound.relations, equations))
    there = replace(line, in_force=anywhere.in_force.under(bound.relations))
    context = "launch" if anywhere.in_force.start else "motion"
    for name in equations.components:
        claim = f"{Expr.generator(reaction_symbol(name)).latex()} = 0"
        if not holds_in(there, equations, {}, context, claim):
            continue
        if not holds_in(anywhere, equations, {}, context, claim):
            reason, readings = f"{name} vanishes there", judged.verdict.readings
            holds = Verdict(Answer.HOLDS, context, reason, readings=readings)
            judgement = replace(judged.judgement, verdict=holds, corrected=None)
            return replace(judged, judgement=judgement, event=bound.relations)
    return judged

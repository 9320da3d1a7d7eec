"""A chain of which each link may hold in a context of its own: cos θ = g/(ω²R) = 0.68."""

from __future__ import annotations

from dataclasses import replace

from polhode.derive import Equations
from polhode.judge._verdict import Answer, Verdict
from polhode.judge.latex import write_latex
from polhode.judge.latex._tree import Relation
from polhode.judge.lines._judge_line import with_all_numbers
from polhode.judge.lines._judged_line import JudgedLine, in_context
from polhode.judge.lines._vacuous import says_something
from polhode.judge.lines._weaker_meanings import weaker_meanings
from polhode.judge.text._text_line import TextLine

#: Contexts in which links may hold, the weakest last.
_CONTEXTS = ("motion", "steady", "threshold", "limit", "launch", "number")


def link_by_link(judged: JudgedLine, equations: Equations) -> JudgedLine:
    """A chain that fails as a whole, with only those links left as failing that fail by themselves.

    It holds, in the weakest of the contexts, where none is left.
    """
    line, verdict, notation = judged.line, judged.verdict, judged.judgement.notation
    relation, links = line.relation.relation, len(verdict.residuals)
    # Members are those of the claim: the d of d = v₀t - ... = ... is defined, and no link of it.
    members = judged.claim.members if judged.claim is not None else ()
    wrong = dict.fromkeys(residual.member for residual in verdict.residuals)
    close = (place for place, member in enumerate(members) if member.sign == "≈")  # not yet decided
    wrong |= dict.fromkeys(close) if wrong else {}
    is_chain = relation is not None and max(wrong, default=0) < len(members) > 1
    is_failing = verdict.answer is Answer.FAILS and not judged.needs
    if relation is None or notation is None or not (is_chain and is_failing and wrong):
        return judged
    contexts, refuted = {"motion"}, []
    for member in tuple(wrong):
        printed = members[member].printed
        if printed is None:
            continue
        link = Relation((printed.left, printed.right), (members[member].sign,))
        alone = replace(line.relation, relation=link, printed=write_latex(link))
        context, is_refuted = _context_of(replace(line, relation=alone), equations)
        if context:
            contexts.add(context)
            del wrong[member]
        if is_refuted:
            refuted.append(member)
    if judged.is_open_value and refuted:  # numbers that are put in are wrong, whatever is open
        judged, wrong = replace(judged, is_open_value=False), dict.fromkeys(refuted)
    if not wrong:
        weakest = max(contexts, key=_CONTEXTS.index)
        holds = Verdict(Answer.HOLDS, weakest, readings=verdict.readings)
        found = replace(judged.judgement, verdict=holds, corrected=None)
        return replace(judged, judgement=found, is_open_value=False)
    left = tuple(residual for residual in verdict.residuals if residual.member in wrong)
    if not left or len(left) == links:
        return judged
    where = "; ".join(f"member {member + 1}" for member in wrong)
    failing = replace(verdict, reason=f"the sides differ in {where}", residuals=left)
    return replace(judged, judgement=replace(judged.judgement, verdict=failing))


def _context_of(line: TextLine, equations: Equations) -> tuple[str, bool]:
    """The first context in which a link holds and says something, empty for none.

    And whether it fails with the numbers of the text.
    """
    for meant, context in weaker_meanings(line, equations):
        found = JudgedLine(meant, in_context(meant, equations, {}, context))
        if found.verdict.holds and says_something(found, context, equations):
            return context, False
    answers = [found.verdict.answer for found in with_all_numbers(line, equations, {})]
    if Answer.HOLDS in answers:
        return "number", False
    return "", Answer.FAILS in answers

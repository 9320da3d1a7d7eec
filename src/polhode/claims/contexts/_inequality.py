"""Inequalities that are to hold on all states of a context."""

from __future__ import annotations

from polhode.algebra import Expr
from polhode.claims._verdict import Answer, Residual, Verdict
from polhode.claims.contexts._counterexample import refutation
from polhode.claims.meaning._components import Component
from polhode.claims.states._asked import SENSE, Asked
from polhode.claims.states._circumstances import Circumstances
from polhode.claims.states._numeric import number
from polhode.claims.states._signs import definite_sign


def judged_inequality(asked: Asked, component: Component, states: Circumstances) -> Verdict:
    """Proved from the signs of factors, or refuted at a state, or else left open by exception."""
    sign = asked.members[component.member].sign
    difference = states.on(component.difference)
    sense = SENSE[sign]
    if difference and definite_sign(difference, states.signs) == sense:
        return Verdict(Answer.HOLDS, "", reason="seen from the signs of its factors")

    def refutes(left: Expr, right: Expr) -> bool:
        return float(number(left - right, {})) * sense < 0

    residual = Residual(component.member, component.label, difference)
    example, second = refutation(component, residual, states, refutes)
    if example is None:
        return Verdict(
            Answer.UNREAD, "", reason="neither proved nor refuted", residuals=(residual,)
        )
    return Verdict(
        Answer.FAILS,
        "",
        reason=f"the left side is not {sign} the right side everywhere",
        residuals=(residual,),
        counterexample=example,
        confirmation=second,
    )


def judged_unequal(asked: Asked, component: Component, states: Circumstances) -> Verdict:
    """≠ holds where the difference has a sign; sometimes, where it does not vanish throughout."""
    difference = states.on(component.difference)
    residual = Residual(component.member, component.label, difference)
    if not difference:
        return Verdict(Answer.FAILS, "", reason="both sides are the same", residuals=(residual,))
    if asked.when == "sometimes" or definite_sign(difference, states.signs):
        return Verdict(Answer.HOLDS, "", reason=f"they differ by {difference}")
    return Verdict(Answer.UNREAD, "", reason="not decided", residuals=(residual,))

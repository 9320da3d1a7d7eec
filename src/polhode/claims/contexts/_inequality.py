"""Inequalities that are to hold on all states of a context."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from operator import eq

from polhode.algebra import ONE, Expr
from polhode.base import PolhodeError
from polhode.claims._verdict import Answer, Evidence, Residual, Verdict
from polhode.claims.contexts._counterexample import refutation
from polhode.claims.meaning._relations import ScalarRelation
from polhode.claims.states._bound_claim import SENSE, STRICT, BoundClaim
from polhode.claims.states._claim_domain import ClaimDomain
from polhode.claims.states._elimination import solved
from polhode.claims.states._numeric import number
from polhode.claims.states._signs import definite_sign, may_vanish, strict_sign


def judged_inequality(asked: BoundClaim, component: ScalarRelation, states: ClaimDomain) -> Verdict:
    """Proved from the signs of factors, or refuted at a state; otherwise undecided.

    A strict inequality is refuted by a state in which both sides are equal.
    """
    sign = asked.members[component.member].sign
    difference = states.on(component.difference)
    residual = Residual(component.member, component.label, difference)
    if _is_proved(difference, sign, states):
        return Verdict(Answer.HOLDS, "", reason="seen from the signs of its factors")
    example, second = _refuted(component, residual, states, sign)
    if example is None:
        return Verdict(
            Answer.UNREAD,
            "",
            reason="it was read, but neither proved nor refuted",
            residuals=(residual,),
        )
    equal = example.left == example.right
    return Verdict(
        Answer.FAILS,
        "",
        reason=f"both sides can be equal, which {sign} excludes"
        if equal
        else f"the left side is not {sign} the right side everywhere",
        residuals=(residual,),
        counterexample=example,
        confirmation=second,
    )


def _is_proved(difference: Expr, sign: str, states: ClaimDomain) -> bool:
    if not difference:
        return sign not in STRICT
    found = strict_sign if sign in STRICT else definite_sign
    return found(difference, states.signs) == SENSE[sign]


def _refuted(
    component: ScalarRelation, residual: Residual, states: ClaimDomain, sign: str
) -> Evidence:
    """A state on the wrong side; for a strict inequality also one of equality."""

    def refutes(left: Expr, right: Expr) -> bool:
        return float(number(left - right, {})) * SENSE[sign] < 0

    found: Evidence = None, None
    if definite_sign(residual.expression or ONE, states.signs) != SENSE[sign]:
        found = refutation(component, residual, states, refutes)
    if found[0] is not None or sign not in STRICT:
        return found
    for equal in _where_equal(residual.expression, states):
        found = refutation(component, residual, equal, eq)
        if found[0] is not None:
            break
    return found


def _where_equal(difference: Expr, states: ClaimDomain) -> Iterator[ClaimDomain]:
    """The states on which some factor of the difference vanishes."""
    if not difference:
        yield states
        return
    for factor in may_vanish(difference, states.signs):
        try:
            symbol, value = solved(factor.numerator)
        except PolhodeError:
            continue
        yield replace(states, given={**states.given, symbol: value})


def judged_unequal(asked: BoundClaim, component: ScalarRelation, states: ClaimDomain) -> Verdict:
    """≠ holds where the difference has a sign; sometimes, where it does not vanish throughout."""
    difference = states.on(component.difference)
    residual = Residual(component.member, component.label, difference)
    if not difference:
        return Verdict(Answer.FAILS, "", reason="both sides are the same", residuals=(residual,))
    if asked.when == "sometimes" or strict_sign(difference, states.signs):
        return Verdict(Answer.HOLDS, "", reason=f"they differ by {difference}")
    return Verdict(Answer.UNREAD, "", reason="it was read, but not decided", residuals=(residual,))

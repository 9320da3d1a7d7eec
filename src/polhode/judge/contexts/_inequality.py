"""Inequalities on all states of a context, and signs of expressions."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace
from operator import eq

from polhode.algebra import ONE, Expr, Symbol, factors, is_positive
from polhode.base import PolhodeError
from polhode.judge._verdict import Answer, Evidence, Refuted, Residual, Verdict
from polhode.judge.contexts._counterexample import refutation
from polhode.judge.meaning._relations import ScalarRelation
from polhode.judge.states._bound_claim import SENSE, STRICT, BoundClaim
from polhode.judge.states._claim_domain import ClaimDomain, solved
from polhode.judge.states._numeric import number


def judged_inequality(claim: BoundClaim, component: ScalarRelation, states: ClaimDomain) -> Verdict:
    """Proved from the signs of factors, or refuted at a state; otherwise undecided.

    A strict inequality is refuted by a state in which both sides are equal.
    """
    sign = claim.members[component.member].sign
    difference = states.on(component.difference)
    residual = Residual(component.member, component.label, difference)
    seen = strict_sign if sign in STRICT else definite_sign
    forms = (difference, _by_differences(difference, states.positive))
    is_seen = any(seen(form, states.signs) == SENSE[sign] for form in forms if form)
    if is_seen or (not difference and sign not in STRICT):
        return Verdict(Answer.HOLDS, "", reason="follows from the signs of the factors")
    example, second = _refuted(component, residual, states, sign)
    if example is None:
        return Verdict(
            Answer.UNREAD,
            "",
            reason="it was read, but neither proved nor refuted",
            residuals=(residual,),
        )
    equal = example.left == example.right
    return Refuted(
        Answer.FAILS,
        "",
        reason=f"both sides can be equal, and {sign} excludes that"
        if equal
        else f"the left side is not {sign} the right side everywhere",
        residuals=(residual,),
        evidence=lambda: (example, second),
    )


def _refuted(
    component: ScalarRelation, residual: Residual, states: ClaimDomain, sign: str
) -> Evidence:
    """A state that violates the inequality; for a strict one, also a state of equality."""

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
    """The states on which a factor of the difference vanishes, one domain for each factor."""
    if not difference:
        yield states
        return
    for factor in may_vanish(difference, states.signs):
        try:
            symbol, value = solved(factor.numerator)
        except PolhodeError:
            continue
        yield replace(states, given={**states.given, symbol: value})


def judged_unequal(claim: BoundClaim, component: ScalarRelation, states: ClaimDomain) -> Verdict:
    """≠ holds if the difference has a definite sign; with "sometimes", if it is not always zero."""
    difference = states.on(component.difference)
    residual = Residual(component.member, component.label, difference)
    if not difference:
        return Verdict(Answer.FAILS, "", reason="both sides are equal", residuals=(residual,))
    if claim.when == "sometimes" or strict_sign(difference, states.signs):
        return Verdict(Answer.HOLDS, "", reason=f"they differ by {difference}")
    return Verdict(Answer.UNREAD, "", reason="it was read, but not decided", residuals=(residual,))


# -- signs of expressions, where their factors show them ------------------------------------------


def definite_sign(expression: Expr, assumed: Collection[Expr] = ()) -> int:
    """1 if the factors show an expression to be ≥ 0 everywhere, -1 for ≤ 0, 0 if undecided."""
    coefficient, powers = factors(expression)
    sign = 1 if coefficient > 0 else -1
    # Even powers cannot change the sign, so only factors of odd power are looked at.
    for factor in (f for f, exponent in powers.items() if exponent % 2):
        if is_positive(-factor):
            sign = -sign
        elif not is_positive(factor) and factor not in assumed and not _is_square_sum(factor):
            return 0
    return sign


def strict_sign(expression: Expr, assumed: Collection[Expr] = ()) -> int:
    """1 if the factors show an expression to be > 0 everywhere, -1 for < 0, 0 otherwise."""
    return 0 if any(may_vanish(expression, assumed)) else definite_sign(expression, assumed)


def may_vanish(expression: Expr, assumed: Collection[Expr] = ()) -> Iterator[Expr]:
    """The factors of an expression that are not known to differ from zero."""
    for factor, exponent in factors(expression)[1].items():
        known = is_positive(factor) or is_positive(-factor) or factor in assumed
        if exponent > 0 and not known and -factor not in assumed:
            yield factor


def _by_differences(expression: Expr, assumed: Collection[Expr]) -> Expr:
    """With I₂ = I₁ + p, where I₂ - I₁ is assumed positive, for every such assumption."""
    pending = list(assumed)
    for i in range(len(pending)):
        difference, symbols = pending[i], sorted(pending[i].symbols(), key=str)
        least = next((s for s in symbols if difference.diff(s) == ONE and not s.kind.varies), None)
        if len(symbols) == 1 or least is None or _is_square_sum(difference):
            continue
        excess = Symbol(f"excess_{i}", positive=True)
        image = {least: Expr.generator(least) - difference + Expr.generator(excess)}
        expression, pending = expression.subs(image), [e.subs(image) for e in pending]
    return expression


def _is_square_sum(factor: Expr) -> bool:
    """Whether every term is a positive number times even powers or positive quantities: x² + y²."""
    return all(
        coefficient > 0 and all(g.positive or power % 2 == 0 for g, power in powers.items())
        for powers, coefficient in factor.terms()
    )

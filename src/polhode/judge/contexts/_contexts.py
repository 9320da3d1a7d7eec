"""The contexts of a claim, and how equations and inequalities are judged in each."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from importlib import import_module

from polhode.base import ParseError
from polhode.judge._dimensions import dimensions_at_odds
from polhode.judge._verdict import Answer, Refuted, Verdict
from polhode.judge.contexts._conditions import conditions
from polhode.judge.contexts._equations import judged_identity, judged_motion
from polhode.judge.states._bound_claim import EQUALITY, MAGNITUDES, SENSE, BoundClaim
from polhode.judge.states._claim_domain import AnyState, ClaimDomain, TrueMotion

Judge = Callable[[BoundClaim], Verdict]


def _deferred(module: str, name: str) -> Judge:
    """A judge whose module is loaded only when its context is used."""

    def judged(claim: BoundClaim) -> Verdict:
        judge: Judge = getattr(import_module(f"polhode.judge.contexts.{module}"), name)
        return judge(claim)

    return judged


_judged_limit = _deferred("_limit", "judged_limit")
_EQUATIONS: dict[str, Judge] = {
    "identity": judged_identity,
    "motion": judged_motion,
    "steady": _deferred("_steady", "judged_steady"),
}
_WHOLE: dict[str, Judge] = {
    "threshold": _deferred("_threshold", "judged_threshold"),
    "limit": _judged_limit,
    "launch": _deferred("_initial_value", "judged_launch"),
    "number": _deferred("_number", "judged_number"),
}
#: Faster judges for corrected claims.
_FASTER: dict[str, Judge] = {"launch": _deferred("_initial_value", "judged_along")}
#: All contexts a claim may be judged in.
CONTEXTS = (*_EQUATIONS, *_WHOLE)


def judge(claim: BoundClaim, context: str) -> Verdict:
    """The verdict on a claim, each member judged by its relation sign.

    Raises `ParseError` for an unknown context, and for signs that have no meaning in it.
    """
    if context not in CONTEXTS:
        raise ParseError(f"context {context!r}", expected=f"one of {', '.join(CONTEXTS)}")
    if any(r.sign in MAGNITUDES for r in claim.members):
        return _judged_with_magnitudes(claim, context)
    if context in _WHOLE:
        return _WHOLE[context](claim)
    verdict = _judged(claim, context)
    if verdict.answer not in (Answer.FAILS, Answer.UNREAD) or claim.small:
        return verdict
    if any(r.sign == "≠" for r in claim.members):
        return verdict  # where both sides are equal it does not hold
    domains = partial(domains_of, claim, context)
    found = partial(conditions, claim, verdict, domains, lambda c: _judged(c, context))
    if isinstance(
        verdict, Refuted
    ):  # sought with the evidence, not for every trial of a correction
        return replace(verdict, conditions=found)
    return verdict.holding_where(found())


def _judged_with_magnitudes(claim: BoundClaim, context: str) -> Verdict:
    """The verdict on a claim with ≫ or ≪; other members are judged by themselves."""
    if context not in (*_EQUATIONS, "limit"):
        raise ParseError(
            f"≫ or ≪ in the context {context}, which was read; it sets no definite bound",
            expected="= ≈ or an inequality",
            advice="write < or >, or state what is small and judge it in the context limit",
            option="small",
        )
    from polhode.judge.contexts._magnitudes import judged_magnitudes  # loads NumPy

    members = {i for i, r in enumerate(claim.members) if r.sign in MAGNITUDES}
    if any(map(claim.says_choice, members)):
        raise ParseError("± beside ≫ or ≪", expected="one sign, or a magnitude")
    rest = claim.only(set(range(len(claim.members))) - members)
    verdicts = [judge(rest, context)] if len(members) < len(claim.members) else []
    for states in domains_of(claim, "motion" if context == "limit" else context):
        components = (c for c in claim.components() if c.member in members)
        verdicts += judged_magnitudes(claim, components, states)
    return _combined(verdicts, context)


def _judged(claim: BoundClaim, context: str) -> Verdict:
    """The verdict in a context in which members are judged by their signs."""
    verdicts = list(_by_signs(claim, context))
    if not verdicts:
        raise ParseError(
            "a formula that states nothing",
            expected="two sides with a sign between them, such as = or <",
            advice="write out the whole equation; ↔ only says which quantities correspond",
        )
    return _combined(verdicts, context)


def _combined(verdicts: Sequence[Verdict], context: str) -> Verdict:
    """One verdict on members that were judged by themselves."""
    wrong = [v for v in verdicts if not v.holds]
    if wrong:
        # A member that fails refutes the whole claim, whatever is undecided beside it.
        worst = next((v for v in wrong if v.answer is Answer.FAILS), wrong[0])
        return replace(worst, context=context)
    approximate = next((v for v in verdicts if v.answer is Answer.APPROXIMATE), None)
    remarks = tuple(dict.fromkeys(r for v in verdicts for r in v.remarks))
    bound = sum(v.error_bound or 0.0 for v in verdicts) or None
    first = approximate or verdicts[0]
    return replace(first, context=context, remarks=remarks, error_bound=bound)


def holds(claim: BoundClaim, context: str) -> bool:
    """Whether a claim holds; without a proof where that is faster."""
    return _FASTER[context](claim).holds if context in _FASTER else judge(claim, context).holds


def follows_from_invariants(claim: BoundClaim) -> bool:
    """Whether a claim holds on all states with the same conserved quantities as its start."""
    from polhode.judge.contexts._initial_value import against_invariants  # loads `simulate`

    return against_invariants(claim) == []


def _by_signs(claim: BoundClaim, context: str) -> Iterator[Verdict]:
    """A verdict on all equations, one on all members with ≈, and one on every other member."""
    signs = {i: relation.sign for i, relation in enumerate(claim.members)}
    equal = [i for i, sign in signs.items() if sign in EQUALITY]
    close = [i for i, sign in signs.items() if sign == "≈"]
    compared = [i for i, sign in signs.items() if sign in SENSE or sign == "≠"]
    if others := [s for s in signs.values() if s not in (*EQUALITY, "≈", "≠", *SENSE)]:
        raise ParseError(
            f"the sign {others[0]} in the context {context}", expected="= ≈ or an inequality"
        )
    # ± is one choice for the whole statement, so members judged separately must not share it.
    with_choice = {i for i in range(len(claim.members)) if claim.says_choice(i)}
    groups = [group for group in (equal, close) if with_choice.intersection(group)]
    if len(groups) > 1 or with_choice.intersection(compared):
        raise ParseError(
            "± in members of different signs, which was read",
            expected="one choice of ± in equations, all with = or all with ≈",
            advice="judge the upper and the lower sign one by one",
        )
    if equal:
        yield _EQUATIONS[context](claim.only(equal))
    if close:  # ≈ may hold exactly; if not, only a stated small quantity says how close it is
        exact = _EQUATIONS[context](claim.only(close))
        yield exact if exact.holds else _judged_close(claim.only(close), exact)
    if not compared:
        return
    from polhode.judge.contexts._inequality import judged_inequality, judged_unequal  # loads NumPy

    for states in domains_of(claim, context):
        for component in claim.components():
            if component.member in compared:
                unequal = signs[component.member] == "≠"
                yield (judged_unequal if unequal else judged_inequality)(claim, component, states)


def _judged_close(claim: BoundClaim, exact: Verdict) -> Verdict:
    """The verdict on ≈ where both sides are not exactly equal: to the order of what is small."""
    if claim.small:
        return _judged_limit(claim)
    if dimensions_at_odds(claim):
        return exact
    return Verdict(
        Answer.UNREAD,
        exact.context,
        reason="it was read, but ≈ is not exact here, and how close both sides are depends on what "
        "is small; state that, as in small 1/omega_1",
        residuals=exact.residuals,
        option="small",
    )


def domains_of(claim: BoundClaim, context: str) -> tuple[ClaimDomain, ...]:
    """The states on which a claim should hold in a context in which equations are judged."""
    if context == "steady":
        from polhode.judge.states._steady_states import steady_states  # loads `analyse`

        return steady_states(claim)
    return (claim.states(AnyState if context == "identity" else TrueMotion),)

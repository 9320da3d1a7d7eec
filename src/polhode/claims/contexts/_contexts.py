"""The contexts of a claim, and how members of different signs are judged in each."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from importlib import import_module

from polhode.base import ParseError
from polhode.claims._verdict import Answer, Verdict
from polhode.claims.contexts._equations import judged_identity, judged_motion
from polhode.claims.states._bound_claim import EQUALITY, MAGNITUDES, SENSE, BoundClaim
from polhode.claims.states._claim_domain import AnyState, ClaimDomain, TrueMotion

Judge = Callable[[BoundClaim], Verdict]


def _of(module: str, name: str) -> Judge:
    """A judge whose file, and all that it needs, is loaded for its context alone."""

    def judged(asked: BoundClaim) -> Verdict:
        judge: Judge = getattr(import_module(f"polhode.claims.contexts.{module}"), name)
        return judge(asked)

    return judged


_judged_limit = _of("_limit", "judged_limit")
_EQUATIONS: dict[str, Judge] = {
    "identity": judged_identity,
    "motion": judged_motion,
    "steady": _of("_steady", "judged_steady"),
}
_WHOLE: dict[str, Judge] = {
    "threshold": _of("_threshold", "judged_threshold"),
    "limit": _judged_limit,
    "launch": _of("_initial_value", "judged_launch"),
    "number": _of("_number", "judged_number"),
}
#: How a corrected claim is judged where that can be quicker.
_TRIED: dict[str, Judge] = {"launch": _of("_initial_value", "judged_along")}
#: Where a claim may be asked to hold.
CONTEXTS = (*_EQUATIONS, *_WHOLE)


def judge(asked: BoundClaim, context: str) -> Verdict:
    """The verdict on a claim; every member is judged by its sign.

    Raises `ParseError` for an unknown context, and for signs that the context has no use for.
    """
    if context not in CONTEXTS:
        raise ParseError(f"context {context!r}", expected=f"one of {', '.join(CONTEXTS)}")
    # ≫ and ≪ speak of a limit, and no state is large or small by itself.
    for relation in asked.members:
        if relation.sign in MAGNITUDES:
            raise ParseError(
                f"the sign {relation.sign}, which was read; no state decides what is much larger",
                expected="= ≈ or an inequality",
                advice="state what is small, and judge what follows from it in the context limit",
                option="small",
            )
    if context in _WHOLE:
        return _WHOLE[context](asked)
    found = list(_by_signs(asked, context))
    if not found:
        raise ParseError(
            "a formula that states nothing",
            expected="two sides with a sign between them, such as = or <",
            advice="write out the whole equation",
        )
    wrong = [v for v in found if not v.holds]
    if wrong:
        worst = next((v for v in wrong if v.answer is Answer.FAILS), wrong[0])
        return replace(worst, context=context)
    approximate = next((v for v in found if v.answer is Answer.APPROXIMATE), None)
    remarks = tuple(dict.fromkeys(r for v in found for r in v.remarks))
    return replace(approximate or found[0], context=context, remarks=remarks)


def holds(asked: BoundClaim, context: str) -> bool:
    """Whether a claim holds, and no more."""
    return _TRIED[context](asked).holds if context in _TRIED else judge(asked, context).holds


def _by_signs(asked: BoundClaim, context: str) -> Iterator[Verdict]:
    signs = {i: relation.sign for i, relation in enumerate(asked.members)}
    equal = [i for i, sign in signs.items() if sign in EQUALITY]
    close = [i for i, sign in signs.items() if sign == "≈"]
    bounds = [i for i, sign in signs.items() if sign in SENSE]
    unequal = [i for i, sign in signs.items() if sign == "≠"]
    if others := [s for s in signs.values() if s not in (*EQUALITY, "≈", "≠", *SENSE)]:
        raise ParseError(
            f"the sign {others[0]} in the context {context}", expected="= ≈ or an inequality"
        )
    # ± is one choice for the whole statement, so that what is judged apart must not share it.
    together = [equal, close]
    with_choice = {i for i in range(len(asked.members)) if asked.says_choice(i)}
    groups = [group for group in together if with_choice.intersection(group)]
    if len(groups) > 1 or with_choice.intersection([*bounds, *unequal]):
        raise ParseError(
            "± in members of different signs, which was read",
            expected="one choice of ± in equations, all with = or all with ≈",
            advice="judge the upper and the lower sign one by one",
        )
    if equal:
        yield _EQUATIONS[context](asked.only(equal))
    if close:
        yield _close(asked.only(close), context)
    if bounds or unequal:
        from polhode.claims.contexts._inequality import judged_inequality, judged_unequal

        for states in _states(asked, context):
            for component in asked.components():
                if component.member in bounds:
                    yield judged_inequality(asked, component, states)
                if component.member in unequal:
                    yield judged_unequal(asked, component, states)


def _close(asked: BoundClaim, context: str) -> Verdict:
    """≈ may be exact; otherwise it takes a small quantity to say how close it is."""
    exact = _EQUATIONS[context](asked)
    return exact if exact.holds or not asked.small else _judged_limit(asked)


def _states(asked: BoundClaim, context: str) -> tuple[ClaimDomain, ...]:
    if context == "steady":
        from polhode.claims.states._steady_states import steady_states

        return steady_states(asked)
    return (asked.states(AnyState if context == "identity" else TrueMotion),)

"""The contexts of a claim, and how members of different signs are judged in each."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from polhode.base import ParseError
from polhode.claims._asked import EQUALITY, Asked
from polhode.claims._circumstances import AnyState, Circumstances, TrueMotion
from polhode.claims._inequality import SENSE, judged_inequality, judged_unequal
from polhode.claims._judge import judged_identity, judged_motion
from polhode.claims._limit import judged_limit
from polhode.claims._number import judged_number
from polhode.claims._steady import judged_steady
from polhode.claims._steady_states import steady_states
from polhode.claims._threshold import judged_threshold
from polhode.claims._verdict import Answer, Verdict

Judge = Callable[[Asked], Verdict]


def _judged_launch(asked: Asked) -> Verdict:
    """Along the motion from a start; what simulates is loaded for this context alone."""
    from polhode.claims._launch import judged_launch

    return judged_launch(asked)


_EQUATIONS: dict[str, Judge] = {
    "identity": judged_identity,
    "motion": judged_motion,
    "steady": judged_steady,
}
_WHOLE: dict[str, Judge] = {
    "threshold": judged_threshold,
    "limit": judged_limit,
    "launch": _judged_launch,
    "number": judged_number,
}
#: Where a claim may be asked to hold.
CONTEXTS = (*_EQUATIONS, *_WHOLE)


def judge(asked: Asked, context: str) -> Verdict:
    """The verdict on a claim; every member is judged by its sign.

    Raises `ParseError` for an unknown context, and for signs that the context has no use for.
    """
    if context not in CONTEXTS:
        raise ParseError(f"context {context!r}", expected=f"one of {', '.join(CONTEXTS)}")
    if context in _WHOLE:
        return _WHOLE[context](asked)
    found = list(_by_signs(asked, context))
    worst = next((v for v in found if not v.holds), None)
    if worst is not None:
        return replace(worst, context=context)
    approximate = next((v for v in found if v.answer is Answer.APPROXIMATE), None)
    remarks = tuple(dict.fromkeys(r for v in found for r in v.remarks))
    return replace(approximate or found[0], context=context, remarks=remarks)


def _by_signs(asked: Asked, context: str) -> Iterator[Verdict]:
    signs = {i: relation.sign for i, relation in enumerate(asked.members)}
    equal = [i for i, sign in signs.items() if sign in EQUALITY]
    close = [i for i, sign in signs.items() if sign == "≈"]
    bounds = [i for i, sign in signs.items() if sign in SENSE]
    if others := [s for s in signs.values() if s not in (*EQUALITY, "≈", "≠", *SENSE)]:
        raise ParseError(
            f"the sign {others[0]} in the context {context}", expected="= ≈ or an inequality"
        )
    if equal:
        yield _EQUATIONS[context](asked.only(equal))
    if close:
        yield _close(asked.only(close), context)
    for component in asked.components():
        if component.member in bounds:
            yield judged_inequality(asked, component, _states(asked, context))
        if signs[component.member] == "≠":
            yield judged_unequal(asked, component, _states(asked, context))


def _close(asked: Asked, context: str) -> Verdict:
    """≈ may be exact; otherwise it takes a small quantity to say how close it is."""
    exact = _EQUATIONS[context](asked)
    return exact if exact.holds or not asked.small else judged_limit(asked)


def _states(asked: Asked, context: str) -> Circumstances:
    if context == "steady":
        return steady_states(asked)[0]
    return asked.states(AnyState if context == "identity" else TrueMotion)

"""Claims on the start of a motion and the moment after it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from polhode.claims._verdict import Verdict
from polhode.claims.contexts._inequality import judged_inequality
from polhode.claims.contexts._judge import judged
from polhode.claims.meaning._relations import ScalarRelation
from polhode.claims.states._bound_claim import EQUALITY, BoundClaim
from polhode.claims.states._claim_domain import TrueMotion

_HIGHEST_RATE = 4


def judged_initially(asked: BoundClaim) -> Verdict:
    """At the start; an inequality whose sides are equal there, just after it."""
    states = asked.states(TrueMotion)
    equal = {i for i, r in enumerate(asked.members) if r.sign in EQUALITY}
    verdict = judged(asked.only(equal), [states], "launch")
    for component in (c for c in asked.components() if c.member not in equal):
        if verdict.holds:
            verdict = judged_inequality(asked, _parting(component, states), states)
    return replace(verdict, context="launch")


def _parting(component: ScalarRelation, states: TrueMotion) -> ScalarRelation:
    """The lowest rates of both sides by which they part from the start on."""
    rates = _rates(component, replace(states, given={}))
    return next((c for c in rates if states.on(c.difference)), component)


def _rates(component: ScalarRelation, running: TrueMotion) -> Iterator[ScalarRelation]:
    for _ in range(_HIGHEST_RATE):
        yield component
        left, right = (running.on(side).dt() for side in (component.left, component.right))
        component = replace(component, left=left, right=right)

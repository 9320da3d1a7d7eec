"""≫ and ≪: of two sides one vanishes beside the other, in the limit of what is small."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import Expr
from polhode.base import ParseError
from polhode.judge._dimensions import dimensions_at_odds, in_words
from polhode.judge._verdict import Answer, Residual, Verdict
from polhode.judge.contexts._inequality import definite_sign
from polhode.judge.contexts._remainder import leading_orders, restored, scaled, weights
from polhode.judge.meaning._relations import ScalarRelation
from polhode.judge.states._bound_claim import BoundClaim
from polhode.judge.states._claim_domain import ClaimDomain

_EXPANDED = 6  # orders, in units of the weight of a small quantity, both ways


def judged_magnitudes(
    claim: BoundClaim, components: Iterator[ScalarRelation], states: ClaimDomain
) -> Iterator[Verdict]:
    """A verdict on each component: whether the ratio of its sides tends to zero.

    A ≫ B bounds nothing at any single state; it says that B/A → 0 as something becomes small. If
    that is not stated, only a ratio that is never small can be refuted.
    """
    for component in components:
        if component.label:
            raise ParseError(
                "≫ or ≪ between vectors",
                expected="two scalars",
                advice="compare their magnitudes",
            )
        yield _Comparison(claim, component, states).verdict()


class _Comparison:
    """One side said to be much smaller than the other."""

    def __init__(self, claim: BoundClaim, component: ScalarRelation, states: ClaimDomain) -> None:
        self._claim, self._component, self._states = claim, component, states
        sides = [states.on(side) for side in (component.left, component.right)]
        is_less = claim.members[component.member].sign == "≪"
        self._less, self._greater = sides if is_less else reversed(sides)

    def verdict(self) -> Verdict:
        if not self._less:
            return Verdict(Answer.UNREAD, "", reason="zero is compared, which has no size")
        if not self._greater:
            return self._failed("one side is zero, and nothing is small beside it")
        if odd := dimensions_at_odds(self._claim.only([self._component.member])):
            return self._failed(in_words(odd))
        ratio = self._less / self._greater
        if ratio.rational is not None:
            return self._failed(f"the ratio of the sides is {ratio}, whatever is small")
        if self._is_never_less:
            return self._failed(f"the side that is to be small is never the smaller one: {ratio}")
        return self._in_the_limit(ratio) if self._claim.small else self._open(ratio)

    @property
    def _is_never_less(self) -> bool:
        signs = self._states.signs
        above = definite_sign(self._greater, signs) == 1
        return above and definite_sign(self._less - self._greater, signs) == 1

    def _in_the_limit(self, ratio: Expr) -> Verdict:
        small = self._claim.small
        reach = _EXPANDED * max(weights(small))
        found = leading_orders(scaled(ratio, small), -reach, reach, self._claim.positive)
        order, term = next(iter(found.items()), (reach + 1, None))
        if order > 0:
            why = f"the ratio of the sides vanishes at order {order} of what is small"
            return Verdict(Answer.HOLDS, "", reason=why)
        kept = f", {restored(term, small)}," if term is not None else ""
        return self._failed(
            f"the ratio of the sides is of order {order} in what is small{kept} and does not vanish"
        )

    def _open(self, ratio: Expr) -> Verdict:
        names = ", ".join(sorted(s.published for s in ratio.symbols() if s.name != "pi"))
        return Verdict(
            Answer.UNREAD,
            "",
            reason="it was read, but ≫ and ≪ are statements about a limit, and what is small is "
            f"not stated: the ratio {ratio} has to vanish with it; state what is small among "
            f"{names}, as in small x or small 1/x",
            option="small",
        )

    def _failed(self, why: str) -> Verdict:
        component = self._component
        residual = Residual(component.member, component.label, component.difference)
        return Verdict(Answer.FAILS, "", reason=why, residuals=(residual,))

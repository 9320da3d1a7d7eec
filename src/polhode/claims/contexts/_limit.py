"""Claims that are true for small quantities, to an order."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from math import log

from polhode.algebra import ONE, ZERO, Expr, Symbol
from polhode.base import NumericError, PolhodeError
from polhode.claims._verdict import Answer, Evidence, Refuted, Residual, Verdict
from polhode.claims.contexts._counterexample import refutation
from polhode.claims.contexts._roots_of_steady import steady_roots
from polhode.claims.contexts._scaling import SMALLNESS, leading_orders, restored, scaled
from polhode.claims.meaning._components import Component
from polhode.claims.states._asked import Asked
from polhode.claims.states._bench import real_states
from polhode.claims.states._circumstances import AnyState, Circumstances, TrueMotion
from polhode.claims.states._numeric import number

_HIGHEST = 6
_LOWEST = -4


def judged_limit(asked: Asked) -> Verdict:
    """To the stated order in the small quantities, and verified by scaling what is left out.

    Judged for all states first, then on true motions, then for the roots of steady motions.
    """
    if not asked.small:
        raise NumericError(
            "a claim in the context limit without a small quantity",
            expected="what is small and to which order",
            advice="name it with the order that is kept, as in epsilon:1",
            option="small",
        )
    verdicts = []
    for candidate in _readings(asked):
        verdict = _judged(asked, candidate)
        if verdict.holds:
            return verdict
        verdicts.append(verdict)
    return verdicts[-1]


@dataclass(frozen=True)
class _Remainder:
    """What is left of one component: as a power series in the smallness."""

    component: Component
    states: Circumstances
    left: Expr
    right: Expr
    positive: tuple[Expr, ...]

    @cached_property
    def orders(self) -> dict[int, Expr]:
        """The first coefficients that are not zero, by their order."""
        return self.series(self.left - self.right)

    def series(self, expression: Expr, highest: int = _HIGHEST) -> dict[int, Expr]:
        """The first coefficient that does not vanish, by its order, with all signs told."""
        return leading_orders(expression, _LOWEST, highest, self.positive)

    @cached_property
    def leading(self) -> int:
        """Order of the larger side."""
        both = map(self.series, (self.left, self.right))
        return min((order for orders in both for order in orders), default=0)


def _readings(asked: Asked) -> Iterator[Iterator[_Remainder]]:
    kinds = (AnyState, TrueMotion)
    for kind in kinds:
        states = asked.states(kind)
        yield (_remainder(c, states, c.left, c.right, asked) for c in asked.components())
    roots = list(steady_roots(asked))
    for branch in range(max((len(values) for _, values in roots), default=0)):
        states = replace(asked, relations=()).states(TrueMotion)
        yield (
            _remainder(c, states, values[branch], c.right, asked)
            for c, values in roots
            if branch < len(values)
        )


def _remainder(
    component: Component, states: Circumstances, left: Expr, right: Expr, asked: Asked
) -> _Remainder:
    first, second = (scaled(states.on(side), asked.small) for side in (left, right))
    return _Remainder(component, states, first, second, _positive(asked))


def _positive(asked: Asked) -> tuple[Expr, ...]:
    """What is taken as positive: what the text says is, and what is large."""
    large = (Expr.generator(s) for small in asked.small for s in _below(small.quantity))
    return (*asked.positive, *large)


def _below(quantity: Expr) -> frozenset[Symbol]:
    return quantity.denominator.symbols()


def _judged(asked: Asked, remainders: Iterable[_Remainder]) -> Verdict:
    stated = [small.order for small in asked.small if small.order is not None]
    reached: list[tuple[int, Expr]] = []
    seen: list[_Remainder] = []
    for left in remainders:
        seen.append(left)
        if not left.orders:
            if left.left != left.right:
                reached.append((_HIGHEST + 1, ZERO))
            continue
        order, term = next(iter(left.orders.items()))
        if order <= _wanted(left, stated, asked):
            return _failed(left, order, restored(term, asked.small))
        reached.append((order, term))
    if not reached:
        return Verdict(Answer.HOLDS, "limit")
    order, dropped = min(reached, key=lambda pair: pair[0])
    return Verdict(
        Answer.APPROXIMATE,
        "limit",
        reason=f"true up to order {order - 1}; the first term left out is of order {order}",
        order=order - 1,
        dropped=restored(dropped, asked.small),
        remarks=tuple(_measured(seen)),
    )


def _wanted(left: _Remainder, stated: Sequence[int], asked: Asked) -> int:
    """The order to which a claim is to be true."""
    if not stated:
        return left.leading
    # terms printed to be kept may be products of what is small, each to its stated order
    kept = _highest_printed(left.component, asked)
    return max(min(stated), min(kept, sum(stated)))


def _highest_printed(component: Component, asked: Asked) -> int:
    """The highest order among several terms whose sum is to vanish: they are printed to be kept."""
    sides = [scaled(side, asked.small) for side in (component.left, component.right) if side]
    terms = [powers for side in sides for powers, _ in side.numerator.terms()]
    if len(sides) > 1 or len(terms) < 2:
        return 0
    return max(powers.get(SMALLNESS, 0) for powers in terms)


def _failed(left: _Remainder, order: int, term: Expr) -> Verdict:
    residual = Residual(left.component.member, left.component.label, term)
    return Refuted(
        Answer.FAILS,
        "limit",
        reason=f"the sides differ at order {order} already",
        residuals=(residual,),
        order=order - 1,
        dropped=term,
        evidence=partial(_evidence, left, order, residual),
    )


def _evidence(left: _Remainder, order: int, residual: Residual) -> Evidence:
    """A state at which the coefficients of that order differ."""
    wrong = Component(residual.member, residual.component, *_coefficients(left, order))
    return refutation(wrong, residual, left.states)


def _coefficients(left: _Remainder, order: int) -> tuple[Expr, Expr]:
    sides = (left.series(side, order) for side in (left.left, left.right))
    first, second = (found.get(order, ZERO) for found in sides)
    return first, second


def _measured(remainders: Sequence[_Remainder]) -> Iterator[str]:
    """How fast the remainder falls as the small quantities are halved, by numbers."""
    for left in remainders:
        difference = left.left - left.right
        if difference:
            try:
                order = _slope(difference, left.states)
            except (PolhodeError, ArithmeticError, ValueError):
                continue
            yield f"halving what is small makes the remainder fall as its power {order:.2f}"
            return


def _slope(difference: Expr, states: Circumstances) -> float:
    point = next(real_states(states, [difference.subs({SMALLNESS: ONE})]), None)
    if point is None:
        raise NumericError("no state among those tried", expected="one that is real")
    sizes = [abs(number(difference, {**point, SMALLNESS: 2.0**-k})) for k in (7, 8)]
    return log(sizes[0] / sizes[1], 2)

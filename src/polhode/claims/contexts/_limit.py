"""Claims that are true for small quantities, to an order."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from math import inf, log

from polhode.algebra import ONE, ZERO, Expr
from polhode.base import NumericError, ParseError, PolhodeError
from polhode.claims._verdict import Answer, Evidence, Refuted, Residual, Verdict
from polhode.claims.balance._declared import reaction_symbol
from polhode.claims.contexts._counterexample import refutation
from polhode.claims.contexts._remainder import SMALLNESS, Remainder, restored, scaled
from polhode.claims.contexts._steady import steady_roots
from polhode.claims.meaning._components import ScalarRelation
from polhode.claims.states._bound_claim import EQUALITY, BoundClaim
from polhode.claims.states._claim_domain import AnyState, ClaimDomain, TrueMotion
from polhode.claims.states._numeric import number
from polhode.claims.states._sample_points import real_states

_DIGITS = 30  # binary ones that a remainder may lose to rounding
_STEEPEST = 15


def judged_limit(asked: BoundClaim) -> Verdict:
    """To the stated order in the small quantities, and to that of every term that is printed.

    What is left over must be smaller than all that is kept: smaller than the stated order, and
    smaller than each printed term, which would otherwise not have been tested. A single quantity
    that is said to vanish need only be beyond the stated order. Judged on all states where no
    accelerations or reactions are spoken of, otherwise on true motions, then for the roots of
    steady motions; of a ± each sign by itself.
    """
    if not asked.small:
        raise NumericError(
            "a claim in the context limit without a small quantity",
            expected="what is small and to which order",
            advice="name it with the order that is kept, as in epsilon:1",
            option="small",
        )
    if others := [r.sign for r in asked.members if r.sign not in (*EQUALITY, "≈")]:
        raise ParseError(f"the sign {others[0]} in the context limit", expected="= or ≈")
    verdicts = [_of_branch(replace(asked, branches=(branch,))) for branch in asked.branches]
    return min(verdicts, key=_standing)


def _standing(verdict: Verdict) -> tuple[int, float]:
    """Failures before what is open, and that before what is true to lower and to higher order."""
    places = (Answer.FAILS, Answer.UNREAD, Answer.APPROXIMATE, Answer.HOLDS)
    return places.index(verdict.answer), inf if verdict.order is None else verdict.order


def _of_branch(asked: BoundClaim) -> Verdict:
    """With one choice of the signs of ±."""
    verdicts = []
    for candidate in _readings(asked):
        verdict = _judged(asked, candidate)
        if verdict.holds:
            return verdict
        verdicts.append(verdict)
    return next((v for v in verdicts if v.answer is Answer.UNREAD), verdicts[-1])


def _readings(asked: BoundClaim) -> Iterator[Iterator[Remainder]]:
    anywhere, moving = asked.states(AnyState), asked.states(TrueMotion)
    sides = [anywhere.on(side) for c in asked.components() for side in (c.left, c.right)]
    kinematic = not any(_is_dynamic(side, anywhere) for side in sides)
    states: ClaimDomain = anywhere if kinematic else moving
    yield (_remainder(c, states, asked) for c in asked.components())
    roots = list(steady_roots(asked))
    spoken = [c for c in asked.components() if c.difference]
    if len(roots) < len(spoken):
        return
    steadily = replace(asked, relations=()).states(TrueMotion)
    for branch in range(max((len(values) for _, values in roots), default=0)):
        yield (
            _remainder(c, steadily, asked, values[branch])
            for c, values in roots
            if branch < len(values)
        )


def _is_dynamic(side: Expr, states: ClaimDomain) -> bool:
    """Whether it speaks of accelerations or reactions, which only the motion determines."""
    equations = states.equations
    known = {*equations.coordinates, *equations.speeds}
    forces = {reaction_symbol(name) for name in equations.components}
    functions = set(equations.functions)
    return any(
        s.base() in forces or (s.kind.varies and s not in known and s.base() not in functions)
        for s in side.symbols()
    )


def _remainder(
    component: ScalarRelation, states: ClaimDomain, asked: BoundClaim, root: Expr | None = None
) -> Remainder:
    first = component.left if root is None else root
    left, right = (scaled(states.on(side), asked.small) for side in (first, component.right))
    # What is taken as positive: what the text says is, and what is large.
    large = (
        Expr.generator(s) for small in asked.small for s in small.quantity.denominator.symbols()
    )
    return Remainder(
        component, states, left, right, (*asked.positive, *large), asked, root is not None
    )


def _judged(asked: BoundClaim, remainders: Iterable[Remainder]) -> Verdict:
    reached: list[tuple[int, Expr]] = []
    seen: list[Remainder] = []
    for left in remainders:
        seen.append(left)
        if not left.orders:
            if left.left != left.right:
                reached.append((left.highest + 1, ZERO))
            continue
        order, term = next(iter(left.orders.items()))
        if why := left.objection(order):
            return _failed(left, order, restored(term, asked.small), why)
        if order <= left.printed.left_aside:
            return Verdict(
                Answer.UNREAD,
                "limit",
                reason=f"it was read and is true up to order {order - 1}, but its left side has a term of "
                f"order {left.printed.left_aside} that is neither met by the right side nor right by "
                "itself; leave it out, or state the order of what is small",
                order=order - 1,
            )
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


def _failed(left: Remainder, order: int, term: Expr, why: str) -> Verdict:
    residual = Residual(left.component.member, left.component.label, term)
    return Refuted(
        Answer.FAILS,
        "limit",
        reason=why,
        residuals=(residual,),
        order=order - 1,
        dropped=term,
        evidence=partial(_evidence, left, order, residual),
    )


def _evidence(left: Remainder, order: int, residual: Residual) -> Evidence:
    """A state at which the coefficients of that order differ."""
    sides = (left.series(side, order) for side in (left.left, left.right))
    first, second = (found.get(order, ZERO) for found in sides)
    wrong = ScalarRelation(residual.member, residual.component, *(first, second))
    return refutation(wrong, residual, left.states)


def _measured(remainders: Sequence[Remainder]) -> Iterator[str]:
    """How fast the remainder falls as the small quantities are halved, by numbers."""
    for left in remainders:
        difference = left.left - left.right
        if difference:
            try:
                point = next(real_states(left.states, [difference.subs({SMALLNESS: ONE})]), None)
                if point is None:
                    raise NumericError("no state among those tried", expected="one that is real")
                first = max(
                    2, min(7, _DIGITS // max(next(iter(left.orders), _STEEPEST), 1))
                )  # what is left stays above rounding
                halvings = (first, first + 1)
                sizes = [abs(number(difference, {**point, SMALLNESS: 2.0**-k})) for k in halvings]
                order = log(sizes[0] / sizes[1], 2)
            except (PolhodeError, ArithmeticError, ValueError):
                continue
            yield f"halving what is small makes the remainder fall as its power {order:.2f}"
            return

"""Claims that are true for small quantities, to an order."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from math import inf, log

from polhode.algebra import ONE, ZERO, Expr
from polhode.base import NumericError, ParseError, PolhodeError
from polhode.claims._verdict import Answer, Evidence, Refuted, Residual, Verdict
from polhode.claims.balance._declared import reaction_symbol
from polhode.claims.contexts._counterexample import refutation
from polhode.claims.contexts._remainder import SMALLNESS, Remainder, restored, scaled
from polhode.claims.contexts._steady import steady_roots
from polhode.claims.meaning._relations import ScalarRelation
from polhode.claims.states._bound_claim import EQUALITY, BoundClaim
from polhode.claims.states._claim_domain import AnyState, ClaimDomain, TrueMotion
from polhode.claims.states._numeric import number
from polhode.claims.states._sample_points import real_states

_DIGITS = 30  # binary ones that a remainder may lose to rounding
_STEEPEST = 15  # order assumed for a remainder beyond all that is expanded


def judged_limit(claim: BoundClaim) -> Verdict:
    """To the stated order in the small quantities, and to that of every term that is printed.

    What is left over must be smaller than all that is kept: smaller than the stated order, and
    smaller than each printed term, which would otherwise not have been tested. A single quantity
    that is said to vanish need only be beyond the stated order. Judged on all states where no
    accelerations or reactions occur, otherwise on true motions, then for the roots of steady
    motions; of a ± each sign by itself.
    """
    if not claim.small:
        raise NumericError(
            "a claim in the context limit without a small quantity",
            expected="what is small and to which order",
            advice="name it with the order that is kept, as in epsilon:1",
            option="small",
        )
    if others := [r.sign for r in claim.members if r.sign not in (*EQUALITY, "≈")]:
        raise ParseError(f"the sign {others[0]} in the context limit", expected="= or ≈")
    verdicts = [_of_branch(replace(claim, branches=(branch,))) for branch in claim.branches]
    # failures before what is open, then what is true to the lowest order
    answers = (Answer.FAILS, Answer.UNREAD, Answer.APPROXIMATE, Answer.HOLDS)
    return min(
        verdicts, key=lambda v: (answers.index(v.answer), inf if v.order is None else v.order)
    )


def _of_branch(claim: BoundClaim) -> Verdict:
    """With one choice of the signs of ±."""
    verdicts = []
    for remainders in _candidates(claim):
        verdict = _judged(claim, remainders)
        if verdict.holds:
            return verdict
        verdicts.append(verdict)
    return next((v for v in verdicts if v.answer is Answer.UNREAD), verdicts[-1])


def _candidates(claim: BoundClaim) -> Iterator[Iterator[Remainder]]:
    """What may have to be small: remainders on a domain, or of the roots of steady motions."""
    anywhere = claim.states(AnyState)
    sides = [anywhere.on(side) for c in claim.components() for side in (c.left, c.right)]
    dynamic = any(_is_dynamic(side, anywhere) for side in sides)
    states: ClaimDomain = claim.states(TrueMotion) if dynamic else anywhere
    yield (_remainder(c, states, claim) for c in claim.components())
    roots = list(steady_roots(claim))
    if len(roots) < sum(bool(c.difference) for c in claim.components()):
        return
    steadily = replace(claim, relations=()).states(TrueMotion)
    for branch in range(max((len(values) for _, values in roots), default=0)):
        yield (
            _remainder(c, steadily, claim, values[branch])
            for c, values in roots
            if branch < len(values)
        )


def _is_dynamic(side: Expr, states: ClaimDomain) -> bool:
    """Whether accelerations or reactions occur, which only the motion determines."""
    equations = states.equations
    known = {*equations.coordinates, *equations.speeds}
    forces = {reaction_symbol(name) for name in equations.components}
    functions = set(equations.functions)
    return any(
        s.base() in forces or (s.kind.varies and s not in known and s.base() not in functions)
        for s in side.symbols()
    )


def _remainder(
    component: ScalarRelation, states: ClaimDomain, claim: BoundClaim, root: Expr | None = None
) -> Remainder:
    first = component.left if root is None else root
    left, right = (scaled(states.on(side), claim.small) for side in (first, component.right))
    # positive is what the text says is, and what is large: the denominators of small quantities
    large = (s for small in claim.small for s in small.quantity.denominator.symbols())
    positive = (*claim.positive, *map(Expr.generator, large))
    return Remainder(component, states, left, right, positive, claim, root is not None)


def _judged(claim: BoundClaim, remainders: Iterable[Remainder]) -> Verdict:
    reached: list[tuple[int, Expr]] = []
    seen: list[Remainder] = []
    for remainder in remainders:
        seen.append(remainder)
        if not remainder.orders:
            if remainder.left != remainder.right:
                reached.append((remainder.highest + 1, ZERO))
            continue
        order, term = next(iter(remainder.orders.items()))
        if why := remainder.objection(order):
            return _failed(remainder, order, restored(term, claim.small), why)
        aside = remainder.printed.left_aside
        if order <= aside:
            return Verdict(
                Answer.UNREAD,
                "limit",
                reason=f"it was read and is true up to order {order - 1}, but its left side has a "
                f"term of order {aside} that neither equals one on the right side nor vanishes by "
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
        reason=f"true up to order {order - 1}; the first omitted term is of order {order}",
        order=order - 1,
        dropped=restored(dropped, claim.small),
        remarks=tuple(_measured(seen)),
    )


def _failed(remainder: Remainder, order: int, term: Expr, why: str) -> Verdict:
    component = remainder.component
    residual = Residual(component.member, component.label, term)

    def evidence() -> Evidence:
        """A state at which the coefficients of that order differ."""
        sides = (remainder.series(side, order) for side in (remainder.left, remainder.right))
        left, right = (found.get(order, ZERO) for found in sides)
        wrong = ScalarRelation(component.member, component.label, left, right)
        return refutation(wrong, residual, remainder.states)

    return Refuted(
        Answer.FAILS,
        "limit",
        reason=why,
        residuals=(residual,),
        order=order - 1,
        dropped=term,
        evidence=evidence,
    )


def _measured(remainders: Sequence[Remainder]) -> Iterator[str]:
    """How the first residual scales with the small quantities, by numbers: a check of its order."""
    for remainder in remainders:
        difference = remainder.left - remainder.right
        if difference:
            try:
                order = _slope(difference, remainder)
            except (PolhodeError, ArithmeticError, ValueError):
                continue
            yield f"the residual scales as ε^{order:.2f}"
            return


def _slope(difference: Expr, remainder: Remainder) -> float:
    """The power of the smallness ε with which a difference falls from ε = 2⁻ᵏ to 2⁻ᵏ⁻¹."""
    point = next(real_states(remainder.states, [difference.subs({SMALLNESS: ONE})]), None)
    if point is None:
        raise NumericError("no state among those tried", expected="one that is real")
    expected = next(iter(remainder.orders), _STEEPEST)
    first = max(2, min(7, _DIGITS // max(expected, 1)))  # the residual stays above rounding
    sizes = [abs(number(difference, {**point, SMALLNESS: 2.0**-k})) for k in (first, first + 1)]
    return log(sizes[0] / sizes[1], 2)

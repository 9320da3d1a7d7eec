"""Claims that hold to an order in small quantities."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import inf, log

from polhode.algebra import ONE, ZERO, Expr, Symbol
from polhode.base import NumericError, ParseError, PolhodeError
from polhode.judge._verdict import Answer, Evidence, Refuted, Residual, Verdict
from polhode.judge.balance._declared import reaction_symbol
from polhode.judge.contexts._counterexample import refutation
from polhode.judge.contexts._equations import other_level
from polhode.judge.contexts._remainder import (
    SMALLNESS,
    Remainder,
    eliminating,
    large_symbols,
    restored,
    scaled,
)
from polhode.judge.contexts._steady import steady_roots
from polhode.judge.meaning._relations import ScalarRelation
from polhode.judge.states._bound_claim import EQUALITY, BoundClaim, Small
from polhode.judge.states._claim_domain import AnyState, ClaimDomain, TrueMotion
from polhode.judge.states._numeric import number
from polhode.judge.states._sample_points import real_states

_OF_STEADY = "taken of steady motions; of motions in general it does not hold"
_DIGITS = 30  # bits by which a remainder may be smaller than the sides, of the 53 of a double
_STEEPEST = 15  # order assumed for a remainder that vanishes to every order expanded


def judged_limit(claim: BoundClaim) -> Verdict:
    """Judge a claim to the stated order in the small quantities, and to that of every printed term.

    The remainder must be of higher order than all that is kept: higher than the stated order, and
    higher than each printed term, which would otherwise not have been tested. A single quantity
    claimed to vanish need only be beyond the stated order. The claim is judged on all states if no
    accelerations or reactions occur, otherwise on true motions, then for the roots of steady
    motions. Each sign of a ± is judged by itself.
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
    claim = with_small_others(claim)
    verdicts = [_of_branch(replace(claim, branches=(branch,))) for branch in claim.branches]
    # The worst branch decides: failures, then undecided ones, then the lowest order reached.
    answers = (Answer.FAILS, Answer.UNREAD, Answer.APPROXIMATE, Answer.HOLDS)
    return min(
        verdicts, key=lambda v: (answers.index(v.answer), inf if v.order is None else v.order)
    )


def _of_branch(claim: BoundClaim) -> Verdict:
    """The verdict for one choice of the signs of ±."""
    verdicts = []
    for approach in approaches(claim):
        verdict = _judged(claim, (_remainder(c, approach, claim) for c in claim.components()))
        if verdict.holds:
            return replace(
                verdict, remarks=(*verdict.remarks, *([_OF_STEADY] if approach.root else []))
            )
        verdicts.append(verdict)
    undecided = next((v for v in verdicts if v.answer is Answer.UNREAD), None)
    # Of several roots a claim is about the one that it comes closest to.
    return undecided or max(verdicts, key=lambda v: -inf if v.order is None else v.order)


def with_small_others(claim: BoundClaim) -> BoundClaim:
    """The claim with small quantities that eliminate none of the symbols it gives."""
    given = {s for c in claim.components() if (s := c.left.symbol) is not None}
    return replace(claim, small=eliminating(claim.small, given))


@dataclass(frozen=True, eq=False)
class Approach:
    """States near a limit, on which the remainders of a claim may have to be small.

    Attributes:
        states: the states.
        root: a speed in steady motion with its value there, scaled; empty for any motion.
    """

    states: ClaimDomain
    root: Mapping[Symbol, Expr]

    def of(self, expression: Expr, small: Sequence[Small]) -> Expr:
        """An expression on these states, in terms of what is small."""
        found = scaled(self.states.on(expression), small)
        return found.subs(self.root) if self.root else found


def approaches(claim: BoundClaim) -> Iterator[Approach]:
    """Where the remainders may have to be small: on all states of a domain, or in steady motion.

    Texts print an approximate rate of precession as if it held always; it is a root of the exact
    relation between steady speeds. In whichever form such a claim is written, that root is put in.
    """
    anywhere = claim.states(AnyState)
    sides = [anywhere.on(side) for c in claim.components() for side in (c.left, c.right)]
    dynamic = any(_is_dynamic(side, anywhere) for side in sides)
    yield Approach(claim.states(TrueMotion) if dynamic else anywhere, {})
    steadily = replace(claim, relations=()).states(TrueMotion)
    said = {s for c in claim.components() if (s := c.left.symbol) is not None}
    unknown = said if dynamic else {s for side in sides for s in side.symbols()}
    for root in steady_roots(claim, unknown, partial(scaled, small=claim.small)):
        yield Approach(steadily, root)


def _is_dynamic(side: Expr, states: ClaimDomain) -> bool:
    """Whether accelerations or reactions occur, which only the dynamics determines."""
    equations = states.equations
    known = {*equations.coordinates, *equations.speeds}
    forces = {reaction_symbol(name) for name in equations.components}
    functions = set(equations.functions)
    return any(
        s.base() in forces or (s.kind.varies and s not in known and s.base() not in functions)
        for s in side.symbols()
    )


def _remainder(component: ScalarRelation, approach: Approach, claim: BoundClaim) -> Remainder:
    # Positive: what the text states, and what is large.
    positive = (*claim.positive, *map(Expr.generator, large_symbols(claim.small)))
    return Remainder(component, approach.states, positive, claim, approach.root)


def _judged(claim: BoundClaim, remainders: Iterable[Remainder]) -> Verdict:
    reached: list[tuple[int, Expr]] = []
    seen: list[Remainder] = []
    levels: list[str] = []
    for printed in remainders:
        remainder, difference = _from_its_level(printed)
        if difference:
            levels.append(
                f"the energies differ by {difference}, since they count from different levels"
            )
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
                f"term of order {aside} that is neither matched on the right side nor zero; leave "
                "it out, or state the order of the small quantity",
                order=order - 1,
            )
        reached.append((order, term))
    if not reached:
        return Verdict(Answer.HOLDS, "limit", remarks=tuple(levels))
    order, dropped = min(reached, key=lambda pair: pair[0])
    return Verdict(
        Answer.APPROXIMATE,
        "limit",
        reason=f"true up to order {order - 1}; the first omitted term is of order {order}",
        order=order - 1,
        dropped=restored(dropped, claim.small),
        remarks=(*levels, *_measured(seen)),
    )


def _from_its_level(remainder: Remainder) -> tuple[Remainder, Expr]:
    """The remainder with an energy counted from the level of the text, and the shift."""
    shift = remainder.orders.get(0, ZERO)
    if not shift or not other_level(remainder.claim, remainder.component, shift):
        return remainder, ZERO
    component = replace(remainder.component, left=remainder.component.left - shift)
    return replace(remainder, component=component), shift


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
    """How the first residual scales with the small quantities, by numbers: a check of its order.

    The exact series gives an integer; the measured power must be close to it.
    """
    for remainder in remainders:
        difference = remainder.left - remainder.right
        if difference:
            try:
                order = _slope(difference, remainder)
            except (PolhodeError, ArithmeticError, ValueError):
                continue
            yield f"the residual scales as ε to the power {order:.2f}"
            return


def _slope(difference: Expr, remainder: Remainder) -> float:
    """The power p of a difference ∝ ε^p, from its values at ε = 2⁻ᵏ and 2⁻ᵏ⁻¹."""
    point = next(real_states(remainder.states, [difference.subs({SMALLNESS: ONE})]), None)
    if point is None:
        raise NumericError("no state among those tried", expected="one that is real")
    expected = next(iter(remainder.orders), _STEEPEST)
    # ε^p = 2^(-kp): k is chosen such that kp ≤ 30 bits keeps the residual above rounding.
    first = max(2, min(7, _DIGITS // max(expected, 1)))
    values = (number(difference, {**point, SMALLNESS: 2.0**-k}) for k in (first, first + 1))
    sizes = [abs(float(value)) for value in values]  # of which zero is an error, not infinity
    return log(sizes[0] / sizes[1], 2)

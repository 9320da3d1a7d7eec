"""Approximate relations between integrals: true at the start, and kept by the motion.

Where a text integrates φ̈ ≈ 2 ω₃ ε̇ to φ̇ ≈ 2 ω₃ ε, it takes the constant of integration as zero.
That is true of motions that start where the relation is true, and of no others.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from polhode.algebra import ZERO, Expr, SymbolKind, as_symbol, time
from polhode.base import NumericError
from polhode.claims._verdict import Answer, Verdict
from polhode.claims.contexts._limit import with_small_others
from polhode.claims.contexts._remainder import (
    SMALLNESS,
    Remainder,
    images_of,
    large_symbols,
    scaled,
)
from polhode.claims.meaning._relations import ScalarRelation
from polhode.claims.states._bound_claim import EQUALITY, BoundClaim
from polhode.claims.states._claim_domain import TrueMotion


def judged_from_start(claim: BoundClaim, at_start: BoundClaim) -> Verdict | None:
    """The verdict on equations along the motion from a start close to a limit; None if undecided.

    A relation holds to an order if it does so at the start, if its rate vanishes to that order on
    all motions close to the limit, and if what is small there stays small.

    Args:
        claim: with its small quantities, and without the start among its restrictions.
        at_start: the same, restricted to the start.
    """
    if not claim.small or not _is_equation(claim):
        return None
    claim, at_start = with_small_others(claim), with_small_others(at_start)
    try:
        first = list(_remainders(at_start, at_start.components()))
        rates = list(_rates(claim))
        if not (_is_near(at_start) and _stays_small(claim)) or any(map(_objects, (*first, *rates))):
            return None
        orders = [order for remainder in (*first, *rates) for order in remainder.orders]
    except (NumericError, ArithmeticError):
        return None
    if not orders:
        return Verdict(Answer.HOLDS, "launch", reason="true at the start, and kept by the motion")
    reason = (
        f"true up to order {min(orders) - 1} at the start, and its rate is zero up to that order, "
        "so that the motion keeps it"
    )
    return Verdict(Answer.APPROXIMATE, "launch", reason=reason, order=min(orders) - 1)


def lacks_only_a_constant(claim: BoundClaim) -> bool:
    """Whether the rates of both sides agree to the order of a claim that itself fails.

    Both sides have to agree in the limit, so that a constant of integration may be small, and to
    differ by what contains a coordinate: a product of constant speeds is not such a constant.
    """
    if not claim.small or not _is_equation(claim):
        return False
    claim = with_small_others(claim)
    try:
        whole = list(_remainders(claim, claim.components()))
        wrong = [remainder for remainder in whole if _objects(remainder)]
        return (
            bool(wrong)
            and all(min(remainder.orders) > 0 for remainder in wrong)
            and all(_contains_a_coordinate(remainder) for remainder in wrong)
            and _stays_small(claim)
            and not any(map(_objects, _rates(claim)))
        )
    except (NumericError, ArithmeticError):
        return False


def is_solution(claim: BoundClaim) -> bool | None:
    """Whether a claim q = f(t) about the only coordinate gives the motion from its start.

    Then f meets the equation of motion, and f(0) and f'(0) are the values at the start. None for
    claims of another form that contain the time.
    """
    component, *others = claim.components()
    q, given, start = component.left.symbol, component.right, claim.initial.values
    if others or q is None or claim.equations.speeds != (q.derivative(),):
        has_time = any(as_symbol(time) in c.difference.symbols() for c in claim.components())
        return None if has_time else False
    rate, at_start = given.dt(), {as_symbol(time): ZERO}
    law = claim.equations.accelerations[q.derivative().derivative()]
    return not (rate.dt() - law.subs({q: given, q.derivative(): rate})) and all(
        value.subs(at_start) == start.get(symbol)
        for symbol, value in ((q, given), (q.derivative(), rate))
    )


def _is_equation(claim: BoundClaim) -> bool:
    signs = {relation.sign for relation in claim.members}
    return len(claim.branches) == 1 and not claim.when and signs <= {*EQUALITY, "≈"}


def _contains_a_coordinate(remainder: Remainder) -> bool:
    """Whether the sides differ, to leading order, by an expression with a coordinate."""
    leading = next(iter(remainder.orders.values()))
    return any(s.kind is SymbolKind.COORDINATE and not s.order for s in leading.symbols())


def _objects(remainder: Remainder) -> bool:
    """Whether the sides differ at an order at which they must not."""
    return any(remainder.objection(order) for order in remainder.orders)


def _remainders(claim: BoundClaim, components: Iterable[ScalarRelation]) -> Iterator[Remainder]:
    positive = (*claim.positive, *map(Expr.generator, large_symbols(claim.small)))
    for component in components:
        yield Remainder(component, claim.states(TrueMotion), positive, claim, {})


def _rates(claim: BoundClaim) -> Iterator[Remainder]:
    """The remainders of the rates of both sides along true motions."""
    states = claim.states(TrueMotion)
    for remainder in _remainders(claim, claim.components()):
        component = remainder.component
        left, right = (states.on(side).dt() for side in (component.left, component.right))
        yield replace(remainder, component=replace(component, left=left, right=right))


def _stays_small(claim: BoundClaim) -> bool:
    """Whether the limit is itself a motion, so that what is small at the start remains so."""
    equations, states = claim.equations, claim.states(TrueMotion)
    state = {*equations.coordinates, *equations.speeds, *equations.kinematics}
    small = [symbol for symbol in images_of(claim.small) if symbol in state]
    rates = (states.on(Expr.generator(symbol.derivative())) for symbol in small)
    return all(_vanishes_in_the_limit(rate, claim) for rate in rates)


def _is_near(at_start: BoundClaim) -> bool:
    """Whether the start is as close to the limit as one likes."""
    states = at_start.states(TrueMotion)
    return all(
        _vanishes_in_the_limit(states.on(small.quantity), at_start) for small in at_start.small
    )


def _vanishes_in_the_limit(expression: Expr, claim: BoundClaim) -> bool:
    at_limit = {SMALLNESS: ZERO}
    return not scaled(expression, claim.small).subs(at_limit)

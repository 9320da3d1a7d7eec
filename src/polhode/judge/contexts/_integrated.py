"""Approximate relations between integrals: true at the start, and kept by the motion.

Where a text integrates φ̈ ≈ 2 ω₃ ε̇ to φ̇ ≈ 2 ω₃ ε, it takes the constant of integration as zero.
That is true of motions that start where the relation is true, and of no others.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from polhode.algebra import ZERO, Expr, SymbolKind, as_symbol, time
from polhode.base import NumericError
from polhode.judge._verdict import Answer, Verdict
from polhode.judge.contexts._limit import with_small_others
from polhode.judge.contexts._remainder import (
    SMALLNESS,
    Remainder,
    images_of,
    large_symbols,
    scaled,
)
from polhode.judge.meaning._mechanics import Mechanics, on_constraints
from polhode.judge.meaning._relations import ScalarRelation
from polhode.judge.states._bound_claim import EQUALITY, BoundClaim
from polhode.judge.states._claim_domain import TrueMotion

_RATES = 3  # of the sides of a formula, compared at the start


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
    differ by what contains a coordinate: a product of constant speeds is not such a constant. The
    left side has to change: a text gets the value of a conserved quantity by no integration.
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
            and all(map(claim.states(TrueMotion).on, (c.left.dt() for c in claim.components())))
            and _stays_small(claim)
            and not any(map(_objects, _rates(claim)))
        )
    except (NumericError, ArithmeticError):
        return False


def is_solution(claim: BoundClaim) -> bool | None:
    """Whether a claim about the course of the motion is true of that from its start.

    It is where both sides are equal at the start, and their rates on any motion: ω = ω₀ + Nt/I. It
    also is if it gives a coordinate as q = f(t) where f meets the only equation of motion, and f(0)
    and f'(0) are the values at the start. None for other claims that contain the time.
    """
    components = list(claim.components())
    if all(as_symbol(time) not in c.difference.symbols() for c in components):
        return False
    found = [_is_kept(claim, c) or _is_course(claim, c) for c in components]
    if all(found):
        return True
    return False if False in found or any(_departs(claim, c) for c in components) else None


def _on_any_motion(claim: BoundClaim) -> TrueMotion:
    """Without the relations by which what is conserved has its value at the start."""
    return replace(claim, relations=()).states(TrueMotion)


def _is_kept(claim: BoundClaim, component: ScalarRelation) -> bool:
    """Whether both sides are equal at the start, and their rates on any motion."""
    states, mechanics = _on_any_motion(claim), Mechanics(claim.equations)
    at_start = claim.initial.at_start(mechanics, component.difference)
    return not at_start and not states.on(component.difference.dt())


def _departs(claim: BoundClaim, component: ScalarRelation) -> bool:
    """Whether both sides, or their first rates, differ at the start."""
    equations, states = claim.equations, _on_any_motion(claim)
    mechanics, rest = Mechanics(equations), component.difference
    if any(equations.dependent.values()):
        return False  # not every start is possible
    for _ in range(_RATES):
        rest = states.on(rest)
        left = claim.initial.at_start(mechanics, rest)
        if any(s.kind.varies for s in left.symbols()):
            return False
        if left:
            return True
        rest = rest.dt()
    return False


def _is_course(claim: BoundClaim, component: ScalarRelation) -> bool | None:
    """Whether q = f(t) is the course of a coordinate from the start; None where none is given."""
    equations, start = claim.equations, claim.initial
    q, given, mechanics = component.left.symbol, component.right, Mechanics(equations)
    if q not in equations.coordinates or len(equations.speeds) != 1:
        return None
    (speed,), rate = equations.speeds, given.dt()
    slope = on_constraints(Expr.generator(q.derivative()), equations).diff(speed)
    if not slope or any(s.kind.varies for s in slope.symbols()):
        return None
    law = equations.accelerations[speed.derivative()].subs({q: given, speed: rate / slope})
    if any(s.kind.varies and s != as_symbol(time) for s in law.symbols()):
        return None
    left_out = (given - Expr.generator(q), rate - Expr.generator(q.derivative()))
    is_met = not any(start.at_start(mechanics, e) for e in left_out)
    return is_met and not (rate.dt() - slope * law)


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

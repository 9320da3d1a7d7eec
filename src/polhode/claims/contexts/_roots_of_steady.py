"""The exact roots that a claim about a rate of steady motion is to be compared with."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import ZERO, Expr, Symbol, sqrt
from polhode.base import PolhodeError
from polhode.claims.meaning._relations import ScalarRelation
from polhode.claims.states._bound_claim import BoundClaim
from polhode.claims.states._steady_states import steady_states


def steady_roots(asked: BoundClaim) -> Iterator[tuple[ScalarRelation, tuple[Expr, ...]]]:
    """Members whose left side is a state variable, with the values it has in steady motion."""
    try:
        families = steady_states(asked)
    except PolhodeError:
        return
    for component in asked.components():
        quantity = component.left.symbol
        for relation in (r for family in families for r in family.settled_relations):
            if quantity is not None and quantity in relation.symbols():
                roots = tuple(_roots(relation.numerator, quantity))
                if roots:
                    yield component, roots
                    break


def _roots(relation: Expr, quantity: Symbol) -> Iterator[Expr]:
    """Both roots of a relation that is at most quadratic, in the form that has no pole."""
    at_zero = {quantity: ZERO}
    slope = relation.diff(quantity)
    a, b, c = slope.diff(quantity) / 2, slope.subs(at_zero), relation.subs(at_zero)
    if quantity in a.symbols():
        return
    if not a:
        yield -c / b
        return
    root = sqrt(b * b - 4 * a * c)
    for sign in (1, -1):
        yield (-b + root * sign) / (2 * a)

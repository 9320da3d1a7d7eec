"""Lagrangians that differ and still are the same: by a constant, or by a total time derivative."""

from __future__ import annotations

from polhode.algebra import Expr
from polhode.claims._dimensions import dimensions_at_odds
from polhode.claims.latex._tree import Name
from polhode.claims.meaning._mechanics import Mechanics
from polhode.claims.meaning._relations import ScalarRelation
from polhode.claims.states._bound_claim import BoundClaim

_LETTERS = ("cal L", "L")


def says_the_same(asked: BoundClaim, component: ScalarRelation) -> bool:
    """Whether a text's Lagrangian has the equations of motion of the model's.

    It has where the variation of the difference vanishes for every coordinate: Landau and
    Lifshitz, Mechanics, § 2.
    """
    printed = asked.members[component.member].printed
    if printed is None or not isinstance(printed.left, Name) or component.label:
        return False
    mechanics = Mechanics(asked.equations)
    if printed.left.letter not in _LETTERS or component.left != mechanics.lagrangian():
        return False
    if dimensions_at_odds(asked.only([component.member])):
        return False
    rest = mechanics.in_rates(component.difference)
    if not any(s.kind.varies for s in rest.symbols()):
        return True
    coordinates = mechanics.declared.coordinates
    rates = {q.derivative() for q in coordinates}
    known = {s for s in rest.symbols() if s.kind.varies} <= {*coordinates, *rates}
    variations = (rest.diff(q.derivative()).dt() - rest.diff(q) for q in coordinates)
    return known and not any(map(bool, variations))


def remark(difference: Expr) -> str:
    """What is said of such a difference."""
    return (
        f"the Lagrangians differ by {difference}, a total time derivative, which no equation of "
        "motion contains"
        if any(s.kind.varies for s in difference.symbols())
        else f"the Lagrangians differ by {difference}, which no equation of motion contains"
    )

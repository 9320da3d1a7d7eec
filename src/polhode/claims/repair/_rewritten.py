"""Whole terms and sums put in the place of wrong ones, found from what is left exactly."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from polhode.algebra import Expr, Vector
from polhode.claims.latex._tree import Negative, Node, Product, Sum
from polhode.claims.repair._edits import Edit
from polhode.claims.repair._places import Place, put, times
from polhode.claims.repair._workpiece import Workpiece
from polhode.claims.repair._written import UNKNOWN_TERM, length, solved, written


def may_be_rewritten(place: Place) -> bool:
    """Whether it is a whole side, a term or a sum."""
    return place.is_term or isinstance(place.node, Sum)


def rewritten(work: Workpiece, place: Place, members: Sequence[int]) -> Iterator[Edit]:
    """What would have to stand at a place, but for its vectors."""
    tail = _tail(work, place.node)
    if tail is None:
        return
    changed = put(work.statement, place.path, times(UNKNOWN_TERM, *tail))
    wanted = solved(work, changed, members)
    if wanted:
        for node in written(work, wanted, tail):
            size = 2.1 + length(node) / 20
            yield Edit("wrong expression", place.path, node, size)


def _tail(work: Workpiece, node: Node) -> list[Node] | None:
    """The vectors that scalars of a term multiply; None where that cannot be said."""
    if isinstance(node, Negative):
        return _tail(work, node.of)
    if isinstance(work.value(node), Expr):
        return []
    vectors = node.factors if isinstance(node, Product) else (node,)
    found = [n for n in vectors if isinstance(work.value(n), Vector)]
    return found if len(found) == 1 and not isinstance(found[0], Sum) else None

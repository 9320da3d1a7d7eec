"""Whole terms and sums put in the place of wrong ones, found from what is left exactly."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from polhode.algebra import Expr, Vector
from polhode.claims.latex._tree import (
    Call,
    Dots,
    Name,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Sum,
    walk,
)
from polhode.claims.repair._edits import Edit
from polhode.claims.repair._places import NodePosition, put, times
from polhode.claims.repair._repair_context import RepairContext
from polhode.claims.repair._written import UNKNOWN_TERM, plainly_written, repeats, solved


def may_be_rewritten(place: NodePosition) -> bool:
    """Whether it is a whole side, a term or a sum; what the claim is about keeps its letter."""
    is_subject = place.is_side and isinstance(_base(place.node), Name | Dots)
    return (place.is_term or isinstance(place.node, Sum)) and not is_subject


def rewritten(work: RepairContext, place: NodePosition, members: Sequence[int]) -> Iterator[Edit]:
    """What would have to stand at a place, but for its vectors."""
    tail = _tail(work, place.node)
    if tail is None:
        return
    changed = put(work.statement, place.path, times(UNKNOWN_TERM, *tail))
    wanted = solved(work, changed, members)
    if wanted:
        for node in plainly_written(work, wanted, tail):
            if not repeats(work, place, node):
                size = 2.1 + _apart(place.node, node) / 20
                yield Edit("wrong expression", place.path, _in_order(node, place.node), size)


def _apart(old: Node, new: Node) -> int:
    """How many letters two expressions do not share."""
    one, other = _letters(old), _letters(new)
    return (one - other).total() + (other - one).total()


def _in_order(node: Node, old: Node) -> Node:
    """A product with its factors in the order in which they stood before, and vectors last."""
    before = [*walk(old)]

    def place(factor: Node) -> int:
        if isinstance(factor, Name) and factor.is_marked_vector:
            return len(before) + 1
        return before.index(_base(factor)) if _base(factor) in before else len(before)

    match node:
        case Negative(of):
            return Negative(_in_order(of, old))
        case Product(factors):
            return Product(tuple(sorted(factors, key=place)))
    return node


def _base(node: Node) -> Node:
    return node.base if isinstance(node, Power) else node


def _letters(node: Node) -> Counter[Node]:
    """The letters and functions of an expression, as often as they are multiplied."""
    match node:
        case Power(base, Number(text)) if text.isdigit():
            return Counter({letter: n * int(text) for letter, n in _letters(base).items()})
        case Call() | Name() | Dots():
            return Counter([node])
    return sum((_letters(part) for part in node.parts if isinstance(part, Node)), Counter())


def _tail(work: RepairContext, node: Node) -> list[Node] | None:
    """The vectors that scalars of a term multiply; None where that cannot be said."""
    if isinstance(node, Negative):
        return _tail(work, node.of)
    if isinstance(work.value(node), Expr):
        return []
    vectors = node.factors if isinstance(node, Product) else (node,)
    found = [n for n in vectors if isinstance(work.value(n), Vector)]
    return found if len(found) == 1 and not isinstance(found[0], Sum) else None

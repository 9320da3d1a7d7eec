"""Terms that a claim has lost, found from what is left of it exactly."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from itertools import islice

import numpy as np

from polhode.algebra import Expr, Vector
from polhode.claims.latex._tree import (
    ComponentList,
    Cross,
    Derivative,
    Dot,
    Dots,
    Name,
    Node,
    Root,
    Sum,
    walk,
)
from polhode.claims.repair._edits import Edit, bases, times_match
from polhode.claims.repair._figures import scalar
from polhode.claims.repair._numeric_evaluator import UNKNOWN
from polhode.claims.repair._places import NodePosition, added, negated, put, times
from polhode.claims.repair._repair_context import RepairContext
from polhode.claims.repair._vector_terms import vector_terms
from polhode.claims.repair._written import UNKNOWN_TERM, length, repeats, solved, written

_MOST_MATCHES = 5


def missing_terms(
    work: RepairContext,
    place: NodePosition,
    members: Sequence[int],
    inner: Collection[NodePosition],
) -> Iterator[Edit]:
    """Terms to be added to a side, or to whatever can be a sum inside it."""
    if not _takes_terms(place, inner):
        return
    deep = 0.05 if isinstance(place.parent, Node) else 0.0
    for term in _terms(work, place, members):
        letters = {piece for piece in walk(term) if isinstance(piece, Node)}
        if any(map(work.is_strange, letters)):  # it would only rewrite what is left over
            continue
        size = 2.0 + deep + length(term) / 20
        yield Edit("missing term", place.path, added(place.node, term), size)


def _takes_away(node: Node, term: Node) -> bool:
    """Whether all that a term does is to put something else in the place of what is there."""
    is_letter = isinstance(node, Name | Dots)
    return negated(node) in (term.terms if isinstance(term, Sum) else (term,)) or (
        is_letter and node in bases(term)
    )


def _terms(work: RepairContext, place: NodePosition, members: Sequence[int]) -> Iterator[Node]:
    def adds(term: Node) -> bool:
        return not _takes_away(place.node, term) and not repeats(work, place, term)

    value = work.value(place.node)
    if isinstance(value, Expr):
        yield from _along(work, place, None, members, adds)
    elif isinstance(value, Vector):
        for direction in work.directions:
            yield from _along(work, place, direction, members, adds)
        yield from filter(adds, vector_terms(work, place, members))


def _along(
    work: RepairContext,
    place: NodePosition,
    direction: Node | None,
    members: Sequence[int],
    adds: Callable[[Node], bool],
) -> Iterator[Node]:
    """Terms along one direction, or scalar ones."""
    tail = [] if direction is None else [direction]
    try:
        unit = (
            scalar(np.ones(work.tried.bench.size))
            if direction is None
            else work.tally.of(direction)
        )
        amount = work.tally.amounts(place, unit, members)[0]
    except UNKNOWN:
        amount = None
    if amount is not None:
        if not np.isfinite(amount).all():
            return
        matches = islice(work.products.equal_to(amount), _MOST_MATCHES)
        found = [t for match in matches if adds(t := times_match(match, *tail))]
        yield from found
        if found:
            return
    lost = _lost(work, place, direction, members)
    if lost is not None:
        yield from filter(adds, written(work, lost, tail))


def _takes_terms(place: NodePosition, inner: Collection[NodePosition]) -> bool:
    """Whether a term may be lost there: of a side, a sum, or where a factor could make it right."""
    inside = isinstance(place.parent, Derivative | Root | ComponentList | Cross | Dot)
    return place.is_side or inside or isinstance(place.node, Sum) or place in inner


def _lost(
    work: RepairContext, place: NodePosition, direction: Node | None, members: Sequence[int]
) -> Expr | None:
    """What is to be added, exactly, on the states of the claim."""
    term = UNKNOWN_TERM if direction is None else times(UNKNOWN_TERM, direction)
    return solved(work, put(work.statement, place.path, added(place.node, term)), members)

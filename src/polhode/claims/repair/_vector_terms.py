"""Whole vectors, their rates and products, that a formula lacks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, islice

import numpy as np

from polhode.claims.latex._tree import Cross, Node
from polhode.claims.repair._edits import times_match
from polhode.claims.repair._figures import Figure, together
from polhode.claims.repair._places import Place
from polhode.claims.repair._products import products
from polhode.claims.repair._tally import UNKNOWN
from polhode.claims.repair._workpiece import Workpiece

_MOST_VECTORS = 40
_MOST_MATCHES = 2


def vector_terms(work: Workpiece, place: Place, members: Sequence[int]) -> Iterator[Node]:
    """Multiples of vectors of the text, and of products of two, that make a formula right."""
    single = work.vectors
    yield from _multiples(work, place, members, single)
    pairs = combinations(list(single.items())[:_MOST_VECTORS], 2)
    crossed: dict[Node, Figure] = {Cross(u, v): one.cross(other) for (u, one), (v, other) in pairs}
    yield from _multiples(work, place, members, crossed)


def _multiples(
    work: Workpiece, place: Place, members: Sequence[int], terms: dict[Node, Figure]
) -> Iterator[Node]:
    if not terms:
        return
    try:
        amounts = work.tally.amounts(place, together(list(terms.values())), members)
    except UNKNOWN:
        return
    for node, amount in zip(terms, amounts, strict=True):
        if np.isfinite(amount).all():
            for match in islice(products(amount, work.known), _MOST_MATCHES):
                yield times_match(match, node)

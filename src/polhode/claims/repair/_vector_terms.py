"""Whole vectors, their rates and products, that a formula lacks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice

import numpy as np

from polhode.claims.latex._tree import Node
from polhode.claims.repair._edits import times_match
from polhode.claims.repair._numeric_evaluator import UNKNOWN
from polhode.claims.repair._places import NodePosition
from polhode.claims.repair._repair_context import RepairContext, StatementTerms

_MOST_MATCHES = 2


def vector_terms(
    work: RepairContext, place: NodePosition, members: Sequence[int]
) -> Iterator[Node]:
    """Multiples of vectors of the text, and of products of two, that make a formula right."""
    yield from _multiples(work, place, members, work.vectors)
    yield from _multiples(work, place, members, work.crossed)


def _multiples(
    work: RepairContext, place: NodePosition, members: Sequence[int], terms: StatementTerms
) -> Iterator[Node]:
    if not len(terms):
        return
    try:
        amounts = work.tally.amounts(place, terms.figures, members)
    except UNKNOWN:
        return
    for i in np.flatnonzero(np.isfinite(amounts).all(axis=1)):
        for match in islice(work.products.equal_to(amounts[i]), _MOST_MATCHES):
            yield times_match(match, terms[int(i)])

"""Whether a statement says anything: by its form alone, whatever its letters stand for."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from polhode.algebra import Vector
from polhode.claims.latex._tree import Cross, Node, Number, Statement, walk
from polhode.claims.repair._figures import Figure, formed, scalar
from polhode.claims.repair._links import Side
from polhode.claims.repair._numeric_evaluator import UNKNOWN
from polhode.claims.repair._places import tidied
from polhode.claims.repair._reading import RepairNotation

_TRIALS = 3
_CLOSE = 1e-9


def is_empty(statement: Statement) -> bool:
    """Whether some member has the same on both sides, or a vector is crossed with itself."""
    sides = (tuple(map(tidied, relation.sides)) for relation in statement.relations)
    same = any(one == other for chain in sides for one, other in pairwise(chain))
    return same or any(isinstance(p, Cross) and p.left == p.right for p in walk(statement))


def says_nothing(statement: Statement, side: Side, reading: RepairNotation) -> bool:
    """Whether a side cancels, or is the same as one beside it, whatever its letters stand for."""
    relation, position = side
    sides = statement.relations[relation].sides
    beside = sides[max(position - 1, 0) : position] + sides[position + 1 : position + 2]
    drawn = _Drawn(reading)
    try:
        own = drawn.of(sides[position])
    except UNKNOWN:
        return False
    return np.abs(own.array).max() < _CLOSE or any(drawn.is_like(own, other) for other in beside)


class _Drawn:
    """Figures of nodes with random ones for letters, rates and whatever cannot be worked out."""

    def __init__(self, reading: RepairNotation) -> None:
        self._reading = reading
        self._random = np.random.default_rng(1)
        self._letters: dict[Node, Figure] = {}

    def of(self, node: Node) -> Figure:
        """The figure of a node."""
        if isinstance(node, Number):
            return scalar(np.full(_TRIALS, float(node.text)))
        inside = [part for part in node.parts if isinstance(part, Node)]
        try:
            return formed(node, [self.of(part) for part in inside])
        except UNKNOWN:
            return self._letter(node)

    def is_like(self, one: Figure, node: Node) -> bool:
        """Whether a node has the same figure."""
        try:
            other = self.of(node)
        except UNKNOWN:
            return False
        return one.rank == other.rank and np.allclose(one.array, other.array, rtol=_CLOSE)

    def _letter(self, node: Node) -> Figure:
        if node not in self._letters:
            rank = 1 if isinstance(self._reading.value(node), Vector) else 0
            shape = (*(3,) * rank, 1, _TRIALS)
            self._letters[node] = Figure(rank, self._random.uniform(0.5, 2.0, shape))
        return self._letters[node]

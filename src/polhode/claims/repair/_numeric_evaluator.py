"""A statement by numbers: what is left of its members when something else stands at a place."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np

from polhode.algebra import Expr, Triad, Vector
from polhode.base import NumericError, PolhodeError
from polhode.claims.latex._tree import Node, Statement
from polhode.claims.meaning._meaning import Side, Tensor
from polhode.claims.meaning._relations import BoundRelation, triad_of
from polhode.claims.repair._figures import Figure, carried, formed, is_arithmetic, scalar, together
from polhode.claims.repair._links import Links
from polhode.claims.repair._places import NodePosition
from polhode.claims.repair._reading import RepairNotation
from polhode.claims.states._bound_claim import BoundClaim
from polhode.claims.states._numeric import Array
from polhode.claims.states._sample_points import SamplePoints

_CLOSE = 1e-7

#: What does not come to a number.
UNKNOWN = (PolhodeError, ArithmeticError, ValueError, KeyError)


class NumericEvaluator:
    """Figures of one statement on the states of a bench.

    Args:
        statement: read.
        asked: the claim it makes.
        links: its members and their sides.
        reading: how it is read.
        bench: the states.
    """

    def __init__(
        self,
        statement: Statement,
        asked: BoundClaim,
        links: Links,
        reading: RepairNotation,
        bench: SamplePoints,
    ) -> None:
        self._statement, self._members, self._links = statement, asked.members, links
        self._reading, self._bench = reading, bench
        self._figures: dict[Node, Figure] = {}
        self._turns: dict[tuple[Triad, Triad], Array] = {}
        triads = (triad_of(r.left, r.right) for r in asked.members)
        self._triad = next((triad for triad in triads if triad is not None), None)

    def of(self, node: Node) -> Figure:
        """The figure of a node by itself; raises one of `UNKNOWN` where it has none."""
        if node not in self._figures:
            self._figures[node] = self._found(node)
        return self._figures[node]

    def _found(self, node: Node) -> Figure:
        """From the figures of its parts where that can be, which is quicker than exactly."""
        if is_arithmetic(node):
            try:
                return formed(node, [self.of(part) for part in node.parts])  # type: ignore[arg-type]
            except UNKNOWN:
                pass
        return self._figure(self._reading.value(node))

    def rows(self, place: NodePosition, new: Figure, members: Sequence[int]) -> Array:
        """What is left of members with another quantity at a place: (rows, trials, states).

        A member of vectors has three rows, along the triad that its residuals are along.
        """
        relation, side, *inside = place.path
        whole = self._statement.relations[relation].sides[side]
        changed = carried(whole, inside, new, self.of)
        left = [self._left(member, (relation, side), changed) for member in members]
        trials = np.broadcast_shapes(*(rows.shape[1:] for rows in left))
        return np.concatenate([np.broadcast_to(r, (len(r), *trials)) for r in left])

    def fitting(
        self, place: NodePosition, others: Sequence[Node], members: Sequence[int]
    ) -> list[Node]:
        """Those of some nodes of one rank that make all members hold when put at a place."""
        if not others:
            return []
        rows = self.rows(place, together([self.of(node) for node in others]), members)
        holds = np.abs(rows).max(axis=(0, 2)) < _CLOSE
        return [node for i, node in enumerate(others) if holds[i]]

    def amounts(self, place: NodePosition, terms: Figure, members: Sequence[int]) -> Array:
        """How much of each of some terms is missing at a place: (terms, states), or not a number.

        Raises `NumericError` where what is left does not change evenly with what is added.
        """
        there, axes = self.of(place.node), _axes(terms.rank)
        tried = [there, *(there + axis for axis in axes), there + axes[0] + axes[0]]
        rest, *steps, twice = np.moveaxis(self.rows(place, together(tried), members), 1, 0)
        slopes = np.array([step - rest for step in steps])
        if not np.allclose(twice - rest, 2 * slopes[0], rtol=_CLOSE, atol=_CLOSE):
            raise NumericError("a change", expected="one in proportion to what is added")
        parts = terms.array.reshape(len(axes), *terms.array.shape[-2:])
        effects = np.einsum("irs,its->trs", slopes, parts)
        with np.errstate(all="ignore"):
            found = -(effects * rest).sum(axis=1) / (effects * effects).sum(axis=1)
        left = np.abs(rest + effects * found[:, None]).max(axis=(1, 2))
        fits = left <= _CLOSE * (1 + np.abs(rest).max())
        return np.where(fits[:, None], found, np.nan)

    def _left(self, member: int, side: tuple[int, int], changed: Figure) -> Array:
        first, second = self._links.sides(member)
        sides = self._statement.relations[first[0]].sides
        one, other = (changed if s == side else self.of(sides[s[1]]) for s in (first, second))
        difference = one + -other
        if difference.rank == 0:
            return difference.array[None]
        relation: BoundRelation = self._members[member]
        triad = triad_of(relation.left, relation.right)
        if difference.rank != 1 or triad is None:
            raise NumericError("a member", expected="two scalars or two vectors")
        turn = self._turn(triad)
        return np.asarray(np.einsum("jis,jbs->ibs", turn, difference.array))

    def _figure(self, value: Side | Tensor) -> Figure:
        match value:
            case Expr():
                return scalar(self._bench.values([value])[0])
            case Vector(components, triad):
                along = self._bench.values(components)
                return Figure(1, np.einsum("ijs,js->is", self._turn(triad), along)[:, None])
            case Tensor(matrix, triad):
                turn = self._turn(triad)
                entries = self._bench.values([e for row in matrix.rows for e in row])
                square = entries.reshape(3, 3, -1)
                return Figure(2, np.einsum("iks,kls,jls->ijs", turn, square, turn)[:, :, None])
        raise NumericError(f"{value}", expected="a scalar, a vector or a tensor")

    def _turn(self, triad: Triad) -> Array:
        """Turns components along a triad into those along that of all figures: (3, 3, states)."""
        if self._triad is None:
            self._triad = triad
        key = triad, self._triad
        if key not in self._turns:
            matrix = triad.rotation_to(self._triad)
            entries = [matrix[i, j] for i, j in product(range(3), range(3))]
            self._turns[key] = self._bench.values(entries).reshape(3, 3, -1)
        return self._turns[key]


def _axes(rank: int) -> list[Figure]:
    """The unit scalar, or unit vectors."""
    size = 3**rank
    shape = (*(3,) * rank, 1, 1)
    return [Figure(rank, np.eye(size)[i].reshape(shape)) for i in range(size)]

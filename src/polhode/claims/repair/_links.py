"""Which members of a claim a place in it is part of."""

from __future__ import annotations

from collections.abc import Collection
from functools import cached_property

from polhode.claims.latex._tree import Cases, Statement, walk
from polhode.claims.repair._places import NodePosition
from polhode.claims.states._bound_claim import BoundClaim

#: Relation of a statement, and number of a side in it.
Side = tuple[int, int]

_LEFT = 0.02  # an author rather errs in what he derives than in what he sets out from


class Links:
    """The members of one statement by the sides they relate.

    Args:
        statement: read.
        asked: the claim it makes.
    """

    def __init__(self, statement: Statement, asked: BoundClaim) -> None:
        self._statement = statement
        self._defined = asked.defined
        self._every = frozenset(range(len(asked.members)))

    @cached_property
    def _pairs(self) -> list[Side]:
        """Relation and left side of every member."""
        claims = ((i, r) for i, r in enumerate(self._statement.relations) if r.is_claim)
        pairs = (
            (i, k, r.sides[0]) for i, r in claims for k, sign in enumerate(r.signs) if sign != "↔"
        )
        return [(i, k) for i, k, first in pairs if k or first not in self._defined]

    @cached_property
    def _is_plain(self) -> bool:
        """Whether there is one member for each sign, and none depends on sides of others."""
        pieces = list(walk(self._statement))
        used = any(pieces.count(letter) > 1 for letter in self._defined)
        cases = any(isinstance(piece, Cases) for piece in pieces)
        return len(self._pairs) == len(self._every) and not used and not cases

    def sides(self, member: int) -> tuple[Side, ...]:
        """Both sides of a member."""
        if member >= len(self._pairs):
            return ()
        relation, left = self._pairs[member]
        return (relation, left), (relation, left + 1)

    def members(self, place: NodePosition) -> frozenset[int]:
        """Those that change with what stands at a place."""
        if not self._is_plain:
            return self._every
        side = place.path[:2]
        return frozenset(m for m in range(len(self._pairs)) if side in self.sides(m))

    def cost(self, place: NodePosition, targets: Collection[int]) -> float | None:
        """What it costs to change this side for these members; None where it is no side of them.

        The later side is the cheaper.
        """
        for member in targets:
            sides = self.sides(member)
            if place.path[:2] in sides:
                return _LEFT if place.path[:2] == sides[0] else 0.0
        return None

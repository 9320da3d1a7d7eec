"""One statement that fails, with all that is known of it while a correction is looked for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from polhode.algebra import Expr, Vector
from polhode.claims._components import Side
from polhode.claims.latex._tree import Node, Statement
from polhode.claims.repair._places import Place, put
from polhode.claims.repair._reading import Reading
from polhode.claims.repair._tally import UNKNOWN, Tally
from polhode.claims.repair._trials import Trials

_CLOSE = 1e-7


@dataclass(frozen=True, eq=False)
class Workpiece:
    """A statement on the bench.

    Attributes:
        statement: read.
        reading: how statements are read.
        tried: where it is to hold, exactly and at states.
        tally: its figures at these states.
    """

    statement: Statement
    reading: Reading
    tried: Trials
    tally: Tally

    def value(self, node: Node) -> Side | None:
        """What a node stands for, if it stands for something."""
        try:
            return self.reading.value(node)
        except UNKNOWN:
            return None

    def vanishes(self, node: Node) -> bool:
        """Whether a vector is zero in these circumstances, so that it can stand for anything."""
        value = self.value(node)
        return isinstance(value, Vector) and not any(map(self.tried.states.on, value.components))

    def fitting(self, place: Place, others: Sequence[Node], members: Sequence[int]) -> list[Node]:
        """Those of some nodes of one rank that make all members hold when put at a place."""
        try:
            return self.tally.fitting(place, others, members)
        except UNKNOWN:
            return [node for node in others if self._fits(place, node, members)]

    def _fits(self, place: Place, node: Node, members: Sequence[int]) -> bool:
        changed = put(self.statement, place.path, node)
        try:
            left = self.left(changed, members, {})
            values = self.tried.bench.values
            return bool(left) and all(np.abs(values([e])).max() < _CLOSE for e in left)
        except UNKNOWN:
            return False

    def left(
        self, changed: Statement, members: Sequence[int], extra: dict[str, Expr]
    ) -> list[Expr]:
        """What must vanish for some members of a changed statement, exactly."""
        return self.tried.left(self.reading.asked(changed, extra), members)

    def might_lack(
        self, place: Place, directions: Sequence[Node | None], members: Sequence[int]
    ) -> Iterator[Node | None]:
        """Directions along which something may be missing at a place, as far as numbers tell."""
        for direction in directions:
            try:
                amount = self.tally.amount(place, direction, members)
            except UNKNOWN:
                yield direction
            else:
                if amount is not None and np.isfinite(amount).all():
                    yield direction

"""Claims to order zero read where what is small has vanished."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from polhode.algebra import Expr
from polhode.claims.contexts._scaling import vanished
from polhode.claims.latex._tree import Node, Statement
from polhode.claims.meaning._meaning import Side
from polhode.claims.repair._reading import RepairNotation
from polhode.claims.states._bound_claim import BoundClaim


@dataclass(frozen=True)
class AtLimit:
    """How statements are read at the limit itself.

    Attributes:
        reading: how they are read near it.
        claim: whose small quantities vanish.
    """

    reading: RepairNotation
    claim: BoundClaim

    def asked(self, statement: Statement, extra: Mapping[str, Expr]) -> BoundClaim:
        """The claim a statement makes there."""
        near = self.reading.asked(statement, extra)
        return replace(near, given={**near.given, **vanished(self.claim.small)}, small=())

    def near(self, there: BoundClaim) -> BoundClaim:
        """The same claim near the limit."""
        return replace(there, given=self.claim.given, small=self.claim.small)

    def value(self, node: Node) -> Side:
        """What one node stands for."""
        return self.reading.value(node)

    @property
    def names(self) -> tuple[Node, ...]:
        """Letters that a correction may use."""
        return self.reading.names

    @property
    def vectors(self) -> tuple[Node, ...]:
        """Letters of vectors that a correction may use."""
        return self.reading.vectors

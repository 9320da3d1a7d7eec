"""What repair needs to know of how a statement is read."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from polhode.algebra import Expr
from polhode.claims.latex._tree import Node, Statement
from polhode.claims.meaning._meaning import Side
from polhode.claims.states._bound_claim import BoundClaim


class RepairNotation(Protocol):
    """What repair needs to know of how a statement is read."""

    def asked(self, statement: Statement, extra: Mapping[str, Expr]) -> BoundClaim:
        """The claim a statement makes; `extra` are further letters it may use."""
        ...

    def value(self, node: Node) -> Side:
        """What one node stands for."""
        ...

    @property
    def names(self) -> tuple[Node, ...]:
        """Letters of the text, with their dots, that a correction may use."""
        ...

    @property
    def vectors(self) -> tuple[Node, ...]:
        """Letters that may stand for vectors, and that a correction may use."""
        ...

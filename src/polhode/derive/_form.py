"""The form of derived expressions: written out in full, or with long parts under names."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol

from polhode.algebra import (
    Elimination,
    Expr,
    Symbol,
    Triad,
    Vector,
    dot,
    eliminate,
    eliminate_in_parts,
    named,
    refuse_long,
)


class Solver(Protocol):
    """Solves linear equations whose right-hand sides stay polynomials in the visible symbols.

    Unknowns of low rank are solved for first; those of high rank are left free.
    """

    def __call__(
        self,
        rows: Sequence[Sequence[Expr]],
        right: Sequence[Expr],
        rank: Sequence[int],
        visible: Iterable[Symbol],
        /,
    ) -> Elimination: ...


@dataclass(frozen=True)
class Form:
    """How long expressions are handled.

    Attributes:
        name: of the form.
        keep: brings an expression to this form; polynomials in the visible symbols stay such.
        refuse_outgrown: raises `OutgrownError` for equations too long for this form.
        eliminate: solves linear equations.
    """

    name: str
    keep: Callable[[Expr, Iterable[Symbol]], Expr]
    refuse_outgrown: Callable[[Iterable[Expr]], None]
    eliminate: Solver

    def express(self, vector: Vector, triad: Triad) -> Vector:
        """A vector resolved along another triad."""
        if triad == vector.triad:
            return vector
        turned = vector.triad.rotation_to(triad).rows
        rows = (tuple(self.keep(entry, ()) for entry in row) for row in turned)
        return Vector(tuple(dot(row, vector.components) for row in rows), triad)

    def kept(self, vector: Vector, visible: Iterable[Symbol] = ()) -> Vector:
        """A vector in this form."""
        symbols = tuple(visible)
        return Vector(tuple(self.keep(c, symbols) for c in vector.components), vector.triad)


CLOSED = Form(
    "closed",
    lambda expression, visible: expression,
    lambda expressions: refuse_long(expressions, "equations of motion"),
    lambda rows, right, rank, visible: eliminate(rows, right, rank),
)
IN_PARTS = Form("in parts", named, lambda expressions: None, eliminate_in_parts)

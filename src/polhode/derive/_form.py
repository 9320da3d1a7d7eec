"""The form of derived expressions: written out in full, or with long parts under names."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from typing import Protocol

from polhode.algebra import (
    Elimination,
    Expr,
    LengthLetter,
    OutgrownError,
    Symbol,
    Triad,
    Vector,
    dot,
    eliminate,
    eliminate_in_parts,
    length,
    lengths_in_parts,
    lengths_written_out,
    named,
    refuse_long,
    with_fewer_terms,
    with_letters,
)

_LONG = 100  # terms, above which lengths are kept under names with everything else


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
    """How long expressions are handled. Forms are compared by their names.

    Attributes:
        name: of the form.
        lengths: brings an expression with lengths that are kept under names to this form.
        directions: the same for the directions of reactions, friction included.
        keep: brings an expression to this form; polynomials in the visible symbols stay such.
        refuse_outgrown: raises `OutgrownError` for equations too long for this form.
        eliminate: solves linear equations.
    """

    name: str
    lengths: Callable[[Expr], Expr] = field(compare=False)
    directions: Callable[[Expr], Expr] = field(compare=False)
    keep: Callable[[Expr, Iterable[Symbol]], Expr] = field(compare=False)
    refuse_outgrown: Callable[[Iterable[Expr]], None] = field(compare=False)
    eliminate: Solver = field(compare=False)

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
        return vector.mapped(lambda component: self.keep(component, symbols))


def _as_it_stands(expression: Expr, visible: Iterable[Symbol] = ()) -> Expr:
    return expression


def _short_lengths_written_out(expression: Expr) -> Expr:
    """With lengths written out where that is short, and else under names."""
    with suppress(OutgrownError):
        written = lengths_written_out(expression)
        if length(written) <= _LONG:
            return written
    return lengths_in_parts(expression)


def _shorter(expression: Expr, visible: Iterable[Symbol]) -> Expr:
    return with_fewer_terms(expression)


def _refuse_outgrown(expressions: Iterable[Expr]) -> None:
    refuse_long(expressions, "equations of motion")


def _eliminate(
    rows: Sequence[Sequence[Expr]],
    right: Sequence[Expr],
    rank: Sequence[int],
    visible: Iterable[Symbol],
) -> Elimination:
    return eliminate(rows, right, rank)


#: Normal forms, in which equality is decided by comparison.
CLOSED = Form(
    "closed",
    lengths_written_out,
    lengths_written_out,
    _as_it_stands,
    _refuse_outgrown,
    _eliminate,
)


def in_lengths(letters: Mapping[str, LengthLetter]) -> Form:
    """The same with distances and slip speeds under names, as they are printed and computed.

    Args:
        letters: of the lengths, by the keys of what they stand for.
    """
    lettered = partial(with_letters, letters=letters)
    return Form("in lengths", lettered, lettered, _shorter, _refuse_outgrown, _eliminate)


#: To compare with: whatever the letters, it is one form.
IN_LENGTHS = in_lengths({})


IN_PARTS = Form(
    "in parts",
    lengths_in_parts,
    _short_lengths_written_out,
    named,
    lambda expressions: None,
    eliminate_in_parts,
)

"""A relation between scalars or vectors taken apart into scalar components."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from polhode.algebra import ZERO, Expr, Triad, Vector, zero_vector
from polhode.base import ParseError
from polhode.model import Frame

if TYPE_CHECKING:
    from polhode.claims.meaning._printed_terms import PrintedRelation

Side = Expr | Vector


class Member(Protocol):
    """One member of a claim: a left side, a sign such as "=", and a right side."""

    @property
    def left(self) -> Side:
        """The left side."""
        ...

    @property
    def sign(self) -> str:
        """The sign between them."""
        ...

    @property
    def right(self) -> Side:
        """The right side."""
        ...

    @property
    def is_alternative(self) -> bool:
        """Whether it is a further value after an "or"."""
        ...

    @property
    def printed(self) -> PrintedRelation | None:
        """Its two sides as they stand in print."""
        ...


@dataclass(frozen=True)
class ScalarRelation:
    """One scalar relation of a claim.

    Attributes:
        member: which link of a chain or row of a block, counted from 0.
        label: direction of a vector relation; empty for a scalar.
    """

    member: int
    label: str
    left: Expr
    right: Expr

    @property
    def difference(self) -> Expr:
        """Left side less right side."""
        return self.left - self.right


def components(member: int, left: Side, right: Side) -> tuple[ScalarRelation, ...]:
    """The scalar relations that a relation stands for.

    Raises `ParseError` for a scalar set against a vector; the number 0 may stand for a vector.
    """
    match left, right:
        case Expr(), Expr():
            return (ScalarRelation(member, "", left, right),)
        case Vector(), Vector():
            return tuple(_along(member, left, right))
        case Vector(), Expr() if not right:
            return tuple(_along(member, left, zero_vector(left.triad)))
        case Expr(), Vector() if not left:
            return tuple(_along(member, zero_vector(right.triad), right))
    raise ParseError(
        f"a {_sort(left)} set against a {_sort(right)}",
        expected="two scalars or two vectors",
        advice="look for a lost hat, arrow or dot product",
    )


def triad_of(left: Side, right: Side) -> Triad | None:
    """The directions along which a relation between vectors is taken apart; none for scalars."""
    vectors = [side for side in (left, right) if isinstance(side, Vector)]
    return next((v.triad for v in vectors if not v.is_zero), vectors[-1].triad if vectors else None)


def _along(member: int, left: Vector, right: Vector) -> Iterator[ScalarRelation]:
    triad = (right if left.is_zero else left).triad
    labels = triad.labels if isinstance(triad, Frame) else ("1", "2", "3")
    sides = left.express(triad).components, right.express(triad).components
    for label, one, other in zip(labels, *sides, strict=True):
        yield ScalarRelation(member, label, one, other)


def _sort(side: Side) -> str:
    return "vector" if isinstance(side, Vector) else "scalar"


def zero_like(side: Side) -> Side:
    """The zero that goes with a scalar or a vector."""
    return zero_vector(side.triad) if isinstance(side, Vector) else ZERO

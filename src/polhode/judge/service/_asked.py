"""The quantity that an answer is to give, and what a relation says it is equal to."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import reduce

from polhode.base import ParseError
from polhode.judge.latex import Piece, read_latex, write_latex
from polhode.judge.latex._tree import (
    Derivative,
    Dot,
    Name,
    Negative,
    Node,
    Product,
    Quotient,
    Relation,
    Sum,
    mapped,
)

_TIME = Name("t")


@dataclass(frozen=True)
class Asked:
    """A quantity that an answer is to give, and the sign that is to stand behind it.

    Attributes:
        node: the quantity.
        sign: as printed.
    """

    node: Node
    sign: str = "="

    @classmethod
    def read(cls, latex: str) -> Asked:
        """From a quantity, or from a relation on the left of which it stands.

        Raises:
            ParseError: for what cannot be read.
        """
        try:
            relation = read_latex(latex).relations[0]
        except ParseError as error:
            raise ParseError(
                f"what is asked for, {latex}, cannot be read: {error.given}",
                expected=error.expected,
            ) from error
        return cls(relation.sides[0], *relation.signs[:1])

    @property
    def quantity(self) -> str:
        """Its LaTeX."""
        return write_latex(self.node)

    def set_equal_to(self, relation: Relation) -> tuple[Node, ...]:
        """What a relation sets the quantity equal to; nothing that has the quantity in it."""
        if set(relation.signs) != {self.sign} or not any(map(self._is_asked, relation.sides)):
            return ()
        return tuple(side for side in relation.sides if not self.is_in(side))

    def solved_from(self, relation: Relation) -> Iterator[Node]:
        """Values that follow from an equation by moving terms and factors."""
        if set(relation.signs) != {"="} or self.sign != "=":
            return
        sides = [_with_factors_in_front(side) for side in relation.sides]
        for side in filter(self.is_in, sides):
            others = [other for other in sides if not self.is_in(other)]
            if others and not self._is_asked(side):
                value = self._solved(side, others[-1])
                yield from () if value is None else (value,)

    def _solved(self, side: Node, value: Node) -> Node | None:
        """What the quantity is if a side in which it occurs once has a value."""
        if self._is_asked(side):
            return value
        match side:
            case Negative(of):
                return self._solved(of, Negative(value))
            case Sum(terms) if one := self._only(terms):
                rest = [term for term in terms if term is not one]
                return self._solved(one, Sum((value, *map(Negative, rest))))
            case Product(factors) if one := self._only(factors):
                rest = [factor for factor in factors if factor is not one]
                return self._solved(one, reduce(Quotient, rest, value))
            case Quotient(above, below) if not self.is_in(below):
                return self._solved(above, Product((value, below)))
            case Quotient(above, below) if not self.is_in(above):
                return self._solved(below, Quotient(above, value))
        return None

    def _only(self, nodes: tuple[Node, ...]) -> Node | None:
        found = [node for node in nodes if self.is_in(node)]
        return found[0] if len(found) == 1 else None

    def _is_asked(self, node: Piece) -> bool:
        return node == self.node or write_latex(node) == self.quantity

    def is_in(self, node: Piece) -> bool:
        """Whether the quantity occurs in a formula."""
        return self._is_asked(node) or any(map(self.is_in, node.parts))


def _with_factors_in_front(node: Node) -> Node:
    """With 2(F·ŷ) for 2F·ŷ, which is read as (2F)·ŷ."""
    inside = mapped(node, _with_factors_in_front)
    if isinstance(inside, Dot) and isinstance(inside.left, Product):
        *front, vector = inside.left.factors
        return Product((*front, Dot(vector, inside.right)))
    return inside


def letters_in(node: Piece) -> frozenset[str]:
    """The letters in a quantity as LaTeX, without dots; numbers are none, nor is the t of d/dt."""
    if isinstance(node, Derivative) and node.by == _TIME:
        return letters_in(node.of)
    if node.parts:
        return frozenset().union(*map(letters_in, node.parts))
    letter = write_latex(node)
    is_letter = letter and not letter[0].isdigit() and letter != r"\pi"
    return frozenset({letter}) if is_letter else frozenset()

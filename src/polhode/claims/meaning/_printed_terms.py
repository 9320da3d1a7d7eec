"""The terms that a relation prints, and what each of them contributes to it.

A term contributes what its side changes by, to first order, when the term is stretched by a small
factor: of √(1 - 4x) the term 4x contributes -2x/√(1 - 4x), however small x itself is.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from polhode.algebra import ZERO, Expr, Symbol, Vector
from polhode.claims.latex import _tree as tree
from polhode.claims.latex._tree import Node
from polhode.claims.meaning._components import Side
from polhode.claims.meaning._evaluate import TIME, Evaluator
from polhode.claims.meaning._meaning import BindingError, Meaning, Tensor

_STRETCH = Symbol("stretch")
_LETTER = tree.Name("stretch", "of a term")
_STRETCHED = tree.Sum((tree.Number("1"), _LETTER))


@dataclass(frozen=True)
class Term:
    """One printed term.

    Attributes:
        contribution: to its side; a vector where that is one.
        own: for a term under a function such as sin, its value.
        among: the whole argument that it stands in; a term as large as that is no correction.
    """

    contribution: Side
    own: Expr = ZERO
    among: Expr = ZERO


@dataclass(frozen=True, eq=False)
class PrintedRelation:
    """A relation as it is printed.

    Attributes:
        evaluator: gives its nodes their meaning.
        left: what stands left of the sign.
        right: what stands right of it.
        is_first: whether it is the first of its chain; the left side of a later one was the right
            side of one before.
    """

    evaluator: Evaluator
    left: Node
    right: Node
    is_first: bool = True

    def terms(self, node: Node) -> tuple[Term, ...]:
        """The terms of one of the sides.

        Raises `BindingError` for a side whose terms cannot be told.
        """
        letter: dict[Node, Meaning] = {_LETTER: Expr.generator(_STRETCH)}
        vocabulary = self.evaluator.vocabulary.saying(letter)
        return tuple(_terms(node, replace(self.evaluator, vocabulary=vocabulary)))

    def factors(self, node: Node) -> tuple[tuple[Node, Meaning], ...]:
        """The factors of one of the sides with their values; a sum is its own."""
        return tuple((f, self.evaluator.value(f)) for f in _factors(node))


def changing(printed: PrintedRelation) -> PrintedRelation:
    """The relation that "x = constant" stands for: the rate of x and zero."""
    rate = tree.Derivative(printed.left, TIME)
    return replace(printed, left=rate, right=tree.Number("0"))


def _factors(node: Node) -> Iterator[Node]:
    match node:
        case tree.Negative(of) | tree.PlusMinus(of, _):
            yield from _factors(of)
        case tree.Product(factors):
            for factor in factors:
                yield from _factors(factor)
        case tree.Quotient(above, _):
            yield from _factors(above)
        case _:
            yield node


def _terms(node: Node, evaluator: Evaluator) -> Iterator[Term]:
    for leaf, argument in _leaves(node):
        contribution = _contribution(node, leaf, evaluator)
        if argument is None:
            yield Term(contribution)
        else:
            yield Term(contribution, evaluator.scalar(leaf), evaluator.scalar(argument))


def _leaves(node: Node, argument: Node | None = None) -> Iterator[tuple[Node, Node | None]]:
    """Terms that hold no sum, and the argument of a function that they stand in."""
    inner = list(_sums(node, argument))
    if not isinstance(node, tree.Sum) and (not inner or any(around for _, around in inner)):
        yield node, argument
    for each, around in inner:
        for term in each.terms:
            yield from _leaves(term, around)


def _sums(piece: tree.Piece, argument: Node | None) -> Iterator[tuple[tree.Sum, Node | None]]:
    """The outermost sums in a piece, each with the argument of a function that it stands in."""
    if isinstance(piece, tree.Sum):
        yield piece, argument
    elif isinstance(piece, tree.Call):
        yield from _sums(piece.argument, piece.argument)
    elif not isinstance(piece, tree.At | tree.Integral | tree.Evaluated):
        for part in piece.parts:
            yield from _sums(part, argument)


def _contribution(node: Node, leaf: Node, evaluator: Evaluator) -> Side:
    def change(piece: tree.Piece) -> tree.Piece:
        if piece is leaf:
            return tree.Product((_STRETCHED, leaf))
        return tree.mapped(piece, change)

    found = evaluator.value(change(node))  # type: ignore[arg-type]
    if isinstance(found, Tensor):
        raise BindingError("a tensor on one side", expected="a scalar or a vector")
    if isinstance(found, Vector):
        return Vector(tuple(map(_slope, found.components)), found.triad)
    return _slope(found)


def _slope(value: Expr) -> Expr:
    return value.diff(_STRETCH).subs({_STRETCH: ZERO})

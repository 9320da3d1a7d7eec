"""Relations of a claim: as bound, by scalar components, and with their printed terms.

The contribution of a term is the first-order change of its side when the term is multiplied by
1 + s: in √(1 - 4x) the term 4x contributes -2x/√(1 - 4x), however small x itself is.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from polhode.algebra import ZERO, Expr, Symbol, Triad, Vector, zero_vector
from polhode.base import ParseError
from polhode.judge.latex import _tree as tree
from polhode.judge.latex._tree import Node, Span
from polhode.judge.meaning._evaluate import TIME, Evaluator
from polhode.judge.meaning._meaning import (
    IMAGINARY,
    BindingError,
    Meaning,
    Side,
    Tensor,
    complex_parts,
    sort,
)
from polhode.model import Frame

_STRETCH = Symbol("stretch")
_LETTER = tree.Name("stretch", "of a term")
_STRETCHED = tree.Sum((tree.Number("1"), _LETTER))


@dataclass(frozen=True)
class BoundRelation:
    """One member of a claim.

    Attributes:
        left: what stands left of the sign.
        sign: one of = ≡ ≈ ≠ < > ≤ ≥ ≪ ≫ ∝.
        right: what stands right of it.
        span: first and one past the last character of the member in its LaTeX.
        is_alternative: whether it is a further value after an "or".
        left_out: orders of the terms that it leaves out, where it states them: x³ of O(x³).
        is_lasting: whether it says that a quantity is constant, whose rate is then on its left.
        printed: its two sides as they stand; None for a relation that is not printed.
    """

    left: Side
    sign: str
    right: Side
    span: Span = (0, 0)
    is_alternative: bool = False
    left_out: tuple[Expr, ...] = ()
    is_lasting: bool = False
    printed: PrintedRelation | None = field(default=None, compare=False, repr=False)


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
        """Left side minus right side."""
        return self.left - self.right


def components(member: int, left: Side, right: Side) -> tuple[ScalarRelation, ...]:
    """The scalar relations that a relation stands for.

    Raises `ParseError` for a scalar set against a vector; the number 0 may stand for a vector.
    """
    match left, right:
        case Expr(), Expr() if IMAGINARY in left.symbols() | right.symbols():
            pairs = zip(
                ("real", "imaginary"), complex_parts(left), complex_parts(right), strict=True
            )
            return tuple(ScalarRelation(member, f"{part} part", *sides) for part, *sides in pairs)
        case Expr(), Expr():
            return (ScalarRelation(member, "", left, right),)
        case Vector(), Vector():
            return tuple(_along(member, left, right))
        case Vector(), Expr() if not right:
            return tuple(_along(member, left, zero_vector(left.triad)))
        case Expr(), Vector() if not left:
            return tuple(_along(member, zero_vector(right.triad), right))
    raise ParseError(
        f"a {sort(left)} set against a {sort(right)}",
        expected="two scalars or two vectors",
        advice="look for a lost hat, arrow or dot product",
    )


def triad_of(left: Side, right: Side) -> Triad | None:
    """The directions along which a relation between vectors is resolved; None for scalars."""
    vectors = [side for side in (left, right) if isinstance(side, Vector)]
    return next((v.triad for v in vectors if not v.is_zero), vectors[-1].triad if vectors else None)


def _along(member: int, left: Vector, right: Vector) -> Iterator[ScalarRelation]:
    triad = (right if left.is_zero else left).triad
    labels = triad.labels if isinstance(triad, Frame) else ("1", "2", "3")
    sides = left.express(triad).components, right.express(triad).components
    for label, one, other in zip(labels, *sides, strict=True):
        yield ScalarRelation(member, label, one, other)


@dataclass(frozen=True)
class Term:
    """One printed term.

    Attributes:
        contribution: to its side; a vector where that is one.
        own: for a term under a function such as sin, its value.
        among: the whole argument that it stands in; a term of that size is not a correction to it.
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

        Raises `BindingError` for a side whose terms cannot be evaluated.
        """
        letter: dict[Node, Meaning] = {_LETTER: Expr.generator(_STRETCH)}
        vocabulary = self.evaluator.vocabulary.stating(letter)
        evaluator = replace(self.evaluator, vocabulary=vocabulary)
        found: list[Term] = []
        for leaf, argument in _leaves(node):
            contribution = _contribution(node, leaf, evaluator)
            if argument is None:
                found.append(Term(contribution))
            else:
                own, among = evaluator.scalar(leaf), evaluator.scalar(argument)
                found.append(Term(contribution, own, among))
        return tuple(found)

    def factors(self, node: Node) -> tuple[tuple[Node, Meaning], ...]:
        """The factors of one of the sides with their values; a sum is a single factor."""
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
    """The first-order change of a side as one of its terms is multiplied by 1 + s."""
    stretched = tree.replaced(node, leaf, tree.Product((_STRETCHED, leaf)))
    found = evaluator.value(stretched)
    if isinstance(found, Tensor):
        raise BindingError("a tensor on one side", expected="a scalar or a vector")
    if isinstance(found, Vector):
        return Vector(tuple(map(_slope, found.components)), found.triad)
    return _slope(found)


def _slope(value: Expr) -> Expr:
    return value.diff(_STRETCH).subs({_STRETCH: ZERO})

"""Places in a formula, the members they belong to, and the formula with a change there."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import count

from polhode.judge.latex._tree import (
    Call,
    Cases,
    Derivative,
    Dots,
    Name,
    Negative,
    Node,
    Number,
    Piece,
    PieceT,
    PlusMinus,
    Power,
    PrintedMatrix,
    Product,
    Quotient,
    Statement,
    Sum,
    Summation,
    mapped,
    walk,
)
from polhode.judge.states._bound_claim import BoundClaim

ONE = Number("1")
ZERO = Number("0")

#: Relation of a statement, and number of a side in it.
Side = tuple[int, int]

# Where factors of a kind stand in a product.
_RANKS: dict[type[Node], int] = {Number: 0, Name: 1, Dots: 2, Call: 3}

_LEFT = 0.02  # extra size of changing the left side: slips are likelier in the result on the right


@dataclass(frozen=True)
class NodePosition:
    """Where a node stands in a statement.

    Attributes:
        path: which of the pieces directly inside, level by level.
        node: what stands there.
        parent: what it is directly inside of.
    """

    path: tuple[int, ...]
    node: Node
    parent: Piece

    @property
    def relation(self) -> int:
        """Which relation of the statement it is in."""
        return self.path[0]

    @property
    def is_side(self) -> bool:
        """Whether it is a whole side."""
        return not isinstance(self.parent, Node)

    @property
    def is_term(self) -> bool:
        """Whether it is one term of a sum or a whole side, with its sign."""
        return self.is_side or isinstance(self.parent, Sum)

    @property
    def is_subject(self) -> bool:
        """Whether it is a left side of one quantity, which the claim is about: θ̈, dL/dt, T."""
        kinds = Sum | Product | Quotient | Negative | PlusMinus | Number
        return self.is_side and not self.path[-1] and not isinstance(self.node, kinds)

    @property
    def is_exponent(self) -> bool:
        """Whether it is the exponent of a power."""
        return isinstance(self.parent, Power) and self.path[-1] == 1

    @property
    def is_variable(self) -> bool:
        """Whether a partial derivative is taken with respect to it."""
        return isinstance(self.parent, Derivative) and self.parent.partial and self.path[-1] == 1


def places(statement: Statement) -> Iterator[NodePosition]:
    """Every node of the relations of a statement, outermost first."""
    for i, relation in enumerate(statement.relations):
        yield from _below(relation, (i,))


def _below(piece: Piece, path: tuple[int, ...]) -> Iterator[NodePosition]:
    for i, part in enumerate(piece.parts):
        here = (*path, i)
        if isinstance(piece, Summation) and i:
            return  # its index and range, which are no quantities
        if isinstance(part, Node) and not isinstance(piece, PrintedMatrix):  # rows stay rows
            yield NodePosition(here, part, piece)
        yield from _below(part, here)


def put(piece: PieceT, path: tuple[int, ...], node: Node) -> PieceT:
    """A piece with another node at a place in it, which keeps the span of what stood there."""
    return mapped(piece, _changer(path, node))


def _changer(path: tuple[int, ...], node: Node) -> Callable[[Piece], Piece]:
    """A function for `mapped`, which calls it part by part in order, to change one at a path."""
    position = count()

    def change(part: Piece) -> Piece:
        if next(position) != path[0]:
            return part
        if len(path) == 1:
            return replace(node, span=part.span)
        return mapped(part, _changer(path[1:], node))

    return change


# -- small algebra on nodes, as an author would write it -----------------------------------------


def negated(node: Node) -> Node:
    """The node with its sign changed."""
    match node:
        case Negative(of):
            return of
        case PlusMinus(of, sign):
            return PlusMinus(of, "∓" if sign == "±" else "±")
    return Negative(node)


def times(*nodes: Node) -> Node:
    """The product of some nodes, flattened and without factors of one."""
    flat: list[Node] = []
    for node in nodes:
        flat += node.factors if isinstance(node, Product) else [node]
    kept = [node for node in flat if node != ONE]
    if not kept:
        return ONE
    return kept[0] if len(kept) == 1 else Product(tuple(kept))


def tidied(piece: Piece) -> Piece:
    """The piece without factors of one, zero terms, and sums and products of a single part."""
    piece = mapped(piece, tidied)
    match piece:
        case Product(factors):
            return times(*factors)
        case Quotient(above, below):
            return over(above, below)
        case Negative(of) if of == ZERO:
            return ZERO
        case Power(base, exponent) if exponent == ONE:
            return base
        case Sum(terms):
            kept = tuple(term for term in terms if term != ZERO)
            return (*kept, ZERO)[0] if len(kept) < 2 else Sum(kept)
    return piece


def over(above: Node, below: Node) -> Node:
    """A quotient; the numerator alone over one, and a fraction of fractions of numbers in one."""
    if below == ONE:
        return above
    if isinstance(above, Quotient) or isinstance(below, Quotient):
        one, other = number_value(above), number_value(below)
        if one is not None and other:
            value = one / other
            top = Number(str(value.numerator))
            return top if value.denominator == 1 else Quotient(top, Number(str(value.denominator)))
    return Quotient(above, below)


def number_value(node: Piece) -> Fraction | None:
    """The value of a whole number, or of a fraction of two; None for anything else."""
    match node:
        case Number(text) if text.isdigit():
            return Fraction(int(text))
        case Quotient(Number(above), Number(below)) if above.isdigit() and below.isdigit():
            return Fraction(int(above), int(below)) if int(below) else None
    return None


def with_factor(node: Node, factor: Node, power: int) -> Node:
    """A term with one more power of a factor, above or below its fraction line.

    An author raises a power that is there already, and puts letters before functions.
    """
    match node:
        case Negative(of):
            return Negative(with_factor(of, factor, power))
        case PlusMinus(of, sign):
            return PlusMinus(with_factor(of, factor, power), sign)
        case Quotient(above, below):
            # Above, unless it is to cancel a factor below, and the reverse.
            if _has(below, factor) if power > 0 else not _has(above, factor):
                return over(above, with_factor(below, factor, -power))
            return over(with_factor(above, factor, power), below)
    changed = _repowered(node, factor, power)
    if changed is not None:
        return changed
    if power < 0 and isinstance(node, Product):
        fractions = [i for i, f in enumerate(node.factors) if isinstance(f, Quotient)]
        if fractions:  # the last one
            i = fractions[-1]
            lowered = with_factor(node.factors[i], factor, power)
            return times(*node.factors[:i], lowered, *node.factors[i + 1 :])
    if power < 0:
        return over(node, raised(factor, -power))
    return _beside(node, raised(factor, power))


def _has(node: Node, factor: Node) -> bool:
    return _repowered(node, factor, 1) is not None


def _repowered(node: Node, factor: Node, power: int) -> Node | None:
    """A product in which a factor has its power raised; None where it does not stand."""
    factors = node.factors if isinstance(node, Product) else (node,)
    for i, each in enumerate(factors):
        match each:
            case Power(base, Number(text)) if base == factor and text.isdigit():
                exponent = int(text)
            case _ if each == factor:
                exponent = 1
            case _:
                continue
        if exponent + power < 0:
            return None
        return times(*factors[:i], raised(factor, exponent + power), *factors[i + 1 :])
    return None


def _beside(node: Node, factor: Node) -> Node:
    """A product with one more factor: numbers first, then letters, functions, and brackets last."""
    factors = node.factors if isinstance(node, Product) else (node,)
    least = 1 if isinstance(factor, Name) else _rank(factor) + 1
    first = next((i for i, each in enumerate(factors) if _rank(each) >= least), len(factors))
    return times(*factors[:first], factor, *factors[first:])


def _rank(factor: Node) -> int:
    match factor:
        case Quotient(Number(), Number()):
            return 0
        case Power(base, _):
            return _rank(base)
        case Name() if factor.is_marked_vector:
            return 5
    return _RANKS.get(type(factor), 4)


def raised(base: Node, exponent: int) -> Node:
    """A whole power."""
    if exponent == 0:
        return ONE
    return base if exponent == 1 else Power(base, Number(str(exponent)))


def in_order(*factors: Node) -> Node:
    """A product with numbers before letters, then dotted letters, functions, and the rest."""
    product = times(*factors)
    if not isinstance(product, Product):
        return product
    return Product(tuple(sorted(product.factors, key=_rank)))


def added(node: Node, term: Node) -> Node:
    """A sum with one more term."""
    terms = node.terms if isinstance(node, Sum) else (node,)
    return term if terms == (ZERO,) else Sum((*terms, term))


# -- sides and members ----------------------------------------------------------------------------


class MemberSides:
    """Which sides of a statement each member of its claim relates, and the reverse.

    Args:
        statement: the statement, as parsed.
        claim: the claim it makes.
    """

    def __init__(self, statement: Statement, claim: BoundClaim) -> None:
        self._statement = statement
        self._defined = claim.defined
        self._every = frozenset(range(len(claim.members)))

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
        """Whether there is one member for each sign, and none depends on the sides of others."""
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
        """The members that depend on what stands at a place."""
        if not self._is_plain:
            return self._every
        side = place.path[:2]
        return frozenset(m for m in range(len(self._pairs)) if side in self.sides(m))

    def cost(self, place: NodePosition, targets: Collection[int]) -> float | None:
        """Extra size of changing this side for these members; None if it is no side of theirs."""
        for member in targets:
            sides = self.sides(member)
            if place.path[:2] in sides:
                return _LEFT if place.path[:2] == sides[0] else 0.0
        return None

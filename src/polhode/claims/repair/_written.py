"""Exact quantities that a formula needs at a place, written in the letters of its text."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import islice

from polhode.algebra import Expr, Symbol, factors
from polhode.algebra import length as terms_of
from polhode.base import PolhodeError
from polhode.claims.latex._tree import (
    Call,
    Cross,
    Derivative,
    Dots,
    Name,
    Negative,
    Node,
    Number,
    Piece,
    Power,
    Quotient,
    Statement,
    Sum,
)
from polhode.claims.repair._edits import number_node
from polhode.claims.repair._places import ZERO, NodePosition, negated, over, raised, times
from polhode.claims.repair._repair_context import RepairContext

_UNKNOWN = Symbol("missing")
_LARGEST_SIZE = 12
_LONGEST_SUM = 4
_MOST = 16
_FACTOR = 4  # how much longer something may be than a short multiple of it

#: Stands in a statement where something is to be found.
UNKNOWN_TERM = Name("missing")


def solved(work: RepairContext, changed: Statement, members: Sequence[int]) -> Expr | None:
    """What the unknown term of a changed statement has to be for some members to hold, exactly."""
    found = None
    try:
        extra = {UNKNOWN_TERM.letter: Expr.generator(_UNKNOWN)}
        for residual in work.left(changed, members, extra):
            settled = work.tried.states.on(residual).numerator
            slope = settled.diff(_UNKNOWN)
            if _UNKNOWN in slope.symbols():
                return None
            rest = settled - slope * Expr.generator(_UNKNOWN)
            if slope and found is None:
                found = -rest / slope
            if settled and (found is None or settled.subs({_UNKNOWN: found})):
                return None
    except (PolhodeError, ArithmeticError):
        return None
    return found


def length(node: Node) -> int:
    """How much a term says: letters with their powers, and how they are put together."""
    match node:
        case Power(base, Number(text)) if text.isdigit():
            return length(base) * int(text)
        case Name(decoration="hat"):
            return 0
        case Number("1"):
            return 0
        case Call() | Name() | Dots() | Number():
            return 1
    rate = isinstance(node, Derivative | Cross)
    nested = 2 * isinstance(node, Sum)
    if isinstance(node, Quotient) and not isinstance(node.below, Number):
        nested = 4
    return rate + nested + sum(length(part) for part in node.parts if isinstance(part, Node))


def written(work: RepairContext, value: Expr, tail: Sequence[Node]) -> Iterator[Node]:
    """A quantity times vectors in the letters of the text, at most one of them of the motion."""
    yield from plainly_written(work, value, tail)
    for node, moved in work.settled.items():
        if moved and moved != work.vocabulary[node] and _are_about_as_long(value, moved):
            yield from plainly_written(work, value / moved, [node, *tail])


def plainly_written(work: RepairContext, value: Expr, tail: Sequence[Node]) -> Iterator[Node]:
    """The same in letters that are free on the states of the claim, if it is that simple."""
    product = _product(value, work.plain)
    if product is not None and len(product[1]) + len(product[2]) < _LARGEST_SIZE:
        number, above, below = product
        term = times(_fraction(abs(number), above, below), *tail)
        yield negated(term) if number < 0 else term


def _product(
    expression: Expr, plain: Mapping[Expr, Node]
) -> tuple[Fraction, list[Node], list[Node]] | None:
    """An expression as a number times letters over letters, if it is that simple."""
    if _is_longer(expression.numerator, _MOST) or _is_longer(expression.denominator, _MOST):
        return None
    number, powers = factors(expression)
    above: list[Node] = []
    below: list[Node] = []
    for factor, power in powers.items():
        node = plain.get(factor)
        if node is None and -factor in plain:
            node, number = plain[-factor], number * (-1) ** (power % 2)
        elif node is None and number < 0 and power % 2 and _subtracts(factor):
            factor, number = -factor, -number
        node = node or _sum(factor, plain)
        if node is None:
            return None
        (above if power > 0 else below).append(raised(node, abs(power)))
    return number, above, below


def _sum(factor: Expr, plain: Mapping[Expr, Node]) -> Node | None:
    """A short sum of products of letters."""
    terms: list[Node] = []
    if _is_longer(factor, _LONGEST_SUM) or not _is_longer(factor, 1):
        return None
    for powers, coefficient in factor.terms():
        nodes = [(plain.get(Expr.generator(g)), power) for g, power in powers.items()]
        if any(node is None for node, _ in nodes):
            return None
        above = [raised(node, power) for node, power in nodes if node is not None]
        term = _fraction(abs(Fraction(coefficient)), above, ())
        terms.append(negated(term) if coefficient < 0 else term)
    if isinstance(terms[0], Negative):
        terms.sort(key=lambda term: isinstance(term, Negative))
    return Sum(tuple(terms))


def _subtracts(polynomial: Expr) -> bool:
    return any(coefficient < 0 for _, coefficient in polynomial.terms())


def _is_longer(polynomial: Expr, most: int) -> bool:
    """Whether it has more than so many terms."""
    return any(islice(polynomial.terms(), most, None))


def _are_about_as_long(one: Expr, other: Expr) -> bool:
    """Whether one may be a short multiple of the other."""
    shorter, longer = sorted((terms_of(one), terms_of(other)))
    return longer <= _FACTOR * shorter


def _fraction(number: Fraction, above: Iterable[Node], below: Iterable[Node]) -> Node:
    top = times(number_node(Fraction(number.numerator)), *above)
    return over(top, times(number_node(Fraction(number.denominator)), *below))


def repeats(work: RepairContext, place: NodePosition, node: Node) -> bool:
    """Whether something new at a place brings in a whole side of the same chain, not a power."""
    sides = work.statement.relations[place.relation].sides
    others = {side for i, side in enumerate(sides) if i != place.path[1]} - {ZERO}
    return _stands_in(node, others)


def _stands_in(piece: Piece, others: Collection[Piece]) -> bool:
    """Whether one of these is the piece or stands in it, other than as the base of a power."""
    inside = (*piece.base.parts, piece.exponent) if isinstance(piece, Power) else piece.parts
    return piece in others or any(_stands_in(part, others) for part in inside)

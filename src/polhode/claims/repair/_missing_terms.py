"""Terms that a claim has lost, found from what is left of it exactly."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import islice

import numpy as np

from polhode.algebra import Expr, Symbol, Vector, factors
from polhode.algebra import length as terms_of
from polhode.base import PolhodeError
from polhode.claims.latex._tree import (
    Call,
    ComponentList,
    Cross,
    Derivative,
    Dot,
    Dots,
    Name,
    Negative,
    Node,
    Number,
    Piece,
    Power,
    Product,
    Quotient,
    Root,
    Statement,
    Sum,
    walk,
)
from polhode.claims.repair._edits import Edit, bases, number_node, times_match
from polhode.claims.repair._numeric_evaluator import UNKNOWN, scalar
from polhode.claims.repair._places import (
    ZERO,
    NodePosition,
    added,
    negated,
    over,
    put,
    raised,
    times,
)
from polhode.claims.repair._repair_context import RepairContext, StatementTerms

# Terms that a claim has lost, found from what is left of it exactly.

_MOST_MATCHES = 5


def missing_terms(
    work: RepairContext,
    place: NodePosition,
    members: Sequence[int],
    inner: Collection[NodePosition],
) -> Iterator[Edit]:
    """Terms to be added to a side, or to whatever can be a sum inside it."""
    if not _takes_terms(place, inner):
        return
    deep = 0.05 if isinstance(place.parent, Node) else 0.0
    for term in _terms(work, place, members):
        letters = {piece for piece in walk(term) if isinstance(piece, Node)}
        if any(map(work.is_strange, letters)):  # it would only rewrite what is left over
            continue
        size = 2.0 + deep + length(term) / 20
        yield Edit("missing term", place.path, added(place.node, term), size)


def _takes_away(node: Node, term: Node) -> bool:
    """Whether all that a term does is to put something else in the place of what is there."""
    is_letter = isinstance(node, Name | Dots)
    return negated(node) in (term.terms if isinstance(term, Sum) else (term,)) or (
        is_letter and node in bases(term)
    )


def _terms(work: RepairContext, place: NodePosition, members: Sequence[int]) -> Iterator[Node]:
    def adds(term: Node) -> bool:
        return not _takes_away(place.node, term) and not repeats(work, place, term)

    value = work.value(place.node)
    if isinstance(value, Expr):
        yield from _along(work, place, None, members, adds)
    elif isinstance(value, Vector):
        for direction in work.directions:
            yield from _along(work, place, direction, members, adds)
        yield from filter(adds, vector_terms(work, place, members))


def _along(
    work: RepairContext,
    place: NodePosition,
    direction: Node | None,
    members: Sequence[int],
    adds: Callable[[Node], bool],
) -> Iterator[Node]:
    """Terms along one direction, or scalar ones."""
    tail = [] if direction is None else [direction]
    try:
        unit = (
            scalar(np.ones(work.tried.bench.size))
            if direction is None
            else work.tally.of(direction)
        )
        amount = work.tally.amounts(place, unit, members)[0]
    except UNKNOWN:
        amount = None
    if amount is not None:
        if not np.isfinite(amount).all():
            return
        matches = islice(work.products.equal_to(amount), _MOST_MATCHES)
        found = [t for match in matches if adds(t := times_match(match, *tail))]
        yield from found
        if found:
            return
    # What is to be added, exactly, on the states of the claim.
    term = UNKNOWN_TERM if direction is None else times(UNKNOWN_TERM, direction)
    lost = solved(work, put(work.statement, place.path, added(place.node, term)), members)
    if lost is not None:
        yield from filter(adds, written(work, lost, tail))


def _takes_terms(place: NodePosition, inner: Collection[NodePosition]) -> bool:
    """Whether a term may be lost there: of a side, a sum, or where a factor could make it right."""
    inside = isinstance(place.parent, Derivative | Root | ComponentList | Cross | Dot)
    return place.is_side or inside or isinstance(place.node, Sum) or place in inner


# Whole vectors, their rates and products, that a formula lacks.

_MOST_MATCHES_of_vector_terms = 2


def vector_terms(
    work: RepairContext, place: NodePosition, members: Sequence[int]
) -> Iterator[Node]:
    """Multiples of vectors of the text, and of products of two, that make a formula right."""
    yield from _multiples(work, place, members, work.vectors)
    yield from _multiples(work, place, members, work.crossed)


def _multiples(
    work: RepairContext, place: NodePosition, members: Sequence[int], terms: StatementTerms
) -> Iterator[Node]:
    if not len(terms):
        return
    try:
        amounts = work.tally.amounts(place, terms.figures, members)
    except UNKNOWN:
        return
    for i in np.flatnonzero(np.isfinite(amounts).all(axis=1)):
        for match in islice(work.products.equal_to(amounts[i]), _MOST_MATCHES_of_vector_terms):
            yield times_match(match, terms[int(i)])


# Whole terms and sums put in the place of wrong ones, found from what is left exactly.


def may_be_rewritten(place: NodePosition) -> bool:
    """Whether it is a whole side, a term or a sum; what the claim is about keeps its letter."""
    is_subject = place.is_side and isinstance(_base(place.node), Name | Dots)
    return (place.is_term or isinstance(place.node, Sum)) and not is_subject


def rewritten(work: RepairContext, place: NodePosition, members: Sequence[int]) -> Iterator[Edit]:
    """What would have to stand at a place, but for its vectors."""
    tail = _tail(work, place.node)
    if tail is None:
        return
    changed = put(work.statement, place.path, times(UNKNOWN_TERM, *tail))
    wanted = solved(work, changed, members)
    if wanted:
        for node in plainly_written(work, wanted, tail):
            if not repeats(work, place, node):
                # How many letters two expressions do not share.
                one, other = _letters(place.node), _letters(node)
                size = 2.1 + ((one - other).total() + (other - one).total()) / 20
                yield Edit("wrong expression", place.path, _in_order(node, place.node), size)


def _in_order(node: Node, old: Node) -> Node:
    """A product with its factors in the order in which they stood before, and vectors last."""
    before = [*walk(old)]

    def place(factor: Node) -> int:
        if isinstance(factor, Name) and factor.is_marked_vector:
            return len(before) + 1
        return before.index(_base(factor)) if _base(factor) in before else len(before)

    match node:
        case Negative(of):
            return Negative(_in_order(of, old))
        case Product(factors):
            return Product(tuple(sorted(factors, key=place)))
    return node


def _base(node: Node) -> Node:
    return node.base if isinstance(node, Power) else node


def _letters(node: Node) -> Counter[Node]:
    """The letters and functions of an expression, as often as they are multiplied."""
    match node:
        case Power(base, Number(text)) if text.isdigit():
            return Counter({letter: n * int(text) for letter, n in _letters(base).items()})
        case Call() | Name() | Dots():
            return Counter([node])
    return sum((_letters(part) for part in node.parts if isinstance(part, Node)), Counter())


def _tail(work: RepairContext, node: Node) -> list[Node] | None:
    """The vectors that scalars of a term multiply; None where that cannot be said."""
    if isinstance(node, Negative):
        return _tail(work, node.of)
    if isinstance(work.value(node), Expr):
        return []
    vectors = node.factors if isinstance(node, Product) else (node,)
    found = [n for n in vectors if isinstance(work.value(n), Vector)]
    return found if len(found) == 1 and not isinstance(found[0], Sum) else None


# Exact quantities that a formula needs at a place, written in the letters of its text.

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
        elif (
            node is None
            and number < 0
            and power % 2
            and any(coefficient < 0 for _, coefficient in factor.terms())
        ):
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

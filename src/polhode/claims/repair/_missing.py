"""Terms that a claim has lost, found from what is left of it exactly."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import islice

import numpy as np

from polhode.algebra import ONE, Expr, Symbol, Vector, factors
from polhode.base import PolhodeError
from polhode.claims.latex._tree import (
    Call,
    Components,
    Cross,
    Derivative,
    Dot,
    Dots,
    Name,
    Node,
    Number,
    Power,
    Root,
    Sum,
)
from polhode.claims.repair._edits import Edit, number_node, times_match
from polhode.claims.repair._figures import scalar
from polhode.claims.repair._places import ONE as ONE_NODE
from polhode.claims.repair._places import Place, added, negated, over, put, raised, times
from polhode.claims.repair._tally import UNKNOWN
from polhode.claims.repair._vector_terms import vector_terms
from polhode.claims.repair._workpiece import Workpiece

_UNKNOWN = Symbol("missing")
_LETTER = "missing"
_LARGEST_SIZE = 12
_LONGEST_SUM = 4
_MOST = 16
_MOST_MATCHES = 5


def missing_terms(
    work: Workpiece, place: Place, members: Sequence[int], inner: Collection[Place]
) -> Iterator[Edit]:
    """Terms to be added to a side, or to whatever can be a sum inside it."""
    if not _takes_terms(place, inner):
        return
    deep = 0.05 if isinstance(place.parent, Node) else 0.0
    for term in _terms(work, place, members):
        size = 2.0 + deep + _length(term) / 20
        yield Edit("missing term", place.path, added(place.node, term), size)


def _terms(work: Workpiece, place: Place, members: Sequence[int]) -> Iterator[Node]:
    value = work.value(place.node)
    if isinstance(value, Expr):
        yield from _along(work, place, None, members)
    elif isinstance(value, Vector):
        for direction in work.directions:
            yield from _along(work, place, direction, members)
        yield from vector_terms(work, place, members)


def _along(
    work: Workpiece, place: Place, direction: Node | None, members: Sequence[int]
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
        found = list(islice(work.products.equal_to(amount), _MOST_MATCHES))
        yield from (times_match(match, *tail) for match in found)
        if found:
            return
    lost = _lost(work, place, direction, members)
    if lost is not None:
        yield from _written(work, lost, tail)


def _length(node: Node) -> int:
    """How many letters a term has, powers counted; directions and signs do not count."""
    match node:
        case Power(base, Number(text)) if text.isdigit():
            return _length(base) * int(text)
        case Name(decoration="hat"):
            return 0
        case Number("1"):
            return 0
        case Call() | Name() | Dots() | Number():
            return 1
    rate = isinstance(node, Derivative | Cross)
    return rate + sum(_length(part) for part in node.parts if isinstance(part, Node))


def _takes_terms(place: Place, inner: Collection[Place]) -> bool:
    """Whether a term may be lost there: of a side, a sum, or where a factor could make it right."""
    whole = not isinstance(place.parent, Node)
    inside = isinstance(place.parent, Derivative | Root | Components | Cross | Dot)
    return whole or inside or isinstance(place.node, Sum) or place in inner


def _lost(
    work: Workpiece, place: Place, direction: Node | None, members: Sequence[int]
) -> Expr | None:
    """What is to be added, exactly, on the states of the claim."""
    letter = Name(_LETTER)
    term = letter if direction is None else times(letter, direction)
    changed = put(work.statement, place.path, added(place.node, term))
    found = None
    try:
        for residual in work.left(changed, members, {_LETTER: Expr.generator(_UNKNOWN)}):
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


def _written(work: Workpiece, lost: Expr, tail: Sequence[Node]) -> Iterator[Node]:
    """A missing term in the letters of the text, with one quantity of the motion at most."""
    settled = work.settled
    plain = {e: n for n in reversed(settled) if (e := work.vocabulary[n]) is not None}
    moving = [(node, v) for node, v in settled.items() if v and v != work.vocabulary[node]]
    for factor, value in [(ONE_NODE, ONE), *moving]:
        product = _product(lost / value, plain)
        if product is not None and len(product[1]) + len(product[2]) < _LARGEST_SIZE:
            number, above, below = product
            term = times(_fraction(abs(number), (*above, factor), below), *tail)
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
    return Sum(tuple(terms))


def _is_longer(polynomial: Expr, most: int) -> bool:
    """Whether it has more than so many terms."""
    return any(islice(polynomial.terms(), most, None))


def _fraction(number: Fraction, above: Iterable[Node], below: Iterable[Node]) -> Node:
    top = times(number_node(Fraction(number.numerator)), *above)
    return over(top, times(number_node(Fraction(number.denominator)), *below))

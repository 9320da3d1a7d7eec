"""Terms that a claim has lost, found from what is left of it exactly."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from fractions import Fraction

import numpy as np

from polhode.algebra import ONE, Expr, Symbol, Vector, factors
from polhode.base import PolhodeError
from polhode.claims.latex._tree import Components, Derivative, Name, Node, Root, Statement, Sum
from polhode.claims.repair._edits import Edit, letters, number_node, relabelled, turned
from polhode.claims.repair._places import Place, added, negated, over, places, put, raised, times
from polhode.claims.repair._reading import Reading
from polhode.claims.repair._trials import Trials

_UNKNOWN = Symbol("missing")
_LETTER = "missing"
_LARGEST_SIZE = 12
_CLOSE = 1e-8
_LONGEST_SUM = 4
_UPRIGHT = Name("z", decoration="hat")


def missing_terms(
    statement: Statement,
    sides: Collection[tuple[int, int]],
    reading: Reading,
    tried: Trials,
    members: Collection[int],
    inner: Collection[Place],
) -> Iterator[Edit]:
    """Terms to be added to one of the sides, or to whatever can be a sum inside it."""
    quantities = _quantities(statement, reading)
    for place in places(statement):
        if place.path[:2] in sides and _takes_terms(place, inner):
            yield from _whole_vectors(statement, place, reading, tried, members)
            for direction in _directions(statement, place, reading):
                lost = _lost(statement, place, direction, reading, tried, members)
                if lost is not None:
                    yield from _written(place, direction, lost, quantities, tried)


def _whole_vectors(
    statement: Statement,
    place: Place,
    reading: Reading,
    tried: Trials,
    members: Collection[int],
) -> Iterator[Edit]:
    """Vectors of the text that make it right when added or taken away."""
    own = dict.fromkeys(n for p in places(statement) for n in letters(p.node))
    bold = [n for n in own if isinstance(n, Name) and n.decoration != "hat"]
    for node in bold:
        for term in (node, negated(node)):
            changed = put(statement, place.path, added(place.node, term))
            try:
                if not isinstance(reading.value(node), Vector):
                    break
                residuals = tried.residuals(reading.asked(changed, {}))
                values = tried.bench.values([e for m, e in residuals if m in members])
            except (PolhodeError, ArithmeticError, KeyError):
                break
            if np.abs(values).max(initial=0.0) < _CLOSE:
                yield Edit("missing term", place.path, added(place.node, term), 2.0)


def _takes_terms(place: Place, inner: Collection[Place]) -> bool:
    """Whether a term may be lost there: of a side, a sum, or where a factor could make it right."""
    whole = not isinstance(place.parent, Node)
    inside = isinstance(place.parent, Derivative | Root | Components)
    return whole or inside or isinstance(place.node, Sum) or place in inner


def _directions(statement: Statement, place: Place, reading: Reading) -> list[Node | None]:
    """The unit vectors a missing term may go along; none for a scalar."""
    try:
        if not isinstance(reading.value(place.node), Vector):
            return [None]
    except (PolhodeError, ArithmeticError):
        return []
    own = [n for p in places(statement) for n in letters(p.node)]
    wide = [*own, *reading.names, _UPRIGHT, *(other for n in own for other in relabelled(n))]
    named = (n for n in wide if isinstance(n, Name) and n.decoration == "hat")
    return list(dict.fromkeys(named))


def _lost(
    statement: Statement,
    place: Place,
    direction: Node | None,
    reading: Reading,
    tried: Trials,
    members: Collection[int],
) -> Expr | None:
    """What is to be added, exactly, on the states of the claim."""
    letter = Name(_LETTER)
    term = letter if direction is None else times(letter, direction)
    try:
        changed = put(statement, place.path, added(place.node, term))
        asked = reading.asked(changed, {_LETTER: Expr.generator(_UNKNOWN)})
        residuals = [e for member, e in tried.residuals(asked) if member in members]
        found = None
        for residual in residuals:
            settled = tried.states.on(residual).numerator
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


Quantities = Mapping[Node, Expr]


def _quantities(statement: Statement, reading: Reading) -> Quantities:
    own = [n for place in places(statement) for n in letters(place.node)]
    other = [t for n in own if (t := turned(n)) is not None]
    known: dict[Node, Expr] = {}
    for node in dict.fromkeys([*own, *other, *reading.names]):
        try:
            value = reading.value(node)
        except (PolhodeError, ArithmeticError):
            continue
        if isinstance(value, Expr) and value:
            known[node] = value
    return known


def _written(
    place: Place, direction: Node | None, lost: Expr, known: Quantities, tried: Trials
) -> Iterator[Edit]:
    """A missing term in the letters of the text, with one quantity of the motion at most."""
    plain = {e: n for n, e in reversed(list(known.items()))}
    moving: list[tuple[Node | None, Expr]] = [(None, ONE)]
    for node, value in known.items():
        settled = tried.states.on(value)
        if settled and settled != value:
            moving.append((node, settled))
    for factor, value in moving:
        product = _product(lost / value, plain)
        if product is None:
            continue
        number, above, below = product
        extra = [factor] if factor is not None else []
        size = len(above) + len(below) + len(extra)
        if size > _LARGEST_SIZE:
            continue
        tail = [direction] if direction is not None else []
        term = times(_fraction(abs(number), (*above, *extra), below), *tail)
        term = negated(term) if number < 0 else term
        yield Edit("missing term", place.path, added(place.node, term), 2.0 + size / 20)
        return


def _product(
    expression: Expr, plain: Mapping[Expr, Node]
) -> tuple[Fraction, list[Node], list[Node]] | None:
    """An expression as a number times letters over letters, if it is that simple."""
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
    terms = []
    for powers, coefficient in factor.terms():
        nodes = [(plain.get(Expr.generator(g)), power) for g, power in powers.items()]
        if any(node is None for node, _ in nodes):
            return None
        above = [raised(node, power) for node, power in nodes if node is not None]
        term = _fraction(abs(Fraction(coefficient)), above, ())
        terms.append(negated(term) if coefficient < 0 else term)
    return Sum(tuple(terms)) if 1 < len(terms) <= _LONGEST_SUM else None


def _fraction(number: Fraction, above: Iterable[Node], below: Iterable[Node]) -> Node:
    top = times(number_node(Fraction(number.numerator)), *above)
    return over(top, times(number_node(Fraction(number.denominator)), *below))

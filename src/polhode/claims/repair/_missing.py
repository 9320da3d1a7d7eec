"""Terms that a claim has lost, found from what is left of it exactly."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from fractions import Fraction

from polhode.algebra import ONE, Expr, Symbol, Vector, factors
from polhode.base import PolhodeError
from polhode.claims.latex._tree import Derivative, Name, Node, Root, Statement, Sum
from polhode.claims.repair._edits import Edit, letters, number_node, turned
from polhode.claims.repair._places import Place, added, negated, over, places, put, raised, times
from polhode.claims.repair._reading import Reading
from polhode.claims.repair._trials import Trials

_UNKNOWN = Symbol("missing")
_LETTER = "missing"
_LARGEST_SIZE = 12


def missing_terms(
    statement: Statement,
    sides: Collection[tuple[int, int]],
    reading: Reading,
    tried: Trials,
    members: Collection[int],
) -> Iterator[Edit]:
    """Terms to be added to one of the sides, or inside a root or a derivative there."""
    quantities = _quantities(statement, reading)
    for place in places(statement):
        if place.path[:2] in sides and _takes_terms(place):
            for direction in _directions(statement, place, reading):
                lost = _lost(statement, place, direction, reading, tried, members)
                if lost is not None:
                    yield from _written(place, direction, lost, quantities, tried)


def _takes_terms(place: Place) -> bool:
    whole = not isinstance(place.parent, Node)
    inside = isinstance(place.parent, Derivative | Root)
    return whole or inside or isinstance(place.node, Sum)


def _directions(statement: Statement, place: Place, reading: Reading) -> list[Node | None]:
    """The unit vectors a missing term may go along; none for a scalar."""
    try:
        if not isinstance(reading.value(place.node), Vector):
            return [None]
    except (PolhodeError, ArithmeticError):
        return []
    hats = [n for p in places(statement) for n in letters(p.node)]
    hats += reading.names
    named = (n for n in hats if isinstance(n, Name) and n.decoration == "hat")
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
            settled = tried.states.on(residual)
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
        top = times(number_node(Fraction(abs(number.numerator))), *above, *extra)
        bottom = times(number_node(Fraction(number.denominator)), *below)
        term = times(over(top, bottom), *tail)
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
        if node is None:
            return None
        (above if power > 0 else below).append(raised(node, abs(power)))
    return number, above, below

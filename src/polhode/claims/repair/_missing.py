"""Terms that a claim has lost, found from what is left of it exactly."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction

from polhode.algebra import ONE, Expr, Symbol, Vector, factors
from polhode.base import PolhodeError
from polhode.claims.latex._tree import Components, Derivative, Name, Node, Root, Sum
from polhode.claims.repair._edits import Edit, letters, number_node, relabelled, turned
from polhode.claims.repair._places import Place, added, negated, over, places, put, raised, times
from polhode.claims.repair._trials import Trials
from polhode.claims.repair._workpiece import Workpiece

_UNKNOWN = Symbol("missing")
_LETTER = "missing"
_LARGEST_SIZE = 12
_LONGEST_SUM = 4
_UPRIGHT = Name("z", decoration="hat")


def missing_terms(
    work: Workpiece, place: Place, members: Sequence[int], inner: Collection[Place]
) -> Iterator[Edit]:
    """Terms to be added to a side, or to whatever can be a sum inside it."""
    if not _takes_terms(place, inner):
        return
    yield from _whole_vectors(work, place, members)
    directions = _directions(work, place)
    for direction in work.might_lack(place, directions, members):
        lost = _lost(work, place, direction, members)
        if lost is not None:
            yield from _written(place, direction, lost, _quantities(work), work.tried)


def _whole_vectors(work: Workpiece, place: Place, members: Sequence[int]) -> Iterator[Edit]:
    """Vectors of the text that make it right when added or taken away."""
    if not isinstance(work.value(place.node), Vector):
        return
    own = dict.fromkeys(n for p in places(work.statement) for n in letters(p.node))
    bold = [n for n in own if isinstance(n, Name) and n.decoration != "hat"]
    whole = [n for n in bold if isinstance(work.value(n), Vector)]
    sums = [added(place.node, term) for node in whole for term in (node, negated(node))]
    for node in work.fitting(place, sums, members):
        yield Edit("missing term", place.path, node, 2.0)


def _takes_terms(place: Place, inner: Collection[Place]) -> bool:
    """Whether a term may be lost there: of a side, a sum, or where a factor could make it right."""
    whole = not isinstance(place.parent, Node)
    inside = isinstance(place.parent, Derivative | Root | Components)
    return whole or inside or isinstance(place.node, Sum) or place in inner


def _directions(work: Workpiece, place: Place) -> list[Node | None]:
    """The unit vectors a missing term may go along; none for a scalar."""
    value = work.value(place.node)
    if not isinstance(value, Vector):
        return [] if value is None else [None]
    own = [n for p in places(work.statement) for n in letters(p.node)]
    wide = [*own, *work.reading.names, _UPRIGHT, *(other for n in own for other in relabelled(n))]
    named = (n for n in wide if isinstance(n, Name) and n.decoration == "hat")
    return [n for n in dict.fromkeys(named) if isinstance(work.value(n), Vector)]


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


Quantities = Mapping[Node, Expr]


def _quantities(work: Workpiece) -> Quantities:
    own = [n for place in places(work.statement) for n in letters(place.node)]
    other = [t for n in own if (t := turned(n)) is not None]
    wide = dict.fromkeys([*own, *other, *work.reading.names])
    found = ((node, work.value(node)) for node in wide)
    return {node: value for node, value in found if isinstance(value, Expr) and value}


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

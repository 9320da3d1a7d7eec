"""Simple conditions that a text may take for granted, or has stated for one sentence only."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from itertools import pairwise, product

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, read_expression
from polhode.base import ParseError
from polhode.catalogue import CATALOGUE
from polhode.derive import Equations
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.text._in_force import InForce

#: A condition as LaTeX or in words, with what it says.
Said = tuple[str, tuple[BoundRelation, ...]]


def conditions(
    tacit: Sequence[Symbol], stated: InForce, near: str, equations: Equations
) -> Iterator[Said]:
    """Conditions to try on a line that fails without them, in their order.

    Args:
        tacit: speeds and given motions that the text nowhere mentions.
        stated: what the text has stated for the line.
        near: the sentence of the line and that before it, whose conditions may be meant on.
        equations: of the system.
    """
    driven = tuple(s for s in tacit if s.kind is SymbolKind.FUNCTION)
    sliding = tuple(s for s in tacit if s in driven or s.name.startswith("v_"))
    turning = tuple(s for s in tacit if s not in sliding)
    groups = dict.fromkeys([driven, sliding, turning, tuple(tacit)])
    resting = [_at_rest(symbols) for symbols in groups]
    bodies = [*_stated_before(stated, near), *_usual_bodies(equations)]
    yield from _lasting(stated)
    yield from filter(None, resting)
    yield from bodies
    for (one, relations), (other, more) in product(filter(None, resting), bodies):
        yield f"{one} and {other}", (*relations, *more)


def _at_rest(tacit: Sequence[Symbol]) -> Said | None:
    """What is not mentioned does not move; None where everything is mentioned."""
    relations = (BoundRelation(Expr.generator(r), "=", ZERO) for s in tacit for r in _rates(s))
    said = " and ".join(f"{Expr.generator(s).latex()} = 0" for s in tacit)
    return (said, tuple(relations)) if tacit else None


def _lasting(stated: InForce) -> Iterator[Said]:
    """Each angle or place that is assumed to have a value, or no rate, keeps it.

    One that it has at a turning point, or whenever else, it does not keep.
    """
    momentary = {relation for each in stated.conditions for relation in each.relations}
    for relation in stated.given:
        symbol = relation.left.symbol if isinstance(relation.left, Expr) else None
        is_of_state = symbol and symbol.kind is SymbolKind.COORDINATE and symbol.order <= 1
        if symbol is None or not is_of_state or relation in momentary:
            continue
        rate = Expr.generator(symbol.base().derivative())
        said = rf"{Expr.generator(symbol.base()).latex()} = \text{{const}}"
        yield said, (BoundRelation(rate, "=", ZERO, is_lasting=True),)


def _rates(symbol: Symbol) -> Iterator[Symbol]:
    """A speed; a given motion with its rates, as far as equations of motion contain them."""
    yield symbol
    for _ in range(3 if symbol.kind is SymbolKind.FUNCTION else 0):
        symbol = symbol.derivative()
        yield symbol


def _stated_before(stated: InForce, near: str) -> Iterator[Said]:
    """What earlier sentences state for themselves and may mean on, alone and two in a row."""
    new = [
        condition
        for condition in stated.conditions
        if (
            condition.is_meant_on or condition.latex in near or _chooses_a_body(condition.relations)
        )
        and any(relation not in stated.given for relation in condition.relations)
    ]
    for one in new:
        yield one.latex, one.relations
    for one, other in pairwise(new):
        yield f"{one.latex} and {other.latex}", (*one.relations, *other.relations)


def _chooses_a_body(relations: tuple[BoundRelation, ...]) -> bool:
    """Whether relations are of parameters only: a hollow sphere stays one in later sentences."""
    sides = [s for r in relations for s in (r.left, r.right) if isinstance(s, Expr)]
    symbols = [symbol for side in sides for symbol in side.symbols()]
    return all(symbol.kind is SymbolKind.PARAMETER for symbol in symbols)


def _usual_bodies(equations: Equations) -> Iterator[Said]:
    """Parameters that the catalogue gives by others, as I = 2 m a²/5 for a marble."""
    entry = CATALOGUE.get(equations.system.name)
    known = {s.published: Expr.generator(s) for s in equations.parameters}
    for parameter in entry.parameters if entry is not None else ():
        if parameter.name not in known:
            continue
        with suppress(ParseError):
            value = read_expression(parameter.default, known)
            if value.symbols():
                left = known[parameter.name]
                said = f"{left.latex()} = {value.latex()}"
                yield said, (BoundRelation(left, "=", value),)

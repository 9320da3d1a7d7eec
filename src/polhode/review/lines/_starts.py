"""The start of a motion that a text states: initial values, and rest."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace

from polhode.algebra import ZERO, Expr, SymbolKind
from polhode.base import PolhodeError
from polhode.claims import BoundRelation, read_latex
from polhode.claims.building_blocks import Name, Node, constant, initial_value, name_of
from polhode.derive import Equations
from polhode.review.lines._states_in_words import upright_at_rest
from polhode.review.text._cues import Cues
from polhode.review.text._in_force import InForce


def with_start(stated: InForce, cues: Cues, equations: Equations) -> InForce:
    """With a start from rest, and at values of coordinates such as θ₁, if words say so."""
    known = {name_of(q.published): q for q in equations.coordinates}
    for latex in cues.placed:
        with suppress(PolhodeError):
            letter = read_latex(f"{latex} = 0").relations[0].sides[0]
            q = known.get(replace(letter, subscript="")) if isinstance(letter, Name) else None
            if q is not None and letter != name_of(q.published) and letter not in stated.defined:
                stated = stated.defining({letter: Expr.generator(initial_value(q))})
    if cues.is_from_upright and not stated.start:
        stated = stated.starting(upright_at_rest(equations))
    rests = stated.is_from_rest or _rests_at_start(cues) or cues.is_placed_at_rest
    return replace(stated, is_from_rest=rests)


def starting(letters: Mapping[Node, Expr], own: InForce, cues: Cues) -> InForce:
    """A start such as θ = θ₁, with new letters for the values there."""
    values = {letter: constant(letter) for letter in letters}
    start = (BoundRelation(value, "=", values[letter]) for letter, value in letters.items())
    return started(tuple(start), own.defining(values), cues)


def started(relations: tuple[BoundRelation, ...], own: InForce, cues: Cues) -> InForce:
    """A start; from rest the rates of the coordinates vanish that have values there."""
    if not _rests_at_start(cues):
        return own.starting(relations)
    sides = (r.left.symbol for r in relations if isinstance(r.left, Expr))
    placed = (s for s in sides if s is not None and s.kind is SymbolKind.COORDINATE and not s.order)
    rates = (BoundRelation(Expr.generator(s.derivative()), "=", ZERO) for s in placed)
    return own.starting((*relations, *rates))


def _rests_at_start(cues: Cues) -> bool:
    return cues.is_launch and cues.is_at_rest

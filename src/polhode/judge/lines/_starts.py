"""The start of a motion that a text states: initial values, and rest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import permutations

from polhode.algebra import PI, ZERO, Expr, Symbol, SymbolKind, is_positive
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.judge.latex import read_latex
from polhode.judge.latex._names import name_of
from polhode.judge.latex._tree import Name, Node
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.meaning._initial_values import INITIAL, initial_value
from polhode.judge.meaning._mechanics import Mechanics
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.meaning._vocabulary import constant
from polhode.judge.text._cues import Cues, Role
from polhode.judge.text._in_force import InForce
from polhode.judge.text._text_line import essential_coordinates

_RIGHT = Expr.generator(PI) / 2
_ANGLES = (ZERO, _RIGHT, -_RIGHT, Expr.generator(PI))


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


def begins(cues: Cues) -> bool:
    """Whether words say that a line is of the start of a motion."""
    return cues.is_launch or cues.is_at_start


def with_initial_values(judged: JudgedLine, own: InForce, equations: Equations) -> InForce | None:
    """What the part states now if a line gives initial values; None for any other line."""
    cues, bound = judged.line.cues, judged.bound
    if (named := _letter_at_start(judged, equations)) is not None:
        letter, state = named
        value = Expr.generator(initial_value(state))
        start: tuple[BoundRelation, ...] = (BoundRelation(Expr.generator(state), "=", value),)
        return started(start, own.defining({letter: value}), cues)
    if bound is None or cues.role is Role.CONSEQUENCE:
        return None
    relations = (*bound.relations, *bound.conditions)
    start = _printed_start(relations, judged.line.in_force, equations)
    return started(start, own, cues) if start else None


def _by_initial_values(equations: Equations) -> dict[Symbol, Symbol]:
    """Coordinates and their rates by their initial values."""
    return {initial_value(s): s for q in equations.coordinates for s in (q, q.derivative())}


def _letter_at_start(judged: JudgedLine, equations: Equations) -> tuple[Name, Symbol] | None:
    """A letter, and of what it is the initial value: ω₀ in θ̇ = ω₀ said of a start, b in r(0) = b.

    It has no other meaning, or may be an initial value by its form.
    """
    line, relations = judged.line, judged.line.statement.relations
    if len(relations) != 1 or relations[0].signs != ("=",):
        return None
    known = line.in_force.defined
    pairs = permutations(relations[0].sides)
    new = [(x, other) for x, other in pairs if isinstance(x, Name) and x not in known]
    if not new:
        return None
    notation, states = line.in_force.notation(equations, {}), _by_initial_values(equations)
    for letter, other in new:
        readings = notation.vocabulary.readings_of(letter)
        is_initial = any(reading.phrase.startswith(INITIAL) for reading in readings)
        if notation.vocabulary.has(letter) and not is_initial:
            continue
        with suppress(PolhodeError, ArithmeticError):
            value = notation.value(other)
            symbol = value.symbol if isinstance(value, Expr) else None
            if symbol is None:
                continue
            if symbol in states:
                return letter, states[symbol]
            if symbol.order and symbol in states.values() and begins(line.cues):
                return letter, symbol
    return None


def _printed_start(
    relations: Sequence[BoundRelation], stated: InForce, equations: Equations
) -> tuple[BoundRelation, ...]:
    """The start that a line states by initial values, as x(0) = ẏ(0) = 0 does; else nothing.

    Another value for a quantity that has one is a claim.
    """
    states, known = _by_initial_values(equations), dict[Symbol, Expr]()
    for relation in reversed(relations):
        symbol = relation.left.symbol if isinstance(relation.left, Expr) else None
        if symbol not in states or relation.sign != "=" or not isinstance(relation.right, Expr):
            return ()
        value = relation.right.subs(known)
        if any(s.kind.varies or (s in states and s != symbol) for s in value.symbols()):
            return ()
        known[symbol] = value
    start = tuple(
        BoundRelation(Expr.generator(states[s]), "=", value) for s, value in known.items()
    )
    before = {relation.left: relation.right for relation in stated.start}
    return start if all(before.get(r.left, r.right) == r.right for r in start) else ()


def upright_at_rest(equations: Equations) -> tuple[BoundRelation, ...]:
    """The state at rest in which the potential energy is greatest; empty where several are."""
    places = [
        (q, value)
        for q in essential_coordinates(equations)
        for value in _ANGLES
        if _is_highest(q, value, equations)
    ]
    if len(places) != 1:
        return ()
    ((q, value),) = places
    rest = (BoundRelation(Expr.generator(s), "=", ZERO) for s in equations.speeds)
    return (BoundRelation(Expr.generator(q), "=", value), *rest)


def _is_highest(q: Symbol, value: Expr, equations: Equations) -> bool:
    with suppress(PolhodeError, ArithmeticError):
        slope = Mechanics(equations).potential_energy().diff(q)
        return not slope.subs({q: value}) and is_positive(-slope.diff(q).subs({q: value}))
    return False


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

"""Contexts in which a line may be meant that does not hold on every true motion."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from polhode.algebra import PI, ZERO, Expr, Symbol, SymbolKind, as_symbol
from polhode.derive import Equations
from polhode.judge.latex._names import name_of
from polhode.judge.latex._tree import Number, walk
from polhode.judge.lines._near_steady import kept_values, under_steady_momenta
from polhode.judge.meaning._initial_values import initial_value
from polhode.judge.meaning._mechanics import on_constraints
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.states._bound_claim import SENSE, Small
from polhode.judge.text._in_force import InForce, with_small
from polhode.judge.text._text_line import SPINS, TIME_LETTER, TextLine, essential_coordinates

#: Words that refer to the instant of which a sentence before has spoken.
_AT_EVENT = re.compile(
    r"\A\W*(?:then|there|here)\b|\bat (?:that|this) (?:moment|instant|point|angle|time|place)\b"
    r"|\bwhere\s*\Z",
    re.I,
)
_AT_THIS_INSTANT = re.compile(r"\bat (?:that|this|the same) (?:very )?(?:moment|instant)\b", re.I)


def weaker_meanings(line: TextLine, equations: Equations) -> Iterator[tuple[TextLine, str]]:
    """The contexts in which a line may be meant that does not hold on every true motion."""
    stated, cues, relation = line.in_force, line.cues, line.relation.relation
    if line.is_steady:
        yield from _steady_meanings(line, equations)
    if relation is not None and any(sign in SENSE for sign in relation.signs):
        yield line, "threshold"
    yield from _meanings_near_motion(line, equations)
    if stated.start or cues.is_launch or TIME_LETTER in line.letters:
        yield _with_tacit_rest(line), "launch"
    yield from _meanings_at_start(line, equations)
    if is_at_end_of_contact(line):
        there = with_printed_start(stated.under(stated.event), stated.event, equations)
        at_event = _with_tacit_rest(replace(line, in_force=there))
        yield at_event, "launch" if there.start else "motion"
    if any(isinstance(p, Number) and p.text != "0" for p in walk(line.statement)):
        for numbers in dict.fromkeys([stated.given, stated.with_numbers(of_state=False).given]):
            yield replace(line, in_force=replace(stated, given=numbers)), "number"


def _meanings_near_motion(line: TextLine, equations: Equations) -> Iterator[tuple[TextLine, str]]:
    """The line to the order of what is small: as stated, in its own sentence or by its words."""
    stated, cues = line.in_force, line.cues
    if stated.small:
        order = 1 if says_that_it_vanishes(line) else None
        yield replace(line, in_force=stated.to_order(order)), "limit"
    if cues.small_in_sentence:  # of another motion than the sentences before speak of
        here = with_small(replace(stated, small=()), cues.small_in_sentence, equations)
        if here.small and set(here.small) != set(stated.small):
            yield replace(line, in_force=here.to_order(cues.order or 1)), "limit"
    if cues.is_fast and (fast := _fast_spin(line, equations)):
        yield replace(line, in_force=replace(stated, small=(*stated.small, *fast))), "limit"
    if cues.is_linear:
        yield replace(line, in_force=replace(stated, small=_small_motion(line, equations))), "limit"


def _steady_meanings(line: TextLine, equations: Equations) -> Iterator[tuple[TextLine, str]]:
    """The contexts in which a line may be meant of steady motion, or of motions close to it."""
    kept = with_steady_values(line, equations)
    yield kept, "steady"
    if kept.in_force.small != line.in_force.small:
        yield kept, "limit"
    for near in under_steady_momenta(line.in_force, equations):
        yield replace(line, in_force=near), "limit"


def with_steady_values(line: TextLine, equations: Equations) -> TextLine:
    """The line with θ₀ for the value that θ keeps in steady motion, and not for that at a start."""
    stated = line.in_force
    if stated.start:
        return line
    departed = {value: Expr.generator(q) for q, value in kept_values(stated).items()}
    new = {
        letter: departed[value]
        for letter, value in stated.defined.items()
        if isinstance(value, Expr) and value in departed
    }
    sides = {side for relation in line.statement.relations for side in relation.sides}
    for q in equations.coordinates:
        letter, at_start = name_of(f"{q.published}_0"), Expr.generator(initial_value(q))
        departs = name_of(q.published) in sides  # r = r₀ + x: the motion is no longer steady
        if letter in line.letters and letter not in stated.defined and not departs:
            new[letter] = Expr.generator(q)
        new |= {n: Expr.generator(q) for n, v in stated.defined.items() if v == at_start}
    in_truth = {as_symbol(value): q for value, q in departed.items()}
    small = (replace(s, quantity=s.quantity.subs(in_truth), symbol=None) for s in stated.small)
    found = tuple(s for s in small if s.quantity) if departed else stated.small
    return replace(line, in_force=replace(stated.defining(new), small=found))


def _meanings_at_start(line: TextLine, equations: Equations) -> Iterator[tuple[TextLine, str]]:
    """The line at the instant at which the motion starts, if words speak of it, or of rest."""
    stated, cues = line.in_force, line.cues
    if speaks_of_start(line):
        yield replace(line, in_force=stated.under(stated.start)), "motion"
    if cues.is_at_rest:
        rest = (BoundRelation(Expr.generator(s), "=", ZERO) for s in equations.speeds)
        yield replace(line, in_force=stated.under((*stated.start, *rest))), "motion"


def speaks_of_start(line: TextLine) -> bool:
    """Whether its words are of the instant at which the motion starts, as "at this instant" is."""
    stated, cues = line.in_force, line.cues
    refers = not stated.event and _AT_THIS_INSTANT.search(cues.words_before) is not None
    return bool(stated.start) and (cues.is_at_start or refers)


def _with_tacit_rest(line: TextLine) -> TextLine:
    """The line with a start at which, of a motion from rest, no speed is left out."""
    stated = line.in_force
    if not (stated.start and (stated.is_from_rest or line.cues.is_at_rest)):
        return line
    speeds = (s for s in line.tacit if s.kind is SymbolKind.SPEED)
    rest = tuple(BoundRelation(Expr.generator(s), "=", ZERO) for s in speeds)
    return replace(line, in_force=stated.starting(rest))


def is_at_end_of_contact(line: TextLine) -> bool:
    """Whether its words refer to the instant at which a contact ends, as the text has said."""
    return bool(line.in_force.event) and _AT_EVENT.search(line.cues.words_before) is not None


def with_printed_start(
    stated: InForce, relations: Iterable[BoundRelation], equations: Equations
) -> InForce:
    """With θ = θ₀ at the start for a θ₀ that relations contain, and its rate zero from rest."""
    sides = [side for r in relations for side in (r.left, r.right) if isinstance(side, Expr)]
    printed = {symbol for side in sides for symbol in side.symbols()}
    placed = [q for q in equations.coordinates if initial_value(q) in printed]
    start = [
        BoundRelation(Expr.generator(q), "=", Expr.generator(initial_value(q))) for q in placed
    ]
    if stated.is_from_rest:
        start += [BoundRelation(Expr.generator(q.derivative()), "=", ZERO) for q in placed]
    return stated.starting(tuple(start))


def _fast_spin(line: TextLine, equations: Equations) -> tuple[Small, ...]:
    """What is small for fast spin: 1/ω of the one spin that is conserved; empty for others."""
    notation = line.in_force.notation(equations, {})
    named = (s.published for s in equations.speeds if s.name.startswith("omega"))
    letters = [name_of(name) for name in (*named, *SPINS)]
    meanings = dict.fromkeys(notation.vocabulary.find(letter) for letter in letters)
    spins = [
        spin
        for spin in meanings
        if isinstance(spin, Expr)
        and spin.varies
        and not on_constraints(spin.dt(), equations).subs(equations.accelerations)
    ]
    return (Small(1 / spins[0], 1),) if len(spins) == 1 else ()


def says_that_it_vanishes(line: TextLine) -> bool:
    """Whether a relation says that something is close to zero: to first order, as a rule."""
    relation = line.relation.relation
    is_close = relation is not None and relation.signs == ("≈",)
    return is_close and relation is not None and relation.sides[1] == Number("0")


def _small_motion(line: TextLine, equations: Equations) -> tuple[Small, ...]:
    """What is small, to first order, in a linear equation: departures or coordinates, and rates.

    Beside what the text calls small, such as an angle whose rate it does not mention.
    """
    found = {s.quantity: s for s in line.in_force.to_order(1).small}
    for q in essential_coordinates(equations):
        quantity = line.in_force.departures.get(q, Expr.generator(q))
        for each in (quantity, Expr.generator(q.derivative())):
            found.setdefault(each, Small(each, 1, each.symbol))
    return tuple(found.values())


def small_variables(line: TextLine, equations: Equations) -> Mapping[Symbol, Expr]:
    """The coordinates and speeds that are close to a value for a line, as its text says.

    Each with this value: zero, or π for the θ of θ = π + ε.
    """
    small = _small_motion(line, equations) if line.cues.is_linear else line.in_force.small
    found = {s.quantity.symbol: ZERO for s in small}
    quantities = {s.quantity for s in small}
    for q, departure in line.in_force.departures.items():
        value = Expr.generator(q) - departure / departure.diff(q)
        if departure in quantities and not value.symbols() - {PI}:
            found[q] = value
    variables = (*equations.coordinates, *equations.speeds)
    return {s: value for s, value in found.items() if s is not None and s in variables}

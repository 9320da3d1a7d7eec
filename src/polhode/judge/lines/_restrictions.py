"""Lines that choose among the motions or the bodies, rather than contradict the model."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from polhode.algebra import ZERO, Expr, SymbolKind, linear_parts
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.judge.latex._tree import Name
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.meaning._bindings import Bound, restrictions
from polhode.judge.meaning._meaning import Side
from polhode.judge.meaning._mechanics import Mechanics, on_constraints
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.states._bound_claim import EQUALITY
from polhode.judge.text._cues import Role
from polhode.judge.text._in_force import varies
from polhode.judge.text._text_line import components_of_turning

_HENCE = Role.CONSEQUENCE
_VARYING = {kind for kind in SymbolKind if kind.varies} | {SymbolKind.TIME}


def restricts(
    relations: Sequence[BoundRelation], equations: Equations, *, is_assumed: bool
) -> bool:
    """Whether relations choose among systems or motions, rather than contradict the model.

    They give values to parameters, coordinates or speeds that nothing else determines.
    """
    free = {*equations.coordinates, *equations.speeds, *equations.parameters}
    free |= {q.derivative() for q in equations.coordinates}
    functions = Mechanics(equations).declared.functions  # whose motion a text may choose
    free |= {rate for f in functions for rate in (f, f.derivative(), f.derivative().derivative())}
    if is_assumed:  # "φ̇ = const" chooses the steady motions; ω̇ = 0 of a spin contradicts the model
        rates = [r.left.symbol for r in relations if r.is_lasting and isinstance(r.left, Expr)]
        free |= {s for s in rates if s is not None and s.kind is SymbolKind.COORDINATE}
    if not relations or any(relation.sign not in EQUALITY for relation in relations):
        return False
    try:
        values, vanishing = restrictions([_of_shape(r, equations) for r in relations])
    except PolhodeError:
        return False
    known = dict(values)  # of a chain such as θ' = φ' = 0 each gives a value
    return not vanishing and all(
        symbol.symbol in free and not any(s.kind in _VARYING for s in value.subs(known).symbols())
        for symbol, value in values.items()
    )


def _of_shape(relation: BoundRelation, equations: Equations) -> BoundRelation:
    """I = (2/5) m a² of a body declared with I = k m a² as the number that it gives k."""
    left, right = relation.left, relation.right
    if not isinstance(left, Expr) or not isinstance(right, Expr) or left.symbol is not None:
        return relation
    difference = left - right
    if not difference.symbols() <= set(equations.parameters):
        return relation
    for parameter in sorted(difference.symbols(), key=lambda s: s.published):
        with suppress(PolhodeError, ArithmeticError):
            (slope,), rest = linear_parts(difference, (parameter,))
            value = (-rest / slope).rational
            if value is not None and value > 0:
                return replace(relation, left=Expr.generator(parameter), right=-rest / slope)
    return relation


def chosen_values(
    judged: JudgedLine, bound: Bound, equations: Equations
) -> tuple[BoundRelation, ...]:
    """The restrictions by which a line chooses among the systems or motions; empty for a claim."""
    if still := _kept_at_rest(judged, bound):
        return still
    is_assumed = judged.line.cues.role is Role.ASSUMPTION
    is_restriction = restricts(bound.relations, equations, is_assumed=is_assumed)
    is_choice = is_restriction or _chooses_motion(judged, bound)
    return _each_by_itself(bound.relations, equations) if is_choice else ()


def _chooses_motion(judged: JudgedLine, bound: Bound) -> bool:
    """Whether it gives components of an angular velocity values that do not change.

    Or, unless it is drawn from others, a ratio of speeds that is a letter of the text's own.
    """
    notation, cues = judged.judgement.notation, judged.line.cues
    if notation is None or any(r.sign not in EQUALITY for r in bound.relations):
        return False
    free = components_of_turning(notation)
    if cues.role is not _HENCE and not judged.line.relation.is_display:
        own = judged.line.in_force.defined.values()
        free |= {v for v in own if isinstance(v, Expr) and v.denominator.varies}
    printed = (side for relation in judged.line.statement.relations for side in relation.sides)
    named = {notation.vocabulary.find(side) for side in printed if isinstance(side, Name)}
    free &= named
    sides = {side for r in bound.relations for side in (r.left, r.right)}
    return not free.isdisjoint(sides) and not any(map(varies, sides - free))


def _kept_at_rest(judged: JudgedLine, bound: Bound) -> tuple[BoundRelation, ...]:
    """That rates which are zero for a line last, as "θ' = 0 and θ'' = 0" says; else nothing.

    "Hence θ'' = 0" is a claim, and wrong of a turning point.
    """
    sides = [(r.sign, r.left, r.right) for r in bound.relations]
    accelerations = [left.symbol for _, left, _ in sides if isinstance(left, Expr)]
    still = {r.left for r in judged.line.in_force.given if r.right == ZERO}
    rates = [
        Expr.generator(s.base().derivative())
        for s in accelerations
        if s is not None and s.kind is SymbolKind.COORDINATE and s.order == 2
    ]
    is_plain = all(sign in EQUALITY and right == ZERO for sign, _, right in sides)
    is_claim = judged.line.cues.role is _HENCE
    if is_claim or not is_plain or len(rates) < len(sides) or not still.issuperset(rates):
        return ()
    return tuple(BoundRelation(rate, "=", ZERO, is_lasting=True) for rate in rates)


def _each_by_itself(
    relations: Sequence[BoundRelation], equations: Equations
) -> tuple[BoundRelation, ...]:
    """Restrictions that give each quantity its value: those of dθ/dt = dφ/dt = 0 are zero.

    Rates are by the independent speeds, on which states are described.
    """
    values, vanishing = restrictions([_of_shape(r, equations) for r in relations])
    known, lasting = dict(values), {r.left for r in relations if r.is_lasting}
    by_quantity = (
        BoundRelation(
            on_constraints(quantity, equations),
            "=",
            value.subs(known),
            is_lasting=quantity in lasting,
        )
        for quantity, value in values.items()
    )
    others = (
        BoundRelation(on_constraints(each, equations).numerator, "=", ZERO) for each in vanishing
    )
    return (*by_quantity, *others)


def held(relations: tuple[BoundRelation, ...]) -> tuple[BoundRelation, ...]:
    """That the further rates of a prescribed motion vanish which keeps the value of one."""
    symbols = [r.left.symbol for r in relations if isinstance(r.left, Expr)]
    driven = [s for s in symbols if s is not None and s.kind is SymbolKind.FUNCTION]
    rates = ((s.derivative(), s.derivative().derivative()) for s in driven)
    return tuple(BoundRelation(Expr.generator(r), "=", ZERO) for pair in rates for r in pair)


def ordered(relations: Sequence[BoundRelation]) -> tuple[Expr, ...]:
    """The differences of parameters that are positive by I₁ < I₂ < I₃, that of I₃ and I₁ too."""
    found = list[tuple[Side, Side]]()  # less and more
    for relation in relations:
        pair = (relation.left, relation.right)
        less, more = pair if relation.sign == "<" else pair[::-1]
        if relation.sign not in ("<", ">"):
            return ()
        found += [(low, more) for low, high in found if high == less]
        found += [(less, high) for low, high in found if low == more]
        found.append((less, more))
    differences = (b - a for a, b in found if isinstance(a, Expr) and isinstance(b, Expr))
    return tuple(dict.fromkeys(differences))

"""Thresholds that a text gives for stability: "rolling upright is stable if ω₃² > g/3a"."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

from polhode.algebra import PI, ZERO, Expr, Symbol
from polhode.analyse import NoSteadyMotionError
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.judge._check import OpenVerdict
from polhode.judge._verdict import Answer, ComparedCondition, Decides, Verdict
from polhode.judge.latex import read_latex, write_latex
from polhode.judge.latex._names import name_of
from polhode.judge.latex._tree import walk
from polhode.judge.lines._judged_line import JudgedLine, in_context
from polhode.judge.meaning._bindings import restrictions
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.states._bound_claim import SENSE
from polhode.judge.text._state_words import StateKind
from polhode.judge.text._text_line import TextLine, essential_coordinates

#: Where symmetric motions are, of a text that does not say at which angle its motion is.
_USUAL = (ZERO, Expr.generator(PI) / 2, Expr.generator(PI))
_OPPOSITE = {">": "<", "≥": "<", "<": ">", "≤": ">"}
_FORMULA = re.compile(r"\$([^$]+)\$|\\\((.+?)\\\)")
_UNDECIDED = "whether it is the condition of stability could not be decided"


def as_threshold(judged: JudgedLine, equations: Equations) -> JudgedLine:
    """A line judged as the condition of stability that its sentence says it is; others as they are.

    The motion is that which the text has stated. If it has stated no angle, those of symmetric
    motions are tried: a condition that none of them has is an error only if each of them was
    decided. A motion is unstable where it is not stable, but for the boundary between them.
    """
    line = judged.line
    latex = _opposite(line) if line.cues.is_of_instability else ""
    if not (latex or line.cues.is_of_stability) or not _compares_quantities(judged):
        return judged
    found = [_judged_at(line, equations, "", latex)]
    is_stated, is_here = True, False
    is_upright = line.cues.state is not None and line.cues.state.kind is StateKind.UPRIGHT
    # A condition of motions at a fixed angle, which the line is not, is compared with no others.
    first = _refuting(found[0])
    is_compared = first is not None and first.is_at_fixed_angles
    for coordinate in () if is_compared else _left_open(judged, equations):
        stated = tuple(dict.fromkeys(_stated_values(line, coordinate, equations)))
        is_stated = bool(stated)
        is_here = is_here or (is_stated and not _is_elsewhere(line, coordinate))
        for value in stated or _USUAL:
            relation = BoundRelation(Expr.generator(coordinate), "=", value)
            meant = replace(line, in_force=line.in_force.under((relation,)))
            is_named = stated or (is_upright and value != _USUAL[-1])
            said = "" if is_named else f"{Expr.generator(coordinate).latex()} = {value.latex()}"
            found.append(_judged_at(meant, equations, said, latex))
    for each in found:
        if each.verdict.holds and not (is_here and _is_of_existence(each)):
            return each
    failing = [each for each in found if _refuting(each) is not None]
    undecided = [
        each
        for each in found
        if each not in failing and not isinstance(each.verdict.error, NoSteadyMotionError)
    ]
    is_decided = not undecided or is_upright or (is_stated and failing[-1:] == found[-1:])
    if failing and is_decided:
        return failing[-1]
    refuting = _refuting(failing[-1]) if failing else None
    opposite = "its opposite is " if latex else ""
    known = f"{opposite}not equivalent to {refuting.words}" if refuting else _UNDECIDED
    verdict = Verdict(Answer.UNREAD, "threshold", f"{known}; say at which angle the motion is")
    return replace(judged, judgement=OpenVerdict(verdict, judged.judgement.notation))


def _is_elsewhere(line: TextLine, coordinate: Symbol) -> bool:
    """Whether its sentence gives a coordinate by another equation, as cos θ = g/aω² does."""
    letter = name_of(coordinate.published)
    for inline in _FORMULA.finditer(line.cues.sentence):
        with suppress(PolhodeError):
            sides = read_latex(inline[1] or inline[2]).relations[0].sides
            if len(sides) == 2 and sides[0] != letter and letter in walk(sides[0]):
                return True
    return False


def _is_of_existence(judged: JudgedLine) -> bool:
    """Whether a line is a condition under which there is a steady motion, and of that alone."""
    compared = judged.verdict.compared
    return compared is not None and compared.decides is not Decides.STABILITY


def _refuting(judged: JudgedLine) -> ComparedCondition | None:
    """The condition of stability that a line which fails was found to differ from; None if none."""
    verdict = judged.verdict
    compared = verdict.compared if verdict.answer is Answer.FAILS else None
    return compared if compared is not None and compared.decides is Decides.STABILITY else None


def _opposite(line: TextLine) -> str:
    """The inequality with its sense turned round; empty where it has several."""
    relation = line.relation.relation
    if relation is None or len(relation.signs) != 1 or relation.signs[0] not in _OPPOSITE:
        return ""
    return write_latex(replace(relation, signs=(_OPPOSITE[relation.signs[0]],)))


def _judged_at(line: TextLine, equations: Equations, said: str, latex: str) -> JudgedLine:
    """The judgement on a line, or another form of it; it needs what is said where it holds."""
    found = JudgedLine(line, in_context(line, equations, {}, "threshold", latex))
    if latex:  # a correction would be of the other form
        verdict = replace(found.verdict, reason=f"its opposite is {found.verdict.reason}")
        found = JudgedLine(line, replace(found.judgement, verdict=verdict, corrected=None))
    return replace(found, needs=said) if said and found.verdict.holds else found


def _compares_quantities(judged: JudgedLine) -> bool:
    """Whether it is an inequality of more than the names of parameters, as I₁ < I₂ < I₃ is."""
    members = judged.claim.members if judged.claim is not None else ()
    sides = [side for m in members for side in (m.left, m.right)]
    names = [isinstance(side, Expr) and side.symbol is not None for side in sides]
    return bool(members) and all(m.sign in SENSE for m in members) and not all(names)


def _left_open(judged: JudgedLine, equations: Equations) -> Iterator[Symbol]:
    """Coordinates that matter, of which neither the line nor its sentence gives the value."""
    given, _ = restrictions([r for r in judged.line.in_force.given if r.sign == "="])
    letters = set(judged.line.letters)
    for q in essential_coordinates(equations):
        if name_of(q.published) not in letters and Expr.generator(q) not in given:
            yield q


def _stated_values(line: TextLine, coordinate: Symbol, equations: Equations) -> Iterator[Expr]:
    """Values that the text has given a coordinate, or from which deviations of it count."""
    own = Expr.generator(coordinate)
    for relation in (r for c in line.in_force.conditions for r in c.relations):
        left, right = relation.left, relation.right
        if left == own and isinstance(right, Expr) and right.symbols() <= {PI}:
            yield right
    for inline in _FORMULA.finditer(line.cues.sentence):  # "θ = 0 is unstable if"
        with suppress(PolhodeError):
            sides = read_latex(inline[1] or inline[2]).relations[0].sides
            if sides[0] == name_of(coordinate.published) and len(sides) == 2:
                notation = line.in_force.notation(equations, {})
                yield notation.scalar(write_latex(sides[1]))
    if deviation := line.in_force.departures.get(coordinate):
        centre = -deviation.subs({coordinate: ZERO}) / deviation.diff(coordinate)
        if centre.symbols() <= {PI}:
            yield centre

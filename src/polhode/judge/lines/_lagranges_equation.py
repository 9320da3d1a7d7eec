"""Lagrange's equation, which is true of every Lagrangian of a system whose loads have potentials.

A text writes it for its own Lagrangian, in its own coordinates, of which it may have fewer than the
declaration: with the rolling put in, or with q for all of them. As a relation it claims nothing
that the Lagrangian does not.
"""

from __future__ import annotations

from dataclasses import replace

from polhode.derive import Equations
from polhode.judge._check import OpenVerdict
from polhode.judge._verdict import Answer, Verdict
from polhode.judge.latex._tree import (
    At,
    Derivative,
    Dots,
    Name,
    Negative,
    Node,
    Number,
    Relation,
    Sum,
)
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.meaning._mechanics import Mechanics
from polhode.judge.text._text_line import TIME_LETTER
from polhode.model import DryFriction

_SAID = "Lagrange's equation, which holds for the Lagrangian of the text"
_LAGRANGIANS = (Name("L"), Name("cal L"))


def as_lagranges_equation(judged: JudgedLine, equations: Equations) -> JudgedLine:
    """A line that is Lagrange's equation, as it stands: true; others as they are."""
    relation = judged.line.relation.relation
    if judged.verdict.holds or relation is None or not is_lagranges_equation(relation):
        return judged
    is_ideal = not any(isinstance(c, DryFriction) for c in equations.system.contact_laws)
    if not is_ideal or Mechanics(equations).has_other_loads:
        return judged
    return replace(judged, judgement=OpenVerdict(Verdict(Answer.HOLDS, "motion", _SAID)), needs="")


def is_lagranges_equation(relation: Relation) -> bool:
    """Whether a relation is d/dt ∂L/∂q̇ - ∂L/∂q = 0 of a letter L, also with a side taken over."""
    if relation.signs != ("=",):
        return False
    terms = [*_terms(relation.sides[0]), *map(_negated, _terms(relation.sides[1]))]
    if len(terms) != 2:
        return False
    for first, second in (terms, terms[::-1]):
        sign, rate = first
        other, slope = second
        if sign == other or not isinstance(rate, Derivative) or rate.by != TIME_LETTER:
            continue
        momentum = rate.of
        if not isinstance(momentum, Derivative) or not isinstance(slope, Derivative):
            continue
        of = _letter(momentum.of)
        is_of_one = of in _LAGRANGIANS and of == _letter(slope.of)
        if is_of_one and not rate.partial and rate.order == 1 and momentum.by == _rate(slope.by):
            return True
    return False


def _letter(node: Node) -> Node:
    return node.of if isinstance(node, At) else node


def _rate(node: Node) -> Node:
    return Dots(node, 1)


def _terms(side: Node) -> list[tuple[int, Node]]:
    match side:
        case Number("0"):
            return []
        case Sum(terms):
            return [each for term in terms for each in _terms(term)]
        case Negative(of):
            return [_negated(each) for each in _terms(of)]
    return [(1, side)]


def _negated(term: tuple[int, Node]) -> tuple[int, Node]:
    return -term[0], term[1]

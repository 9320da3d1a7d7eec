"""What a text states to be small: ratios, angles, other components, departures."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.judge.contexts._contexts import holds
from polhode.judge.latex import read_latex
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.meaning._meaning import Meaning
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.states._bound_claim import MAGNITUDES, Small
from polhode.judge.text._cues import Cues, Role
from polhode.judge.text._in_force import BARS, InForce
from polhode.judge.text._text_line import components_of_turning

_HENCE = Role.CONSEQUENCE
#: Words right before the value of a coordinate that make it a place nearby.
_NEAR = re.compile(
    r"\b(?:near|close to"
    r"|(?:moves?|motion|oscillat\w+|linear\w+|expand\w*|swings?) (?:\w+ )?(?:about|around)"
    r"|in the (?:vicinity|neighbou?rhood) of)\s*\Z",
    re.I,
)


def taken_as_small(
    judged: JudgedLine, own: InForce, equations: Equations
) -> tuple[JudgedLine, InForce] | None:
    """A line that says what is small, as ε ≪ 1 and sin θ ≈ θ do; None for any other."""
    cues, ratios = judged.line.cues, _ratios(judged, equations)
    is_said_here = any(latex in judged.line.latex for latex, _ in cues.small_here)
    if ratios and cues.role is not _HENCE and (is_said_here or not judged.verdict.holds):
        said = "an assumption: it says what is small"
        return replace(judged, stated=said), replace(own, small=(*own.small, *ratios))
    if angle := _small_angle(judged, equations):
        said = f"an assumption: it takes {angle.published} as small"
        small = Small(Expr.generator(angle))
        return replace(judged, stated=said), replace(own, small=(*own.small, small))
    return None


def other_components(judged: JudgedLine) -> tuple[Small, ...]:
    """The components of an angular velocity beside those that a line prints, as small."""
    notation = judged.judgement.notation
    components = components_of_turning(notation) if notation is not None else frozenset()
    printed = {notation.vocabulary.find(n) for n in judged.line.letters} if notation else set()
    others = sorted(components - printed, key=str) if components & printed else []
    return tuple(Small(each, 1, each.symbol) for each in others)


def _ratios(judged: JudgedLine, equations: Equations) -> tuple[Small, ...]:
    """What is small where one side is much smaller than the other; empty for other relations."""
    relation = judged.line.relation.relation
    if relation is None or any(sign not in MAGNITUDES for sign in relation.signs):
        return ()
    found = []
    with suppress(PolhodeError, ArithmeticError):
        notation = judged.line.in_force.notation(equations, {})
        magnitudes = read_latex(BARS.sub("", judged.line.latex))  # |ε| ≪ 1 speaks of ε
        for member in notation.bound(magnitudes).relations:
            less, more = member.left, member.right
            if member.sign == "≫":
                less, more = more, less
            if isinstance(less, Expr) and isinstance(more, Expr):
                found.append(Small(less / more, symbol=less.symbol))
    return tuple(found)


def _small_angle(judged: JudgedLine, equations: Equations) -> Symbol | None:
    """The angle that has to be small for an approximation such as sin θ ≈ θ, if nothing says so."""
    is_said = judged.verdict.context == "limit" and judged.line.cues.is_linear
    if not (is_said or judged.verdict.option == "small") or judged.claim is None:
        return None
    symbols = {s for c in judged.claim.components() for s in c.difference.symbols()}
    if len(symbols) != 1 or not symbols <= {*equations.coordinates}:
        return None
    (angle,) = symbols
    small = replace(judged.claim, small=(Small(Expr.generator(angle)),))
    return angle if holds(small, "limit") else None


def neighbourhood(cues: Cues, relations: tuple[BoundRelation, ...]) -> tuple[Small, ...]:
    """What is small where words such as "near" say that the motion is close to a place."""
    if _NEAR.search(cues.words_before) is None:
        return ()
    pairs = [(r.left, r.right) for r in relations]
    found = [x - at for x, at in pairs if isinstance(x, Expr) and isinstance(at, Expr)]
    symbols = [x.symbol for x, _ in pairs if isinstance(x, Expr)]
    is_place = all(s is not None and s.kind is SymbolKind.COORDINATE for s in symbols)
    return tuple(Small(each, 1, each.symbol) for each in found) if is_place else ()


def departing(judged: JudgedLine, own: InForce, letters: Sequence[Meaning]) -> InForce:
    """With a small departure, and with the speeds that vanish in the motion it departs from.

    Departures from another motion that were small before are so no longer.
    """
    text = judged.line.cues.two_sentences
    speeds = [
        relation.left
        for condition in own.conditions
        for relation in condition.relations
        if condition.latex in text and isinstance(relation.left, Expr) and relation.right == ZERO
    ]
    moving = [s for s in speeds if s.symbol is not None and _is_speed(s.symbol)]
    departures = [value for value in letters if isinstance(value, Expr) and value.varies]
    small = tuple(Small(quantity, 1) for quantity in (*departures, *moving))
    return replace(own, small=small, integrated=())


def _is_speed(symbol: Symbol) -> bool:
    return symbol.kind is SymbolKind.SPEED or symbol.order == 1

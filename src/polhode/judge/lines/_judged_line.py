"""One line with the judgement on it in a context, under what the text has stated."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property

from polhode.algebra import ZERO
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.judge._check import OpenVerdict, judgement, may_hold
from polhode.judge._notation import Notation
from polhode.judge._verdict import Verdict
from polhode.judge.latex._tree import Node
from polhode.judge.meaning._bindings import Bound
from polhode.judge.meaning._meaning import Meaning
from polhode.judge.meaning._mechanics import on_constraints
from polhode.judge.meaning._proposals import OWN
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.states._bound_claim import BoundClaim
from polhode.judge.text._in_force import Chosen
from polhode.judge.text._text_line import TextLine


@dataclass(frozen=True)
class JudgedLine:
    """A line with the judgement on it.

    Attributes:
        line: what was judged.
        judgement: in the context in which it holds, or else on every true motion.
        needs: a simple condition, not stated by the text, under which it holds.
        stated: what it is where it is stated rather than claimed: "defines k", "an assumption".
        is_assumed: whether it is an equation that lines after it may be drawn from.
        defines: letters to which it gives a meaning.
        is_open_value: whether it gives a number that depends on what the text has not stated.
        event: restrictions for the instant that it says a contact to end at.
        otherwise: a convention under which it would hold; empty for none.
    """

    line: TextLine
    judgement: OpenVerdict
    needs: str = ""
    stated: str = ""
    is_assumed: bool = False
    defines: Mapping[Node, Meaning] = field(default_factory=dict)
    is_open_value: bool = False
    event: tuple[BoundRelation, ...] = ()
    otherwise: str = ""

    @property
    def verdict(self) -> Verdict:
        """Without a correction."""
        return self.judgement.verdict

    @cached_property
    def bound(self) -> Bound | None:
        """Its statement with a meaning for every letter, in the reading kept; None without one."""
        notation = self.judgement.notation
        try:
            return None if notation is None else notation.bound(self.line.statement)
        except (PolhodeError, ZeroDivisionError):
            return None

    @cached_property
    def claim(self) -> BoundClaim | None:
        """The claim that it makes, in the reading that was kept; None where it makes none."""
        notation, bound = self.judgement.notation, self.bound
        try:
            return None if notation is None or bound is None else notation.claimed(bound)
        except (PolhodeError, ZeroDivisionError):
            return None


def may_define(verdict: Verdict, letter: Node) -> bool:
    """Whether one reading of a line takes a letter as the line itself defines it."""
    ways = (way.chosen.get(letter) for way in verdict.by_reading)
    return any(read is not None and read.meaning == OWN for read in ways)


def in_context(
    line: TextLine, equations: Equations, chosen: Chosen, context: str, latex: str = ""
) -> OpenVerdict:
    """The judgement on a line, or on another form of it."""
    try:
        return judgement(latex or line.latex, _notation(line, equations, chosen), context)
    except PolhodeError as error:
        return OpenVerdict(Verdict.unread(context, error))


def may_hold_in(
    line: TextLine, equations: Equations, chosen: Chosen, context: str, latex: str = ""
) -> bool:
    """Whether a line, or another form of it, may hold: a quick test before it is judged."""
    return may_hold(latex or line.latex, _notation(line, equations, chosen), context)


def holds_in(
    line: TextLine, equations: Equations, chosen: Chosen, context: str, latex: str = ""
) -> bool:
    """Whether a line, or another form of it, holds."""
    asked = (line, equations, chosen, context, latex)
    return may_hold_in(*asked) and in_context(*asked).verdict.holds


def _notation(line: TextLine, equations: Equations, chosen: Chosen) -> Callable[[Chosen], Notation]:
    return lambda more: line.in_force.notation(equations, {**chosen, **more})


def differs_by_a_constant(
    line: TextLine, equations: Equations, chosen: Chosen | None = None, latex: str = ""
) -> bool:
    """Whether the sides of an equation differ by what is constant, as after an integration.

    Of the equation of a line, or of another form of it.
    """
    relation = line.relation.relation
    if relation is None or relation.signs not in (("=",), ("≈",)):
        return False
    left, right = re.split(r"=|\\approx|\\simeq|≈", latex or line.latex, maxsplit=1)
    sign, context = (r"\approx", "limit") if line.in_force.small else ("=", "motion")
    change = rf"\frac{{d}}{{dt}}\left({left} - \left({right}\right)\right) {sign} 0"
    return holds_in(line, equations, chosen or {}, context, change)


def vanishes_at_rest(judged: JudgedLine, equations: Equations) -> bool:
    """Whether a line sets to zero what is zero at rest, as P = 0 does of a momentum."""
    still, claim = dict.fromkeys(equations.speeds, ZERO), judged.claim
    found = [] if claim is None else claim.components()
    with suppress(ArithmeticError):  # of a ratio of speeds
        return bool(found) and all(
            not c.right and not on_constraints(c.left, equations).subs(still) for c in found
        )
    return False

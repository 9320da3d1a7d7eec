"""The system for which a moment of inertia that a text states wrongly would be right."""

from __future__ import annotations

from copy import copy, deepcopy
from dataclasses import dataclass

from polhode.algebra import Expr, Matrix
from polhode.base import PolhodeError
from polhode.derive import Equations, derive
from polhode.judge.consequences._equations_of_text import Equation
from polhode.judge.consequences._open_letters import OpenLetters
from polhode.judge.contexts._contexts import holds
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.lines._weaker_meanings import weaker_meanings
from polhode.model import Body, System


@dataclass(frozen=True)
class WrongInertia:
    """A principal moment of inertia of a body, as a wrong line gives it.

    Attributes:
        right: as declared, kg m².
        stated: by the line.
    """

    right: Expr
    stated: Expr


def wrong_inertia(equation: Equation, letters: OpenLetters, system: System) -> WrongInertia | None:
    """The moment of inertia for which an equation gives another value; None if it does not."""
    if any(symbol.kind.varies for symbol in equation.symbols):
        return None
    for unknown in equation.unknowns.values():
        right = letters.values.get(unknown.symbol)
        if right is None or unknown.power > 1:
            continue
        if not any(right in row for body in system.bodies for row in body.inertia.rows):
            continue
        stated = letters.solved(equation.relation, unknown.symbol, unknown.slope)
        if stated is not None:
            return WrongInertia(right, stated)
    return None


def equations_with(system: System, wrong: tuple[WrongInertia, ...]) -> Equations | None:
    """The equations of the system with these moments of inertia; None where no body has them."""
    images = {each.right: each.stated for each in wrong}
    memo: dict[int, object] = {}
    for body in system.bodies:
        memo[id(body)] = _with_moments(body, images)
    try:
        return derive(deepcopy(system, memo))
    except PolhodeError:
        return None


def _with_moments(body: Body, images: dict[Expr, Expr]) -> Body:
    changed = copy(body)
    rows = [
        [images.get(entry, entry) if i == j else entry for j, entry in enumerate(row)]
        for i, row in enumerate(body.inertia.rows)
    ]
    object.__setattr__(changed, "inertia", Matrix.of(rows))
    return changed


def holds_with(equations: Equations, judged: JudgedLine) -> bool:
    """Whether a line holds for a system with other moments of inertia."""
    known = judged.judgement.notation
    if known is None:
        return False
    try:
        notation = judged.line.in_force.notation(equations, known.vocabulary.chosen)
        claim = notation.read_claim(judged.line.statement, {})
        weaker = (context for _, context in weaker_meanings(judged.line, equations))
        return any(holds(claim, context) for context in dict.fromkeys(("motion", *weaker)))
    except (PolhodeError, ArithmeticError):
        return False

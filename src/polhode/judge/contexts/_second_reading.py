"""A judged claim compared with a second, numeric reading of its letters."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice

import numpy as np

from polhode.algebra import as_symbol, time
from polhode.base import PolhodeError
from polhode.judge._verdict import Answer
from polhode.judge.balance._newton_euler import trial_of
from polhode.judge.balance._second_reader import Sides, read_members
from polhode.judge.contexts._counterexample import drawn_numbers
from polhode.judge.latex._tree import Node, PlusMinus, Statement, walk
from polhode.judge.states._bound_claim import BoundClaim
from polhode.judge.states._claim_domain import AnyState, TrueMotion

_KINDS: dict[str, type[AnyState] | type[TrueMotion]] = {"identity": AnyState, "motion": TrueMotion}
_DIFFERENT = 1e-4  # relative; another quantity, misread for the one meant, differs by far more
_EQUAL = 1e-9  # relative; rounding of the numeric reading
_STATES = 12  # for a claim that fails: sides may agree at a few, where all angles are positive


def disputed(
    answer: Answer,
    claim: BoundClaim,
    context: str,
    statement: Statement,
    defined: Mapping[Node, object],
    meant: Mapping[Node, str],
) -> str:
    """How a second reader contradicts a verdict; empty if it agrees or cannot read the claim.

    A claim judged true must not differ at any state; one judged false must not hold at all of them.

    Args:
        answer: of the verdict.
        claim: the claim, bound.
        context: where it is to hold.
        statement: the claim, as LaTeX was parsed.
        defined: letters that the text defines.
        meant: letters of several meanings, each with the quantity that it is read as.
    """
    if context not in _KINDS or any(isinstance(p, PlusMinus) for p in walk(statement)):
        return ""
    states = claim.states(_KINDS[context])
    sides = [e for c in claim.components() for e in (c.left, c.right)]
    if claim.initial.values and any(as_symbol(time) in side.symbols() for side in sides):
        return ""  # it is true at one instant of a motion only, and not at any state
    system = claim.equations.system
    count = 1 if answer is Answer.HOLDS else _STATES
    agreed: list[Sides] = []
    try:
        for numbers in islice(drawn_numbers(sides, states), count):
            trial = trial_of(system, numbers)
            with np.errstate(all="ignore"):
                found = list(read_members(statement, system, numbers, trial, defined, meant))
            known = [s for s in found if s is not None and s.is_known]
            if answer is Answer.HOLDS:
                return _described([s for s in known if s.differ_by > _DIFFERENT], "they differ")
            if len(known) < len(found) or any(s.differ_by > _EQUAL for s in known):
                return ""
            agreed += known
    except (PolhodeError, ArithmeticError, KeyError, np.linalg.LinAlgError):
        return ""
    return _described(agreed, "they agree, as at other states")


def _described(sides: list[Sides], what: str) -> str:
    if not sides:
        return ""
    left, right = (", ".join(f"{x:.9g}" for x in side) for side in (sides[0].left, sides[0].right))
    return f"a second reading of the letters gives {left} and {right} at one state: {what}"

"""A second reading of a claim that was judged: numbers from its letters on."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice

import numpy as np

from polhode.base import PolhodeError
from polhode.claims._verdict import Answer
from polhode.claims.balance._newton_euler import trial_of
from polhode.claims.balance._second_reader import Sides, read_members
from polhode.claims.contexts._counterexample import drawn_numbers
from polhode.claims.latex._tree import Name, Node, PlusMinus, Statement, walk
from polhode.claims.states._bound_claim import BoundClaim
from polhode.claims.states._claim_domain import AnyState, TrueMotion

_KINDS: dict[str, type[AnyState] | type[TrueMotion]] = {"identity": AnyState, "motion": TrueMotion}
_APART = 1e-4  # relative; what is meant by another quantity differs by far more
_ALIKE = 1e-9  # relative; rounding of a reading by numbers
_STATES = 3  # at which a claim that fails may not agree: a mass may happen to be 1


def disputed(
    answer: Answer,
    claim: BoundClaim,
    context: str,
    statement: Statement,
    defined: Mapping[Node, object],
    points: Mapping[Name, str],
) -> str:
    """Why a second reader does not agree with a verdict; empty where it does, or cannot read.

    Args:
        answer: of the verdict.
        claim: the claim, bound.
        context: where it is to hold.
        statement: the claim, as LaTeX was parsed.
        defined: letters that the text defines.
        points: the point that was taken, for moments that may be about several; empty for another
            letter of which one of several meanings was chosen.
    """
    if context not in _KINDS or any(isinstance(p, PlusMinus) for p in walk(statement)):
        return ""
    states = claim.states(_KINDS[context])
    sides = [e for c in claim.components() for e in (c.left, c.right)]
    system = claim.equations.system
    count = 1 if answer is Answer.HOLDS else _STATES
    agreed: list[Sides] = []
    try:
        for numbers in islice(drawn_numbers(sides, states), count):
            trial = trial_of(system, numbers)
            with np.errstate(all="ignore"):
                found = list(read_members(statement, system, numbers, trial, defined, points))
            known = [s for s in found if s is not None and s.is_known]
            if answer is Answer.HOLDS:
                return _described([s for s in known if s.differ_by > _APART], "they differ")
            if len(known) < len(found) or any(s.differ_by > _ALIKE for s in known):
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

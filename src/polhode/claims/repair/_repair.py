"""The smallest correction that makes a claim hold."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import chain, pairwise

from polhode.base import PolhodeError
from polhode.claims._dimensions import dimensions_at_odds
from polhode.claims.latex._tree import Statement
from polhode.claims.repair._at_limit import AtLimit
from polhode.claims.repair._exchanged import exchanged
from polhode.claims.repair._formal import is_empty, says_nothing
from polhode.claims.repair._one_by_one import JUDGED_WHOLE, one_by_one
from polhode.claims.repair._reading import RepairNotation
from polhode.claims.repair._repair_search import ENOUGH, STAGES, RepairSearch
from polhode.claims.repair._repaired import Repaired, smallest
from polhode.claims.repair._trials import FITTED
from polhode.claims.states._bound_claim import BoundClaim

Holds = Callable[[BoundClaim], bool]

_MOST_EDITS = 4


def repaired(
    statement: Statement, reading: RepairNotation, context: str, holds: Holds
) -> tuple[Repaired, ...]:
    """The smallest corrections, all of about the same size; none where none was found.

    Args:
        statement: the claim that fails.
        reading: how statements are read.
        context: where the claim is to hold.
        holds: exact judgement of a corrected claim.
    """
    if context in FITTED:
        return _fitted(statement, reading, context, holds)
    if context not in JUDGED_WHOLE:
        return ()
    asked = reading.asked(statement, {})
    if asked.small and all(small.order == 0 for small in asked.small):
        limit = AtLimit(reading, asked)
        found = _fitted(statement, limit, "motion", lambda changed: holds(limit.near(changed)))
        if found:
            return found
    return one_by_one(statement, reading, holds)


def _fitted(
    statement: Statement, reading: RepairNotation, context: str, holds: Holds
) -> tuple[Repaired, ...]:
    whole = Repaired(statement, ())
    starts = chain([whole], _exchanged(whole, reading, context))
    found = (_from(start, reading, context, holds) for start in starts)
    return next(filter(None, found), ())


def _exchanged(whole: Repaired, reading: RepairNotation, context: str) -> Iterator[Repaired]:
    """With sines and cosines of an angle exchanged, if less is wrong then."""
    before = RepairSearch(whole, reading, context).wrong
    for changes in exchanged(whole.statement):
        repair = whole.with_changes(changes)
        if RepairSearch(repair, reading, context).wrong < before:
            yield repair


def _from(
    repair: Repaired, reading: RepairNotation, context: str, holds: Holds
) -> tuple[Repaired, ...]:
    """The smallest corrections that begin with some changes."""
    for _ in range(_MOST_EDITS):
        workshop = RepairSearch(repair, reading, context)
        if not workshop.failing:
            return ()
        whole: list[Repaired] = []
        for found, enough in zip(workshop.corrected(workshop.failing), ENOUGH, strict=True):
            whole += [r for r in found if _sound(r, workshop.failing, reading, holds)]
            if any(r.size - repair.size < enough for r in whole):
                break
        if whole:
            return smallest(whole)
        first = _begun(workshop)
        if first is None:
            return ()
        repair = first
    return ()


def _begun(workshop: RepairSearch) -> Repaired | None:
    """Some of the members corrected: with one place changed if that can be, else with more."""
    pairs = [pair for pair in pairwise(workshop.failing) if pair[1] == pair[0] + 1]
    groups = [*pairs, *((member,) for member in workshop.failing)]
    stages = [workshop.corrected(group) for group in groups]
    found = (repairs for _ in range(STAGES) for stage in stages if (repairs := next(stage)))
    return next((repairs[0] for repairs in found), None)


def _tells(repair: Repaired, reading: RepairNotation) -> bool:
    """Whether it says more than that something is what it is."""
    inserted = [change.path for change in repair.changes if change.inserts]
    return not any(says_nothing(repair.statement, (p[0], p[1]), reading) for p in inserted)


def _sound(repair: Repaired, failing: Sequence[int], reading: RepairNotation, holds: Holds) -> bool:
    """Whether it holds, is of one dimension, and says something."""
    if is_empty(repair.statement) or not _tells(repair, reading):
        return False
    try:
        asked = reading.asked(repair.statement, {})
        if dimensions_at_odds(asked) or _cancels(repair, asked, failing):
            return False
        return holds(asked)
    except (PolhodeError, ArithmeticError):
        return False


def _cancels(repair: Repaired, asked: BoundClaim, failing: Sequence[int]) -> bool:
    """Whether what is brought in leaves nothing on both sides of a member."""
    if not any(change.inserts for change in repair.changes):
        return False
    sides = ((c.member, c.left or c.right) for c in asked.components())
    left = {member for member, rest in sides if rest}
    return any(member not in left for member in failing)

"""The smallest correction that makes a claim hold."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import chain, islice, pairwise

import numpy as np

from polhode.algebra import Vector
from polhode.base import PolhodeError
from polhode.claims._dimensions import dimensions_at_odds
from polhode.claims.latex._tree import Call, Cross, Dots, Name, Node, Number, Power, Statement, walk
from polhode.claims.repair._edits import (
    Edit,
    Repaired,
    edits,
    exchanged,
    replaced,
    smallest,
    turned,
)
from polhode.claims.repair._multiplier import Match
from polhode.claims.repair._numeric_evaluator import UNKNOWN, Figure, formed, scalar
from polhode.claims.repair._places import NodePosition, Side, places, raised, tidied
from polhode.claims.repair._repair_search import ENOUGH, STAGES, RepairSearch
from polhode.claims.repair._trials import FITTED, AtLimit, RepairNotation
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


# Corrections of claims that are judged as a whole: small changes, tried one by one.

#: Contexts in which there is no residual that could be fitted.
JUDGED_WHOLE = ("threshold", "limit", "number")

_MOST = 40
_NUMBERS = (Fraction(-1), Fraction(2), Fraction(1, 2), Fraction(4), Fraction(1, 4))


def one_by_one(
    statement: Statement, reading: RepairNotation, holds: Callable[[BoundClaim], bool]
) -> tuple[Repaired, ...]:
    """The smallest single changes with which a claim holds.

    Only what has one dimension is judged, and no more than some changes are.
    """
    whole = Repaired(statement, ())
    found = sorted((e for p in places(statement) for e in _changes(p, reading)), key=_size)
    tried = (whole.with_changes((edit,)) for edit in found)
    possible = ((r, asked) for r in tried if (asked := _possible(r, reading)) is not None)
    right: list[Repaired] = []
    for repair, asked in islice(possible, _MOST):
        if right and repair.size > right[0].size:
            break
        if _is_right(asked, holds):
            right.append(repair)
    return smallest(right) if right else ()


def _changes(place: NodePosition, reading: RepairNotation) -> Iterator[Edit]:
    node = place.node
    for number in _NUMBERS:
        yield from edits(place, Match(number))
    match node:
        case Power(base, Number(text)) if text.isdigit():
            for power in (int(text) + 1, int(text) - 1):
                yield Edit("wrong power", place.path, raised(base, power), 1.05)
        case Name() | Dots() if not isinstance(place.parent, Power):
            yield Edit("wrong power", place.path, raised(node, 2), 1.05)
    if isinstance(node, Dots):
        less = node.of if node.count == 1 else Dots(node.of, node.count - 1)
        yield replaced(place, less, 1.1)
    other = turned(node)
    if isinstance(node, Call) and other is not None:
        yield replaced(place, other, 1.1)
    if _is_scalar_letter(node) and not isinstance(place.parent, Dots):
        yield from (
            replaced(place, n, 1.3) for n in reading.names if (_is_scalar_letter(n) and n != node)
        )


def _is_scalar_letter(node: Node) -> bool:
    return isinstance(node, Dots) or (isinstance(node, Name) and not node.is_marked_vector)


def _possible(repair: Repaired, reading: RepairNotation) -> BoundClaim | None:
    """The claim it makes, if that is of one dimension."""
    try:
        asked = reading.asked(repair.statement, {})
        return None if dimensions_at_odds(asked) else asked
    except (PolhodeError, ArithmeticError):
        return None


def _is_right(asked: BoundClaim, holds: Callable[[BoundClaim], bool]) -> bool:
    try:
        return holds(asked)
    except (PolhodeError, ArithmeticError):
        return False


def _size(edit: Edit) -> float:
    return edit.size


# Whether a statement says anything: by its form alone, whatever its letters stand for.

_TRIALS = 3
_CLOSE = 1e-9


def is_empty(statement: Statement) -> bool:
    """Whether some member has the same on both sides, or a vector is crossed with itself."""
    sides = (tuple(map(tidied, relation.sides)) for relation in statement.relations)
    same = any(one == other for chain in sides for one, other in pairwise(chain))
    return same or any(isinstance(p, Cross) and p.left == p.right for p in walk(statement))


def says_nothing(statement: Statement, side: Side, reading: RepairNotation) -> bool:
    """Whether a side cancels, or is the same as one beside it, whatever its letters stand for."""
    relation, position = side
    sides = statement.relations[relation].sides
    beside = sides[max(position - 1, 0) : position] + sides[position + 1 : position + 2]
    drawn = _Drawn(reading)
    try:
        own = drawn.of(sides[position])
    except UNKNOWN:
        return False
    return np.abs(own.array).max() < _CLOSE or any(drawn.is_like(own, other) for other in beside)


class _Drawn:
    """Figures of nodes with random ones for letters, rates and whatever cannot be worked out."""

    def __init__(self, reading: RepairNotation) -> None:
        self._reading = reading
        self._random = np.random.default_rng(1)
        self._letters: dict[Node, Figure] = {}

    def of(self, node: Node) -> Figure:
        """The figure of a node."""
        if isinstance(node, Number):
            return scalar(np.full(_TRIALS, float(node.text)))
        inside = [part for part in node.parts if isinstance(part, Node)]
        try:
            return formed(node, [self.of(part) for part in inside])
        except UNKNOWN:
            if node not in self._letters:
                rank = 1 if isinstance(self._reading.value(node), Vector) else 0
                shape = (*(3,) * rank, 1, _TRIALS)
                self._letters[node] = Figure(rank, self._random.uniform(0.5, 2.0, shape))
            return self._letters[node]

    def is_like(self, one: Figure, node: Node) -> bool:
        """Whether a node has the same figure."""
        try:
            other = self.of(node)
        except UNKNOWN:
            return False
        return one.rank == other.rank and np.allclose(one.array, other.array, rtol=_CLOSE)

"""Corrections of claims that are judged as a whole: small changes, tried one by one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import islice

from polhode.base import PolhodeError
from polhode.claims._dimensions import dimensions_at_odds
from polhode.claims.latex._tree import Call, Dots, Name, Node, Number, Power, Statement
from polhode.claims.repair._edits import Edit, edits, replaced, turned
from polhode.claims.repair._multiplier import Match
from polhode.claims.repair._places import NodePosition, places, raised
from polhode.claims.repair._reading import RepairNotation
from polhode.claims.repair._repaired import Repaired, smallest
from polhode.claims.states._bound_claim import BoundClaim

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
        yield from (replaced(place, n, 1.3) for n in reading.names if _is_like(n, node))


def _is_scalar_letter(node: Node) -> bool:
    return isinstance(node, Dots) or (isinstance(node, Name) and not node.is_marked_vector)


def _is_like(other: Node, node: Node) -> bool:
    return _is_scalar_letter(other) and other != node


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

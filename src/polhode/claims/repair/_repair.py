"""The smallest correction that makes a claim hold."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from polhode.algebra import ZERO, Expr, Vector
from polhode.base import PolhodeError
from polhode.claims._asked import Asked
from polhode.claims._numeric import Array
from polhode.claims.latex._tree import (
    Call,
    Cross,
    Dots,
    Name,
    Node,
    Power,
    Product,
    Quotient,
    Statement,
    walk,
)
from polhode.claims.repair._edits import Edit, edits, letters, relabelled, replaced_by, turned
from polhode.claims.repair._missing import missing_terms
from polhode.claims.repair._multiplier import (
    Match,
    matches,
    multiplier,
    response,
    simple_numbers,
)
from polhode.claims.repair._own_terms import Response, fitted
from polhode.claims.repair._places import Place, places, put, tidied
from polhode.claims.repair._reading import Reading
from polhode.claims.repair._trials import Trials, trials

Holds = Callable[[Asked], bool]

_CLOSE = 1e-8
_EQUALLY_SMALL = 0.15
_TRIED = 12
_MOST_EDITS = 4
_MOST_INNER = 8


@dataclass(frozen=True)
class Repaired:
    """A corrected statement and the changes that were made."""

    statement: Statement
    changes: tuple[Edit, ...]

    @property
    def size(self) -> float:
        """How much was changed."""
        return sum(change.size for change in self.changes)


def repaired(
    statement: Statement, reading: Reading, context: str, holds: Holds
) -> tuple[Repaired, ...]:
    """The smallest corrections, all of about the same size; none where none was found.

    Args:
        statement: the claim that fails.
        reading: how statements are read.
        context: where the claim is to hold.
        holds: exact judgement of a corrected claim.
    """
    repair = Repaired(statement, ())
    for _ in range(_MOST_EDITS):
        workshop = _Workshop(repair, reading, context)
        if not workshop.failing:
            return ()
        found = workshop.corrected(workshop.failing)
        whole = [r for r in found if _sound(r, workshop.failing, reading, holds)]
        if whole:
            return _smallest(whole)
        first = workshop.corrected(workshop.failing[:1])
        if not first:
            return ()
        repair = first[0]
    return ()


def _sound(repair: Repaired, failing: Sequence[int], reading: Reading, holds: Holds) -> bool:
    if _says_nothing(repair.statement):
        return False
    grown = any(change.what == "missing term" for change in repair.changes)
    try:
        asked = reading.asked(repair.statement, {})
        cancelled = grown and any(_is_empty(asked, member) for member in failing)
        return not cancelled and holds(asked)
    except (PolhodeError, ArithmeticError):
        return False


def _is_empty(asked: Asked, member: int) -> bool:
    """Whether both sides of a member vanish by themselves."""
    sides = (c for c in asked.components() if c.member == member)
    return not any(c.left or c.right for c in sides)


def _says_nothing(statement: Statement) -> bool:
    """Whether some member has the same on both sides, or a vector is crossed with itself."""
    sides = (tuple(map(tidied, relation.sides)) for relation in statement.relations)
    same = any(one == other for chain in sides for one, other in pairwise(chain))
    return same or any(isinstance(p, Cross) and p.left == p.right for p in walk(statement))


def _smallest(found: Sequence[Repaired]) -> tuple[Repaired, ...]:
    ordered = sorted(found, key=lambda r: r.size)
    limit = ordered[0].size + _EQUALLY_SMALL
    kept = {tidied(r.statement): r for r in reversed(ordered) if r.size <= limit}
    return tuple(reversed(kept.values()))


class _Workshop:
    """One statement that fails, tried at many states."""

    def __init__(self, repair: Repaired, reading: Reading, context: str) -> None:
        self._repair = repair
        self._statement = repair.statement
        self._reading = reading
        self._asked = reading.asked(self._statement, {})
        self._tried: Trials = trials(self._asked, context)

    @cached_property
    def failing(self) -> tuple[int, ...]:
        """Members that do not hold at the states of the bench."""
        residuals = self._tried.residuals(self._asked)
        values = self._tried.bench.values([e for _, e in residuals])
        size = 1 + np.abs(values).max(initial=0.0)
        bad = np.abs(values).max(axis=1, initial=0.0) > _CLOSE * size
        return tuple(dict.fromkeys(m for (m, _), off in zip(residuals, bad, strict=True) if off))

    def corrected(self, targets: Sequence[int]) -> list[Repaired]:
        """Statements in which these members hold, and those that held before still do."""
        every = {member for member, _ in self._tried.residuals(self._asked)}
        kept = (every - set(self.failing)) | set(targets)
        open_ = {p: s for p in places(self._statement) if (s := self._side(p, targets)) is not None}
        responses = self._responses(open_, kept)
        found: list[tuple[Edit, ...]] = []
        found += [(edit,) for edit in self._single(open_, responses, kept)]
        if not found:
            found += fitted(responses, self._tried.bench.size)
            inner = [p for p, f in responses.items() if self._can_take_terms(p, f)][:_MOST_INNER]
            found += [(edit,) for target in targets for edit in self._missing(target, kept, inner)]
        smallest = sorted(map(self._applied, found), key=lambda repair: repair.size)
        return smallest[:_TRIED]

    def _applied(self, changes: Sequence[Edit]) -> Repaired:
        changed = self._statement
        for edit in changes:
            changed = put(changed, edit.path, edit.node)
        return Repaired(changed, (*self._repair.changes, *changes))

    def _responses(self, open_: Iterable[Place], kept: set[int]) -> dict[Place, Response]:
        """How the residuals change with a factor at every place."""
        found = {p: response(self._statement, p, self._reading, self._tried, kept) for p in open_}
        return {place: function for place, function in found.items() if function is not None}

    def _single(
        self, open_: Mapping[Place, float], responses: Mapping[Place, Response], kept: set[int]
    ) -> Iterator[Edit]:
        for place, extra in open_.items():
            for edit in self._at(place, responses.get(place), kept):
                yield replace(edit, size=edit.size + extra)

    def _at(self, place: Place, function: Response | None, kept: set[int]) -> Iterator[Edit]:
        node = place.node
        if isinstance(node, Name | Dots) and self._vocabulary.get(node, ZERO) is None:
            yield from self._vectors(place, kept)
        if function is None:
            return
        for number in simple_numbers(function, self._tried.bench.size):
            yield from edits(place, Match(number))
        factor = multiplier(function, self._tried.bench.size)
        if factor is not None:
            for match in matches(factor, self._known):
                yield from edits(place, match)
            yield from self._exchanged(place, factor)

    def _missing(self, target: int, kept: set[int], inner: Collection[Place]) -> Iterator[Edit]:
        sides = self._sides(target)
        yield from missing_terms(self._statement, sides, self._reading, self._tried, kept, inner)

    def _can_take_terms(self, place: Place, function: Response) -> bool:
        """Whether it is a factor or the like, and could be made right by another value."""
        if not isinstance(place.parent, Product | Quotient | Power | Call):
            return False
        return multiplier(function, self._tried.bench.size) is not None

    def _exchanged(self, place: Place, factor: Array) -> Iterator[Edit]:
        """Other letters whose value is what the place would have to be."""
        known = dict(self._known)
        if place.node in known:
            wanted = factor * known[place.node]
            fitting = {n: True for n, v in self._known if np.allclose(v, wanted, rtol=_CLOSE)}
            yield from replaced_by(place, fitting)

    def _vectors(self, place: Place, kept: set[int]) -> Iterator[Edit]:
        """Other vectors put in the place of one, tried one by one."""
        for edit in replaced_by(place, dict.fromkeys(self._other_vectors, True)):
            changed = put(self._statement, edit.path, edit.node)
            try:
                residuals = self._tried.residuals(self._reading.asked(changed, {}))
                values = self._tried.bench.values([e for m, e in residuals if m in kept])
            except (PolhodeError, ArithmeticError, KeyError):
                continue
            if len(values) and np.abs(values).max() < _CLOSE * 1e2:
                yield edit

    @cached_property
    def _vocabulary(self) -> dict[Node, Expr | None]:
        """Letters of the claim and of the text, and the scalars they stand for."""
        own = [n for place in places(self._statement) for n in letters(place.node)]
        turns = [t for n in own if (t := turned(n)) is not None]
        indexed = [other for n in own for other in relabelled(n)]
        wide = [*own, *turns, *indexed, *self._reading.names]
        return {node: self._scalar(node) for node in dict.fromkeys(wide)}

    def _scalar(self, node: Node) -> Expr | None:
        try:
            value = self._reading.value(node)
        except (PolhodeError, ArithmeticError):
            return None
        return value if isinstance(value, Expr) and value else None

    @cached_property
    def _known(self) -> list[tuple[Node, Array]]:
        scalars = {n: e for n, e in self._vocabulary.items() if e is not None}
        found = []
        for node, expression in scalars.items():
            try:
                (values,) = self._tried.bench.values([expression])
            except (KeyError, PolhodeError, ArithmeticError, ValueError):
                continue
            if np.isfinite(values).all() and values.all():
                found.append((node, values))
        return found

    @cached_property
    def _other_vectors(self) -> list[Node]:
        named = (n for n, e in self._vocabulary.items() if e is None and isinstance(n, Name | Dots))
        return [n for n in named if not self._vanishes(n)]

    def _vanishes(self, node: Node) -> bool:
        """Whether a vector is zero in these circumstances, so that it can stand for anything."""
        try:
            value = self._reading.value(node)
        except (PolhodeError, ArithmeticError):
            return True
        return isinstance(value, Vector) and not any(map(self._tried.states.on, value.components))

    # -- which sides a member relates -----------------------------------------------------------

    @cached_property
    def _pairs(self) -> list[tuple[int, int]]:
        """Relation and left side of every member."""
        relations = enumerate(self._statement.relations)
        return [(i, k) for i, r in relations if r.is_claim for k in range(len(r.signs))]

    def _sides(self, member: int) -> tuple[tuple[int, int], ...]:
        """Paths of both sides of a member."""
        if member >= len(self._pairs):
            return ()
        relation, left = self._pairs[member]
        return (relation, left), (relation, left + 1)

    def _side(self, place: Place, targets: Sequence[int]) -> float | None:
        """What it costs to change this side for these members: the later one is the cheaper."""
        for member in targets:
            sides = self._sides(member)
            if place.path[:2] in sides:
                return 0.02 if place.path[:2] == sides[0] else 0.0
        return None

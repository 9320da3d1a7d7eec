"""The smallest correction that makes a claim hold."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from polhode.algebra import ZERO, Expr, Symbol, Vector
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
from polhode.claims.repair._figures import scalar
from polhode.claims.repair._links import Links
from polhode.claims.repair._missing import missing_terms
from polhode.claims.repair._multiplier import (
    Match,
    Response,
    matches,
    multiplier,
    simple_numbers,
)
from polhode.claims.repair._own_terms import fitted
from polhode.claims.repair._places import Place, places, put, tidied, times
from polhode.claims.repair._reading import Reading
from polhode.claims.repair._tally import UNKNOWN, Tally
from polhode.claims.repair._trials import Trials, trials
from polhode.claims.repair._workpiece import Workpiece

Holds = Callable[[Asked], bool]
Changing = Callable[[Array], Array]

_FACTOR = Symbol("multiplier")
_LETTER = "multiplier"

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
        self._links = Links(self._statement, self._asked)
        bench = self._tried.bench
        self._tally = Tally(self._statement, self._asked, self._links, reading, bench)
        self._work = Workpiece(self._statement, reading, self._tried, self._tally)

    @cached_property
    def _members(self) -> list[int]:
        """The member that each residual belongs to."""
        return [member for member, _ in self._residuals]

    @cached_property
    def _residuals(self) -> list[tuple[int, Expr]]:
        return self._tried.residuals(self._asked)

    @cached_property
    def _values(self) -> Array:
        return self._tried.bench.values([e for _, e in self._residuals])

    @cached_property
    def failing(self) -> tuple[int, ...]:
        """Members that do not hold at the states of the bench."""
        size = 1 + np.abs(self._values).max(initial=0.0)
        bad = np.abs(self._values).max(axis=1, initial=0.0) > _CLOSE * size
        return tuple(dict.fromkeys(m for m, off in zip(self._members, bad, strict=True) if off))

    def corrected(self, targets: Sequence[int]) -> list[Repaired]:
        """Statements in which these members hold, and those that held before still do."""
        kept = (frozenset(self._members) - set(self.failing)) | set(targets)
        open_ = [p for p in places(self._statement) if self._links.cost(p, targets) is not None]
        found: list[tuple[Edit, ...]] = []
        responses = {p: r for p in open_ if (r := self._response(p, kept)) is not None}
        able = [p for p in open_ if self._links.members(p).issuperset(targets)]
        for place in able:
            cost = self._links.cost(place, targets) or 0.0
            fitting = self._at(place, responses.get(place), kept)
            found += [(replace(edit, size=edit.size + cost),) for edit in fitting]
        if not found:
            found += fitted(responses)
            inner = [p for p in able if p in responses and self._can_take_terms(p, responses[p])]
            found += [(edit,) for edit in self._missing(able, kept, inner[:_MOST_INNER])]
        smallest = sorted(map(self._applied, found), key=lambda repair: repair.size)
        return smallest[:_TRIED]

    def _applied(self, changes: Sequence[Edit]) -> Repaired:
        changed = self._statement
        for edit in changes:
            changed = put(changed, edit.path, edit.node)
        return Repaired(changed, (*self._repair.changes, *changes))

    def _response(self, place: Place, kept: Collection[int]) -> Response | None:
        """How the residuals of these members change with a factor at a place."""
        members = sorted(self._links.members(place) & set(kept))
        of_kept = [i for i, m in enumerate(self._members) if m in kept]
        rows = tuple(k for k, i in enumerate(of_kept) if self._members[i] in members)
        if not rows:
            return None
        for changing in (self._by_numbers, self._exactly):
            try:
                found = Response(changing(place, members), rows, self._values[of_kept])
                if found.is_faithful:
                    return found
            except UNKNOWN:
                continue
        return None

    def _by_numbers(self, place: Place, members: Sequence[int]) -> Changing:
        known = self._tally.of(place.node)
        return lambda factors: self._tally.rows(place, scalar(factors) * known, members)

    def _exactly(self, place: Place, members: Collection[int]) -> Changing:
        changed = put(self._statement, place.path, times(Name(_LETTER), place.node))
        asked = self._reading.asked(changed, {_LETTER: Expr.generator(_FACTOR)})
        return self._tried.bench.function(self._tried.left(asked, members), _FACTOR)

    def _at(self, place: Place, response: Response | None, kept: Collection[int]) -> Iterator[Edit]:
        node = place.node
        if isinstance(node, Name | Dots) and self._vocabulary.get(node, ZERO) is None:
            yield from self._vectors(place, kept)
        if response is None:
            return
        for number in simple_numbers(response):
            yield from edits(place, Match(number))
        factor = multiplier(response)
        if factor is not None:
            for match in matches(factor, self._known):
                yield from edits(place, match)
            yield from self._exchanged(place, factor)

    def _missing(
        self, able: Sequence[Place], kept: Collection[int], inner: Collection[Place]
    ) -> Iterator[Edit]:
        for place in able:
            members = sorted(self._links.members(place) & set(kept))
            yield from missing_terms(self._work, place, members, inner)

    def _can_take_terms(self, place: Place, response: Response) -> bool:
        """Whether it is a factor or the like, and could be made right by another value."""
        if not isinstance(place.parent, Product | Quotient | Power | Call):
            return False
        return multiplier(response) is not None

    def _exchanged(self, place: Place, factor: Array) -> Iterator[Edit]:
        """Other letters whose value is what the place would have to be."""
        known = dict(self._known)
        if place.node in known:
            wanted = factor * known[place.node]
            fitting = {n: True for n, v in self._known if np.allclose(v, wanted, rtol=_CLOSE)}
            yield from replaced_by(place, fitting)

    def _vectors(self, place: Place, kept: Collection[int]) -> Iterator[Edit]:
        """Other vectors put in the place of one."""
        others = [n for n in self._other_vectors if n != place.node]
        members = sorted(self._links.members(place) & set(kept))
        fitting = self._work.fitting(place, others, members)
        yield from replaced_by(place, dict.fromkeys(fitting, True))

    @cached_property
    def _vocabulary(self) -> dict[Node, Expr | None]:
        """Letters of the claim and of the text, and the scalars they stand for."""
        own = [n for place in places(self._statement) for n in letters(place.node)]
        turns = [t for n in own if (t := turned(n)) is not None]
        indexed = [other for n in own for other in relabelled(n)]
        wide = [*own, *turns, *indexed, *self._reading.names]
        return {node: self._scalar(node) for node in dict.fromkeys(wide)}

    def _scalar(self, node: Node) -> Expr | None:
        value = self._work.value(node)
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
        bold = (n for n in named if isinstance(self._work.value(n), Vector))
        return [n for n in bold if not self._work.vanishes(n)]

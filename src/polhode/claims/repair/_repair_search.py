"""One statement that fails, tried at many states: what could be changed for it to hold."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import combinations, product

import numpy as np

from polhode.algebra import ZERO, Expr, Symbol
from polhode.claims.latex._tree import (
    Call,
    Dots,
    Name,
    Number,
    Piece,
    Power,
    Product,
    Quotient,
    Statement,
)
from polhode.claims.repair._edits import (
    Edit,
    Repaired,
    dotted,
    edits,
    emptied,
    replaced,
    replaced_by,
)
from polhode.claims.repair._missing_terms import may_be_rewritten, missing_terms, rewritten
from polhode.claims.repair._multiplier import Match, Response, simple_number, simple_numbers
from polhode.claims.repair._numeric_evaluator import UNKNOWN, NumericEvaluator, scalar
from polhode.claims.repair._places import Links, NodePosition, places, put, tidied, times
from polhode.claims.repair._repair_context import RepairContext
from polhode.claims.repair._trials import RepairNotation, Trials, trials
from polhode.claims.states._numeric import Array

Changing = Callable[[Array], Array]

#: How many sorts of changes are tried in turn, and from which size on the next sort may be smaller.
STAGES = 3
ENOUGH = (1.9, 2.15, 99.0)

_FACTOR = Symbol("multiplier")
_LETTER = "multiplier"

_CLOSE = 1e-8
_TRIED = 12
_MOST_INNER = 8
_MOST_COMPONENTS = 3
_MOST_EDITS_EACH = 3


class RepairSearch:
    """One statement that fails, tried at many states."""

    def __init__(self, repair: Repaired, reading: RepairNotation, context: str) -> None:
        self._repair = repair
        self._statement = repair.statement
        self._reading = reading
        self._asked = reading.asked(self._statement, {})
        self._tried: Trials = trials(self._asked, context)
        self._links = Links(self._statement, self._asked)
        bench = self._tried.bench
        self._tally = NumericEvaluator(self._statement, self._asked, self._links, reading, bench)
        self._responses: dict[NodePosition, Response | None] = {}
        self._work = RepairContext(self._statement, reading, self._tried, self._tally)

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
        bad = zip(self._members, self._is_wrong, strict=True)
        return tuple(dict.fromkeys(member for member, wrong in bad if wrong))

    @property
    def wrong(self) -> int:
        """How many residuals differ from nothing."""
        return sum(self._is_wrong)

    @cached_property
    def _is_wrong(self) -> list[bool]:
        """Whether each residual differs from nothing at the states of the bench."""
        size = 1 + np.abs(self._values).max(initial=0.0)
        return list(np.abs(self._values).max(axis=1, initial=0.0) > _CLOSE * size)

    def corrected(self, targets: Sequence[int]) -> Iterator[list[Repaired]]:
        """Statements in which these members hold, and those that held before still do.

        First those with one place changed, then those with several, or with a term more, and then
        those in which a whole expression is another; `STAGES` in all.
        """
        kept = (frozenset(self._members) - set(self.failing)) | set(targets)
        open_ = [p for p in places(self._statement) if self._links.cost(p, targets) is not None]
        able = [p for p in open_ if self._links.members(p).issuperset(targets)]
        responses = {p: r for p in able if (r := self._response(p, kept)) is not None}
        costs = {p: self._links.cost(p, targets) or 0.0 for p in able}
        yield self._ranked(
            (replace(edit, size=edit.size + costs[place]),)
            for place in able
            for edit in self._at(place, responses.get(place), kept)
        )
        inner = [p for p in able if p in responses and self._can_take_terms(p, responses[p])]
        missing = (
            (replace(edit, size=edit.size + costs[place]),)
            for place in able
            for edit in self._missing(place, kept, inner[:_MOST_INNER])
        )
        chains = {side[0] for target in targets for side in self._links.sides(target)}
        others = [p for p in places(self._statement) if p.relation in chains and p not in able]
        whole = responses | {p: r for p in others if (r := self._response(p, kept)) is not None}
        several = [*self._throughout(kept), *self._along_components(responses, targets, kept)]
        yield self._ranked([*several, *map(self._late, fitted(whole)), *missing])
        yield self._ranked(
            (replace(edit, size=edit.size + costs[place]),)
            for place, response in responses.items()
            if may_be_rewritten(place) and response.multiplier is not None
            for edit in rewritten(self._work, place, self._within(place, kept))
        )

    def _along_components(
        self,
        responses: Mapping[NodePosition, Response],
        targets: Collection[int],
        kept: Collection[int],
    ) -> Iterator[tuple[Edit, ...]]:
        """One place changed for each wrong component of a vector, where none mends them all."""
        rows = [i for i, m in enumerate(self._members) if m in kept]
        wrong = [k for k, i in enumerate(rows) if self._members[i] in targets and self._is_wrong[i]]
        if not 1 < len(wrong) <= _MOST_COMPONENTS:
            return
        apart = {p: r for p, r in responses.items() if len(r.moved) == 1}
        options = []
        for row in wrong:
            alone = ((p, r.among([row])) for p, r in apart.items() if r.moved == (row,))
            found = [edit for p, r in alone if r for edit in self._scaled(p, r)]
            options.append(sorted(found, key=lambda edit: edit.size)[:_MOST_EDITS_EACH])
        yield from product(*options)

    def _late(self, changes: tuple[Edit, ...]) -> tuple[Edit, ...]:
        """Changes of earlier sides of a chain are the dearer ones."""
        last = [len(self._statement.relations[change.path[0]].sides) for change in changes]
        extra = [0.02 * (n - change.path[1]) for n, change in zip(last, changes, strict=True)]
        return tuple(replace(c, size=c.size + e) for c, e in zip(changes, extra, strict=True))

    def _throughout(self, kept: Collection[int]) -> Iterator[tuple[Edit, ...]]:
        """One slip made everywhere: what is differentiated by has lost its dot."""
        found = [p for p in places(self._statement) if p.is_variable]
        for letter in dict.fromkeys(p.node for p in found):
            alike = [p for p in found if p.node == letter]
            changes = tuple(replaced(p, dotted(p.node), 1 / len(alike)) for p in alike)
            if self._hold(self._repair.with_changes(changes).statement, kept):
                yield changes

    def _hold(self, changed: Statement, kept: Collection[int]) -> bool:
        try:
            left = self._tried.left(self._reading.asked(changed, {}), kept)
            return bool(np.abs(self._tried.bench.values(left)).max(initial=0.0) < _CLOSE * 1e2)
        except UNKNOWN:
            return False

    def _ranked(self, found: Iterable[tuple[Edit, ...]]) -> list[Repaired]:
        different: dict[Piece, Repaired] = {}
        for changes in sorted(found, key=lambda changes: sum(c.size for c in changes)):
            repair = self._repair.with_changes(changes)
            different.setdefault(tidied(repair.statement), repair)
            if len(different) == _TRIED:
                break
        return list(different.values())

    def _response(self, place: NodePosition, kept: Collection[int]) -> Response | None:
        """How the residuals of these members change with a factor at a place."""
        if place not in self._responses:
            self._responses[place] = self._found_response(place)
        found = self._responses[place]
        return found and found.among([i for i, m in enumerate(self._members) if m in kept])

    def _found_response(self, place: NodePosition) -> Response | None:
        members = sorted(self._links.members(place))
        rows = tuple(i for i, m in enumerate(self._members) if m in members)
        if not rows:
            return None
        for changing in (self._by_numbers, self._exactly):
            try:
                found = Response(changing(place, members), rows, self._values)
                if found.is_faithful:
                    return found
            except UNKNOWN:
                continue
        return None

    def _by_numbers(self, place: NodePosition, members: Sequence[int]) -> Changing:
        known = self._tally.of(place.node)
        return lambda factors: self._tally.rows(place, scalar(factors) * known, members)

    def _exactly(self, place: NodePosition, members: Collection[int]) -> Changing:
        changed = put(self._statement, place.path, times(Name(_LETTER), place.node))
        asked = self._reading.asked(changed, {_LETTER: Expr.generator(_FACTOR)})
        return self._tried.bench.function(self._tried.left(asked, members), _FACTOR)

    def _at(
        self, place: NodePosition, response: Response | None, kept: Collection[int]
    ) -> Iterator[Edit]:
        node = place.node
        if isinstance(node, Name | Dots) and self._work.vocabulary.get(node, ZERO) is None:
            # Other vectors put in the place of one.
            others = [n for n in self._work.other_vectors if n != place.node]
            fitting = self._work.fitting(place, others, self._within(place, kept))
            yield from replaced_by(place, dict.fromkeys(fitting, True))
        if response is not None:
            yield from self._scaled(place, response)
            if place.is_side and 0 in set(simple_numbers(response)):
                yield from (
                    e
                    for e in emptied(place)
                    if self._hold(self._repair.with_changes((e,)).statement, kept)
                )

    def _scaled(self, place: NodePosition, response: Response) -> Iterator[Edit]:
        """What a place multiplied by a factor makes right."""
        for number in simple_numbers(response):
            yield from edits(place, Match(number))
        factor = response.multiplier
        if factor is not None:
            for match in self._work.products.short(factor):
                yield from edits(place, match)
            # Other letters whose value is what the place would have to be.
            known = dict(self._work.known)
            if place.node in known:
                wanted = factor * known[place.node]
                close = np.abs(self._work.figures - wanted) <= _CLOSE * (1 + np.abs(wanted))
                fitting = [self._work.known[i][0] for i in np.flatnonzero(close.all(axis=1))]
                yield from replaced_by(place, dict.fromkeys(fitting, True))

    def _missing(
        self, place: NodePosition, kept: Collection[int], inner: Collection[NodePosition]
    ) -> Iterator[Edit]:
        return missing_terms(self._work, place, self._within(place, kept), inner)

    def _within(self, place: NodePosition, kept: Collection[int]) -> list[int]:
        """Those of some members that a place is part of."""
        return sorted(self._links.members(place) & set(kept))

    def _can_take_terms(self, place: NodePosition, response: Response) -> bool:
        """Whether it is a factor or the like, and could be made right by another value."""
        if not isinstance(place.parent, Product | Quotient | Power | Call):
            return False
        return response.multiplier is not None


# Several coefficients of a claim's own terms, fitted together.

_INDEPENDENT = 1e-10
_MOST_TOGETHER = 3
_MOST_PLACES = 24


def fitted(responses: Mapping[NodePosition, Response]) -> Iterator[tuple[Edit, ...]]:
    """Sets of two or three changes of numbers or signs that together let a claim hold.

    Args:
        responses: how what must vanish changes with a factor put at each place.
    """
    places = [p for p in responses if p.is_term or isinstance(p.node, Number)]
    slopes = {p: s.ravel() for p in places if (s := responses[p].slope()) is not None}
    if not slopes:
        return
    tried = list(slopes)[:_MOST_PLACES]
    rest = next(iter(responses.values())).before.ravel()
    for together in range(2, _MOST_TOGETHER + 1):
        found = False
        for chosen, factors in _solutions(rest, np.array([slopes[p] for p in tried]), together):
            where = [tried[i] for i in chosen]
            # Whether no place is inside another.
            apart = not any(
                a.path[: len(b.path)] == b.path or b.path[: len(a.path)] == a.path
                for a, b in combinations(where, 2)
            )
            if apart:
                found = True
                options = [list(edits(p, match)) for p, match in zip(where, factors, strict=True)]
                if all(options):
                    yield tuple(min(each, key=lambda edit: edit.size) for each in options)
        if found:
            return


def _solutions(
    rest: Array, slopes: Array, together: int
) -> Iterator[tuple[tuple[int, ...], list[Match]]]:
    """Which slopes, with which factors, bring the rest to nothing; all sets are tried at once."""
    sets = list(combinations(range(len(slopes)), together))
    if not sets or together > len(rest):
        return
    bases, triangles = np.linalg.qr(np.moveaxis(slopes[np.array(sets)], 1, 2))
    shares = np.einsum("snk,n->sk", bases, -rest)
    left = np.abs(np.einsum("snk,sk->sn", bases, shares) + rest).max(axis=1)
    sizes = np.abs(np.diagonal(triangles, axis1=1, axis2=2))
    apart = sizes.min(axis=1) > _INDEPENDENT * sizes.max(axis=1)
    for i in np.flatnonzero(apart & (left <= _CLOSE * np.abs(rest).max())):
        change = np.linalg.solve(triangles[i], shares[i])
        numbers = [simple_number(np.array([1 + x])) for x in change]
        factors = [Match(n) for n in numbers if n is not None and n != 1]
        if len(factors) == together:
            yield sets[i], factors

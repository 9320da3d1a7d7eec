"""Search for the changes with which a statement that fails would hold at sample points."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property, partial
from itertools import combinations, islice, product, tee

import numpy as np

from polhode.algebra import ZERO, Expr, Symbol
from polhode.judge.latex._tree import (
    Call,
    Dots,
    Name,
    Negative,
    Node,
    Number,
    Piece,
    Power,
    Product,
    Quotient,
    walk,
)
from polhode.judge.repair._edits import (
    Edit,
    Repaired,
    bare,
    dotted,
    edits,
    emptied,
    replaced,
    replaced_by,
)
from polhode.judge.repair._missing_terms import may_be_rewritten, missing_terms, rewritten
from polhode.judge.repair._multiplier import Match, Response, simple_number, simple_numbers
from polhode.judge.repair._numeric_evaluator import NumericEvaluator, scalar
from polhode.judge.repair._places import MemberSides, NodePosition, places, put, tidied, times
from polhode.judge.repair._repair_context import RepairContext
from polhode.judge.repair._small_changes import (
    SmallChanges,
    is_scalar_letter,
    small_changes,
)
from polhode.judge.repair._trials import RepairNotation, trials
from polhode.judge.states._numeric import NO_VALUE, Array

Changing = Callable[[Array], Array]

#: Number of stages, each of which tries larger changes.
STAGES = 4
#: For each stage, the size below which a correction cannot be undercut by the stages after it.
ENOUGH = (1.55, 1.55, 2.15, 99.0)

_FACTOR = Symbol("multiplier")
_LETTER = "multiplier"

_CLOSE = 1e-8  # relative; values in doubles at sample points
_INDEPENDENT = 1e-10  # ratio of pivots below which slopes are dependent
_MOST_CANDIDATES = 12
_MOST_INNER = 8
_MOST_SWAPPED = 60  # pairs of letters
_SWAP = 1.3  # size of the exchange of two letters
_MOST_EXACT_TRIALS = 80  # of small changes that numbers alone cannot judge
_MOST_COMPONENTS = 3
_MOST_EDITS_EACH = 3
_MOST_TOGETHER = 3
_MOST_PLACES = 24


class RepairSearch:
    """Candidates for the correction of one statement, found from its residuals at sample points.

    Args:
        repair: the statement, perhaps with some changes already.
        notation: how statements are read.
        context: where it is to hold, such as ``motion``.
    """

    def __init__(self, repair: Repaired, notation: RepairNotation, context: str) -> None:
        self._repair = repair
        self._statement = statement = repair.statement
        self._places = tuple(places(statement))
        self._notation = notation
        self._claim = claim = notation.read_claim(statement, {})
        self._trials = trials(claim, context)
        self._samples = self._trials.samples
        self._sides = MemberSides(statement, claim)
        self._evaluator = NumericEvaluator(statement, claim, self._sides, notation, self._samples)
        self._responses: dict[NodePosition, Response | None] = {}
        self._stages: dict[tuple[int, ...], Iterator[list[Repaired]]] = {}
        self._exact_trials_left = _MOST_EXACT_TRIALS
        self._context = RepairContext(statement, notation, self._trials, self._evaluator)

    # -- what is wrong ---------------------------------------------------------------------------

    @cached_property
    def _residuals(self) -> list[tuple[int, Expr]]:
        return self._trials.residuals(self._claim)

    @cached_property
    def _members(self) -> list[int]:
        """The member that each residual belongs to."""
        return [member for member, _ in self._residuals]

    @cached_property
    def _values(self) -> Array:
        """The residuals: (residuals, states)."""
        return self._samples.values([e for _, e in self._residuals])

    @cached_property
    def _is_wrong(self) -> list[bool]:
        """Whether each residual differs from zero at the sample points, beyond rounding."""
        size = 1 + np.abs(self._values).max(initial=0.0)
        return list(np.abs(self._values).max(axis=1, initial=0.0) > _CLOSE * size)

    @property
    def wrong(self) -> int:
        """How many residuals differ from zero."""
        return sum(self._is_wrong)

    @cached_property
    def failing(self) -> tuple[int, ...]:
        """Members of the claim that do not hold at the sample points."""
        bad = zip(self._members, self._is_wrong, strict=True)
        return tuple(dict.fromkeys(member for member, wrong in bad if wrong))

    # -- candidates ------------------------------------------------------------------------------

    def corrected(self, targets: tuple[int, ...]) -> Iterator[list[Repaired]]:
        """Statements in which these members hold, and those that held before still do.

        One list for each of the `STAGES`, which is kept: one place changed by the factor that it
        needs; one place changed in any small way; several places changed or a term added; a whole
        expression rewritten.
        """
        stages = self._stages.get(targets) or self._searched(targets)
        self._stages[targets], found = tee(stages)
        return found

    def _searched(self, targets: Sequence[int]) -> Iterator[list[Repaired]]:
        kept = (frozenset(self._members) - set(self.failing)) | set(targets)
        on_sides = [p for p in self._places if self._sides.cost(p, targets) is not None]
        eligible = [p for p in on_sides if self._sides.members(p).issuperset(targets)]
        responses = {p: r for p in eligible if (r := self._response(p, kept)) is not None}
        costs = {p.path: self._sides.cost(p, targets) or 0.0 for p in eligible}
        yield self._ranked(
            (replace(edit, size=edit.size + costs[place.path]),)
            for place in eligible
            for edit in self._at(place, responses.get(place), kept)
        )
        yield self._ranked(
            (replace(edit, size=edit.size + costs[place.path]),)
            for place in eligible
            for edit in self._slips(place, kept)
        )
        # A factor or an argument can be short of a term only if some other value corrects it.
        inner = {
            place: response.multiplier
            for place, response in responses.items()
            if isinstance(place.parent, Product | Quotient | Power | Call)
            and response.multiplier is not None
        }
        inner = dict(islice(inner.items(), _MOST_INNER))
        missing = (
            (replace(edit, size=edit.size + costs[place.path]),)
            for place in eligible
            if self._small.is_homogeneous is not False  # else no further term makes it so
            for edit in missing_terms(self._context, place, self._within(place, kept), inner)
        )
        chains = {side[0] for target in targets for side in self._sides.sides(target)}
        beside = (p for p in self._places if p.path not in costs)
        others = [p for p in beside if p.relation in chains]
        whole = responses | {p: r for p in others if (r := self._response(p, kept)) is not None}
        several = [
            *self._throughout(kept),
            *self._swapped(eligible, kept),
            *self._along_components(responses, targets, kept),
        ]
        yield self._ranked([*several, *map(self._preferring_later_sides, fitted(whole)), *missing])
        yield self._ranked(
            (replace(edit, size=edit.size + costs[place.path]),)
            for place, response in responses.items()
            if self._small.is_homogeneous is not False
            and may_be_rewritten(place)
            and response.multiplier is not None
            for edit in rewritten(self._context, place, self._within(place, kept))
        )

    def _ranked(self, found: Iterable[tuple[Edit, ...]]) -> list[Repaired]:
        """The smallest distinct statements that sets of changes lead to."""
        different: dict[Piece, Repaired] = {}
        for changes in sorted(found, key=lambda changes: sum(c.size for c in changes)):
            repair = self._repair.with_changes(changes)
            different.setdefault(tidied(repair.statement), repair)
            if len(different) == _MOST_CANDIDATES:
                break
        return list(different.values())

    def _at(
        self, place: NodePosition, response: Response | None, kept: Collection[int]
    ) -> Iterator[Edit]:
        """Single changes of a place that make the kept members hold."""
        node = place.node
        if isinstance(node, Name | Dots) and self._context.vocabulary.get(node, ZERO) is None:
            others = [n for n in self._context.other_vectors if n != node]
            fitting = self._context.fitting(place, others, self._within(place, kept))
            yield from replaced_by(place, fitting)
        if response is not None:
            yield from self._scaled(place, response)
            is_number = all(isinstance(p, Number | Negative) for p in walk(place.node))
            may_vanish = is_number or self._small.is_homogeneous is not False
            if place.is_side and may_vanish and 0 in set(simple_numbers(response)):
                for edit in emptied(place):
                    if self._holds((edit,), kept):
                        yield edit

    def _slips(self, place: NodePosition, kept: Collection[int]) -> Iterator[Edit]:
        """Small changes of a place that make the kept members hold."""
        found: dict[Node, Edit] = {}
        for edit in self._small.at(place):
            if edit.node not in found or edit.size < found[edit.node].size:
                found[edit.node] = edit
        nodes = [node for node in found if self._context.has_value(node)]
        members = self._within(place, kept)
        try:
            fitting = self._evaluator.fitting(place, nodes, members)
        except NO_VALUE:  # such as inside of a rate
            tried = nodes[: self._exact_trials_left]
            self._exact_trials_left -= len(tried)
            fitting = self._context.fitting(place, tried, members)
        yield from (found[node] for node in fitting)

    @cached_property
    def _small(self) -> SmallChanges:
        return small_changes(self._statement, self._notation, self._claim)

    def _scaled(self, place: NodePosition, response: Response) -> Iterator[Edit]:
        """Edits that multiply a place by the factor needed, or put a letter of the value needed."""
        for number in simple_numbers(response):
            yield from edits(place, Match(number))
        factor = response.multiplier
        if factor is None:
            return
        subjects = self._small.subjects[place.relation]
        for match in self._context.products.short(factor):
            if not subjects.intersection(node for node, _ in match.powers):
                yield from edits(place, match)
        scalars = dict(self._context.scalars)
        if place.node in scalars:
            needed = factor * scalars[place.node]
            close = np.abs(self._context.scalar_values - needed) <= _CLOSE * (1 + np.abs(needed))
            fitting = [self._context.scalars[i][0] for i in np.flatnonzero(close.all(axis=1))]
            yield from replaced_by(place, filter(partial(self._may_replace, place), fitting))

    def _may_replace(self, place: NodePosition, new: Node) -> bool:
        """Whether an author may have meant another letter: of the kind, and no fudge force."""
        if isinstance(place.parent, Dots) and isinstance(new, Call):
            return False
        if bare(place.node) == bare(new):
            return True  # a dot lost, or one too many
        return self._small.may_become(place.node, new) and not self._context.is_foreign(new)

    def _along_components(
        self,
        responses: Mapping[NodePosition, Response],
        targets: Collection[int],
        kept: Collection[int],
    ) -> Iterator[tuple[Edit, ...]]:
        """One place changed for each wrong component of a vector, where none corrects them all."""
        rows = [i for i, m in enumerate(self._members) if m in kept]
        wrong = [k for k, i in enumerate(rows) if self._members[i] in targets and self._is_wrong[i]]
        if not 1 < len(wrong) <= _MOST_COMPONENTS:
            return
        separate = {p: r for p, r in responses.items() if len(r.affected) == 1}
        options = []
        for row in wrong:
            alone = ((p, r.among([row])) for p, r in separate.items() if r.affected == (row,))
            found = [edit for p, r in alone if r for edit in self._scaled(p, r)]
            options.append(sorted(found, key=lambda edit: edit.size)[:_MOST_EDITS_EACH])
        yield from product(*options)

    def _preferring_later_sides(self, changes: tuple[Edit, ...]) -> tuple[Edit, ...]:
        """Changes with a little size added for earlier sides of a chain: slips come late."""
        last = [len(self._statement.relations[change.path[0]].sides) for change in changes]
        extra = [0.02 * (n - change.path[1]) for n, change in zip(last, changes, strict=True)]
        return tuple(replace(c, size=c.size + e) for c, e in zip(changes, extra, strict=True))

    def _throughout(self, kept: Collection[int]) -> Iterator[tuple[Edit, ...]]:
        """One slip made everywhere: partial derivatives by q where q̇ is meant."""
        found = [p for p in self._places if p.is_variable]
        for letter in dict.fromkeys(p.node for p in found):
            alike = [p for p in found if p.node == letter]
            changes = tuple(replaced(p, dotted(p.node), 1 / len(alike)) for p in alike)
            if self._holds(changes, kept):
                yield changes

    def _swapped(
        self, eligible: Sequence[NodePosition], kept: Collection[int]
    ) -> Iterator[tuple[Edit, ...]]:
        """Two letters, functions or numbers that have each other's places."""
        found = [
            p
            for p in eligible
            if (is_scalar_letter(p.node) or isinstance(p.node, Call | Number))
            and not (p.is_exponent or isinstance(p.parent, Dots))
        ]
        pairs = (
            (p, q)
            for p, q in combinations(found, 2)
            if p.path[:2] == q.path[:2] and p.node != q.node and _kind(p.node) == _kind(q.node)
            if self._is_alike(p.node, q.node)
        )
        for p, q in islice(pairs, _MOST_SWAPPED):
            half = _SWAP / 2
            what = f"swapped {_kind(p.node)}"
            changes = (Edit(what, p.path, q.node, half), Edit(what, q.path, p.node, half))
            if self._holds(changes, kept):
                yield changes

    def _is_alike(self, one: Node, other: Node) -> bool:
        return self._small.is_homogeneous is True and self._small.may_become(one, other)

    def _holds(self, changes: Sequence[Edit], kept: Collection[int]) -> bool:
        """Whether members of the statement with some changes hold at the sample points."""
        # Looser than for one response: a changed statement is evaluated along another route.
        changed = self._repair.with_changes(changes).statement
        return self._context.holds(changed, sorted(kept), _CLOSE * 1e2)

    def _within(self, place: NodePosition, kept: Collection[int]) -> list[int]:
        """The members, among those kept, that a place is part of."""
        return sorted(self._sides.members(place) & set(kept))

    # -- how residuals respond to a factor -------------------------------------------------------

    def _response(self, place: NodePosition, kept: Collection[int]) -> Response | None:
        """The residuals of these members as a function of a factor at a place."""
        if place not in self._responses:
            self._responses[place] = self._found_response(place)
        found = self._responses[place]
        return found and found.among([i for i, m in enumerate(self._members) if m in kept])

    def _found_response(self, place: NodePosition) -> Response | None:
        """By numbers where possible; inside of a rate, exactly, with a symbol for the factor."""
        members = sorted(self._sides.members(place))
        rows = tuple(i for i, m in enumerate(self._members) if m in members)
        if not rows:
            return None
        for changing in (self._by_numbers, self._partly_exactly, self._exactly):
            try:
                found = Response(changing(place, members), rows, self._values)
                if found.is_faithful:
                    return found
            except NO_VALUE:
                continue
        return None

    def _by_numbers(self, place: NodePosition, members: Sequence[int]) -> Changing:
        known = self._evaluator.of(place.node)
        return lambda factors: self._evaluator.rows(place, scalar(factors) * known, members)

    def _partly_exactly(self, place: NodePosition, members: Sequence[int]) -> Changing:
        around = self._evaluator.around(place)
        inside = place.path[len(around.path) :]
        changed = put(around.node, inside, times(Name(_LETTER), place.node))
        value = self._evaluator.function(changed, _FACTOR)
        return lambda factors: self._evaluator.rows(around, value(factors), members)

    def _exactly(self, place: NodePosition, members: Collection[int]) -> Changing:
        changed = put(self._statement, place.path, times(Name(_LETTER), place.node))
        claim = self._notation.read_claim(changed, {_LETTER: Expr.generator(_FACTOR)})
        return self._samples.function(self._trials.vanishing(claim, members), _FACTOR)


def _kind(node: Node) -> str:
    return {Call: "functions", Number: "numbers"}.get(type(node), "letters")


# -- several coefficients of a claim's terms, fitted together -------------------------------------


def fitted(responses: Mapping[NodePosition, Response]) -> Iterator[tuple[Edit, ...]]:
    """Sets of two or three changes of numbers or signs with which a claim holds.

    Args:
        responses: the residuals as a function of a factor at each place.
    """
    possible = [p for p in responses if p.is_term or isinstance(p.node, Number)]
    slopes = {p: s.ravel() for p in possible if (s := responses[p].slope()) is not None}
    if not slopes:
        return
    tried = list(slopes)[:_MOST_PLACES]
    rest = next(iter(responses.values())).before.ravel()
    for count in range(2, _MOST_TOGETHER + 1):
        found = False
        for chosen, factors in _solutions(rest, np.array([slopes[p] for p in tried]), count):
            where = [tried[i] for i in chosen]
            if any(_is_inside(a, b) or _is_inside(b, a) for a, b in combinations(where, 2)):
                continue
            found = True
            options = [list(edits(p, match)) for p, match in zip(where, factors, strict=True)]
            if all(options):
                yield tuple(min(each, key=lambda edit: edit.size) for each in options)
        if found:
            return


def _is_inside(place: NodePosition, whole: NodePosition) -> bool:
    return place.path[: len(whole.path)] == whole.path


def _solutions(
    rest: Array, slopes: Array, count: int
) -> Iterator[tuple[tuple[int, ...], list[Match]]]:
    """Sets of slopes, with the factors by which they cancel the residual.

    Each set is a small least-squares problem; all of them are solved in one batched QR
    factorisation, and sets that leave a remainder or are nearly dependent are dropped.
    """
    sets = list(combinations(range(len(slopes)), count))
    if not sets or count > len(rest):
        return
    bases, triangles = np.linalg.qr(np.moveaxis(slopes[np.array(sets)], 1, 2))
    shares = np.einsum("snk,n->sk", bases, -rest)
    left = np.abs(np.einsum("snk,sk->sn", bases, shares) + rest).max(axis=1)
    sizes = np.abs(np.diagonal(triangles, axis1=1, axis2=2))
    independent = sizes.min(axis=1) > _INDEPENDENT * sizes.max(axis=1)
    for i in np.flatnonzero(independent & (left <= _CLOSE * np.abs(rest).max())):
        change = np.linalg.solve(triangles[i], shares[i])
        numbers = [simple_number(np.array([1 + x])) for x in change]
        factors = [Match(n) for n in numbers if n is not None and n != 1]
        if len(factors) == count:
            yield sets[i], factors

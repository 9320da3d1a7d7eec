"""Factors and terms that a claim about small quantities lacks, to their leading order.

The claim is solved for an unknown factor or term at a place. Of the solution, a power series in
what is small, the first term is what was left out.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice

from polhode.algebra import Expr, Symbol
from polhode.judge.contexts._limit import Approach, approaches, with_small_others
from polhode.judge.contexts._remainder import leading_orders, restored, weights
from polhode.judge.latex._tree import (
    Call,
    Dots,
    Name,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Statement,
    Sum,
    walk,
)
from polhode.judge.repair._edits import Edit, edits
from polhode.judge.repair._missing_terms import as_product, length_of, written
from polhode.judge.repair._multiplier import Match
from polhode.judge.repair._places import ZERO, NodePosition, added, negated, places, put, times
from polhode.judge.repair._trials import RepairNotation
from polhode.judge.states._bound_claim import BoundClaim
from polhode.judge.states._numeric import NO_VALUE

_UNKNOWN = Symbol("missing")
_LETTER = Name("missing")
_MOST_PLACES = 24
_HIGHEST = 4  # order of a missing factor or term, in units of the weight of a small quantity
_IN_BRACKETS = 0.4  # size added for a letter that becomes a sum


@dataclass(frozen=True, eq=False)
class LeadingTerms:
    """What a statement about small quantities lacks.

    Attributes:
        statement: the statement, as parsed.
        notation: how statements are read.
        claim: the claim it makes.
        wrong: its members that were found not to hold.
        known: letters and functions that a correction may use.
        homogeneous: whether its terms have one dimension, so that a further term may.
    """

    statement: Statement
    notation: RepairNotation
    claim: BoundClaim
    wrong: Collection[int]
    known: Sequence[Node]
    homogeneous: bool

    def edits(self, allowed: Collection[tuple[int, ...]]) -> Iterator[Edit]:
        """Changes of the places at these paths by a missing factor or term."""
        tried = (p for p in places(self.statement) if p.path in allowed and _may_change(p))
        for place in islice(tried, _MOST_PLACES):
            yield from self._factors(place)
            if self.homogeneous and _may_lack_terms(place):
                yield from self._terms(place)

    def _factors(self, place: NodePosition) -> Iterator[Edit]:
        if place.node == ZERO:
            return
        for value in self._solutions(place, times(_LETTER, place.node)):
            found = as_product(value, self._letters)
            if found is not None:
                number, above, below = found
                powers = [*map(_power, above), *((n, -p) for n, p in map(_power, below))]
                if any(isinstance(n, Sum) for n, _ in powers) and powers[0][1] * len(powers) != 1:
                    continue  # at most one sum, and nothing with it
                yield from edits(place, Match(number, tuple(powers)))

    def _terms(self, place: NodePosition) -> Iterator[Edit]:
        inside = not place.is_side
        for value in self._solutions(place, added(place.node, _LETTER)):
            term = written(value, self._letters)
            if term is None or _cancels(place.node, term):
                continue
            if not (inside and any(isinstance(piece, Sum | Quotient) for piece in walk(term))):
                brackets = _IN_BRACKETS * (inside and not isinstance(place.node, Sum))
                size = 2.0 + length_of(term) / 20 + brackets
                yield Edit("missing term", place.path, added(place.node, term), size)

    def _solutions(self, place: NodePosition, node: Node) -> Iterator[Expr]:
        """The leading term of the unknown with which a wrong member holds, in every reading."""
        changed = put(self.statement, place.path, node)
        try:
            extra = {_LETTER.letter: Expr.generator(_UNKNOWN)}
            claim = self.notation.read_claim(changed, extra)
            pairs = [c.difference for c in claim.components() if c.member in self.wrong]
        except NO_VALUE:
            return
        found: dict[Expr, None] = {}
        for approach in self._approaches:
            for difference in pairs:
                try:
                    value = self._leading(difference, approach)
                except NO_VALUE:
                    continue
                if value:
                    found.setdefault(value)
        yield from found

    def _leading(self, difference: Expr, approach: Approach) -> Expr | None:
        """The leading term of the unknown, if the difference is linear in it."""
        small = self._claim.small
        residual = approach.of(difference, small).numerator
        slope = residual.diff(_UNKNOWN)
        if not slope or _UNKNOWN in slope.symbols():
            return None
        value = -(residual - slope * Expr.generator(_UNKNOWN)) / slope
        reach = _HIGHEST * max(weights(small))
        orders = leading_orders(value, -reach, reach, self._claim.positive)
        term = next(iter(orders.values()), None)
        return None if term is None else restored(term, small)

    @cached_property
    def _claim(self) -> BoundClaim:
        return with_small_others(self.claim)

    @cached_property
    def _approaches(self) -> tuple[Approach, ...]:
        try:
            return tuple(approaches(self._claim))
        except NO_VALUE:
            return ()

    @cached_property
    def _letters(self) -> Mapping[Expr, Node]:
        """The letter of each scalar; the first one, if several stand for the same."""
        found: dict[Expr, Node] = {}
        for node in self.known:
            try:
                value = self.notation.value(node)
            except NO_VALUE:
                continue
            if isinstance(value, Expr) and value:
                found.setdefault(value, node)
        return found


def _may_change(place: NodePosition) -> bool:
    """Whether it is a term, a factor or a sum, and no exponent and no letter under dots."""
    inside = isinstance(place.parent, Product | Quotient | Negative)
    kinds = Name | Dots | Number | Power | Product | Quotient | Sum | Negative | Call
    return (place.is_term or inside) and isinstance(place.node, kinds)


def _may_lack_terms(place: NodePosition) -> bool:
    """Whether it is a side, a sum, or a factor, but no term of a sum and no bare number."""
    if isinstance(place.node, Number) or place.is_subject:
        return place.node == ZERO and place.is_side
    return place.is_side or isinstance(place.parent, Product | Quotient)


def _power(node: Node) -> tuple[Node, int]:
    match node:
        case Power(base, Number(text)) if text.isdigit():
            return base, int(text)
    return node, 1


def _cancels(node: Node, term: Node) -> bool:
    """Whether a term takes away what stands there, or repeats it."""
    terms = node.terms if isinstance(node, Sum) else (node,)
    return any(one in (term, negated(term)) for one in terms)

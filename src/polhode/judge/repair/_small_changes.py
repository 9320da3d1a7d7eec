"""The slips of one stroke: formulas that differ from the printed one by a single small change.

A sign, a number, a power, a dot, a letter, an index, a function, a factor too many or too few, a
term too many, a fraction upside down. The candidates are many and nearly all are wrong; what they
are worth is found elsewhere, by numbers first.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from polhode.algebra import PI, Expr
from polhode.base import PURE, Dimension
from polhode.judge._dimensions import dimension_of, dimensions_at_odds
from polhode.judge.latex._tree import (
    Call,
    Dots,
    Name,
    Negative,
    Node,
    Number,
    PlusMinus,
    Power,
    Product,
    Quotient,
    Root,
    Statement,
    Sum,
    walk,
)
from polhode.judge.repair._edits import (
    Edit,
    bare,
    dotted,
    edits,
    letters,
    other_function,
    relabelled,
    replaced,
    replaced_by,
    scaled,
    undotted,
)
from polhode.judge.repair._multiplier import Match
from polhode.judge.repair._places import (
    ONE,
    ZERO,
    NodePosition,
    places,
    raised,
    with_factor,
)
from polhode.judge.repair._repair_context import is_foreign
from polhode.judge.repair._trials import RepairNotation
from polhode.judge.states._bound_claim import BoundClaim
from polhode.judge.states._numeric import NO_VALUE

_WHOLE = (2, 3, 4, 5, 6, 8)  # numbers that may be missing before a term or below it
_FACTORS = (Fraction(-1), *map(Fraction, _WHOLE), *(Fraction(1, n) for n in _WHOLE))
_SMALL = range(1, 13)  # integers that a printed one may stand for
_POWERS = (2, 3, 4)
_RATIOS = tuple(Fraction(n, d) for n, d in ((2, 1), (1, 2), (3, 1), (1, 3), (4, 1), (1, 4)))
_UNITS = 0.05  # size added per letter of a term that is left out
_OWN, _OTHER = 1.05, 1.15  # sizes of a missing factor that the statement has, or has not


@dataclass(frozen=True, eq=False)
class SmallChanges:
    """The single changes that one statement allows.

    Attributes:
        own: letters and functions of the statement.
        known: these, and others of the text that an author may have meant.
        subjects: of each relation, which none of its other sides may repeat.
        sums: of the statement, such as m₁ + m₂, of which a text may have printed one term only.
        dimension: of a node; None where it has none that is known.
        is_homogeneous: whether all terms of the statement have one dimension. If so, a change must
            leave every dimension alone; if not, it must change one. None where that is not known.
    """

    own: Sequence[Node]
    known: Sequence[Node]
    sums: Sequence[Sum]
    subjects: Mapping[int, frozenset[Node]]
    dimension: Callable[[Node], Dimension | None]
    is_homogeneous: bool | None
    _known: dict[Node, Dimension | None] = field(default_factory=dict)

    def at(self, place: NodePosition) -> Iterator[Edit]:
        """The changes of what stands at a place."""
        if place.is_exponent and len(place.path) == 3 and ZERO in self.subjects[place.relation]:
            return  # x³ < 0 says no more than x < 0
        if self.is_homogeneous is not False:
            found = _of_signs_and_numbers(place)
            turns = self._is_beside_zero(place)  # where a sign turns the whole relation round
            yield from (edit for edit in found if not (turns and edit.what == "wrong sign"))
        yield from self._of_powers(place)
        yield from self._of_letters(place)
        yield from self._left_out(place)
        yield from self._missing_factors(place)

    def may_become(self, old: Node, new: Node) -> bool:
        """Whether one node may stand in place of another, by their dimensions."""
        one, other = self._of(old), self._of(new)
        if one is None or other is None or self.is_homogeneous is None:
            return True
        return (one == other) == self.is_homogeneous

    def _of(self, node: Node) -> Dimension | None:
        if node not in self._known:
            self._known[node] = PURE if node == ONE else self.dimension(node)
        return self._known[node]

    def _is_beside_zero(self, place: NodePosition) -> bool:
        """Whether it is a whole side, with or without its sign, beside one that is zero."""
        is_side = len(place.path) == 2 + isinstance(place.parent, Negative | PlusMinus)
        return is_side and ZERO in self.subjects[place.relation]

    def _of_powers(self, place: NodePosition) -> Iterator[Edit]:
        node = place.node
        match node:
            case Power(base, Number(text)) if text.isdigit() and (
                self.may_become(base, ONE) or self._is_beside_zero(place)
            ):
                powers = (int(text) + 1, int(text) - 1)
                for power in powers[self._is_beside_zero(place) :]:
                    yield Edit("wrong power", place.path, raised(base, power), 1.05)
            case Root(of, None) if self.may_become(node, of):
                yield Edit("extra root", place.path, of, 1.15)
            case Quotient() | Sum() if not place.is_subject and not isinstance(place.parent, Root):
                if self.may_become(node, Root(node)):
                    yield Edit("missing root", place.path, Root(node), 1.15)
        match node:
            case Quotient(above, below) if ONE not in (above, below):
                if self.may_become(above, below):
                    turned = Quotient(below, above)
                    yield Edit("fraction upside down", place.path, turned, 1.1)
        bare = is_scalar_letter(node) or isinstance(node, Call)
        outer = isinstance(place.parent, Power | Dots | Call) or place.is_variable
        if bare and not outer and self.may_become(node, ONE) and not self._is_beside_zero(place):
            yield Edit("wrong power", place.path, raised(node, 2), 1.05)

    def _of_letters(self, place: NodePosition) -> Iterator[Edit]:
        node = place.node
        other = other_function(node)
        if other is not None and self.is_homogeneous is not False:
            yield replaced(place, other, 1.0)
        if isinstance(node, Call) and self.is_homogeneous is not False:
            yield Edit("extra function", place.path, node.argument, 1.15)
            angles = dict.fromkeys(n.argument for n in self.own if isinstance(n, Call))
            for angle in (a for a in angles if isinstance(a, Name) and a != node.argument):
                for other in (angle, Negative(angle)):
                    whole = Call(node.function, Sum((node.argument, other)))
                    yield Edit("wrong angle", place.path, whole, 1.1)
        if isinstance(node, Number) and self.is_homogeneous is False and len(node.text) > 1:
            # 9.81 where g is meant
            others = [n for n in self.known if is_scalar_letter(n)]
            yield from (Edit("wrong symbol", place.path, n, 1.15) for n in others)
        if not is_scalar_letter(node) or isinstance(place.parent, Dots):
            return
        more = [dotted(node)] if not isinstance(node, Dots) or node.count == 1 else []
        others = [n for n in (*more, *self.known) if is_scalar_letter(n)]
        if isinstance(node, Dots):  # one acceleration may stand for another
            others += [Dots(n, node.count) for n in self.known if isinstance(n, Name)]
        others = [n for n in others if n != node and n not in self.subjects[place.relation]]
        others = [n for n in others if self._of(n) is not None or n in self.own]  # not İ = 0
        others += [s for s in self.sums if node in s.terms and not isinstance(place.parent, Sum)]
        if isinstance(node, Dots):
            others.append(undotted(node))
        beside_zero = ZERO in self.subjects[place.relation]  # which has any dimension
        fitting = [
            n for n in others if self.may_become(node, n) or (beside_zero and bare(n) == bare(node))
        ]
        yield from replaced_by(place, fitting)
        if not isinstance(place.parent, Call) and self.is_homogeneous is not False:
            calls = (n for n in self.own if isinstance(n, Call) and n.argument == node)
            yield from (Edit("missing function", place.path, call, 1.15) for call in calls)

    def _left_out(self, place: NodePosition) -> Iterator[Edit]:
        node = place.node
        if node in (ONE, ZERO):
            return
        if isinstance(place.parent, Sum):
            size = 1.0 + _UNITS * len([*letters(node)])
            yield Edit("extra term", place.path, ZERO, size)
            return
        inside = isinstance(place.parent, Product | Quotient) and not isinstance(node, Number)
        if inside and self.may_become(node, ONE):
            yield Edit("extra factor", place.path, ONE, 1.05)

    def _missing_factors(self, place: NodePosition) -> Iterator[Edit]:
        # What is not zero does not become zero by another factor.
        if not _lacks_factors(place) or self._is_beside_zero(place):
            return
        present = {n.base if isinstance(n, Power) else n for n in walk(place.node)}
        for letter in self.known:
            if letter in present or letter in self.subjects[place.relation]:
                continue  # its power is changed instead
            if not (is_scalar_letter(letter) or isinstance(letter, Call)):
                continue
            if not self.may_become(letter, ONE):
                continue
            size = _OWN if letter in self.own else _OTHER
            for power in (1, -1):
                node = with_factor(place.node, letter, power)
                yield Edit("missing factor", place.path, node, size)


def small_changes(
    statement: Statement, notation: RepairNotation, claim: BoundClaim
) -> SmallChanges:
    """The single changes of a statement, with the letters that its author may have meant."""
    own = tuple(dict.fromkeys(n for p in places(statement) for n in letters(p.node)))
    indexed = (other for n in own for other in relabelled(n))
    dimensions = claim.equations.dimensions

    def value(node: Node) -> Expr | None:
        try:
            found = notation.value(node)
        except NO_VALUE:
            return None
        return found if isinstance(found, Expr) else None

    def dimension(node: Node) -> Dimension | None:
        found = value(node)
        return None if found is None else dimension_of(found, dimensions)

    others = [*indexed, *(n for n in notation.names if not is_foreign(value(n), claim.equations))]
    known = tuple(dict.fromkeys([*own, *others]))
    sums = tuple(dict.fromkeys(p.node for p in places(statement) if isinstance(p.node, Sum)))
    subjects = {i: frozenset(relation.sides) for i, relation in enumerate(statement.relations)}
    # A printed number such as 1.42 for a time has lost its unit, and says nothing of dimensions.
    is_homogeneous: bool | None = not dimensions_at_odds(claim)
    if claim.small:  # a text that expands in what is small brings in no function of it
        known = tuple(n for n in known if n in own or not isinstance(n, Call))
    if has_only_numbers(claim):
        is_homogeneous = None
        known = tuple(n for n in known if n in own or _is_number(value(n), claim))
    roots = (p.node for p in places(statement) if isinstance(p.node, Root))
    if any(isinstance(piece, Sum) for root in roots for piece in walk(root)):
        is_homogeneous = None  # the terms under a root are not compared
    return SmallChanges(own, known, sums, subjects, dimension, is_homogeneous)


def _is_number(value: Expr | None, claim: BoundClaim) -> bool:
    """Whether a letter has a value among those that are stated."""
    return value is not None and value.symbols() <= {*claim.given, PI}


def has_only_numbers(claim: BoundClaim) -> bool:
    """Whether every member gives a printed number."""
    return all(member in claim.digits for member in range(len(claim.members)))


def is_scalar_letter(node: Node) -> bool:
    """Whether it is a letter, dotted or not, that is not marked as a vector."""
    return isinstance(node, Dots) or (isinstance(node, Name) and not node.is_marked_vector)


def _of_signs_and_numbers(place: NodePosition) -> Iterator[Edit]:
    if place.is_exponent:
        if isinstance(place.node, Number) and place.node.text.isdigit():
            powers = (n for n in _POWERS if n != int(place.node.text))
            yield from (Edit("wrong power", place.path, Number(str(n)), 1.0) for n in powers)
        return
    for number in _FACTORS:
        yield from edits(place, Match(number))
        if isinstance(place.parent, Root) and not isinstance(place.node, Sum | Negative):
            yield Edit("wrong factor", place.path, scaled(place.node, abs(number)), 1.2)
    if isinstance(place.node, Number) and place.node.text.isdigit() and int(place.node.text):
        old = Fraction(place.node.text)
        tried = dict.fromkeys([*map(Fraction, _SMALL), *(old * r for r in _RATIOS)])
        for new in (n for n in tried if n != old and n.denominator == 1):
            yield from edits(place, Match(new / old))


def _lacks_factors(place: NodePosition) -> bool:
    """Whether factors may be missing there: in a term, or under a root."""
    node, parent = place.node, place.parent
    if node == ZERO or place.is_subject:
        return False
    if isinstance(node, Sum):
        return place.is_side or isinstance(parent, Negative | PlusMinus | Root)
    signed = isinstance(node, Negative | PlusMinus)
    return not signed and (place.is_term or isinstance(parent, Root | Negative | PlusMinus))

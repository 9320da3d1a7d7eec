"""Changes of a formula at one place, written as an author would."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import reduce

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
    Statement,
    Sum,
    walk,
)
from polhode.judge.repair._multiplier import Match
from polhode.judge.repair._places import (
    ONE,
    NodePosition,
    in_order,
    negated,
    number_value,
    over,
    places,
    put,
    raised,
    tidied,
    times,
    with_factor,
)

_AXES = (("1", "2", "3"), ("x", "y", "z"), ("rho", "phi", "z"))
_PAIRS = (("sin", "cos"), ("sinh", "cosh"), ("tan", "cot"), ("sech", "tanh"))
_OTHER = {one: other for pair in _PAIRS for one, other in (pair, pair[::-1])}
# Sizes rank corrections: 1 is one wrong sign, number or letter; fractions of it order changes of
# the same kind, so that the slip an author is most likely to make is proposed first.
_EXCHANGE = 2.0  # size of exchanging sine and cosine throughout: one slip, but not a small one
# Changes that bring in nothing new, by which no side can become a copy of another.
_INSERTING_NOTHING = (
    "wrong sign",
    "wrong relation sign",
    "extra term",
    "extra factor",
    "wrong factor",
)
# Extra sizes: nobody turns the sign of what a line is about, or of the first of several terms, if
# turning another does as well.
_ON_SUBJECT = 0.2
_ON_FIRST = 0.16
_DOTTED = 0.04  # size added for another letter that also has more or fewer dots
_LATER = 0.001  # taken off for each place further back in a sum: slips come late
EQUALLY_SMALL = 0.15  # difference in size up to which corrections are proposed together


@dataclass(frozen=True)
class Edit:
    """One change.

    Attributes:
        what: in words, such as "wrong sign".
        path: where.
        node: what is to stand there.
        size: how much is changed; the smallest edit is proposed.
    """

    what: str
    path: tuple[int, ...]
    node: Node
    size: float

    @property
    def inserts(self) -> bool:
        """Whether it inserts letters, by which one side may become a copy of the other."""
        return self.what not in _INSERTING_NOTHING


@dataclass(frozen=True)
class Repaired:
    """A corrected statement and the changes that were made."""

    statement: Statement
    changes: tuple[Edit, ...]

    @property
    def size(self) -> float:
        """How much was changed."""
        return sum(change.size for change in self.changes)

    def with_changes(self, changes: Sequence[Edit]) -> Repaired:
        """With more places changed."""
        changed = self.statement
        for edit in changes:
            changed = put(changed, edit.path, edit.node)
        return Repaired(changed, (*self.changes, *changes))


def smallest(found: Sequence[Repaired], difference: float = EQUALLY_SMALL) -> tuple[Repaired, ...]:
    """The smallest, and all others that are larger by no more than a difference."""
    ordered = sorted(found, key=lambda r: r.size)
    limit = ordered[0].size + difference
    kept = {tidied(r.statement): r for r in reversed(ordered) if r.size <= limit}
    return tuple(reversed(kept.values()))


# -- a place multiplied by a factor ---------------------------------------------------------------


def edits(place: NodePosition, match: Match) -> Iterator[Edit]:
    """Edits that multiply a place by a matched factor, in several notations."""
    if not match.powers:
        yield from _by_number(place, match.number)
        return
    is_argument = isinstance(place.parent, Call)
    if (place.is_term and not place.is_subject) or is_argument:
        yield from _inserted(place, match)
    if match.number == 1 and len(match.powers) == 1:
        (node, power), *_ = match.powers
        inside = isinstance(place.parent, Product | Quotient | Negative | PlusMinus)
        if inside and power == -1 and node == place.node:
            yield Edit("extra factor", place.path, ONE, 1.0)
        yield from _repowered(place, node, power)


def _by_number(place: NodePosition, number: Fraction) -> Iterator[Edit]:
    node = place.node
    subject = _ON_SUBJECT if place.is_subject else 0.0
    if number == -1 and (place.is_term or isinstance(node, Negative | PlusMinus)):
        first = isinstance(place.parent, Sum) and not place.path[-1]
        size = 1.0 + max(subject, _ON_FIRST * first) - _LATER * place.path[-1]
        yield Edit("wrong sign", place.path, negated(node), size)
    # A printed integer is replaced; where the term has no number, one is written before it.
    if isinstance(node, Number) and "." not in node.text and number > 0:
        what = "wrong power" if place.is_exponent else "wrong factor"
        value, whole = Fraction(node.text) * number, number_value(place.parent)
        if whole is None:
            extra = 0.0 if value.denominator == 1 else 0.95
            yield Edit(what, place.path, number_node(value), 1.0 + extra)
        else:  # 5/4 becomes 3/2, not 6/4
            value = whole * (number if place.path[-1] == 0 else 1 / number)
            yield Edit(what, place.path[:-1], number_node(value), 1.0)
    elif (
        place.is_term
        and number not in (0, 1)
        and not any(isinstance(factor, Number) for factor in _factors(node))
    ):
        changed = scaled(node, abs(number))
        subject += _ON_SUBJECT * isinstance(node, Sum)
        size = 1.2 if 1 in abs(number).as_integer_ratio() else 1.6 + subject
        if number < 0:
            changed, size = negated(changed), size + 1
        yield Edit("wrong factor", place.path, changed, size + subject)
    if number == 0 and isinstance(place.parent, Sum):
        yield Edit("extra term", place.path, Number("0"), 1.0 + len([*letters(node)]) / 20)


def _factors(node: Node) -> tuple[Node, ...]:
    """The factors of a term, above and below."""
    match node:
        case Negative(of) | PlusMinus(of):
            return _factors(of)
        case Product(factors):
            return tuple(f for factor in factors for f in _factors(factor))
        case Quotient(above, below):
            return (*_factors(above), *_factors(below))
    return (node,)


def scaled(node: Node, number: Fraction) -> Node:
    """A term with a number before it, or below its fraction line."""
    match node:
        case Negative(of):
            return Negative(scaled(of, number))
        case PlusMinus(of, sign):
            return PlusMinus(scaled(of, number), sign)
        case Product(factors) if any(isinstance(f, Quotient) for f in factors):
            i = next(i for i, f in enumerate(factors) if isinstance(f, Quotient))
            return times(*factors[:i], scaled(factors[i], number), *factors[i + 1 :])
    above, below = (node.above, node.below) if isinstance(node, Quotient) else (node, ONE)
    return over(
        times(Number(str(number.numerator)), above), times(Number(str(number.denominator)), below)
    )


def _inserted(place: NodePosition, match: Match) -> Iterator[Edit]:
    """Letters that are missing as factors above or below."""
    if any(power < 0 and node in bases(place.node) for node, power in match.powers):
        return  # the letter would only be cancelled; its power is changed instead
    sign = 1 if match.number < 0 else 0
    inner = place.node.of if isinstance(place.node, Negative) else place.node
    node = reduce(lambda n, each: with_factor(n, *each), match.powers, inner)
    if abs(match.number) != 1:
        number = abs(match.number)
        above = times(Number(str(number.numerator)), node)
        node = over(above, Number(str(number.denominator)))
    if isinstance(place.node, Negative) != bool(sign):
        node = Negative(node)
    yield Edit("missing factor", place.path, node, 0.3 + match.size + sign)


def _repowered(place: NodePosition, node: Node, power: int) -> Iterator[Edit]:
    """A quantity that is to have another power."""
    match place.node:
        case Power(base, Number(text)) if text.isdigit():
            exponent = int(text)
        case Name() | Dots() | Call():
            base, exponent = place.node, 1
        case _:
            return
    if node != base or exponent + power in (0, exponent):
        return
    if isinstance(place.parent, Power) and place.parent.base == place.node:
        return
    if exponent + power > 0:
        yield Edit("wrong power", place.path, raised(base, exponent + power), 1.0 + abs(power) / 20)


def times_match(match: Match, *nodes: Node) -> Node:
    """Nodes multiplied by a matched factor."""
    term = times(over(*_above_and_below(match)), *nodes)
    return negated(term) if match.number < 0 else term


def _above_and_below(match: Match) -> tuple[Node, Node]:
    """Numerator and denominator of the magnitude of a matched factor."""
    number = abs(match.number)
    above = [raised(node, p) for node, p in match.powers if p > 0]
    below = [raised(node, -p) for node, p in match.powers if p < 0]
    top, bottom = Number(str(number.numerator)), Number(str(number.denominator))
    return in_order(top, *above), in_order(bottom, *below)


def number_node(value: Fraction) -> Node:
    """A positive number as a text prints it."""
    return over(Number(str(value.numerator)), Number(str(value.denominator)))


def bases(node: Node) -> set[Node]:
    """What stands as a factor above the fraction lines, whatever its power."""
    match node:
        case Negative(of) | PlusMinus(of) | Power(of, _) | Quotient(of, _):
            return bases(of)
        case Product(factors):
            return {base for factor in factors for base in bases(factor)}
    return {node}


# -- something else at a place --------------------------------------------------------------------


def emptied(place: NodePosition) -> Iterator[Edit]:
    """Edits by which a whole side vanishes: zero, or ẋ for a constant x."""
    is_letter = isinstance(place.node, Name | Dots)
    beside_zero = Number("0") in place.parent.parts
    if is_letter and beside_zero and _dots(place.node) < 2:
        yield replaced(place, dotted(place.node), 1.0)
    if not is_letter and not beside_zero:
        yield Edit("extra term", place.path, Number("0"), 2.0 + len([*letters(place.node)]) / 20)


def replaced_by(place: NodePosition, others: Iterable[Node]) -> Iterator[Edit]:
    """Other letters or functions put at a place, for those whose value fits."""
    for other in dict.fromkeys(others):
        if other != place.node:
            yield replaced(place, other, _distance(place.node, other))


def replaced(place: NodePosition, node: Node, size: float) -> Edit:
    """Another node put at a place."""
    return Edit(_kind_of_slip(place.node, node), place.path, node, size)


def _kind_of_slip(old: Node, new: Node) -> str:
    """The slip of an author who wrote the old node for the new one, in words."""
    if isinstance(old, Call) and isinstance(new, Call):
        same = old.function == new.function
        return "wrong angle" if same else f"{old.function} where {new.function} is right"
    first, second = bare(old), bare(new)
    if first == second:
        return "dot lost" if _dots(new) > _dots(old) else "one dot too many"
    if isinstance(first, Name) and isinstance(second, Name):
        if first.decoration == second.decoration == "hat":
            return "swapped component"
        if first.letter == second.letter:
            return "wrong index"
    return "wrong symbol"


def _distance(old: Node, new: Node) -> float:
    """The size of the change, a little larger for letters that look less alike."""
    if isinstance(old, Call) and isinstance(new, Call):
        return 1.0
    first, second = bare(old), bare(new)
    if first == second or _letter(first) == _letter(second):
        return 1.0
    dots = _DOTTED * (_dots(old) != _dots(new))
    return dots + (1.05 if _decoration(first) == _decoration(second) else 1.1)


def _letter(node: Node) -> str:
    return node.letter if isinstance(node, Name) else ""


def _decoration(node: Node) -> str | None:
    return node.decoration if isinstance(node, Name) else None


def bare(node: Node) -> Node:
    """The node without its dots."""
    return node.of if isinstance(node, Dots) else node


def _dots(node: Node) -> int:
    return node.count if isinstance(node, Dots) else 0


def dotted(node: Node) -> Node:
    """The node with one more dot."""
    return Dots(node.of, node.count + 1) if isinstance(node, Dots) else Dots(node, 1)


def undotted(node: Dots) -> Node:
    """The node with one dot less."""
    return node.of if node.count == 1 else Dots(node.of, node.count - 1)


def letters(node: Node) -> Iterator[Node]:
    """Names, dotted names and functions inside a node."""
    for piece in walk(node):
        if isinstance(piece, Name | Dots | Call):
            yield piece


def relabelled(node: Node) -> Iterator[Node]:
    """The same letter with the label of another axis: L_2 for L_3, a unit vector for another."""
    match node:
        case Name(decoration="hat", letter=label):
            yield from (replace(node, letter=other) for other in _other_labels(label))
        case Name(subscript=label):
            yield from (replace(node, subscript=other) for other in _other_labels(label))
        case Dots(of, count):
            yield from (Dots(other, count) for other in relabelled(of))


def _other_labels(label: str) -> Iterator[str]:
    return (other for axes in _AXES if label in axes for other in axes if other != label)


def other_function(node: Node) -> Node | None:
    """The function that this one is most easily confused with, such as the cosine for a sine."""
    if isinstance(node, Call) and node.function in _OTHER:
        return Call(_OTHER[node.function], node.argument)
    return None


def exchanged_functions(statement: Statement) -> Iterator[tuple[Edit, ...]]:
    """The sine and cosine of an angle exchanged throughout, as if it were taken from another axis.

    Yields one set of changes for every angle of which both occur.
    """
    calls: dict[object, list[NodePosition]] = {}
    for place in places(statement):
        if isinstance(place.node, Call) and place.node.function in ("sin", "cos"):
            calls.setdefault(place.node.argument, []).append(place)
    for alike in calls.values():
        functions = {place.node.function for place in alike if isinstance(place.node, Call)}
        if len(functions) > 1:
            others = [(place, other_function(place.node)) for place in alike]
            yield tuple(replaced(p, node, _EXCHANGE / len(alike)) for p, node in others if node)

"""Missing terms, and whole expressions that are wrong, in the letters of the text.

A missing term is found by numbers along known directions, or exactly: the claim is solved for an
unknown put at the place, and the solution is written as products of letters.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import islice

import numpy as np

from polhode.algebra import Expr, Symbol, Vector, factors, length
from polhode.base import PolhodeError
from polhode.judge.latex._tree import (
    Call,
    ComponentList,
    Cross,
    Derivative,
    Dot,
    Dots,
    Name,
    Negative,
    Node,
    Number,
    Piece,
    Power,
    Product,
    Quotient,
    Root,
    Statement,
    Sum,
    walk,
)
from polhode.judge.meaning._meaning import Side
from polhode.judge.repair._edits import Edit, bases, number_node, times_match
from polhode.judge.repair._numeric_evaluator import scalar
from polhode.judge.repair._places import (
    ZERO,
    NodePosition,
    added,
    in_order,
    negated,
    over,
    put,
    raised,
    times,
)
from polhode.judge.repair._repair_context import RepairContext, VectorTerms
from polhode.judge.states._numeric import NO_VALUE, Array

# Bounds on the search: longer terms would hold too, but no author lost them in one slip, and
# factoring long polynomials takes most of the time.
_MOST_MATCHES = 5
_MATCHES_LOOKED_AT = 40  # those in letters of the statement come first
_MOST_VECTOR_MATCHES = 2
_LARGEST_SIZE = 12  # factors of a term
_LONGEST_SUM = 4  # terms of a sum of letters, and
_MOST_DIVIDED = 2  # of one over other letters
_LONGEST_LOST = 10  # length of a term that is longer than all that is printed
_LONGEST = 16  # terms of a polynomial that is factored
_BRACKETS = 0.4  # size added for a letter that becomes a sum
_NEW = 0.1  # size added for a letter that the statement does not have
_LONGER = 1  # letters by which a rewritten expression may be longer than the printed one
_LONGEST_RESIDUAL = 100  # terms of one that is divided by others; a slip leaves a shorter one
_FACTOR = 4  # ratio of lengths above which one expression is no short multiple of another

#: Stands in a statement for the unknown term.
_UNKNOWN_TERM = Name("missing")
_UNKNOWN = Symbol("missing")


# -- terms that are missing -----------------------------------------------------------------------


def missing_terms(
    context: RepairContext,
    place: NodePosition,
    members: Sequence[int],
    inner: Mapping[NodePosition, Array],
) -> Iterator[Edit]:
    """Terms to be added to a side, or to a part of it that can be a sum.

    Args:
        context: the statement that fails.
        place: where a term may be added.
        members: members of the claim that have to hold with it.
        inner: factors, arguments and the like that another value would make right, each with the
            factor by which its value is wrong, at every state.
    """
    inside = isinstance(place.parent, Derivative | Root | ComponentList | Cross | Dot)
    if not (place.is_side or inside or isinstance(place.node, Sum) or place in inner):
        return
    is_number = isinstance(place.node, Number) and place.node != ZERO
    if place.is_subject or is_number or _restates(context, place):
        return
    # A letter becomes a sum in brackets only where nothing shorter will do.
    deep = 0.05 if isinstance(place.parent, Node) else 0.0
    deep += _BRACKETS * (place in inner and not isinstance(place.node, Sum))
    printed = context.statement.relations[place.relation].sides[place.path[1]]
    longest = max(_LONGEST_LOST, length_of(printed))
    for term in _terms(context, place, members, inner.get(place)):
        letters = {piece for piece in walk(term) if isinstance(piece, Node)}
        # A term in new forces or accelerations would only restate the residual.
        sums = sum(isinstance(factor, Sum) for factor in _base(term).parts)
        if sums > 1 or any(map(context.is_foreign, letters)):
            continue
        has_sum = any(isinstance(piece, Sum) for piece in walk(term))
        if has_sum and _takes_back(context.value(place.node), context.value(term)):
            continue
        most = 0 if isinstance(place.parent, Product | Quotient) else _MOST_DIVIDED
        is_divided = not place.is_side or (place.node != ZERO and _has_letters_below(term))
        if _divided_terms(term) > most or (is_divided and length_of(term) > longest):
            continue  # the residual again, over other factors
        size = 2.0 + deep + length_of(term) / 20 + _NEW * len(_new_letters(context, term))
        yield Edit("missing term", place.path, added(place.node, term), size)


def _new_letters(context: RepairContext, term: Node) -> set[Node]:
    """The letters of a term that the statement does not have."""
    found = (piece for piece in walk(term) if isinstance(piece, Node) and _is_letter(piece))
    return {*found}.difference(context.own)


def _takes_back(printed: Side | None, term: Side | None) -> bool:
    """Whether a term, multiplied out, takes from a printed one: I w² + (J - I) w²/2."""
    if not (isinstance(printed, Expr) and isinstance(term, Expr)):
        return False
    common = printed.denominator * term.denominator
    one, other = (
        {frozenset(powers.items()): coefficient for powers, coefficient in (each * common).terms()}
        for each in (printed, term)
    )
    return any(one[monomial] * other[monomial] < 0 for monomial in one.keys() & other.keys())


def _has_letters_below(term: Node) -> bool:
    return any(isinstance(p, Quotient) and not isinstance(p.below, Number) for p in walk(term))


def _divided_terms(term: Node) -> int:
    """The number of terms of sums above and below the bar of a fraction over letters."""
    match term:
        case Negative(of):
            return _divided_terms(of)
        case Product(factors):
            return max(map(_divided_terms, factors))
        case Quotient(above, below) if not isinstance(below, Number):
            return sum(len(part.terms) for side in (above, below) for part in _factored_sums(side))
    return 0


def _factored_sums(node: Node) -> Iterator[Sum]:
    """The sums among the factors of an expression."""
    for factor in node.factors if isinstance(node, Product) else (node,):
        if isinstance(_base(factor), Sum):
            yield _base(factor)  # type: ignore[misc]  # as has just been seen


def _is_letter(node: Node) -> bool:
    return isinstance(node, Name) and node.decoration != "hat"


def _restates(context: RepairContext, place: NodePosition) -> bool:
    """Whether a term there would only restate the residual: beside a 0 that equals a sum."""
    sides = context.statement.relations[place.relation].sides
    return place.is_side and place.node == ZERO and any(isinstance(s, Sum) for s in sides)


def _terms(
    context: RepairContext, place: NodePosition, members: Sequence[int], needed: Array | None
) -> Iterator[Node]:
    def adds(term: Node) -> bool:
        """Whether a term does more than replace what stands there already."""
        parts = term.terms if isinstance(term, Sum) else (term,)
        is_letter = isinstance(place.node, Name | Dots)
        cancels = negated(place.node) in parts or (is_letter and place.node in bases(term))
        return not cancels and not _repeats(context, place, term)

    value = context.value(place.node)
    if isinstance(value, Expr):
        yield from _along(context, place, None, members, adds, needed)
    elif isinstance(value, Vector):
        for direction in context.directions:
            yield from _along(context, place, direction, members, adds, None)
        yield from filter(adds, _multiples(context, place, members, context.vectors))
        yield from filter(adds, _multiples(context, place, members, context.crossed))


def _along(
    context: RepairContext,
    place: NodePosition,
    direction: Node | None,
    members: Sequence[int],
    adds: Callable[[Node], bool],
    needed: Array | None,
) -> Iterator[Node]:
    """Terms along one direction, or scalar terms: by numbers first, then exactly.

    A term inside of a function, in which the residuals are not linear, follows from the factor
    that is needed there.
    """
    evaluator = context.evaluator
    ones = np.ones(context.trials.samples.size)
    tail = [] if direction is None else [direction]
    try:
        unit = scalar(ones) if direction is None else evaluator.of(direction)
        amount = evaluator.amounts(place, unit, members)[0]
    except NO_VALUE:
        amount = None if needed is None else (needed - 1) * evaluator.of(place.node).array[0]
    if amount is not None:
        if not np.isfinite(amount).all():
            return
        matches = islice(context.products.equal_to(amount), _MATCHES_LOOKED_AT)
        terms = dict.fromkeys(times_match(match, *tail) for match in matches)
        found = sorted(filter(adds, terms), key=lambda term: len(_new_letters(context, term)))
        yield from found[:_MOST_MATCHES]
        if found:
            return
    unknown = added(place.node, times(_UNKNOWN_TERM, *tail))
    missing = _solved(context, put(context.statement, place.path, unknown), members)
    if missing is not None:
        yield from filter(adds, _written(context, missing, tail))


def _multiples(
    context: RepairContext, place: NodePosition, members: Sequence[int], terms: VectorTerms
) -> Iterator[Node]:
    """Multiples of vectors of the text, or of vector products of two, that correct a formula."""
    if not len(terms):
        return
    try:
        amounts = context.evaluator.amounts(place, terms.values, members)
    except NO_VALUE:
        return
    for i in np.flatnonzero(np.isfinite(amounts).all(axis=1)):
        for match in islice(context.products.equal_to(amounts[i]), _MOST_VECTOR_MATCHES):
            yield times_match(match, terms[int(i)])


# -- terms and sums that are wrong as a whole -----------------------------------------------------


def may_be_rewritten(place: NodePosition) -> bool:
    """Whether it is a whole side, a term or a sum; a side of one letter is the claim's subject."""
    is_subject = place.is_side and isinstance(_base(place.node), Name | Dots)
    return (place.is_term or isinstance(place.node, Sum)) and not is_subject


def rewritten(
    context: RepairContext, place: NodePosition, members: Sequence[int]
) -> Iterator[Edit]:
    """The expression that would have to stand at a place, with its vectors unchanged."""
    tail = _tail(context, place.node)
    if tail is None:
        return
    changed = put(context.statement, place.path, times(_UNKNOWN_TERM, *tail))
    required = _solved(context, changed, members)
    if required:
        for node in _plainly_written(context, required, tail):
            one, other = _letters(place.node), _letters(node)
            # A referee changes an expression; one that has nothing in common with it is another.
            related = place.node == ZERO or any(letter in one for letter in other)
            longer = other.total() > one.total() + _LONGER and place.node != ZERO
            if related and not longer and not _repeats(context, place, node):
                unshared = (one - other).total() + (other - one).total()
                ordered = _in_order(node, place.node)
                yield Edit("wrong expression", place.path, ordered, 2.1 + unshared / 20)


def _tail(context: RepairContext, node: Node) -> list[Node] | None:
    """The vector of a term as a list, empty for a scalar; None for more than one vector."""
    if isinstance(node, Negative):
        return _tail(context, node.of)
    if isinstance(context.value(node), Expr):
        return []
    vectors = node.factors if isinstance(node, Product) else (node,)
    found = [n for n in vectors if isinstance(context.value(n), Vector)]
    return found if len(found) == 1 and not isinstance(found[0], Sum) else None


def _letters(node: Node) -> Counter[Node]:
    """The letters and functions of an expression, counted with their powers."""
    match node:
        case Power(base, Number(text)) if text.isdigit():
            return Counter({letter: n * int(text) for letter, n in _letters(base).items()})
        case Call() | Name() | Dots():
            return Counter([node])
    return sum((_letters(part) for part in node.parts if isinstance(part, Node)), Counter())


def _in_order(node: Node, old: Node) -> Node:
    """A product with its factors in the author's order, and vectors last."""
    before = [*walk(old)]

    def place(factor: Node) -> int:
        if isinstance(factor, Name) and factor.is_marked_vector:
            return len(before) + 1
        return before.index(_base(factor)) if _base(factor) in before else len(before)

    match node:
        case Negative(of):
            return Negative(_in_order(of, old))
        case Product(factors):
            return Product(tuple(sorted(factors, key=place)))
    return node


def _base(node: Node) -> Node:
    return node.base if isinstance(node, Power) else node


# -- exact quantities, written in the letters of the text -----------------------------------------


def _solved(context: RepairContext, changed: Statement, members: Sequence[int]) -> Expr | None:
    """The exact value of the unknown term with which some members hold; None without one.

    Each residual has to be linear in the unknown, s x + r; all of them must have the same root.
    """
    found = None
    try:
        extra = {_UNKNOWN_TERM.letter: Expr.generator(_UNKNOWN)}
        for residual in context.vanishing(changed, members, extra):
            settled = context.trials.states.on(residual).numerator
            if _is_longer(settled, _LONGEST_RESIDUAL):
                return None
            slope = settled.diff(_UNKNOWN)
            if _UNKNOWN in slope.symbols():
                return None
            rest = settled - slope * Expr.generator(_UNKNOWN)
            if slope and found is None:
                found = -rest / slope
            if settled and (found is None or settled.subs({_UNKNOWN: found})):
                return None
    except (PolhodeError, ArithmeticError):
        return None
    return found


def length_of(node: Node) -> int:
    """The length of a term: letters with their powers, more for sums, quotients and derivatives."""
    match node:
        case Power(base, Number(text)) if text.isdigit():
            return length_of(base) * int(text)
        case Name(decoration="hat"):
            return 0
        case Number("1"):
            return 0
        case Call() | Name() | Dots() | Number():
            return 1
    rate = isinstance(node, Derivative | Cross)
    nested = 2 * isinstance(node, Sum)
    if isinstance(node, Quotient) and not isinstance(node.below, Number):
        nested = 4
    return rate + nested + sum(length_of(part) for part in node.parts if isinstance(part, Node))


def _written(context: RepairContext, value: Expr, tail: Sequence[Node]) -> Iterator[Node]:
    """A quantity times vectors, in letters of the text.

    At most one letter stands for a quantity that the motion determines, such as a reaction.
    """
    yield from _plainly_written(context, value, tail)
    for node, on_domain in context.on_domain.items():
        if not on_domain or on_domain == context.vocabulary[node]:
            continue
        shorter, longer = sorted((length(value), length(on_domain)))
        if longer <= min(
            _FACTOR * shorter, _LONGEST_RESIDUAL
        ):  # else neither is a short multiple of the other
            yield from _plainly_written(context, value / on_domain, [node, *tail])


def _plainly_written(context: RepairContext, value: Expr, tail: Sequence[Node]) -> Iterator[Node]:
    """A quantity times vectors, in letters that are free on the claim's states, if possible."""
    term = written(value, context.spellings, tail)
    if term is not None:
        yield term


def written(value: Expr, spellings: Mapping[Expr, Node], tail: Sequence[Node] = ()) -> Node | None:
    """A quantity times vectors, as a product in the letters that some scalars have."""
    product = as_product(value, spellings)
    if product is None or len(product[1]) + len(product[2]) >= _LARGEST_SIZE:
        return None
    number, above, below = product
    term = times(_fraction(abs(number), above, below), *tail)
    return negated(term) if number < 0 else term


def as_product(
    expression: Expr, plain: Mapping[Expr, Node]
) -> tuple[Fraction, list[Node], list[Node]] | None:
    """An expression as a number times letters over letters; None if it is not that simple."""
    if _is_longer(expression.numerator, _LONGEST) or _is_longer(expression.denominator, _LONGEST):
        return None
    number, powers = factors(expression)
    above: list[Node] = []
    below: list[Node] = []
    # Constants stand before what varies.
    for factor, power in sorted(powers.items(), key=lambda item: item[0].varies):
        node = plain.get(factor)
        # Factors have an arbitrary sign: use the one that is a letter, or that prints no leading
        # minus, and count the sign in the number.
        if node is None and -factor in plain:
            node, number = plain[-factor], number * (-1) ** (power % 2)
        elif (
            node is None
            and number < 0
            and power % 2
            and any(coefficient < 0 for _, coefficient in factor.terms())
        ):
            factor, number = -factor, -number
        node = node or _sum(factor, plain)
        if node is None:
            return None
        (above if power > 0 else below).append(raised(node, abs(power)))
    return number, above, below


def _sum(factor: Expr, plain: Mapping[Expr, Node]) -> Node | None:
    """A short sum of products of letters."""
    terms: list[Node] = []
    if _is_longer(factor, _LONGEST_SUM) or not _is_longer(factor, 1):
        return None
    for powers, coefficient in factor.terms():
        nodes = [(plain.get(Expr.generator(g)), power) for g, power in powers.items()]
        if any(node is None for node, _ in nodes):
            return None
        above = [raised(node, power) for node, power in nodes if node is not None]
        term = _fraction(abs(Fraction(coefficient)), above, ())
        terms.append(negated(term) if coefficient < 0 else term)
    if isinstance(terms[0], Negative):
        terms.sort(key=lambda term: isinstance(term, Negative))
    return Sum(tuple(terms))


def _is_longer(polynomial: Expr, most: int) -> bool:
    """Whether it has more than so many terms."""
    return any(islice(polynomial.terms(), most, None))


def _fraction(number: Fraction, above: Iterable[Node], below: Iterable[Node]) -> Node:
    top = in_order(number_node(Fraction(number.numerator)), *above)
    return over(top, in_order(number_node(Fraction(number.denominator)), *below))


def _repeats(context: RepairContext, place: NodePosition, node: Node) -> bool:
    """Whether a new node at a place contains a whole other side of the same chain."""
    sides = context.statement.relations[place.relation].sides
    others = {side for i, side in enumerate(sides) if i != place.path[1]} - {ZERO}
    return _stands_in(node, others)


def _stands_in(piece: Piece, others: Collection[Piece]) -> bool:
    """Whether one of the others is this piece or stands in it, except as the base of a power."""
    inside = (*piece.base.parts, piece.exponent) if isinstance(piece, Power) else piece.parts
    return piece in others or any(_stands_in(part, others) for part in inside)

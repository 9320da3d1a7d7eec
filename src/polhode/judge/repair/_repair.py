"""The smallest correction that makes a claim hold.

Where the residual of a claim can be fitted, `RepairSearch` proposes candidates from numbers at
sample points, and only those are judged exactly. Claims that are judged as a whole are corrected by
small changes tried one by one. A correction must hold, be dimensionally homogeneous and not be
empty.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import chain, pairwise
from math import floor, inf, log10
from operator import attrgetter

import numpy as np

from polhode.algebra import Expr, Vector
from polhode.base import PolhodeError
from polhode.judge._dimensions import dimensions_at_odds
from polhode.judge.contexts._equations import ENERGIES
from polhode.judge.latex._lexicon import CONSTANTS
from polhode.judge.latex._tree import (
    At,
    Cross,
    Derivative,
    Differential,
    Dots,
    Name,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Relation,
    Statement,
    walk,
)
from polhode.judge.meaning._differentials import unequal_differentials
from polhode.judge.repair._edits import (
    EQUALLY_SMALL,
    Edit,
    Repaired,
    dotted,
    exchanged_functions,
    replaced,
    smallest,
)
from polhode.judge.repair._leading_terms import LeadingTerms
from polhode.judge.repair._numeric_evaluator import NumericTensor, combined, scalar
from polhode.judge.repair._places import ZERO, MemberSides, negated, places, tidied
from polhode.judge.repair._repair_search import ENOUGH, STAGES, RepairSearch
from polhode.judge.repair._screens import Screen, screens
from polhode.judge.repair._small_changes import has_only_numbers, small_changes
from polhode.judge.repair._trials import FITTED, AtLimit, RepairNotation
from polhode.judge.states._bound_claim import EQUALITY, SENSE, BoundClaim
from polhode.judge.states._claim_domain import AnyState, ClaimDomain, TrueMotion
from polhode.judge.states._numeric import NO_VALUE, number

Holds = Callable[[BoundClaim], bool]

#: Contexts in which there is no residual that could be fitted.
JUDGED_WHOLE = ("threshold", "limit", "number")

_REVERSED = {"<": ">", ">": "<", "≤": "≥", "≥": "≤", "≠": "="}
_MISPRINT = 0.15  # relative; a number farther off is due to what it is computed from
_ANEW = 1.6  # size of a number computed anew, which nothing printed resembles
_ALIKE = 0.06  # difference in size of corrections that are shown together, and
_MOST_ALIKE = 3  # how many, corrections of a statement on some times of a motion
_ONE_SLIP = 1.9  # size of what may be one slip
_CHAIN = 3  # sides
_MOST_EDITS = 4  # rounds in which some members are corrected
_MOST_TRIED = 40  # exact judgements of a claim that is judged as a whole
_EVEN = (Number("2"), Number("4"))
_TRIALS = 3  # random values of each letter
_CLOSE = 1e-9  # of values of order one, in doubles


def repaired(
    statement: Statement,
    notation: RepairNotation,
    context: str,
    wrong: Collection[int],
    holds: Holds,
) -> tuple[Repaired, ...]:
    """The smallest corrections, all of about the same size; empty if none was found.

    Args:
        statement: the claim that fails.
        notation: how statements are read.
        context: where the claim is to hold.
        wrong: members of the claim that were found not to hold.
        holds: exact judgement of a corrected claim.
    """
    whole = Repaired(statement, ())
    slips = chain(_turned(whole), _differentiated(whole), _of_energies(whole))
    at_once = [r for r in slips if _is_sound(r, (), notation, holds)]
    claim = notation.read_claim(statement, {})
    if at_once and claim.when:  # at single times much is true, so that others are shown beside it
        others = _one_by_one(statement, notation, context, wrong, holds)
        return tuple(smallest([*at_once, *others])[:_MOST_ALIKE])
    if at_once:
        return smallest(at_once)
    if any(claim.members[i].sign == "≠" for i in wrong):
        return ()  # the sides are equal: nothing in them is wrong
    if context in FITTED:
        return _by_residuals(statement, notation, context, wrong, holds)
    if context not in JUDGED_WHOLE:
        return ()
    # A claim to order zero is an equation at the limit itself, where its residual can be fitted.
    if claim.small and all(small.order == 0 for small in claim.small):
        limit = AtLimit(notation, claim)
        found = _fitted(statement, limit, "motion", lambda changed: holds(limit.near(changed)))
        if found:
            return found
    return _one_by_one(statement, notation, context, wrong, holds)


# -- where the residual can be fitted -------------------------------------------------------------


def _by_residuals(
    statement: Statement,
    notation: RepairNotation,
    context: str,
    wrong: Collection[int],
    holds: Holds,
) -> tuple[Repaired, ...]:
    claim = notation.read_claim(statement, {})
    when = claim.when
    # What holds at the start often holds at any time; its own numbers come second.
    contexts = ("motion", context) if when == "initially" else (context,)
    has_residual = all(relation.sign not in SENSE for relation in claim.members)
    for where in contexts if has_residual else ():
        try:
            if found := _fitted(statement, notation, where, holds):
                return found
        except PolhodeError:
            pass
    # Roots of a relation between steady speeds may have no residual in the form printed.
    if context == "steady" or when:
        return _one_by_one(statement, notation, context, wrong, holds)
    return ()


def _fitted(
    statement: Statement, notation: RepairNotation, context: str, holds: Holds
) -> tuple[Repaired, ...]:
    whole = Repaired(statement, ())
    direct = _corrections_from(whole, notation, context, holds)
    if direct and direct[0].size < _ONE_SLIP:
        return direct
    apart = _side_by_side(statement, notation, context, holds)
    if apart or direct:
        return direct if direct and (not apart or direct[0].size <= apart[0].size) else apart
    starts = chain(_exchanged(whole, notation, context), _made_homogeneous(whole, notation))
    found = (_corrections_from(start, notation, context, holds) for start in starts)
    return next(filter(None, found), ())


def _side_by_side(
    statement: Statement, notation: RepairNotation, context: str, holds: Holds
) -> tuple[Repaired, ...]:
    """A chain a = b = c corrected side by side: each side that is wrong, as if a = c stood alone.

    What the chain is about, its first side, is left as it is.
    """
    changes: list[Edit] = []
    for relation in statement.relations:
        if len(relation.sides) < _CHAIN or not set(relation.signs) <= set(EQUALITY):
            return ()
    for i, relation in enumerate(statement.relations):
        for k, side in enumerate(relation.sides[1:], 1):
            alone = Statement((Relation((relation.sides[0], side), ("=",)),))
            found = _side_corrected(alone, notation, context, holds)
            if found is None:
                return ()
            changes += [replace(c, path=(i, k, *c.path[2:])) for c in found]
    repair = Repaired(statement, ()).with_changes(changes)
    try:
        says_something = bool(changes) and not _is_empty(repair.statement)
        right = says_something and holds(notation.read_claim(repair.statement, {}))
    except (PolhodeError, ArithmeticError):
        return ()
    return (repair,) if right else ()


def _side_corrected(
    alone: Statement, notation: RepairNotation, context: str, holds: Holds
) -> tuple[Edit, ...] | None:
    """The changes of the right side of one equation, none if it holds; None if there are none."""
    try:
        if holds(notation.read_claim(alone, {})):
            return ()
    except (PolhodeError, ArithmeticError):
        return None
    whole = Repaired(alone, ())
    found: list[Repaired] = []
    # On a motion accelerations are known, and a term in them is better sought where they are free.
    for where in dict.fromkeys((context, "identity" if context == "motion" else context)):
        for start in chain([whole], _made_homogeneous(whole, notation)):
            found += _corrections_from(start, notation, where, holds)
            if any(r.size < _ONE_SLIP for r in found):
                break
        right = [r for r in found if all(change.path[1] == 1 for change in r.changes)]
        if any(r.size < _ONE_SLIP for r in right):
            break  # one slip that corrects it at any state is found on a motion too
    return min(right, key=lambda r: r.size).changes if right else None


def _made_homogeneous(whole: Repaired, notation: RepairNotation) -> Iterator[Repaired]:
    """Statements of one dimension, where the printed one lacks a dot."""
    claim = notation.read_claim(whole.statement, {})
    if not dimensions_at_odds(claim):
        return
    for place in places(whole.statement):
        if not isinstance(place.node, Name | Dots) or isinstance(place.parent, Dots):
            continue
        if not _may_vary(place.node, notation):
            continue
        repair = whole.with_changes((replaced(place, dotted(place.node), 1.0),))
        try:
            if not dimensions_at_odds(notation.read_claim(repair.statement, {})):
                yield repair
        except (PolhodeError, ArithmeticError):
            continue


def _may_vary(letter: Node, notation: RepairNotation) -> bool:
    """Whether a letter stands for what may have a rate, unlike a mass or π."""
    try:
        value = notation.value(letter)
    except NO_VALUE:
        return False
    return isinstance(value, Vector) or any(s.kind.varies for s in value.symbols())


def _exchanged(whole: Repaired, notation: RepairNotation, context: str) -> Iterator[Repaired]:
    """Statements with sine and cosine of an angle exchanged, if fewer residuals are then wrong."""
    before = RepairSearch(whole, notation, context).wrong
    for changes in exchanged_functions(whole.statement):
        repair = whole.with_changes(changes)
        if RepairSearch(repair, notation, context).wrong < before:
            yield repair


def _corrections_from(
    repair: Repaired, notation: RepairNotation, context: str, holds: Holds
) -> tuple[Repaired, ...]:
    """The smallest corrections that include the changes made so far.

    If no candidate corrects the whole claim, some of its members are corrected and the search
    starts again from there.
    """
    for _ in range(_MOST_EDITS):
        search = RepairSearch(repair, notation, context)
        if not search.failing:
            return ()
        whole: list[Repaired] = []
        # Later stages find larger changes, so the search stops once a small one is sound.
        for found, enough in zip(search.corrected(search.failing), ENOUGH, strict=True):
            for candidate in found:  # the smallest first
                if candidate.size > min((r.size for r in whole), default=inf) + EQUALLY_SMALL:
                    break
                if _is_sound(candidate, search.failing, notation, holds):
                    whole.append(candidate)
            if any(r.size - repair.size < enough for r in whole):
                break
        if whole:
            return smallest(whole)
        first = _partly_corrected(search)
        if first is None:
            return ()
        repair = first
    return ()


def _partly_corrected(search: RepairSearch) -> Repaired | None:
    """The claim with one or two of its members corrected, by the smallest change of any stage.

    Neighbours in a chain share a side, so pairs come first.
    """
    pairs = [pair for pair in pairwise(search.failing) if pair[1] == pair[0] + 1]
    groups = [*pairs, *((member,) for member in search.failing)]
    stages = [search.corrected(group) for group in groups]
    found = (repairs for _ in range(STAGES) for stage in stages if (repairs := next(stage)))
    return next((repairs[0] for repairs in found), None)


def _is_sound(
    repair: Repaired, failing: Sequence[int], notation: RepairNotation, holds: Holds
) -> bool:
    """Whether it holds, is dimensionally homogeneous, and is neither empty nor a tautology."""
    inserted = [change.path for change in repair.changes if change.inserts]
    changed = (repair.statement.relations[change.path[0]] for change in repair.changes)
    says_nothing = _is_empty(repair.statement) or any(map(_is_trivial, changed))
    if says_nothing or unequal_differentials(repair.statement):
        return False
    if any(_is_tautology(repair.statement, (p[0], p[1]), notation) for p in inserted):
        return False
    try:
        claim = notation.read_claim(repair.statement, {})
        states = replace(claim, given={}).states(AnyState)  # what is given may be the start only
        vanishing = (_makes_vanish(repair.statement, p, notation, states) for p in inserted)
        at_odds = not has_only_numbers(claim) and dimensions_at_odds(claim)
        if at_odds or any(vanishing):
            return False
        if inserted:  # the insertion must not make both sides of a member vanish
            sides = ((c.member, c.left or c.right) for c in claim.components())
            left = {member for member, rest in sides if rest}
            if any(member not in left for member in failing):
                return False
        return holds(claim)
    except (PolhodeError, ArithmeticError):
        return False


# -- where the claim is judged as a whole ---------------------------------------------------------


def _one_by_one(
    statement: Statement,
    notation: RepairNotation,
    context: str,
    wrong: Collection[int],
    holds: Holds,
) -> tuple[Repaired, ...]:
    """The smallest single changes with which a claim holds.

    Only statements of one dimension that pass a screen by numbers are judged, the smallest first.
    """
    whole, claim = Repaired(statement, ()), notation.read_claim(statement, {})
    changes, sides = small_changes(statement, notation, claim), MemberSides(statement, claim)
    where = {p.path: m for p in places(statement) if (m := sides.members(p)).intersection(wrong)}
    tried = dict.fromkeys(
        (edit.path, edit.node, edit.what, edit.size)
        for place in places(statement)
        if place.path in where
        for edit in changes.at(place)
        # Without one of its terms, much holds at some time; a number is of the quantity printed.
        if not (claim.when and edit.what == "extra term")
        if not (context == "number" and place.is_subject)
    )
    if context == "limit":
        homogeneous = changes.is_homogeneous is not False
        terms = LeadingTerms(statement, notation, claim, wrong, changes.known, homogeneous)
        tried |= dict.fromkeys((e.path, e.node, e.what, e.size) for e in terms.edits(where))
    if context == "number":
        tried |= dict.fromkeys((e.path, e.node, e.what, e.size) for e in _digits(statement, claim))
    ordered = [Edit(what, path, node, size) for path, node, what, size in tried]
    ordered.sort(key=attrgetter("size"))
    for passes in screens(claim, context):
        passed = partial(_passes, passes, notation=notation, members=where)
        right = _right(whole, ordered, notation, holds, passed)
        if right and claim.when:  # much is true at some time: one of many would be a guess
            right = smallest(right, _ALIKE)
            return right if len(right) <= _MOST_ALIKE else ()
        if right and (context != "limit" or right[0].size < _ONE_SLIP):
            return right
        if right:
            exchanged = map(whole.with_changes, exchanged_functions(statement))
            return smallest([*right, *(r for r in exchanged if _is_sound(r, (), notation, holds))])
    return ()


def _right(
    whole: Repaired,
    changes: Sequence[Edit],
    notation: RepairNotation,
    holds: Holds,
    passes: Callable[[Repaired], bool],
) -> tuple[Repaired, ...]:
    """The statements with the smallest of some changes, in order of size, that are sound."""
    right: list[Repaired] = []
    judged = 0
    for edit in changes:
        enough = right and edit.size > right[0].size + EQUALLY_SMALL
        if enough or judged == _MOST_TRIED:
            break
        repair = whole.with_changes((edit,))
        if not passes(repair):
            continue
        judged += 1
        if _is_sound(repair, (), notation, holds):
            right.append(repair)
    return smallest(right) if right else ()


def _digits(statement: Statement, claim: BoundClaim) -> Iterator[Edit]:
    """The right digits of a printed number, as many as are printed."""
    states = claim.states(TrueMotion)
    for place in places(statement):
        beside = claim.components()[place.relation : place.relation + 1]
        if not (place.is_side and place.path[1] and isinstance(place.node, Number) and beside):
            continue
        value = float(number(states.on(beside[0].left), {}))
        printed = place.node.text
        if not 0 < value < inf or not float(printed):
            continue
        if abs(value / float(printed) - 1) < _MISPRINT:
            right = f"{value:.{len(printed.partition('.')[2])}f}"
            yield Edit("wrong number", place.path, Number(right), 1.0)
            continue
        right = _to_digits(value, len(printed.replace(".", "").lstrip("0")))
        is_slip = _is_one_slip(printed, right)
        yield Edit("wrong number", place.path, Number(right), 1.0 if is_slip else _ANEW)


def _to_digits(value: float, count: int) -> str:
    """A number with so many significant digits, without a power of ten."""
    decimals = max(count - 1 - floor(log10(value)), 0)
    return f"{value:.{decimals}f}"


def _is_one_slip(printed: str, right: str) -> bool:
    """Whether two numbers differ in their decimal point, in one digit, or by two digits swapped."""
    one, other = (text.replace(".", "").strip("0") for text in (printed, right))
    if one == other or len(printed) != len(right):
        return one == other
    wrong = [i for i, (a, b) in enumerate(zip(printed, right, strict=True)) if a != b]
    swapped = [printed[i] for i in wrong] == [right[i] for i in reversed(wrong)]
    return len(wrong) == 1 or (len(wrong) == 2 and swapped)


def _turned(whole: Repaired) -> Iterator[Repaired]:
    """The statement with one of its inequalities turned round, or with = in place of ≠."""
    statement = whole.statement
    for i, relation in enumerate(statement.relations):
        for k, sign in enumerate(relation.signs):
            if sign in _REVERSED:
                signs = (*relation.signs[:k], _REVERSED[sign], *relation.signs[k + 1 :])
                if len({SENSE[s] for s in signs if s in SENSE}) > 1:
                    continue  # nobody writes a < b > c
                turned = replace(relation, signs=signs)
                relations = (*statement.relations[:i], turned, *statement.relations[i + 1 :])
                edit = Edit("wrong relation sign", (i, k), relation.sides[k], 1.0)
                yield Repaired(replace(statement, relations=relations), (edit,))


def _of_energies(whole: Repaired) -> Iterator[Repaired]:
    """The statement with the sign of one term of an energy turned.

    As an energy may be counted from any level, its residual does not show that this is enough.
    """
    for place in places(whole.statement):
        letters = [s for s in whole.statement.relations[place.relation].sides if _is_energy(s)]
        if letters and place.is_term and place.node not in letters:
            edit = Edit("wrong sign", place.path, negated(place.node), 1.0)
            yield whole.with_changes((edit,))


def _is_energy(side: Node) -> bool:
    letter = side.of if isinstance(side, At) else side
    return isinstance(letter, Name) and letter.letter in ENERGIES


def _differentiated(whole: Repaired) -> Iterator[Repaired]:
    """The statement with dL/dt for L/dt."""
    for place in places(whole.statement):
        match place.node:
            case Quotient(Name() | Dots() | Product() as above, Differential(by, "d")):
                rate = Derivative(above, by)
                yield whole.with_changes((Edit("differential lost", place.path, rate, 1.0),))


def _passes(
    passes: Screen,
    repair: Repaired,
    notation: RepairNotation,
    members: Mapping[tuple[int, ...], Collection[int]],
) -> bool:
    """Whether a statement has one dimension and passes a screen, in the members that change."""
    try:
        claim = notation.read_claim(repair.statement, {})
        one_dimension = has_only_numbers(claim) or not dimensions_at_odds(claim)
        return one_dimension and passes(claim, members[repair.changes[0].path])
    except NO_VALUE:
        return False


# -- empty statements and tautologies, by their form alone ----------------------------------------


def _is_empty(statement: Statement) -> bool:
    """Whether some member is of the form a = a, or a product has the factor 0 or is a × a."""
    sides = [tuple(map(tidied, relation.sides)) for relation in statement.relations]
    same = any(one == other for each in sides for one, other in pairwise(each))
    vanishing = any(
        (isinstance(p, Cross) and p.left == p.right)
        or (isinstance(p, Product) and ZERO in p.factors)
        for p in chain.from_iterable(walk(side) for side in chain.from_iterable(sides))
    )
    return same or vanishing


def _is_trivial(relation: Relation) -> bool:
    """Whether it says nothing: x² > 0, or that zero is constant."""
    sides = [*map(tidied, relation.sides)]
    for one, sign, other in zip(sides, relation.signs, sides[1:], strict=False):
        even = any(isinstance(s, Power) and s.exponent in _EVEN for s in (one, other))
        constant = any(isinstance(s, Name) and s.letter in CONSTANTS for s in (one, other))
        if ZERO in (one, other) and (constant or (sign in SENSE and even)):
            return True
    return False


def _makes_vanish(
    statement: Statement, path: tuple[int, ...], notation: RepairNotation, states: ClaimDomain
) -> bool:
    """Whether the term at a place is zero: what is too much is left out, not written as zero."""
    around = [p for p in places(statement) if p.is_term and p.path == path[: len(p.path)]]
    if not around:
        return False
    try:
        value = notation.value(around[-1].node)
        parts = value.components if isinstance(value, Vector) else (value,)
        left = any(not isinstance(part, Expr) or states.on(part) for part in parts)
    except NO_VALUE:
        return False
    return around[-1].node != ZERO and not left


def _is_tautology(statement: Statement, side: tuple[int, int], notation: RepairNotation) -> bool:
    """Whether a side vanishes or equals its neighbour for any values of its letters."""
    relation, position = side
    sides = statement.relations[relation].sides
    beside = sides[max(position - 1, 0) : position] + sides[position + 1 : position + 2]
    random = _RandomValues(notation)
    try:
        own = random.of(sides[position])
        # θ̇ and dθ/dt are spelled differently, and are the same.
        value = notation.value(sides[position])
        symbol = value.symbol if isinstance(value, Expr) else None
        is_letter = symbol is not None and isinstance(sides[position], Name | Dots)
        if is_letter and any(notation.value(other) == value for other in beside):
            return True
    except NO_VALUE:
        return False
    return np.abs(own.array).max() < _CLOSE or any(random.equals(own, other) for other in beside)


class _RandomValues:
    """Values of nodes, with random numbers for letters, rates and all that is not arithmetic."""

    def __init__(self, notation: RepairNotation) -> None:
        self._notation = notation
        self._random = np.random.default_rng(1)
        self._letters: dict[Node, NumericTensor] = {}

    def of(self, node: Node) -> NumericTensor:
        """The value of a node."""
        if isinstance(node, Number):
            return scalar(np.full(_TRIALS, float(node.text)))
        inside = [part for part in node.parts if isinstance(part, Node)]
        try:
            return combined(node, [self.of(part) for part in inside])
        except NO_VALUE:
            pass
        if node not in self._letters:
            rank = 1 if isinstance(self._notation.value(node), Vector) else 0
            shape = (*(3,) * rank, 1, _TRIALS)
            self._letters[node] = NumericTensor(rank, self._random.uniform(0.5, 2.0, shape))
        return self._letters[node]

    def equals(self, one: NumericTensor, node: Node) -> bool:
        """Whether a node has the same value."""
        try:
            other = self.of(node)
        except NO_VALUE:
            return False
        return one.rank == other.rank and np.allclose(one.array, other.array, rtol=_CLOSE)

"""Claims about steady motions, including roots with ±."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind
from polhode.analyse import reduced
from polhode.base import ByIdentity, PolhodeError
from polhode.judge._verdict import Answer, Residual, Verdict
from polhode.judge.contexts._equations import Failure, failed, failures, judged
from polhode.judge.meaning._phrases import roots
from polhode.judge.meaning._relations import ScalarRelation
from polhode.judge.states._bound_claim import BoundClaim, restricted_states
from polhode.judge.states._claim_domain import TrueMotion
from polhode.judge.states._steady_states import SteadyStates, steady_states


def judged_steady(claim: BoundClaim) -> Verdict:
    """Judge a claim with all non-ignorable speeds and all accelerations zero, on every family.

    A member that gives a speed by a root, with or without ±, claims that each of its branches is a
    steady motion; a remark says whether it covers all of them. A relation between speeds and angles
    need not hold where an angle is fixed by itself, such as at the bottom of a hoop; a remark then
    says that the claim does not speak of such motions.
    """
    families = steady_states(claim)
    solved = [solved_members(claim, branch) for branch in range(len(claim.branches))]
    if not any(solved):
        return _on_families(claim, families)
    found = [f for branch in solved for f in _contradictions(branch, families[0])]
    members = (member for branch in solved for member in branch)
    found = found or [f for member in members for f in _not_steady(claim, member)]
    if found:
        return failed(found, "steady")
    named = {member.member for member in solved[0]}
    rest = claim.only([i for i in range(len(claim.members)) if i not in named])
    others = _on_families(rest, families)
    if not others.holds:
        return others
    remarks = tuple(_covered(solved, families))
    return Verdict(Answer.HOLDS, "steady", remarks=(*others.remarks, *remarks))


def _on_families(claim: BoundClaim, families: Sequence[SteadyStates]) -> Verdict:
    """The verdict on every family.

    A relation that contains an angle or a rate need not hold where this one rests, if it holds
    where it does not.
    """
    named_in_claim = {s for c in claim.components() for s in c.difference.symbols()}
    special = [f for f in families if f.resting & named_in_claim]
    # Where an angle rests at 0 or π, a side may have no value, such as 1/sin θ.
    singular = [f for f in special if not _has_values(claim, f)]
    families = [f for f in families if f not in singular] or families
    wrong = [f for f in families if next(failures(claim, [f]), None) is not None]
    right = [f for f in families if f not in wrong]
    verdict = judged(claim, wrong, "steady")
    excluded = [*wrong, *singular]
    if not excluded or not right:
        return verdict
    named, unnamed = ("; ".join(str(f.family) for f in group) for group in (right, excluded))
    remark = f"it holds on the steady motions {named}"
    if all(f in special for f in wrong) and not all(f.resting for f in right):
        remark += f", and does not cover {unnamed}"
        return Verdict(Answer.HOLDS, "steady", remarks=(remark,))
    return replace(verdict, remarks=(*verdict.remarks, f"{remark}, but not on {unnamed}"))


def _has_values(claim: BoundClaim, family: SteadyStates) -> bool:
    """Whether both sides have values on a family."""
    try:
        for component in claim.components():
            family.on(component.left)
            family.on(component.right)
    except (PolhodeError, ZeroDivisionError):
        return False
    return True


# -- members that give a quantity by its roots ----------------------------------------------------


@dataclass(frozen=True)
class SolvedMember:
    """A member that gives one state variable by roots.

    Attributes:
        member: its number.
        quantity: the variable it gives.
        value: the claimed value.
        is_alternative: whether it is a further value after an "or".
    """

    member: int
    quantity: Symbol
    value: Expr
    is_alternative: bool = False


def solved_members(claim: BoundClaim, branch: int) -> list[SolvedMember]:
    """The members of a branch of ± that give a coordinate or speed by roots or by ±."""
    state = {*claim.equations.coordinates, *claim.equations.speeds}
    found = []
    for component in claim.components(branch):
        quantity = component.left.symbol
        rooted = any(g.depth and g.partner() is None for g in component.right.generators)
        given_by_itself = quantity in component.right.symbols()
        if quantity in state and not given_by_itself and (rooted or len(claim.branches) > 1):
            alternative = claim.branches[branch][component.member].is_alternative
            found.append(SolvedMember(component.member, quantity, component.right, alternative))
    return found


def _contradictions(solved: Sequence[SolvedMember], states: TrueMotion) -> Iterator[Failure]:
    """Members that give one quantity different values without an "or" in the text."""
    for one, other in combinations(solved, 2):
        if one.quantity == other.quantity and not other.is_alternative:
            component = ScalarRelation(other.member, "", one.value, other.value)
            left = states.on(component.difference)
            if left:
                yield Failure(component, states, Residual(other.member, "", left))


def _not_steady(claim: BoundClaim, solved: SolvedMember) -> Iterator[Failure]:
    """Accelerations that do not vanish where the quantity has the claimed value."""
    equations = claim.equations
    at_rest = {q.derivative(): ZERO for q in reduced(equations).essential}
    given = {**at_rest, **claim.given}
    given[solved.quantity] = solved.value.subs(given)
    key, fixed = ByIdentity(equations), tuple(given.items())
    states = restricted_states(TrueMotion, key, fixed, claim.relations, claim.positive)
    for symbol in equations.acceleration_symbols:
        left = states.on(Expr.generator(symbol))
        if left:
            component = ScalarRelation(solved.member, "", Expr.generator(symbol), ZERO)
            yield Failure(component, states, Residual(solved.member, "", left))
            return


def _covered(solved: list[list[SolvedMember]], families: tuple[SteadyStates, ...]) -> Iterator[str]:
    """How many of the roots of a family's relation the branches give."""
    for members in zip(*solved, strict=True):
        values = dict.fromkeys(member.value for member in members)
        quantity = members[0].quantity
        for relation in (r for family in families for r in family.settled_relations):
            orders = (powers.get(quantity, 0) for powers, _ in relation.numerator.terms())
            degree = max(orders, default=0)
            if degree:
                yield f"{min(len(values), degree)} of {degree} roots of {relation} = 0 are covered"


# -- exact roots that an approximate claim about a steady rate is compared with -------------------


def steady_roots(
    claim: BoundClaim, unknown: Collection[Symbol], scaled: Callable[[Expr], Expr]
) -> Iterator[dict[Symbol, Expr]]:
    """The values that a speed or an angle has in steady motion.

    Args:
        claim: about small quantities.
        unknown: what may be solved for.
        scaled: an expression in terms of the small quantities. The relation between steady speeds
            is scaled before it is solved, since a small quantity may contain the unknown.
    """
    try:
        families = steady_states(claim)
    except PolhodeError:
        return
    for relation in (r for family in families for r in family.speed_relations):
        symbols = {s for s in relation.symbols() if s in unknown and s.kind.varies}
        speeds = {s for s in symbols if s.order or s.kind is SymbolKind.SPEED} or symbols
        # A claim that gives a speed is about that one; otherwise it is about the one left open.
        given = {s for c in claim.components() if (s := c.left.symbol) in speeds}
        large = {s for s in speeds if scaled(x := Expr.generator(s)) != x}
        for choice in (given - large, speeds - large, given):
            if len(choice) == 1:
                (chosen,) = choice
                for root in roots(scaled(relation).numerator, chosen):
                    yield {chosen: root}
                break

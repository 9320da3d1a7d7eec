"""Claims about steady motions, ± branches among them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, Symbol
from polhode.analyse import reduced
from polhode.claims._verdict import Answer, Residual, Verdict
from polhode.claims.contexts._judge import Failure, failed, judged
from polhode.claims.meaning._components import Component
from polhode.claims.states._asked import Asked
from polhode.claims.states._circumstances import TrueMotion
from polhode.claims.states._steady_states import SteadyStates, steady_states


def judged_steady(asked: Asked) -> Verdict:
    """With non-ignorable speeds and all accelerations zero, on every family.

    A member that gives a speed by a root, with or without ±, claims that every branch of it is a
    steady motion; whether it covers all of them is remarked.
    """
    families = steady_states(asked)
    solved = [solved_members(asked, branch) for branch in range(len(asked.branches))]
    if not any(solved):
        return judged(asked, families, "steady")
    found = [f for branch in solved for member in branch for f in _not_steady(asked, member)]
    if found:
        return failed(found, "steady")
    named = {member.member for member in solved[0]}
    rest = asked.only([i for i in range(len(asked.members)) if i not in named])
    others = judged(rest, families, "steady")
    if not others.holds:
        return others
    remarks = tuple(_covered(solved, families))
    return Verdict(Answer.HOLDS, "steady", remarks=remarks)


@dataclass(frozen=True)
class Solved:
    """A member that gives one state variable by roots."""

    member: int
    quantity: Symbol
    value: Expr


def solved_members(asked: Asked, branch: int) -> list[Solved]:
    state = {*asked.equations.coordinates, *asked.equations.speeds}
    found = []
    for component in asked.components(branch):
        quantity = component.left.symbol
        rooted = any(g.depth and g.partner() is None for g in component.right.generators)
        if quantity in state and (rooted or len(asked.branches) > 1):
            found.append(Solved(component.member, quantity, component.right))
    return found


def _not_steady(asked: Asked, solved: Solved) -> Iterator[Failure]:
    """Accelerations that do not vanish where the quantity has the claimed value."""
    equations = asked.equations
    still = {q.derivative(): ZERO for q in reduced(equations).essential}
    given = {**still, **asked.given}
    given[solved.quantity] = solved.value.subs(given)
    states = TrueMotion(equations, given, asked.relations, asked.positive)
    for symbol in equations.acceleration_symbols:
        left = states.on(Expr.generator(symbol))
        if left:
            component = Component(solved.member, "", Expr.generator(symbol), ZERO)
            yield Failure(component, states, Residual(solved.member, "", left))
            return


def _covered(solved: list[list[Solved]], families: tuple[SteadyStates, ...]) -> Iterator[str]:
    """How many of the roots of a family's relation the branches are."""
    for members in zip(*solved, strict=True):
        values = dict.fromkeys(member.value for member in members)
        for relation in (r for family in families for r in family.settled_relations):
            degree = _degree(relation, members[0].quantity)
            if degree:
                yield f"{min(len(values), degree)} of {degree} roots of {relation} = 0 are covered"


def _degree(relation: Expr, symbol: Symbol) -> int:
    return max((powers.get(symbol, 0) for powers, _ in relation.numerator.terms()), default=0)

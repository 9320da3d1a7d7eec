"""Whether relations hold on given states, member by member and component by component."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import product
from math import prod

from polhode.algebra import ONE, Expr
from polhode.claims._dimensions import dimensions_at_odds
from polhode.claims._verdict import Answer, Evidence, Refuted, Residual, Verdict
from polhode.claims.balance._declared import reaction_symbol
from polhode.claims.latex._tree import Name
from polhode.claims.meaning._components import ScalarRelation
from polhode.claims.meaning._mechanics import Mechanics
from polhode.claims.states._bound_claim import BoundClaim
from polhode.claims.states._claim_domain import AnyState, ClaimDomain, TrueMotion

# Whether relations hold on given states, member by member and component by component.


@dataclass(frozen=True)
class Failure:
    """One component of a claim that does not hold on some states."""

    component: ScalarRelation
    states: ClaimDomain
    residual: Residual


def judged_identity(asked: BoundClaim) -> Verdict:
    """For all states obeying the constraints, accelerations free."""
    states = asked.states(AnyState)
    return judged(asked, [states], "identity")


def judged_motion(asked: BoundClaim) -> Verdict:
    """On every true motion."""
    states = asked.states(TrueMotion)
    return judged(asked, [states], "motion")


def judged(asked: BoundClaim, all_states: Sequence[ClaimDomain], context: str) -> Verdict:
    """The verdict on equations: holds, or fails with evidence."""
    found = list(failures(asked, all_states))
    alike = [f for f in found if len(asked.branches) == 1 and says_the_same(asked, f.component)]
    wrong = [f for f in found if f not in alike]
    if wrong:
        return failed(wrong, context)
    said = dict.fromkeys(remark(f.component.difference) for f in alike)
    return Verdict(Answer.HOLDS, context, remarks=tuple(said))


def failures(asked: BoundClaim, all_states: Iterable[ClaimDomain]) -> Iterator[Failure]:
    """Every component that does not vanish on every set of states.

    ± is one choice for the whole statement: at every state all components vanish on one branch,
    which is so where each product of residuals, one of each branch, vanishes. A ± of which one
    sign is right everywhere and the other is not says too much.
    """
    every = [asked.components(branch) for branch in range(len(asked.branches))]
    found: dict[ScalarRelation, Failure] = {}
    idle: dict[int, list[Failure]] = {branch: [] for branch in range(len(every))}
    for states in all_states:
        wrong = [[c for c in branch if states.on(c.difference)] for branch in every]
        for alike in sorted(product(*wrong), key=lambda picked: len({*map(_place, picked)})):
            failure = _failure(alike, states)
            if failure is not None:
                found.setdefault(alike[0], failure)
        for branch, components in enumerate(wrong):
            idle[branch] += [f for c in components if (f := _failure((c,), states)) is not None]
    if not found and not all(idle.values()):
        yield from next(filter(None, idle.values()), ())
        return
    yield from sorted(found.values(), key=lambda f: every[0].index(f.component))


def _failure(alike: Sequence[ScalarRelation], states: ClaimDomain) -> Failure | None:
    """Of components, one of each branch: the states on which none of them vanishes."""
    left = prod((states.on(component.difference) for component in alike), start=ONE)
    first = alike[0]
    if not left:
        return None
    return Failure(first, states, Residual(first.member, first.label, left))


def failed(found: Sequence[Failure], context: str) -> Verdict:
    """The verdict on a claim with these failures, refuted at a state."""
    where = "; ".join(dict.fromkeys(_place(f.component) for f in found))
    return Refuted(
        Answer.FAILS,
        context,
        f"the sides differ in {where}",
        residuals=tuple(f.residual for f in found),
        remarks=tuple(_left_open(found[0])),
        evidence=partial(_evidence, found[0]),
    )


def _left_open(failure: Failure) -> Iterator[str]:
    """Which reactions that are spoken of no motion determines."""
    component, equations = failure.component, failure.states.equations
    spoken = component.left.symbols() | component.right.symbols()
    names = [name for name in equations.undetermined if reaction_symbol(name) in spoken]
    if names:
        yield f"Newton's laws leave {', '.join(names)} open: more holds the body than is needed"


def _evidence(worst: Failure) -> Evidence:
    from polhode.claims.contexts._counterexample import refutation  # numbers are for failures alone

    whole = worst.residual.expression
    return refutation(worst.component, worst.residual, worst.states, nonzero=whole)


def _place(component: ScalarRelation) -> str:
    member = f"member {component.member + 1}"
    return f"component {component.label} of {member}" if component.label else member


# Lagrangians that differ and still are the same: by a constant, or by a total time derivative.

_LETTERS = ("cal L", "L")


def says_the_same(asked: BoundClaim, component: ScalarRelation) -> bool:
    """Whether a text's Lagrangian has the equations of motion of the model's.

    It has where the variation of the difference vanishes for every coordinate: Landau and
    Lifshitz, Mechanics, § 2.
    """
    printed = asked.members[component.member].printed
    if printed is None or not isinstance(printed.left, Name) or component.label:
        return False
    mechanics = Mechanics(asked.equations)
    if printed.left.letter not in _LETTERS or component.left != mechanics.lagrangian():
        return False
    if dimensions_at_odds(asked.only([component.member])):
        return False
    rest = mechanics.in_rates(component.difference)
    if not any(s.kind.varies for s in rest.symbols()):
        return True
    coordinates = mechanics.declared.coordinates
    rates = {q.derivative() for q in coordinates}
    known = {s for s in rest.symbols() if s.kind.varies} <= {*coordinates, *rates}
    variations = (rest.diff(q.derivative()).dt() - rest.diff(q) for q in coordinates)
    return known and not any(map(bool, variations))


def remark(difference: Expr) -> str:
    """What is said of such a difference."""
    return (
        f"the Lagrangians differ by {difference}, a total time derivative, which no equation of "
        "motion contains"
        if any(s.kind.varies for s in difference.symbols())
        else f"the Lagrangians differ by {difference}, which no equation of motion contains"
    )

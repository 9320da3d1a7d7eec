"""Whether equations hold on given states, member by member and component by component."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import combinations, product
from math import prod

from polhode.algebra import ONE, Expr, as_symbol, dot, linear_parts, solve, time
from polhode.base import PolhodeError
from polhode.judge._dimensions import dimensions_at_odds
from polhode.judge._verdict import Answer, Evidence, Refuted, Residual, Verdict
from polhode.judge.balance._declared import reaction_symbol
from polhode.judge.latex._tree import At, Name, Negative, Sum, walk
from polhode.judge.meaning._derived_quantities import (
    effective_potential,
    hamiltonian,
    independent,
    phase_space,
)
from polhode.judge.meaning._evaluate import Evaluator
from polhode.judge.meaning._mechanics import Mechanics, on_constraints
from polhode.judge.meaning._relations import PrintedRelation, ScalarRelation
from polhode.judge.meaning._vocabulary import Vocabulary
from polhode.judge.states._bound_claim import BoundClaim
from polhode.judge.states._claim_domain import AnyState, ClaimDomain, TrueMotion

_LAGRANGIANS = ("cal L", "L")
_GIBBS = ("S", "G", "cal S", "Z")  # of the energy of acceleration
_TIME = as_symbol(time)
_FEW = 4  # accelerations of a system of which rows are tried
ENERGIES = ("E", "V", "U", "H", "cal H", "W", "PE", "GPE", "EPE")


def judged_identity(claim: BoundClaim) -> Verdict:
    """For all states obeying the constraints, accelerations free."""
    return judged(claim, [claim.states(AnyState)], "identity")


def judged_motion(claim: BoundClaim) -> Verdict:
    """On every true motion."""
    if at_given_accelerations(claim) is not None:
        return Verdict(Answer.HOLDS, "motion")
    return judged(claim, [claim.states(TrueMotion)], "motion")


def at_given_accelerations(claim: BoundClaim) -> Callable[[Expr], Expr] | None:
    """Expressions on some equations of motion and accelerations that are given, if a claim follows.

    Of a motion with θ̇ = 0 and θ̈ = 0 the other accelerations follow from rows of M u̇ = f, however
    complicated the restriction is that the remaining rows set for the state. None where no choice
    of rows makes the claim true.
    """
    equations = claim.equations
    rates = equations.acceleration_symbols
    held = [r for r in claim.relations if not r.symbols().isdisjoint(rates)]
    if not held or len(claim.branches) > 1 or len(rates) > _FEW:
        return None
    others = tuple(r for r in claim.relations if r not in held)
    states = replace(claim, relations=others).states(AnyState)
    solved_for = [Expr.generator(rate) for rate in rates]
    sides = zip(equations.mass.rows, equations.forcing, strict=True)
    rows = [dot(row, solved_for) - side for row, side in sides]
    for chosen in combinations(rows, len(rates) - len(held)):
        with suppress(PolhodeError, ArithmeticError):
            known = [linear_parts(states.on(row), rates) for row in (*held, *chosen)]
            found = solve([parts for parts, _ in known], [-rest for _, rest in known])
            values = dict(zip(rates, found, strict=True))
            if not any(states.on(c.difference).subs(values) for c in claim.components()):
                return lambda expression: states.on(expression).subs(values)
    return None


def judged(claim: BoundClaim, domains: Sequence[ClaimDomain], context: str) -> Verdict:
    """The verdict on equations: holds, or fails with evidence."""
    found = list(failures(claim, domains))
    equivalent = [
        f for f in found if len(claim.branches) == 1 and _is_equivalent(claim, f.component)
    ]
    wrong = [f for f in found if f not in equivalent]
    if wrong:
        return failed(wrong, context)
    remarks = [_remark(claim, f.component) for f in equivalent]
    bound = None if equivalent else error_bound(claim, domains)
    return Verdict(Answer.HOLDS, context, remarks=tuple(dict.fromkeys(remarks)), error_bound=bound)


def error_bound(claim: BoundClaim, domains: Iterable[ClaimDomain]) -> float | None:
    """At least the probability that a claim judged true does not hold; None if that is certain."""
    branches = [claim.components(branch) for branch in range(len(claim.branches))]
    decided = (
        states.vanishing(*(component.difference for component in chosen))
        for states in domains
        for chosen in product(*branches)
    )
    return sum(found.error_bound for found in decided) or None


@dataclass(frozen=True)
class Failure:
    """One component of a claim that does not hold on some states."""

    component: ScalarRelation
    states: ClaimDomain
    residual: Residual


def failures(claim: BoundClaim, domains: Iterable[ClaimDomain]) -> Iterator[Failure]:
    """Every component whose residual does not vanish on every domain.

    ± is one choice for the whole statement: at every state all components must vanish on one of the
    branches. That is so exactly if each product of residuals, one from each branch, vanishes. If
    one sign is right everywhere and the other is not, the ± claims too much and fails.
    """
    branches = [claim.components(branch) for branch in range(len(claim.branches))]
    found: dict[ScalarRelation, Failure] = {}
    single: list[list[Failure]] = [[] for _ in branches]  # of one branch each
    for states in domains:
        wrong = [
            [c for c in branch if not states.vanishing(c.difference).is_zero] for branch in branches
        ]
        # Products of the same component on every branch come first: they read best in a verdict.
        for chosen in sorted(product(*wrong), key=lambda picked: len({*map(_place, picked)})):
            failure = _failure(chosen, states)
            if failure is not None:
                found.setdefault(chosen[0], failure)
        for failing, components in zip(single, wrong, strict=True):
            failing += [f for c in components if (f := _failure((c,), states)) is not None]
    if not found and not all(single):
        yield from next(filter(None, single), ())
        return
    yield from sorted(found.values(), key=lambda f: branches[0].index(f.component))


def _failure(chosen: Sequence[ScalarRelation], states: ClaimDomain) -> Failure | None:
    """The failure of components, one from each branch, if the product of residuals is not zero."""
    if states.vanishing(*(component.difference for component in chosen)).is_zero:
        return None
    left = prod((states.on(component.difference) for component in chosen), start=ONE)
    first = chosen[0]
    return Failure(first, states, Residual(first.member, first.label, left)) if left else None


def failed(found: Sequence[Failure], context: str) -> Verdict:
    """The verdict on a claim with these failures, refuted at a state."""
    first = found[0]
    component, equations = first.component, first.states.equations
    where = "; ".join(dict.fromkeys(_place(f.component) for f in found))
    used = component.left.symbols() | component.right.symbols()
    undetermined = [name for name in equations.undetermined if reaction_symbol(name) in used]
    remarks: tuple[str, ...] = ()
    if undetermined:
        names = ", ".join(undetermined)
        remarks = (f"Newton's laws do not determine {names}: there are more supports than needed",)

    def evidence() -> Evidence:
        from polhode.judge.contexts._counterexample import refutation  # NumPy, for failures only

        whole = first.residual.expression
        return refutation(component, first.residual, first.states, nonzero=whole)

    return Refuted(
        Answer.FAILS,
        context,
        f"the sides differ in {where}",
        residuals=tuple(f.residual for f in found),
        remarks=remarks,
        evidence=evidence,
    )


def _place(component: ScalarRelation) -> str:
    member = f"member {component.member + 1}"
    return f"component {component.label} of {member}" if component.label else member


# -- energies of another level, and Lagrangians that differ by a total time derivative ------------


def _is_equivalent(claim: BoundClaim, component: ScalarRelation) -> bool:
    """Whether a text's energy or Lagrangian differs from the model's by what has no effect.

    An energy may differ by a constant, an effective potential by a function of the momenta that are
    held. A Lagrangian gives the same equations of motion if the Lagrange derivative
    d/dt ∂f/∂q̇ - ∂f/∂q of the difference f vanishes for every coordinate: then f is a constant plus
    a total time derivative. See Landau and Lifshitz, Mechanics, § 2.
    """
    printed = claim.members[component.member].printed
    component = _with_letter_left(claim, component)
    left = _printed_letter(claim, component)
    if left is None or (printed is not None and _count(ENERGIES, printed) > 1):
        return False  # of two energies both are counted from one level
    if dimensions_at_odds(claim.only([component.member])):
        return False
    mechanics = Mechanics(claim.equations)
    if left.letter in _GIBBS and component.left == mechanics.energy_of_acceleration():
        rest = claim.states(AnyState).on(component.difference)
        return rest.symbols().isdisjoint(claim.equations.acceleration_symbols)
    if left.letter not in _LAGRANGIANS or component.left != mechanics.lagrangian():
        return left.letter in ENERGIES and _is_energy_level(
            mechanics, component, claim.members[component.member].printed
        )
    rest = mechanics.in_rates(component.difference)
    # By the constraints heights may be counted from another body's: V = Mgr of a weight on a rope.
    if not rest.varies or not on_constraints(component.difference.dt(), claim.equations):
        return True
    coordinates = mechanics.declared.coordinates
    rates = {q.derivative() for q in coordinates}
    known = {s for s in rest.symbols() if s.kind.varies} <= {*coordinates, *rates}
    variations = (rest.diff(q.derivative()).dt() - rest.diff(q) for q in coordinates)
    return known and not any(map(bool, variations))


def _count(letters: Sequence[str], printed: PrintedRelation) -> int:
    """How often a relation prints some letters, whatever their subscripts are."""
    sides = (walk(printed.left), walk(printed.right))
    return sum(isinstance(p, Name) and p.letter in letters for side in sides for p in side)


def _printed_letter(claim: BoundClaim, component: ScalarRelation) -> Name | None:
    """The letter that a scalar relation is about, such as the V of V(θ) = ..."""
    return _letter_of(claim, component, is_left=True) or _letter_of(claim, component, is_left=False)


def _letter_of(claim: BoundClaim, component: ScalarRelation, is_left: bool) -> Name | None:
    printed = claim.members[component.member].printed
    if printed is None or component.label:
        return None
    side = printed.left if is_left else printed.right
    letter = side.of if isinstance(side, At) else side
    if isinstance(letter, Sum):
        return _sum_of_energies(claim, component.left if is_left else component.right, letter)
    return letter if isinstance(letter, Name) else None


def _sum_of_energies(claim: BoundClaim, value: Expr, printed: Sum) -> Name | None:
    """The L or E that T - V or T + V stands for, as in L = T - V = ..."""
    terms = [term.of if isinstance(term, Negative) else term for term in printed.terms]
    if not all(isinstance(term, Name) for term in terms):
        return None
    mechanics = Mechanics(claim.equations)
    known = {"L": mechanics.lagrangian(), "E": mechanics.energy()}
    return next((Name(letter) for letter, quantity in known.items() if value == quantity), None)


def _with_letter_left(claim: BoundClaim, component: ScalarRelation) -> ScalarRelation:
    """The relation, or ... = E as E = ..."""
    if _letter_of(claim, component, is_left=True) or not _letter_of(
        claim, component, is_left=False
    ):
        return component
    return replace(component, left=component.right, right=component.left)


def other_level(claim: BoundClaim, component: ScalarRelation, difference: Expr) -> bool:
    """Whether a component gives an energy, and a constant difference of it is one of levels."""
    component = _with_letter_left(claim, component)
    left = _printed_letter(claim, component)
    if left is None or left.letter not in ENERGIES:
        return False
    if not _is_constant(difference) or dimensions_at_odds(claim.only([component.member])):
        return False
    mechanics = Mechanics(claim.equations)
    levels = (mechanics.energy(), mechanics.potential_energy(), *mechanics.potentials.values())
    return component.left in levels


def _is_energy_level(
    mechanics: Mechanics, component: ScalarRelation, printed: PrintedRelation | None
) -> bool:
    """Whether an energy is measured from another level than the model's.

    That of an effective potential may depend on the momenta that are held.
    """
    if not component.left:
        return False  # there is nothing whose level could be another
    difference = mechanics.in_rates(component.difference)
    rate = on_constraints(component.difference.dt(), mechanics.equations)
    potential = mechanics.potential_energy()
    levels = (mechanics.energy(), potential, -potential, *mechanics.potentials.values())
    if not rate and component.left in levels:
        return True
    try:
        if component.left == hamiltonian(mechanics):
            return _is_constant(difference)
        if component.left != effective_potential(mechanics):
            return False
        space = phase_space(mechanics)
    except (PolhodeError, ZeroDivisionError):
        return False  # the system has none
    if _TIME in difference.symbols() or not space.is_constant(difference):
        return False
    # A text may leave out the energy of a cyclic rotation, but has to print it rightly.
    return _is_constant(difference) or not any(
        space.is_constant(term) and not _is_constant(term)
        for term in _printed_terms(mechanics, printed)
    )


def _printed_terms(mechanics: Mechanics, printed: PrintedRelation | None) -> Iterator[Expr]:
    """The terms of the sides of a relation, as far as the declaration and the field know them."""
    evaluator = Evaluator(Vocabulary.of(mechanics.equations))
    for side in (printed.left, printed.right) if printed else ():
        for term in side.terms if isinstance(side, Sum) else ():
            with suppress(PolhodeError):
                yield mechanics.in_rates(evaluator.scalar(term))


def _constrained(mechanics: Mechanics, difference: Expr) -> Expr:
    """By the constraints: a text writes ẏ where the model has a ω, or counts heights otherwise."""
    found = on_constraints(difference, mechanics.equations)
    with suppress(PolhodeError):
        found = found.subs(independent(mechanics))
    return found


def _remark(claim: BoundClaim, component: ScalarRelation) -> str:
    component = _with_letter_left(claim, component)
    difference = component.difference
    mechanics = Mechanics(claim.equations)
    left = _printed_letter(claim, component)
    if left is not None and left.letter in _GIBBS:
        return "the sides differ by terms without accelerations, which have no effect"
    if component.left != mechanics.lagrangian():
        if not _is_constant(difference):
            difference = _constrained(mechanics, difference)
        return f"the energies differ by {difference}, since they count from different levels"
    kind = ", a total time derivative," if difference.varies else ","
    return f"the Lagrangians differ by {difference}{kind} which no equation of motion contains"


def _is_constant(expression: Expr) -> bool:
    return not expression.varies and _TIME not in expression.symbols()

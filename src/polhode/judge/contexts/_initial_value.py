"""Claims along the motion from a given start: the context `launch`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import islice
from math import isclose

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, is_positive
from polhode.analyse import invariants
from polhode.base import ByIdentity, NumericError, PolhodeError
from polhode.derive import Equations
from polhode.judge._verdict import (
    Answer,
    Confirmation,
    Counterexample,
    Refuted,
    Residual,
    SimpleCondition,
    SimpleRelation,
    Verdict,
)
from polhode.judge.balance._newton_euler import moved
from polhode.judge.contexts._equations import Failure, failed, failures, judged
from polhode.judge.contexts._inequality import judged_inequality
from polhode.judge.contexts._integrated import judged_from_start
from polhode.judge.contexts._sampled_motion import (
    TIME,
    SampledMotion,
    SampledRelation,
    sampled_motions,
)
from polhode.judge.meaning._initial_values import initial_value
from polhode.judge.meaning._relations import ScalarRelation
from polhode.judge.states._bound_claim import EQUALITY, BoundClaim
from polhode.judge.states._claim_domain import IrreducibleStates, TrueMotion, solved
from polhode.judge.states._numeric import number
from polhode.judge.states._sample_points import SamplePoints, SymbolValues

_MOTIONS = 3  # with different parameters, so that agreement by chance is unlikely
_SHORT, _LONG = 6.0, 24.0  # s; the longer one where an event has to be reached
_PARTS = (0.07, 0.2)  # fractions of a motion at which a correction is tried
_HIGHEST_RATE = 4  # highest derivative of both sides compared just after the start
_TOLERANCES = (1e-6, 1e-9)  # of the second integration
_ROUNDING = 1e-5  # relative difference allowed between the two integrations
#: The letter of texts for the time at which a motion starts.
_CLOCK = Symbol("t_0")


def judged_launch(claim: BoundClaim) -> Verdict:
    """Judge a claim along the motion from the given start.

    Equations are first tried exactly, with the conserved quantities at their initial values. If
    that leaves them open, and for every statement on the course of the motion, the motion is
    integrated for several choices of the parameters.
    """
    claim = _started(claim)
    if (near := judged_from_start(claim, at_start(claim))) is not None:
        return near
    found = against_invariants(claim)
    if found == []:
        return Verdict(Answer.HOLDS, "launch", reason="follows from the conserved quantities")
    if found and _keeps_its_start(claim):
        return _after_equilibrium(claim, found)
    return judged_along(claim)


def judged_along(claim: BoundClaim) -> Verdict:
    """Judge it by integration alone, without a proof: faster where many claims are tried."""
    if claim.when == "initially":
        return _judged_initially(at_start(claim))
    claim = _started(claim)
    fixed = {s: e for s, e in claim.given.items() if not s.kind.varies}
    event = {s: e for s, e in claim.given.items() if s.kind.varies}
    if len(event) > 1:
        raise NumericError(
            f"an event at which {', '.join(sorted(s.published for s in event))} have given values",
            expected="one quantity: the event is the instant at which it first reaches its value",
            advice="judge the claim with each of these restrictions separately",
        )
    return _judged_by_numbers(replace(claim, given=fixed), event)


def _started(claim: BoundClaim) -> BoundClaim:
    """The claim with its restrictions on the state as the start, if no start is given."""
    if claim.start:
        return claim
    start = {s: e for s, e in claim.given.items() if s.kind.varies}
    fixed = {s: e for s, e in claim.given.items() if s not in start}
    return replace(claim, start=start, given=fixed)


def at_start(claim: BoundClaim) -> BoundClaim:
    """The claim restricted to the start of the motion."""
    claim = _started(claim)
    fixed = {s: e for s, e in claim.given.items() if not s.kind.varies}
    return replace(claim, given={**fixed, **claim.start})


def _is_equation(claim: BoundClaim) -> bool:
    """Whether all members are equations, with no words on when they hold."""
    return not claim.when and all(relation.sign in EQUALITY for relation in claim.members)


# -- exactly, from the conserved quantities -------------------------------------------------------


def against_invariants(claim: BoundClaim) -> list[Failure] | None:
    """What fails on the states with the conserved quantities of the start; None if undecided.

    With the other restrictions of the claim these are the states at an event, such as θ = π/2.
    """
    claim = _started(claim)
    timeless = not any(TIME in c.difference.symbols() for c in claim.components())
    if not (timeless and claim.start and _is_equation(claim)):
        return None
    try:
        return list(failures(claim, [_with_invariants(claim)]))
    except (PolhodeError, ArithmeticError):
        return None


def _with_invariants(claim: BoundClaim) -> TrueMotion:
    """All states with the same conserved quantities as the start."""
    start = _whole_start(claim)
    conserved = [e - e.subs(start) for e in _conserved(ByIdentity(claim.equations))]
    relations = (*claim.relations, *(e for e in conserved if e))
    positive = (*claim.positive, *_arriving(claim))
    return replace(claim.states(IrreducibleStates), relations=relations, positive=positive)


def _whole_start(claim: BoundClaim) -> dict[Symbol, Expr]:
    """The start, with letters for what it leaves open, as far as no loop determines that."""
    state = (*claim.equations.coordinates, *claim.equations.speeds)
    letters = {s: initial_value(s) for s in state if s not in claim.start}
    start = {s: Expr.generator(letter) for s, letter in letters.items()} | dict(claim.start)
    for closure in claim.equations.closures:
        if gap := closure.subs(start):
            letter, value = solved(gap, lambda s: (s not in letters.values(), s.published))
            start = {s: e.subs({letter: value}) for s, e in start.items()}
    return start


def _arriving(claim: BoundClaim) -> Iterator[Expr]:
    """The rates at which coordinates first reach the values of an event, counted positive."""
    for symbol, value in claim.given.items():
        since = claim.start.get(symbol)
        if symbol.kind is SymbolKind.COORDINATE and not symbol.order and since is not None:
            rate = Expr.generator(symbol.derivative())
            yield from (way * rate for way in (1, -1) if is_positive((value - since) * way))


def _keeps_its_start(claim: BoundClaim) -> bool:
    """Whether it starts in equilibrium: whatever has an initial value keeps it."""
    states = at_start(claim).states(TrueMotion)
    rates = (Expr.generator(symbol.derivative()) for symbol in claim.start)
    return bool(claim.start) and not any(map(states.on, rates))


def _after_equilibrium(claim: BoundClaim, found: Sequence[Failure]) -> Verdict:
    """The verdict on what fails for a motion that leaves the equilibrium in which it starts."""
    refuted = failed(found, "launch").proved()
    if refuted.counterexample is None:
        return judged_along(claim)  # the equilibrium is stable, as far as was tried
    if any(s.kind.varies for s in claim.given):
        return refuted
    undecided = Verdict(
        Answer.UNREAD,
        "launch",
        reason="it was read; it holds while the body stays in the equilibrium in which it starts, "
        "and fails for a motion that leaves it",
        residuals=refuted.residuals,
    )
    where = tuple(_ways_to_leave(claim))
    return replace(undecided, option="positive", holds_where=where) if where else undecided


def _ways_to_leave(claim: BoundClaim) -> Iterator[SimpleCondition]:
    """The signs of speeds with which a motion leaves an equilibrium and the claim holds."""
    for speed in (Expr.generator(s) for s in claim.start if s in claim.equations.speeds):
        for sign, way in (">", speed), ("<", -speed):
            if against_invariants(replace(claim, positive=(*claim.positive, way))) == []:
                yield (SimpleRelation(speed, sign, ZERO),)


@lru_cache(maxsize=16)
def _conserved(key: ByIdentity[Equations]) -> tuple[Expr, ...]:
    found = (i.expression for i in invariants(key.subject))
    return tuple(map(key.subject.kinetics.on_speeds, found))


# -- at the start and just after it ---------------------------------------------------------------


def _judged_initially(claim: BoundClaim) -> Verdict:
    """Judge it at the start; an inequality whose sides are equal there, just after the start.

    Just after it, the sign of left - right is that of its lowest derivative that does not vanish.
    """
    states = claim.states(TrueMotion)
    equal = {i for i, r in enumerate(claim.members) if r.sign in EQUALITY}
    verdict = judged(claim.only(equal), [states], "launch")
    for component in (c for c in claim.components() if c.member not in equal):
        if verdict.holds:
            verdict = judged_inequality(claim, _lowest_rates(component, states), states)
    return replace(verdict, context="launch")


def _lowest_rates(component: ScalarRelation, states: TrueMotion) -> ScalarRelation:
    """The lowest rates of both sides that differ at the start; both sides, where none do."""
    running = replace(states, given={})
    rates = component
    for _ in range(_HIGHEST_RATE):
        if states.on(rates.difference):
            return rates
        left, right = (running.on(side).dt() for side in (rates.left, rates.right))
        rates = replace(rates, left=left, right=right)
    return component


# -- by numbers, along several motions ------------------------------------------------------------


def _judged_by_numbers(claim: BoundClaim, event: Mapping[Symbol, Expr]) -> Verdict:
    """Judge it along several motions, or at the event at which it is claimed."""
    running = replace(claim, relations=()).states(TrueMotion)
    duration = _LONG if event or claim.when == "finally" else _SHORT
    found = (motion.at(event) for motion in _motions(claim, running, duration))
    relation, is_tested = None, False
    for motion in islice(filter(None, found), _MOTIONS):
        for component in claim.components():
            relation = SampledRelation.along(motion, component, claim, running)
            sample = relation.exception(claim.when)
            if sample is not None:
                return _refuted(relation, sample, claim)
            is_tested = is_tested or not relation.is_void
    if relation is None:
        raise NumericError(
            "a start from which no motion could be integrated",
            expected="a start that fixes the motion",
        )
    if not is_tested:
        raise NumericError(
            "a start from which both sides stay zero along every motion that was tried",
            expected="a start from which something moves",
        )
    reason = f"by numerical integration of {_MOTIONS} motions"
    return Verdict(Answer.HOLDS, "launch", reason=reason)


def _motions(claim: BoundClaim, running: TrueMotion, duration: float) -> Iterator[SampledMotion]:
    starts = replace(claim, given={**claim.given, **claim.start}).states(TrueMotion)
    used = [running.on(side) for c in claim.components() for side in (c.left, c.right)]
    clock = _CLOCK if any(_CLOCK in e.symbols() for e in used) else None
    return sampled_motions(starts, used, clock, duration)


def sample_points_along(claim: BoundClaim) -> tuple[TrueMotion, SamplePoints]:
    """States at a few instants of several motions from the start, for trying an equation.

    Raises `NumericError` unless all members are equations along the whole motion.
    """
    claim = _started(claim)
    if not _is_equation(claim) or any(s.kind.varies for s in claim.given):
        raise NumericError(
            "a statement about single instants", expected="an equation along a motion"
        )
    running = replace(claim, relations=()).states(TrueMotion)
    motions = islice(_motions(claim, running, _SHORT), _MOTIONS)
    instants = (motion.state(part) for motion in motions for part in _PARTS)
    return running, SamplePoints(
        tuple(SymbolValues(state, running, i) for i, state in enumerate(instants))
    )


def _refuted(relation: SampledRelation, sample: int, claim: BoundClaim) -> Verdict:
    component, motion = relation.component, relation.motion
    left, right = (float(side[sample]) for side in relation.sides)
    since = float(motion.times[sample])
    residual = Residual(component.member, component.label, component.difference)
    equations = claim.equations
    state = {*equations.coordinates, *equations.speeds, *equations.parameters}
    start = {f"{s.published}": f"{motion.start[s]:.12g}" for s in state}
    values = {"t": f"{since + motion.begin:.12g}", **dict(sorted(start.items()))}
    example = Counterexample(values, Expr.of(left), Expr.of(right), residual)
    return Refuted(
        Answer.FAILS,
        "launch",
        reason=f"does not hold {since:.4g} s after the start of a motion integrated numerically",
        residuals=(residual,),
        evidence=lambda: (example, _integrated_anew(relation, sample)),
    )


def _integrated_anew(relation: SampledRelation, sample: int) -> Confirmation | None:
    """Both sides at one sample, with the motion integrated again from the balance of every body.

    A loose tolerance is tried first: it is fast, and agreement to five digits is no coincidence.
    """
    motion, component = relation.motion, relation.component
    since = float(motion.times[sample])
    expected = [float(side[sample]) for side in relation.sides]
    scale = max(*map(abs, expected), 1e-12)
    found = None
    for tolerance in _TOLERANCES:
        try:
            state = moved(motion.run.equations.system, motion.start, since, tolerance)
            numbers = {**motion.start, **state, TIME: since + motion.begin}
            sides = (component.left, component.right)
            left, right = (float(number(side, numbers)) for side in sides)
        except (PolhodeError, ArithmeticError, KeyError):
            return None  # rates of reactions, for instance, are no part of that balance
        agrees = all(
            isclose(one, other, rel_tol=_ROUNDING, abs_tol=_ROUNDING * scale)
            for one, other in zip((left, right), expected, strict=True)
        )
        found = Confirmation({"t": since + motion.begin}, left, right, agrees)
        if agrees:
            break
    return found

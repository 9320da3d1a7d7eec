"""Claims along the motion from a given start."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from itertools import islice

from polhode.algebra import Expr, Symbol
from polhode.analyse import invariants
from polhode.base import NumericError, PolhodeError
from polhode.claims._verdict import (
    Answer,
    Confirmation,
    Counterexample,
    Refuted,
    Residual,
    Verdict,
)
from polhode.claims.contexts._equations import failures, judged
from polhode.claims.contexts._inequality import judged_inequality
from polhode.claims.contexts._sampled_motion import TIME, Followed, SampledMotion, courses
from polhode.claims.meaning._components import ScalarRelation
from polhode.claims.meaning._the import The
from polhode.claims.states._bound_claim import EQUALITY, BoundClaim
from polhode.claims.states._claim_domain import TrueMotion
from polhode.claims.states._sample_points import SamplePoints, SymbolValues

_MOTIONS = 3
_SHORT, _LONG = 6.0, 24.0
_PARTS = (0.2, 0.7)  # of a motion at which a correction is tried
#: The letter of texts for the time at which a motion starts.
_CLOCK = Symbol("t_0")


def judged_launch(asked: BoundClaim) -> Verdict:
    """Along the motion from the start that is given.

    Equations are first tried exactly, with the conserved quantities at their starting values;
    what is left open then, and every statement on the course of the motion, is decided by
    integrating it for several choices of the parameters.
    """
    asked = _started(asked)
    # Whether it is an equation between states, said of the whole motion.
    timeless = not any(TIME in c.difference.symbols() for c in asked.components())
    if (timeless and _is_equation(asked)) and _holds_exactly(asked, _whole(asked)):
        return Verdict(Answer.HOLDS, "launch", reason="follows from the conserved quantities")
    return judged_along(asked)


def judged_along(asked: BoundClaim) -> Verdict:
    """The same by following motions, without a proof: quicker where much is tried."""
    asked = _started(asked)
    fixed = {s: e for s, e in asked.given.items() if not s.kind.varies}
    if asked.when == "initially":
        return judged_initially(replace(asked, given={**fixed, **asked.start}))
    event = {s: e for s, e in asked.given.items() if s.kind.varies}
    return _followed(replace(asked, given=fixed), event)


def _is_equation(asked: BoundClaim) -> bool:
    """Whether it is an equation, said of the whole motion."""
    whole = not asked.when and not any(s.kind.varies for s in asked.given)
    return whole and all(relation.sign in EQUALITY for relation in asked.members)


def _started(asked: BoundClaim) -> BoundClaim:
    """With the restrictions on the state as the start, where no start is given."""
    if asked.start:
        return asked
    start = {s: e for s, e in asked.given.items() if s.kind.varies}
    fixed = {s: e for s, e in asked.given.items() if s not in start}
    return replace(asked, start=start, given=fixed)


def _whole(asked: BoundClaim) -> dict[Symbol, Expr]:
    """The start, with a letter for every coordinate and speed that it leaves open."""
    state = (*asked.equations.coordinates, *asked.equations.speeds)
    return {s: Expr.generator(Symbol(f"{s.published}_start")) for s in state} | dict(asked.start)


def _holds_exactly(asked: BoundClaim, start: Mapping[Symbol, Expr]) -> bool:
    try:
        kept = _conserved(The(asked.equations))
        fixed = [e - e.subs(start) for e in kept]
        relations = (*asked.relations, *(e for e in fixed if e))
        states = replace(asked.states(TrueMotion), relations=relations)
        return next(failures(asked, [states]), None) is None
    except (PolhodeError, ArithmeticError):
        return False


@lru_cache(maxsize=16)
def _conserved(the: The) -> tuple[Expr, ...]:
    found = (i.expression for i in invariants(the.equations))
    return tuple(map(the.equations.kinetics.on_speeds, found))


def _followed(asked: BoundClaim, event: Mapping[Symbol, Expr]) -> Verdict:
    """By numbers, on several motions: all along them, or when something comes to pass."""
    relation = None
    for relation in _along_motions(asked, event):
        sample = relation.exception(asked.when)
        if sample is not None:
            return _refuted(relation, sample, asked)
    if relation is None:
        raise NumericError(
            "no motion could be followed from the start", expected="a start that fixes the motion"
        )
    remark = f"by numbers, along {_MOTIONS} motions"
    return Verdict(Answer.HOLDS, "launch", reason=remark)


def _along_motions(asked: BoundClaim, event: Mapping[Symbol, Expr]) -> Iterator[Followed]:
    running = replace(asked, relations=()).states(TrueMotion)
    duration = _LONG if event or asked.when == "finally" else _SHORT
    found = (course.at(event) for course in _courses(asked, running, duration))
    for course in islice(filter(None, found), _MOTIONS):
        for component in asked.components():
            yield Followed.along(course, component, asked, running)


def _courses(asked: BoundClaim, running: TrueMotion, duration: float) -> Iterator[SampledMotion]:
    starts = replace(asked, given={**asked.given, **asked.start}).states(TrueMotion)
    used = [running.on(side) for c in asked.components() for side in (c.left, c.right)]
    clock = next((s for e in used for s in e.symbols() if s == _CLOCK), None)
    return courses(starts, used, clock, duration)


def bench_along(asked: BoundClaim) -> tuple[TrueMotion, SamplePoints]:
    """States at some moments of several motions from the start, to try an equation at.

    Raises `NumericError` for what is no equation, or not said of the whole motion.
    """
    asked = _started(asked)
    if not _is_equation(asked):
        raise NumericError("a statement on moments", expected="an equation along a motion")
    running = replace(asked, relations=()).states(TrueMotion)
    found = islice(_courses(asked, running, _SHORT), _MOTIONS)
    moments = (course.state(part) for course in found for part in _PARTS)
    return running, SamplePoints(
        tuple(SymbolValues(state, running, i) for i, state in enumerate(moments))
    )


def _refuted(followed: Followed, sample: int, asked: BoundClaim) -> Verdict:
    component, course = followed.component, followed.course
    left, right = (float(side[sample]) for side in followed.sides)
    since = float(course.times[sample])
    residual = Residual(component.member, component.label, component.difference)
    state = {*asked.equations.coordinates, *asked.equations.speeds, *asked.equations.parameters}
    said = {f"{s.published}": f"{course.start[s]:.12g}" for s in state}
    values = {"t": f"{since + course.begin:.12g}", **dict(sorted(said.items()))}
    example = Counterexample(values, Expr.of(left), Expr.of(right), residual)
    return Refuted(
        Answer.FAILS,
        "launch",
        reason=f"not met {since:.4g} s after the start of a motion that was followed by numbers",
        residuals=(residual,),
        evidence=lambda: (example, _second_opinion(followed, sample)),
    )


def _second_opinion(followed: Followed, sample: int) -> Confirmation | None:
    from polhode.claims.contexts._own_motion import followed_anew  # only failures are followed anew

    return followed_anew(followed, sample)


# Claims on the start of a motion and the moment after it.

_HIGHEST_RATE = 4


def judged_initially(asked: BoundClaim) -> Verdict:
    """At the start; an inequality whose sides are equal there, just after it."""
    states = asked.states(TrueMotion)
    equal = {i for i, r in enumerate(asked.members) if r.sign in EQUALITY}
    verdict = judged(asked.only(equal), [states], "launch")
    for component in (c for c in asked.components() if c.member not in equal):
        if verdict.holds:
            # The lowest rates of both sides by which they part from the start on.
            rates = _rates(component, replace(states, given={}))
            verdict = judged_inequality(
                asked, next((c for c in rates if states.on(c.difference)), component), states
            )
    return replace(verdict, context="launch")


def _rates(component: ScalarRelation, running: TrueMotion) -> Iterator[ScalarRelation]:
    for _ in range(_HIGHEST_RATE):
        yield component
        left, right = (running.on(side).dt() for side in (component.left, component.right))
        component = replace(component, left=left, right=right)

"""Claims along the motion from a given start."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.analyse import invariants
from polhode.base import NumericError, PolhodeError
from polhode.claims._asked import EQUALITY, Asked
from polhode.claims._circumstances import TrueMotion
from polhode.claims._components import Component
from polhode.claims._inequality import SENSE, judged_inequality
from polhode.claims._judge import failures, judged
from polhode.claims._numeric import Array, number
from polhode.claims._points import points
from polhode.claims._verdict import Answer, Confirmation, Counterexample, Residual, Verdict
from polhode.simulate import Trajectory, simulate

Name: TypeAlias = str | Symbol | Expr

_MOTIONS = 3
_TRIES = 20
_DURATION = 6.0
_SAMPLES = 400
_CLOSE = 1e-6


def judged_launch(asked: Asked) -> Verdict:
    """Along the motion from the start that is given.

    Equations are first tried exactly, with the conserved quantities at their starting values;
    what is left open then, and every statement on the course of the motion, is decided by
    integrating it for several choices of the parameters.
    """
    start = dict(asked.start) or {s: e for s, e in asked.given.items() if s.kind.varies}
    given = {s: e for s, e in asked.given.items() if not s.kind.varies}
    if asked.when == "initially":
        return _initially(replace(asked, given={**given, **start}))
    asked = replace(asked, given=given)
    equal = all(relation.sign in EQUALITY for relation in asked.members)
    if equal and not asked.when and _holds_exactly(asked, _whole(asked, start)):
        return Verdict(Answer.HOLDS, "launch", reason="follows from the conserved quantities")
    return _followed(asked, start)


def _whole(asked: Asked, start: Mapping[Symbol, Expr]) -> dict[Symbol, Expr]:
    """The start, with a letter for every coordinate and speed that it leaves open."""
    state = (*asked.equations.coordinates, *asked.equations.speeds)
    return {s: Expr.generator(Symbol(f"{s.published}_start")) for s in state} | dict(start)


def _initially(asked: Asked) -> Verdict:
    states = TrueMotion(asked.equations, asked.given, asked.relations)
    equal = {i for i, r in enumerate(asked.members) if r.sign in EQUALITY}
    verdict = judged(asked.only(equal), [states], "launch")
    for component in (c for c in asked.components() if c.member not in equal):
        if verdict.holds:
            verdict = judged_inequality(asked, component, states)
    return replace(verdict, context="launch")


def _holds_exactly(asked: Asked, start: Mapping[Symbol, Expr]) -> bool:
    try:
        kept = [i.expression for i in invariants(asked.equations)]
        fixed = [e - e.subs(start) for e in map(asked.equations.kinetics.on_speeds, kept)]
        relations = (*asked.relations, *(e for e in fixed if e))
        states = TrueMotion(asked.equations, asked.given, relations)
        return next(failures(asked, [states]), None) is None
    except (PolhodeError, ArithmeticError):
        return False


@dataclass(frozen=True, eq=False)
class _Course:
    """One motion by numbers, and a component of the claim along it."""

    run: Trajectory
    parameters: Mapping[Symbol, float]
    component: Component
    sign: str

    @cached_property
    def times(self) -> Array:
        """Sample times, s."""
        return np.linspace(0.0, float(self.run.duration), _SAMPLES)

    @cached_property
    def sides(self) -> tuple[Array, Array]:
        """Values of both sides at the sample times."""
        fixed = {Expr.generator(s): v for s, v in self.parameters.items()}
        left, right = (
            np.broadcast_to(self.run.evaluate(side.subs(fixed), self.times), self.times.shape)
            for side in (self.component.left, self.component.right)
        )
        return left, right

    @cached_property
    def met(self) -> Array:
        """Where the relation is met."""
        left, right = self.sides
        scale = max(np.abs(left).max(), np.abs(right).max(), 1e-300)
        if self.sign in SENSE:
            return np.asarray((left - right) * SENSE[self.sign] > -_CLOSE * scale)
        return np.asarray(np.abs(left - right) <= _CLOSE * scale)

    def exception(self, when: str) -> int | None:
        """The sample that refutes the relation's holding this often; None where none does."""
        wrong = self.met if when == "never" else np.logical_not(self.met)
        if when == "sometimes":
            return None if self.met.any() else 0
        if when == "finally":
            return len(wrong) - 1 if wrong[-1] else None
        return int(np.argmax(wrong)) if wrong.any() else None


def _followed(asked: Asked, start: Mapping[Symbol, Expr]) -> Verdict:
    """By numbers, on several motions."""
    runs = list(_motions(asked, start))
    if not runs:
        raise NumericError(
            "no motion could be followed from the start", expected="a start that fixes the motion"
        )
    for component in asked.components():
        sign = asked.members[component.member].sign
        for run, parameters in runs:
            course = _Course(run, parameters, component, sign)
            sample = course.exception(asked.when)
            if sample is not None:
                return _refuted(course, sample)
    remark = f"by numbers, on {len(runs)} motions of {_DURATION:g} s with {_SAMPLES} samples each"
    return Verdict(Answer.HOLDS, "launch", reason=remark)


def _refuted(course: _Course, sample: int) -> Verdict:
    component = course.component
    left, right = (float(side[sample]) for side in course.sides)
    time = float(course.times[sample])
    residual = Residual(component.member, component.label, component.difference)
    said = {s.published: f"{v:.12g}" for s, v in course.parameters.items()}
    values = {"t": f"{time:.12g}", **dict(sorted(said.items()))}
    example = Counterexample(values, Expr.of(left), Expr.of(right), residual)
    return Verdict(
        Answer.FAILS,
        "launch",
        reason=f"not met at t = {time:.4g} s of a motion that was followed by numbers",
        residuals=(residual,),
        counterexample=example,
        confirmation=Confirmation({"t": time}, left, right, agrees=True),
    )


def _motions(
    asked: Asked, start: Mapping[Symbol, Expr]
) -> Iterator[tuple[Trajectory, dict[Symbol, float]]]:
    """Motions with different parameters and all that the start leaves open."""
    equations = asked.equations
    letters = {s for e in start.values() for s in e.symbols()} | {*equations.parameters}
    state = {*equations.coordinates, *equations.speeds} - start.keys()
    open_ = letters | state
    found = 0
    for seed in range(_TRIES):
        drawn = points((), open_, seed).floats()
        given = {s: float(number(e, drawn)) for s, e in asked.given.items()}
        values = {**drawn, **given}
        begin: dict[Name, float] = {s: float(number(e, values)) for s, e in start.items()}
        begin |= {s: values[s] for s in state}
        parameters: dict[Name, float] = {s: values[s] for s in equations.parameters}
        try:
            run = simulate(equations, parameters, begin, _DURATION)
        except PolhodeError:
            continue
        yield run, {s: values[s] for s in letters if s in values}
        found += 1
        if found == _MOTIONS:
            return

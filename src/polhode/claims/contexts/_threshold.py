"""Inequalities that are to be equivalent to the exact condition of a system."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache, partial

from polhode.algebra import Expr, Symbol
from polhode.analyse import Truth, stability
from polhode.base import ParseError, PolhodeError
from polhode.claims._verdict import Answer, Evidence, Refuted, Residual, Verdict
from polhode.claims.contexts._counterexample import refutation
from polhode.claims.contexts._judge import failed, failures
from polhode.claims.meaning._components import Component
from polhode.claims.meaning._the import The
from polhode.claims.states._asked import EQUALITY, SENSE, Asked
from polhode.claims.states._circumstances import AnyState
from polhode.claims.states._numeric import number
from polhode.claims.states._signs import definite_sign
from polhode.claims.states._steady_states import SteadyStates, steady_states


@dataclass(frozen=True)
class Exact:
    """A condition that the model gives: `expression > 0`, and what it decides."""

    expression: Expr
    decides: str


def judged_threshold(asked: Asked) -> Verdict:
    """Whether an inequality is equivalent to the exact condition.

    The conditions are those of linear stability of the steady motion, and of its being possible.
    Where a condition is even in the bounded quantity, the positive half-line is meant.
    """
    equalities = [c for c in asked.components() if asked.members[c.member].sign in EQUALITY]
    wrong = list(failures(asked.only({c.member for c in equalities}), [_any(asked)]))
    if wrong:
        return failed(wrong, "threshold")
    claimed = [_claimed(c, asked) for c in asked.components() if c not in equalities]
    if not claimed:
        raise ParseError("no inequality", expected="one with < or > in the context threshold")
    known = exact_conditions(asked)
    if not known:
        raise ParseError(
            "a threshold where nothing depends on the parameters",
            expected="a steady motion that is stable or possible under a condition",
            advice="restrict the claim to the motion that is meant",
            option="given",
        )
    said = []
    for component, greater in claimed:
        match = next((e for e in known if _equivalent(component, greater, e, asked)), None)
        if match is None:
            return _refuted(component, known[0], asked)
        said.append(f"equivalent to the condition of {match.decides}, {match.expression} > 0")
    return Verdict(Answer.HOLDS, "threshold", reason="; ".join(dict.fromkeys(said)))


def _any(asked: Asked) -> AnyState:
    return asked.states(AnyState)


def _claimed(component: Component, asked: Asked) -> tuple[Component, int]:
    sign = asked.members[component.member].sign
    if sign not in SENSE:
        raise ParseError(f"the sign {sign} in a threshold", expected="one of " + " ".join(SENSE))
    return component, SENSE[sign]


def exact_conditions(asked: Asked) -> tuple[Exact, ...]:
    """Conditions of stability and of existence, for every family that obeys the restrictions."""
    given = tuple(asked.given.items())
    return _conditions(The(asked.equations), given, asked.relations, asked.positive)


@lru_cache(maxsize=16)
def _conditions(
    the: The,
    given: tuple[tuple[Symbol, Expr], ...],
    relations: tuple[Expr, ...],
    positive: tuple[Expr, ...],
) -> tuple[Exact, ...]:
    asked = Asked(((),), the.equations, dict(given), relations, positive=positive)
    families = steady_states(asked)
    return tuple(e for family in families for e in (*_stability(family), *_existence(family)))


def _stability(family: SteadyStates) -> Iterator[Exact]:
    if family.family is None:
        return
    try:
        conditions = stability(family.family).conditions
    except PolhodeError:
        return
    for condition in conditions:
        if condition.truth is Truth.OPEN:
            yield Exact(family.on(condition.expression), "stability")


def _existence(family: SteadyStates) -> Iterator[Exact]:
    branches = family.family.branches if family.family is not None else ()
    found = dict.fromkeys(c.expression for b in branches for c in b.exists)
    for expression in found:
        if expression.rational is None:
            yield Exact(expression.subs(dict(family.given)), "existence")


def _equivalent(component: Component, greater: int, exact: Exact, asked: Asked) -> bool:
    """Whether the difference of the sides, or of their squares, is the condition times a positive.

    Both sides are taken as not negative in the second case.
    """
    states = _any(asked)
    left, right = states.on(component.left), states.on(component.right)
    for difference in (left - right, left * left - right * right):
        if difference and definite_sign(difference * greater / exact.expression, states.signs) == 1:
            return True
    return False


def _refuted(component: Component, exact: Exact, asked: Asked) -> Verdict:
    residual = Residual(component.member, component.label, component.difference)
    states = replace(_any(asked), relations=(*asked.relations, exact.expression))
    return Refuted(
        Answer.FAILS,
        "threshold",
        reason=f"not equivalent to the condition of {exact.decides}, {exact.expression} > 0; "
        "where that is just met, the sides differ",
        residuals=(residual,),
        evidence=partial(_where_just_met, component, residual, states),
    )


def _where_just_met(component: Component, residual: Residual, states: AnyState) -> Evidence:
    try:
        return refutation(component, residual, states, _differ_above_zero)
    except PolhodeError:
        return None, None


def _differ_above_zero(left: Expr, right: Expr) -> bool:
    return left != right and number(left, {}) > 0 and number(right, {}) > 0

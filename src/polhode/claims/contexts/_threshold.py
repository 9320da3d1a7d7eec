"""Inequalities that are to be equivalent to the exact condition of a system."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.analyse import Truth, stability
from polhode.base import ParseError, PolhodeError
from polhode.claims._verdict import Answer, Evidence, Refuted, Residual, Verdict
from polhode.claims.contexts._counterexample import example_where
from polhode.claims.contexts._equivalence import Comparison, PrintedBound
from polhode.claims.contexts._judge import failed, failures
from polhode.claims.meaning._mechanics import EquationsKey
from polhode.claims.meaning._relations import ScalarRelation
from polhode.claims.states._bound_claim import EQUALITY, SENSE, STRICT, BoundClaim
from polhode.claims.states._claim_domain import AnyState, ClaimDomain
from polhode.claims.states._points import ExactPoint
from polhode.claims.states._steady_states import SteadyStates, steady_states

_STABILITY, _EXISTENCE = "stability", "existence"


@dataclass(frozen=True)
class Exact:
    """What the model demands: expressions that have to be positive, all of them.

    Attributes:
        expressions: what has to be positive.
        decides: what that decides.
        states: where it is said.
    """

    expressions: tuple[Expr, ...]
    decides: str
    states: ClaimDomain

    def __str__(self) -> str:
        said = " and ".join(f"{e} > 0" for e in self.expressions)
        return f"the condition{'s' * (len(self.expressions) > 1)} of {self.decides}, {said}"


def judged_threshold(asked: BoundClaim) -> Verdict:
    """Whether inequalities are together equivalent to the exact condition.

    The condition is that of linear stability of a family of steady motions, all parts of it
    together, or that of its being possible. Where it is even in a speed, the magnitude of that
    speed is meant. Equivalence is proved from signs, or refuted by a state of bodies that can be;
    where neither is found, it stays open.
    """
    if any(map(asked.says_choice, range(len(asked.members)))):
        raise ParseError("± in a threshold", expected="one sign, or a magnitude")
    equalities = [c for c in asked.components() if asked.members[c.member].sign in EQUALITY]
    wrong = list(failures(asked.only({c.member for c in equalities}), [_any(asked)]))
    if wrong:
        return failed(wrong, "threshold")
    claimed = [_inequality(c, asked) for c in asked.components() if c not in equalities]
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
    compared = [(exact, _compared(claimed, exact, asked)) for exact in known]
    proved = next((exact for exact, comparison in compared if comparison.is_proved), None)
    if proved is not None:
        return _met(claimed, proved, asked)
    if all(comparison.parting is not None for _, comparison in compared):
        return _refuted(claimed[0], *compared[0])
    return _undecided(next(exact for exact, c in compared if c.parting is None))


def _any(asked: BoundClaim) -> AnyState:
    return asked.states(AnyState)


def _inequality(component: ScalarRelation, asked: BoundClaim) -> ScalarRelation:
    sign = asked.members[component.member].sign
    if sign not in SENSE:
        raise ParseError(f"the sign {sign} in a threshold", expected="one of " + " ".join(SENSE))
    return component


def _compared(claimed: Sequence[ScalarRelation], exact: Exact, asked: BoundClaim) -> Comparison:
    bounds = []
    for component in claimed:
        sides = [exact.states.on(side) for side in (component.left, component.right)]
        upward = SENSE[asked.members[component.member].sign] > 0
        bounds.append(PrintedBound(*sides) if upward else PrintedBound(*reversed(sides)))
    return Comparison(tuple(bounds), exact.expressions, exact.states, _sizes(bounds, exact))


def _sizes(bounds: Sequence[PrintedBound], exact: Exact) -> frozenset[Symbol]:
    """Speeds in which the condition is even, though the text bounds them with their sign."""
    differences = [bound.greater - bound.less for bound in bounds]
    speeds = {
        s
        for e in differences
        for s in e.symbols()
        if s.kind.varies and not s.positive and (s.order or s.kind is SymbolKind.SPEED)
    }
    return frozenset(
        s
        for s in speeds
        if all(map(partial(_is_even, s), exact.expressions))
        and not all(map(partial(_is_even, s), differences))
    )


def _is_even(symbol: Symbol, expression: Expr) -> bool:
    return expression.subs({symbol: -Expr.generator(symbol)}) == expression


def exact_conditions(asked: BoundClaim) -> tuple[Exact, ...]:
    """Conditions of stability and of existence, for every family that obeys the restrictions."""
    given = tuple(asked.given.items())
    return _conditions(EquationsKey(asked.equations), given, asked.relations, asked.positive)


@lru_cache(maxsize=16)
def _conditions(
    the: EquationsKey,
    given: tuple[tuple[Symbol, Expr], ...],
    relations: tuple[Expr, ...],
    positive: tuple[Expr, ...],
) -> tuple[Exact, ...]:
    asked = BoundClaim(((),), the.equations, dict(given), relations, positive=positive)
    anywhere = _any(asked)
    return tuple(
        e
        for family in steady_states(asked)
        for e in (*_stability(family), *_existence(family, anywhere))
    )


def _stability(family: SteadyStates) -> Iterator[Exact]:
    if family.family is None:
        return
    try:
        conditions = stability(family.family).conditions
    except PolhodeError:
        return
    found = tuple(family.on(c.expression) for c in conditions if c.truth is Truth.OPEN)
    if found:
        yield Exact(found, _STABILITY, family)


def _existence(family: SteadyStates, anywhere: AnyState) -> Iterator[Exact]:
    branches = family.family.branches if family.family is not None else ()
    every = (c.expression.subs(dict(family.given)) for b in branches for c in b.exists)
    found = tuple(dict.fromkeys(e for e in every if e.rational is None))
    if found:
        yield Exact(found, _EXISTENCE, anywhere)


def _met(claimed: Sequence[ScalarRelation], exact: Exact, asked: BoundClaim) -> Verdict:
    """Equivalent, but perhaps for equality: linear stability leaves open what happens there."""
    loose = [c for c in claimed if asked.members[c.member].sign not in STRICT]
    if loose and exact.decides == _STABILITY:
        return Verdict(
            Answer.UNREAD,
            "threshold",
            reason=f"it was read and is equivalent to {exact}, but for equality, where linear "
            "stability decides nothing; write < or >",
        )
    return Verdict(Answer.HOLDS, "threshold", reason=f"equivalent to {exact}")


def _undecided(exact: Exact) -> Verdict:
    return Verdict(
        Answer.UNREAD,
        "threshold",
        reason=f"it was read, but whether it is equivalent to {exact} was neither proved nor "
        "refuted",
    )


def _refuted(component: ScalarRelation, exact: Exact, comparison: Comparison) -> Verdict:
    residual = Residual(component.member, component.label, component.difference)
    return Refuted(
        Answer.FAILS,
        "threshold",
        reason=f"not equivalent to {exact}; there are motions that one allows and the other not",
        residuals=(residual,),
        evidence=partial(_parted, component, residual, exact, comparison),
    )


def _parted(
    component: ScalarRelation, residual: Residual, exact: Exact, comparison: Comparison
) -> Evidence:
    """A motion that the inequality allows and the condition does not, or the reverse."""

    def parts(point: ExactPoint) -> bool:
        return bool(comparison.agree(point.floats()) == 0)

    try:
        return example_where(parts, component, residual, exact.states)
    except PolhodeError:
        return None, None

"""Simple conditions under which a claim that fails in general holds after all."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import product
from typing import Any

from polhode.algebra import (
    ZERO,
    Expr,
    FieldPoint,
    NoResidueError,
    Residue,
    Symbol,
    factors,
    has_parts,
    is_positive,
    vanishing,
)
from polhode.base import PolhodeError
from polhode.judge._verdict import Residual, SimpleCondition, SimpleRelation, Verdict
from polhode.judge.states._bound_claim import SENSE, BoundClaim
from polhode.judge.states._claim_domain import ClaimDomain

_SIGNS = 2  # quantities whose signs are varied together
_FACTORS = 3  # factors of a residual, of which one has to vanish
_LONGEST = 30  # characters of a condition that is still simple
_TERMS = 60  # of a residual that is taken apart; longer ones have no simple factor

Judge = Callable[[BoundClaim], Verdict]
Found = Iterator[SimpleCondition]
Domains = Callable[[], Sequence[ClaimDomain]]


def conditions(
    claim: BoundClaim, verdict: Verdict, domains: Domains, judge: Judge
) -> tuple[SimpleCondition, ...]:
    """Where a claim holds that fails or is undecided, in alternatives; empty if none is simple.

    Args:
        claim: the claim.
        verdict: on it.
        domains: the states on which it should hold.
        judge: the verdict under further assumptions.
    """
    try:
        found = (tuple(_found(claim, verdict, states, judge)) for states in domains())
        return next(filter(None, found), ())
    except (PolhodeError, ArithmeticError):
        return ()


def _found(claim: BoundClaim, verdict: Verdict, states: ClaimDomain, judge: Judge) -> Found:
    signs = list(_signs_of_magnitudes(claim, states, judge))
    if signs:
        yield from signs
        return
    equal = [r for r in verdict.residuals if claim.members[r.member].sign not in SENSE]
    if len(equal) == len(verdict.residuals):
        yield from _equalities(claim, states, equal)
    elif len(claim.members) == 1:
        yield from _signs_of_factors(claim, verdict.residuals[0].expression, judge)


def _signs_of_magnitudes(claim: BoundClaim, states: ClaimDomain, judge: Judge) -> Found:
    """Signs of the quantities under roots and in magnitudes for which a claim holds.

    √(x²) is x where x > 0: a text that writes one for the other takes x as positive.
    """
    differences = [states.on(c.difference) for c in claim.components()]
    generators = dict.fromkeys(g for e in differences for g in e.generators)
    insides: list[Expr] = [f for g in generators if (f := getattr(g, "plain", None)) is not None]
    known = (*claim.positive, *(-f for f in claim.positive))
    open_ = [f for f in dict.fromkeys(insides) if f not in known]
    if not 0 < len(open_) <= _SIGNS:
        return
    sides = [states.on(side) for c in claim.components() for side in (c.left, c.right)]
    for inside in (f for f in open_ if len(str(f)) > _LONGEST):
        if not any(side and _has_sign(inside / side) for side in sides):
            return  # long, and not the sign of a side that is printed
    for signs in product((1, -1), repeat=len(open_)):
        chosen = list(zip(open_, signs, strict=True))
        positive = tuple(f * sign for f, sign in chosen)
        if judge(replace(claim, positive=(*claim.positive, *positive))).holds:
            yield tuple(_signed(f, sign) for f, sign in chosen)


def _signs_of_factors(claim: BoundClaim, difference: Expr, judge: Judge) -> Found:
    """The sign of one factor of the difference of both sides for which an inequality holds."""
    if not _is_short(difference):
        return
    open_ = [f for f in factors(difference)[1] if _is_simple(f) and not _has_sign(f)]
    for factor, sign in product(open_[:_SIGNS], (1, -1)):
        positive = (*claim.positive, factor * sign)
        if judge(replace(claim, positive=positive)).holds:
            yield (_signed(factor, sign),)


def _equalities(claim: BoundClaim, states: ClaimDomain, residuals: Sequence[Residual]) -> Found:
    """The values of simple quantities for which all residuals vanish, if nothing else does it."""
    if not residuals or not all(_is_short(r.expression) for r in residuals):
        return
    each = [[f for f in factors(r.expression.numerator)[1] if not _has_sign(f)] for r in residuals]
    common = [f for f in each[0] if all(f in other for other in each)]
    if not all(map(_is_simple, common)) or not 0 < len(common) <= _FACTORS:
        return
    # What else makes a component of a vector vanish is another for each: at rest, of all of them.
    if all(f in common or f.varies for other in each for f in other):
        yield from ((_vanishing(f),) for f in common if not _says_nothing(claim, states, f))


def _is_short(expression: Expr) -> bool:
    return not has_parts(expression) and sum(1 for _ in expression.numerator.terms()) <= _TERMS


def _has_sign(factor: Expr) -> bool:
    return is_positive(factor) or is_positive(-factor)


def _is_simple(factor: Expr) -> bool:
    """A single quantity, or two terms in parameters of which one is a parameter: I - 2 m a²/5."""
    terms = list(factor.terms())
    degrees = [sum(powers.values()) for powers, _ in terms]
    fixed = all(isinstance(g, Symbol) and not g.kind.varies for powers, _ in terms for g in powers)
    return degrees == [1] or (len(degrees) == 2 and 1 in degrees and fixed)


def _signed(quantity: Expr, sign: int) -> SimpleRelation:
    return SimpleRelation(quantity, ">" if sign > 0 else "<", ZERO)


def _vanishing(factor: Expr) -> SimpleRelation:
    """I_1 - I_2 as the condition I_1 = I_2."""
    symbol, slope = next(
        (g, coefficient)
        for powers, coefficient in factor.terms()
        for g in powers
        if sum(powers.values()) == 1
    )
    left = Expr.generator(symbol)
    return SimpleRelation(left, "=", left - factor / slope)


def _says_nothing(claim: BoundClaim, states: ClaimDomain, factor: Expr) -> bool:
    """Whether both sides of every member vanish with a speed, so that the claim says 0 = 0."""
    if factor.symbol is None:
        return False
    sides = (side for c in claim.components() for side in (c.left, c.right))
    return all(_vanishes_with(states.on(side), factor.symbol) for side in sides)


def _vanishes_with(expression: Expr, symbol: Symbol) -> bool:
    """Whether an expression vanishes where a symbol does.

    With named parts it is evaluated at a random point of a prime field: to put zero into the parts
    would take long, and whether the result vanishes is decided at such a point too.
    """
    if has_parts(expression):
        with suppress(NoResidueError):
            return vanishing(
                expression.residue, lambda number: _PointWithZero(symbol, f"zero {number}")
            ).is_zero
    return expression.subs({symbol: ZERO}).is_zero


class _PointWithZero(FieldPoint):
    """A random point at which one symbol is zero."""

    def __init__(self, symbol: Symbol, seed: str, negative: frozenset[str] = frozenset()) -> None:
        super().__init__(seed, negative)
        self._symbol = symbol

    def _remade(self, negative: frozenset[str]) -> FieldPoint:
        return _PointWithZero(self._symbol, self.seed, negative)

    def _found(self, generator: Any) -> Residue:
        found = super()._found(generator)
        return found._replace(value=0 * found.value) if generator == self._symbol else found

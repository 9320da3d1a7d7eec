"""Whether a line that holds under restrictions says anything there, or only 0 = 0."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from math import prod

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, as_symbol
from polhode.base import NumericError, PolhodeError
from polhode.derive import Equations
from polhode.judge.contexts._contexts import follows_from_invariants, holds
from polhode.judge.contexts._equations import at_given_accelerations
from polhode.judge.latex._tree import Derivative, Dots, Number, walk
from polhode.judge.lines._judged_line import JudgedLine, differs_by_a_constant
from polhode.judge.meaning._bindings import restrictions
from polhode.judge.meaning._mechanics import on_constraints
from polhode.judge.states._bound_claim import EQUALITY, BoundClaim
from polhode.judge.states._claim_domain import TrueMotion
from polhode.judge.text._text_line import TextLine, essential_coordinates

_EQUATING = (*EQUALITY, "≈")


def says_something(judged: JudgedLine, context: str, equations: Equations) -> bool:
    """Whether a line that holds in a context says more than that nothing happens there.

    From (almost) rest in equilibrium, what is conserved keeps the value that it has there.
    """
    if context == "steady" and _is_equation_of_motion(judged, equations):
        return False
    if not _is_empty(judged, context, equations):
        return True
    claim = judged.claim
    return context == "launch" and (
        differs_by_a_constant(judged.line, equations)
        or (claim is not None and follows_from_invariants(claim))
    )


def _is_equation_of_motion(judged: JudgedLine, equations: Equations) -> bool:
    """Whether a line prints what vanishes in steady motion, and does not set it to zero.

    Of steady motion I d²θ/dt² = 2M would be true, as M is zero there, but it does not speak of it.
    """
    notation = judged.judgement.notation
    if notation is None:
        return False
    vanishing = vanishing_in_steady_motion(equations)
    for relation in judged.line.statement.relations:
        if Number("0") in relation.sides:
            continue
        for piece in walk(relation):
            with suppress(PolhodeError, ArithmeticError):
                value = notation.value(piece) if isinstance(piece, Dots | Derivative) else None
                if isinstance(value, Expr) and value.symbol in vanishing:
                    return True
    return False


def _is_empty(judged: JudgedLine, context: str, equations: Equations) -> bool:
    """Whether all terms of a line vanish in steady motion or at rest: it does not speak of it then.

    That single quantities vanish, such as dθ/dt, it may say.
    """
    vanishing = _vanishing(judged.line, context, equations)
    if vanishing and context == "launch":
        return True  # nothing moves
    claim = judged.claim
    if not vanishing or claim is None or any(r.sign not in _EQUATING for r in claim.members):
        return False
    given, _ = restrictions([r for r in judged.line.in_force.given if r.sign in EQUALITY])
    placed = {q.symbol: value for q, value in given.items() if q.symbol is not None}
    at_rest = {**placed, **dict.fromkeys(vanishing, ZERO)}
    sides = [side for c in claim.components() for side in (c.left, c.right) if side]
    if all(side.symbol is not None for side in sides):
        return context == "motion" and all(side.symbol in vanishing for side in sides)
    with suppress(PolhodeError, ArithmeticError):
        known = (on_constraints(side.subs(at_rest), equations) for side in sides)
        if not any(side.subs(at_rest) for side in known):
            return True
        # Where θ' = 0 also cos θ = cos θ₀ for a start from rest, whatever the factor of either is.
        return context == "motion" and not any(map(claim.states(TrueMotion).on, sides))
    return False


def speaks_of_rates(judged: JudgedLine, line: TextLine, context: str, equations: Equations) -> bool:
    """Whether a line that holds at rest, where any factor of a rate is right, speaks of motion.

    Members that print a rate have to hold on every motion, unless one side is a rate or zero.
    """
    at_rest, claim = _vanishing(judged.line, context, equations), judged.claim
    if context != "motion" or claim is None or judged.line.in_force == line.in_force:
        return False
    stated = {r.left for r in line.in_force.given}
    given = {s: v for s, v in claim.given.items() if v or Expr.generator(s) in stated}
    general = replace(claim, given=given)
    printed = {
        c.member
        for c in claim.components()
        if at_rest & c.difference.symbols()
        and not any(side.symbol in at_rest or not side for side in (c.left, c.right))
    }
    return bool(printed) and not holds(general.only(printed), context)


def _vanishing(line: TextLine, context: str, equations: Equations) -> frozenset[Symbol]:
    """The speeds and accelerations that vanish in a context by themselves."""
    if context == "steady":
        return vanishing_in_steady_motion(equations)
    if context not in ("motion", "launch"):
        return frozenset()
    start, _ = restrictions(line.in_force.start)
    values = {as_symbol(quantity): value for quantity, value in start.items()}
    if context == "motion":  # at rest
        values = dict.fromkeys(equations.speeds, ZERO)
    still = frozenset(speed for speed, value in values.items() if not value)
    if any(a.subs(values) for a in equations.accelerations.values()):
        return still if context == "motion" else frozenset()
    return still.union(equations.acceleration_symbols)


def vanishing_in_steady_motion(equations: Equations) -> frozenset[Symbol]:
    """The speeds and accelerations that vanish there: rates of coordinates that matter."""
    speeds = frozenset(q.derivative() for q in essential_coordinates(equations))
    return speeds.union(equations.acceleration_symbols)


def is_void(judged: JudgedLine, context: str, equations: Equations) -> bool:
    """Whether a line that holds in a context under further restrictions says nothing there."""
    if judged.claim is None or (context == "steady" and _is_empty(judged, context, equations)):
        return True
    differences = [component.difference for component in judged.claim.components()]
    for relation in judged.line.in_force.given:
        if relation.is_lasting and isinstance(relation.left, Expr):
            # An equation for the acceleration is of motions on which the value does not last.
            acceleration = relation.left.dt()
            found = [d for d in differences if acceleration.symbols() <= d.symbols()]
            if found:
                return found != [acceleration]
    return _is_at_rest(judged.claim) or says_nothing(judged.claim)


def _is_at_rest(claim: BoundClaim) -> bool:
    """Whether all rates of a line are zero on its states, where any factor of them is right."""
    symbols = {s for c in claim.components() for side in (c.left, c.right) for s in side.symbols()}
    rates = [s for s in symbols if s.kind is SymbolKind.SPEED or s.order]
    states = claim.states(TrueMotion)
    with suppress(NumericError):
        return bool(rates) and all(states.vanishing(Expr.generator(r)).is_zero for r in rates)
    return False


def says_nothing(claim: BoundClaim) -> bool:
    """Whether every term vanishes by itself on the states for which it should hold: 0 = 0.

    Where that cannot be decided, it is taken to say nothing.
    """
    states = claim.states(TrueMotion)
    sides = [side for c in claim.components() for side in (c.left, c.right)]
    found = [term for side in sides for term in terms(side)]
    try:
        return all(states.vanishing(term).is_zero for term in found)
    except NumericError:
        value = at_given_accelerations(claim)
        return value is None or not any(map(value, found))


def terms(side: Expr) -> Iterator[Expr]:
    """The terms of the numerator of a side."""
    for powers, coefficient in side.numerator.terms():
        factors = (Expr.generator(generator) ** power for generator, power in powers.items())
        yield prod(factors, start=Expr.of(coefficient))

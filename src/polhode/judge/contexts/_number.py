"""Printed numbers, judged to the precision of their digits, and compared as they are printed."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

from polhode.algebra import ZERO, Expr, as_symbol, pi
from polhode.base import NumericError, ParseError
from polhode.judge._verdict import Answer, Residual, Verdict
from polhode.judge.states._bound_claim import SENSE, STRICT, BoundClaim
from polhode.judge.states._claim_domain import TrueMotion
from polhode.judge.states._numeric import number

_ROUNDING = 1e-12  # relative; of the evaluation in doubles
_LONGEST = 40  # characters of a value that is shown beside the number


def judged_number(claim: BoundClaim) -> Verdict:
    """Whether sides agree within half a unit of the last printed digit, or are unequal as said.

    Raises `ParseError` where parameters are left without a value.
    """
    try:
        return _judged(claim)
    except NumericError:  # of most angles in degrees the sine is no root: cos(50°)
        approximate = {as_symbol(pi): Expr.of(Fraction(math.pi))}
        given = {symbol: value.subs(approximate) for symbol, value in claim.given.items()}
        return _judged(replace(claim, given=given))


def _judged(claim: BoundClaim) -> Verdict:
    states = claim.states(TrueMotion)
    for component in claim.components():
        left, right = states.on(component.left), states.on(component.right)
        half = states.on(claim.digits.get(component.member, ZERO))
        sign = claim.members[component.member].sign
        if not _is_so(sign, left, right, half):
            about, printed, exactly = _short(left), _short(right), f"{left}, "
            if len(exactly) > _LONGEST:
                exactly = ""
            return Verdict(
                Answer.FAILS,
                "number",
                reason=f"the left side is {exactly}about {about}; the text prints {printed}",
                residuals=(Residual(component.member, component.label, left - right),),
            )
    return Verdict(Answer.HOLDS, "number")


def _is_so(sign: str, left: Expr, right: Expr, half: Expr) -> bool:
    """Whether sides are as a sign says; an inequality compares with the number as printed."""
    if sign == "≠":
        return not _is_close(left, right, half)
    if sign not in SENSE:
        return _is_close(left, right, half)
    difference = left - right
    _require_number(difference)
    if not difference:
        return sign not in STRICT
    return float(number(difference, {})) * SENSE[sign] > 0


def _is_close(left: Expr, right: Expr, half: Expr) -> bool:
    difference = left - right
    if not difference:
        return True
    ratio = difference / half if half else difference
    _require_number(ratio)
    if not half:
        varies = any(symbol.name != "pi" for symbol in right.symbols())  # as θ = θ + 1 does
        scale = 0.0 if varies else abs(float(number(right, {})))
        return abs(float(number(difference, {}))) <= _ROUNDING * scale
    return abs(float(number(ratio, {}))) <= 1 + _ROUNDING


def _require_number(expression: Expr) -> None:
    """Raise `ParseError` for an expression that depends on a quantity."""
    if open_ := sorted(s.published for s in expression.symbols() if s.name != "pi"):
        raise ParseError(
            f"a number that depends on {', '.join(open_)}",
            expected="a value for each of them",
            advice=f"restrict the claim by {', '.join(f'{name} = …' for name in open_)}",
            option="given",
        )


def _short(value: Expr) -> str:
    is_number = all(symbol.name == "pi" for symbol in value.symbols())
    return f"{float(number(value, {})):.6g}" if is_number else str(value)

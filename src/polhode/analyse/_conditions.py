"""Conditions on signs, in their shortest exact form."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from enum import Enum
from math import prod

from polhode.algebra import ONE, ZERO, Expr, factors, is_positive
from polhode.base import Shown


class Truth(Enum):
    """Whether a condition holds always, never, or depending on the parameters."""

    ALWAYS = "true"
    NEVER = "false"
    OPEN = "open"


@dataclass(frozen=True)
class Condition(Shown):
    """`expression > 0`, with factors of known sign left out.

    Attributes:
        expression: what must be positive; 1 where the condition always holds, -1 where it cannot.
    """

    expression: Expr

    @property
    def truth(self) -> Truth:
        """Whether it depends on the parameters."""
        value = self.expression.rational
        if value is None:
            return Truth.OPEN
        return Truth.ALWAYS if value > 0 else Truth.NEVER

    def latex(self) -> str:
        """LaTeX of the inequality."""
        return f"{self.expression.latex()} > 0"

    def __str__(self) -> str:
        return self.truth.value if self.truth is not Truth.OPEN else f"{self.expression} > 0"


#: The condition that always holds.
ALWAYS = Condition(ONE)


def positive(expression: Expr, assumed: Collection[Expr] = ()) -> Condition:
    """The condition that an expression is positive, given that those in `assumed` are."""
    if expression.is_zero:
        return Condition(-ONE)
    number, powers = factors(expression)
    sign = ONE if number > 0 else -ONE
    left: list[Expr] = []
    for factor in (f for f, exponent in powers.items() if exponent % 2):
        if _is_surely_positive(-factor, assumed):
            sign = -sign
        elif not _is_surely_positive(factor, assumed):
            left.append(factor)
    return Condition(prod(left, start=sign))


def _is_surely_positive(factor: Expr, assumed: Collection[Expr]) -> bool:
    return is_positive(factor) or factor in assumed or _is_definite(factor, assumed)


def _is_definite(factor: Expr, assumed: Collection[Expr]) -> bool:
    """Whether it is quadratic in some letter, a x² + b x + c, and positive definite.

    That is a > 0 and 4 a c - b² > 0. Where the latter vanishes it touches zero: stability is then
    marginal.
    """
    for symbol in sorted(factor.symbols(), key=lambda s: s.published):
        slope, at_zero = factor.diff(symbol), {symbol: ZERO}
        a = slope.diff(symbol) / 2
        if not a or symbol in a.symbols():
            continue
        try:
            b, c = slope.subs(at_zero), factor.subs(at_zero)
        except ZeroDivisionError:  # the slope of an absolute value, which zero does not have
            continue
        below = 4 * a * c - b * b
        if below and _has_no_negative_factor(a, assumed):
            return _has_no_negative_factor(below, assumed)
    return False


def _has_no_negative_factor(expression: Expr, assumed: Collection[Expr]) -> bool:
    number, powers = factors(expression)
    odd = (f for f, exponent in powers.items() if exponent % 2)
    return number > 0 and all(is_positive(f) or f in assumed for f in odd)

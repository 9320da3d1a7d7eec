"""Conditions on signs, brought to their shortest exact form."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from enum import Enum
from math import prod

from polhode.algebra import ONE, Expr, factors, is_positive


class Truth(Enum):
    """Whether a condition holds always, never, or depending on the parameters."""

    ALWAYS = "true"
    NEVER = "false"
    OPEN = "open"


@dataclass(frozen=True)
class Condition:
    """`expression > 0`, with factors of known sign left out.

    Attributes:
        expression: what must be positive; 1 where the condition always holds, -1 where it cannot.
    """

    expression: Expr

    @property
    def truth(self) -> Truth:
        """Whether anything is left to ask."""
        value = self.expression.rational
        if value is None:
            return Truth.OPEN
        return Truth.ALWAYS if value > 0 else Truth.NEVER

    def latex(self) -> str:
        """LaTeX of the inequality."""
        return f"{self.expression.latex()} > 0"

    def __str__(self) -> str:
        return self.truth.value if self.truth is not Truth.OPEN else f"{self.expression} > 0"


def positive(expression: Expr, assumed: Collection[Expr] = ()) -> Condition:
    """The condition that an expression is positive, `assumed` ones being so already."""
    number, powers = factors(expression)
    sign = ONE if number > 0 else -ONE
    if expression.is_zero:
        return Condition(-ONE)
    left: list[Expr] = []
    for factor, exponent in powers.items():
        if exponent % 2 == 0 or is_positive(factor) or factor in assumed:
            continue
        if is_positive(-factor) or -factor in assumed:
            sign = -sign
            continue
        left.append(factor)
    return Condition(prod(left, start=sign))

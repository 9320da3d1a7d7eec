"""What a check found, and whether it holds."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from polhode.algebra import Expr
from polhode.tour._numerals import power_of_ten

ALLOWED = 1e-10
"""Largest relative defect of a computed motion that still passes."""


@dataclass(frozen=True)
class Check:
    """One check of one system.

    Attributes:
        name: short.
        how: what was compared with what.
        passed: whether it holds.
        found: the difference in words or as a number.
    """

    name: str
    how: str
    passed: bool
    found: str


def decided(name: str, how: str, residuals: Iterable[Expr]) -> Check:
    """A check that expressions vanish identically, which the algebra decides."""
    left = [residual for residual in residuals if not residual.is_zero]
    return Check(name, how, not left, left[0].pretty() if left else "exactly zero")


def measured(name: str, how: str, defect: float) -> Check:
    """A check that a relative defect of a computed motion is of the size of rounding."""
    return Check(name, how, defect <= ALLOWED, power_of_ten(defect))

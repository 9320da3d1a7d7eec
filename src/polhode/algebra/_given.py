"""Numbers as they are given: Python's floats and NumPy's scalars."""

from __future__ import annotations

from fractions import Fraction

from polhode.base import NumericError


def decimal(value: float) -> Fraction:
    """The decimal that a float prints as."""
    if value != value or value in (float("inf"), float("-inf")):
        raise NumericError(f"the number {value}", expected="a finite number", advice="")
    return Fraction(repr(float(value)))


def is_numpy_scalar(value: object) -> bool:
    """Whether it is a single number of NumPy's, without importing that."""
    return getattr(value, "shape", None) == () and hasattr(value, "item")

"""The sorts of real numbers that a motion can be computed in."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any, TypeAlias

import numpy as np

from polhode.algebra import Arithmetic, Op, arrays
from polhode.base import NumericError

#: As asked for: double, extended, quadruple, or a number of decimal digits.
Precision: TypeAlias = str | int | None

_DOUBLE_BITS = 53
_FEWEST, _MOST = 16, 10_000  # decimal digits
_SPARE = 64  # bits carried beyond those asked for in what is worked out once


class Numbers(ABC):
    """Numbers of one precision.

    Attributes:
        name: what the precision is called.
        bits: of the significand.
        dtype: NumPy's type of arrays of them.
    """

    name: str
    bits: int
    dtype: Any

    @property
    @abstractmethod
    def arithmetic(self) -> Arithmetic:
        """How arrays of them are computed with, elementwise."""

    @abstractmethod
    def array(self, values: Any) -> Any:
        """Numbers of any sort as an array of these, each rounded at most once."""

    @abstractmethod
    def scalar(self, value: Any) -> Any:
        """One element of an array, as people want it."""

    @property
    def limbs(self) -> int:
        """How many doubles hold one of them as their sum."""
        return math.ceil(self.bits / _DOUBLE_BITS)

    def joined(self, limbs: Sequence[Any]) -> Any:
        """The sums of arrays of doubles, the largest first."""
        total = self.array(limbs[-1])
        for limb in limbs[-2::-1]:
            total = self.array(limb) + total
        return total

    @cached_property
    def exact(self) -> Any:
        """An mpmath context with bits to spare, for what is worked out once."""
        return context_of(self.bits + _SPARE)


class Doubles(Numbers):
    """NumPy's doubles."""

    name, bits, dtype = "double", _DOUBLE_BITS, float

    @cached_property
    def arithmetic(self) -> Arithmetic:
        return arrays()

    def array(self, values: Any) -> Any:
        return np.asarray(values, dtype=float)

    def scalar(self, value: Any) -> Any:
        return float(value)


class LongDoubles(Numbers):
    """The long doubles of the machine: where they are longer, 64 bits."""

    name, bits, dtype = "extended", int(np.finfo(np.longdouble).nmant) + 1, np.longdouble

    @cached_property
    def arithmetic(self) -> Arithmetic:
        plain = Arithmetic.of(np, lambda number: self._rounded(ratio(self.exact, number)))
        return Arithmetic(plain.number, self._rounded(+self.exact.pi), plain.functions)

    def array(self, values: Any) -> Any:
        given = np.asarray(values)
        if given.dtype != object:
            return given.astype(np.longdouble)
        found = [self._rounded(number(self.exact, value)) for value in given.ravel()]
        return np.array(found, dtype=np.longdouble).reshape(given.shape)

    def scalar(self, value: Any) -> Any:
        return np.longdouble(value)

    def _rounded(self, value: Any) -> Any:
        return np.longdouble(self.exact.nstr(value, 30))


class ManyDigits(Numbers):
    """mpmath's numbers, in arrays of objects."""

    dtype = object

    def __init__(self, name: str, bits: int) -> None:
        self.name, self.bits = name, bits

    @cached_property
    def context(self) -> Any:
        """The mpmath context that they belong to."""
        return context_of(self.bits)

    @cached_property
    def arithmetic(self) -> Arithmetic:
        context = self.context
        calls = {op: np.frompyfunc(getattr(context, op.value), 1, 1) for op in _CALLS}
        return Arithmetic(lambda value: ratio(context, value), +context.pi, calls)

    def array(self, values: Any) -> Any:
        given = np.asarray(values, dtype=object)
        found = np.empty(given.shape, dtype=object)
        for place in np.ndindex(given.shape):
            found[place] = number(self.context, given[place])
        return found

    def scalar(self, value: Any) -> Any:
        return value


_CALLS = (Op.SQRT, Op.SIN, Op.COS, Op.EXP, Op.SINH, Op.COSH)

DOUBLES = Doubles()
_QUADRUPLE = ManyDigits("quadruple", 113)


def numbers_for(precision: Precision) -> Numbers:
    """The numbers of a precision that was asked for.

    Raises:
        NumericError: for a precision that is not known, or that this machine does not have.
    """
    if precision in (None, "double"):
        return DOUBLES
    if precision == "quadruple":
        return _QUADRUPLE
    if precision == "extended":
        return _long_doubles()
    if isinstance(precision, str) and precision.isdecimal() and len(precision) < _FEWEST:
        precision = int(precision)
    if isinstance(precision, bool) or not isinstance(precision, int):
        raise _unknown(precision)
    if not _FEWEST <= precision <= _MOST:
        raise _unknown(precision)
    return ManyDigits(f"{precision} digits", math.ceil(precision * math.log2(10)) + 4)


def _long_doubles() -> LongDoubles:
    if LongDoubles.bits <= _DOUBLE_BITS:
        raise NumericError(
            "extended precision, on a machine whose long double is a double",
            expected="double, quadruple, or a number of decimal digits",
            advice="ask for quadruple, which is computed without it",
        )
    return LongDoubles()


def _unknown(precision: object) -> NumericError:
    return NumericError(
        f"precision {precision!r}"[:80],
        expected="double, extended, quadruple, or a number of decimal digits from "
        f"{_FEWEST} to {_MOST}",
    )


@lru_cache(maxsize=64)
def context_of(bits: int) -> Any:
    """The mpmath context of so many bits."""
    import mpmath

    context = mpmath.MPContext()
    context.prec = bits
    return context


def ratio(context: Any, value: Fraction) -> Any:
    """A fraction, rounded to a context."""
    return context.mpf(value.numerator) / value.denominator


def number(context: Any, value: Any) -> Any:
    """A number of any sort, rounded to a context."""
    return (
        +context.make_mpf(value._mpf_)
        if hasattr(value, "_mpf_")
        else ratio(context, fraction_of(value))
    )


def fraction_of(value: Any) -> Fraction:
    """The fraction that a finite number of any sort is."""
    if hasattr(value, "_mpf_"):
        sign, mantissa, exponent, _ = value._mpf_
        size = Fraction(int(mantissa)) * Fraction(2) ** int(exponent)
        return -size if sign else size
    if hasattr(value, "as_integer_ratio"):
        return Fraction(*(int(part) for part in value.as_integer_ratio()))
    return Fraction(int(value)) if hasattr(value, "__index__") else Fraction(float(value))

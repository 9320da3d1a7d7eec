"""The number types in which a motion can be computed."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any, TypeAlias

import numpy as np

from polhode.algebra import Arithmetic, Op, arrays, fraction_of
from polhode.base import NumericError

#: As requested: double, extended, quadruple, or a number of decimal digits.
Precision: TypeAlias = str | int | None

_DOUBLE_BITS = 53
# Decimal digits. Series are stored as sums of doubles: the last digits of more than 300 would be
# below the smallest double.
_FEWEST, _MOST = 16, 300
_SPARE = 64  # bits carried beyond those requested, in what is computed only once
_DOUBLE_SPACING = 2.0**-52
_POLISHED = 40  # secant steps to a zero at most; 300 digits take about ten
_NEAR = 1e-9  # distance between the first two points of the secant method


class NumberType(ABC):
    """Numbers of one precision.

    Attributes:
        name: of the precision.
        bits: of the significand.
        dtype: NumPy's type of arrays of them.
    """

    name: str
    bits: int
    dtype: Any

    @property
    @abstractmethod
    def arithmetic(self) -> Arithmetic:
        """The arithmetic of arrays of them, elementwise."""

    @abstractmethod
    def array(self, values: Any) -> Any:
        """Numbers of any type as an array of these, each rounded at most once."""

    @abstractmethod
    def scalar(self, value: Any) -> Any:
        """One element of an array, as a single number."""

    @property
    def limbs(self) -> int:
        """How many doubles it takes to represent one of them as their sum."""
        return math.ceil(self.bits / _DOUBLE_BITS)

    def joined(self, limbs: Sequence[Any]) -> Any:
        """The sums of arrays of doubles, the largest first."""
        total = self.array(limbs[-1])
        for limb in limbs[-2::-1]:
            total = self.array(limb) + total
        return total

    @cached_property
    def exact(self) -> Any:
        """An mpmath context with spare bits, for values that are computed only once."""
        return context_of(self.bits + _SPARE)

    @cached_property
    def careful(self) -> ManyDigits:
        """Numbers of that context, for the computations where a contact mode ends."""
        return ManyDigits(self.name, self.bits, _SPARE)

    # -- single numbers, vectors and matrices ---------------------------------------------------

    @property
    def scalars(self) -> Arithmetic:
        """The arithmetic of single numbers."""
        return self.arithmetic

    @abstractmethod
    def finer(self, share: float) -> Any:
        """A tolerance of double precision, scaled to the rounding of these numbers."""

    @abstractmethod
    def solved(self, matrix: Any, right: Any) -> Any:
        """The solution of linear equations, for one right side or the columns of a matrix."""

    @abstractmethod
    def least(self, matrix: Any, right: Any) -> Any:
        """The least-squares solution of linear equations; of several, the shortest."""

    def size(self, vector: Any) -> Any:
        """The length of a vector."""
        return self.scalars.functions[Op.SQRT](vector @ vector)

    def direction(self, angle: Any) -> tuple[Any, Any]:
        """Cosine and sine of an angle."""
        functions = self.scalars.functions
        return functions[Op.COS](angle), functions[Op.SIN](angle)

    def spacing(self, value: Any) -> Any:
        """The distance to the next number."""
        return abs(value) * self.finer(_DOUBLE_SPACING)

    def zero(self, function: Callable[[Any], Any], near: float) -> Any:
        """A zero of a function, by the secant method from its zero in double precision."""
        older = self.scalar(self.array(near - _NEAR)[()])
        newer = self.scalar(self.array(near)[()])
        before, now = function(older), function(newer)
        for _ in range(_POLISHED):
            if now in (0, before):
                break
            older, newer = newer, newer - now * (newer - older) / (now - before)
            before, now = now, function(newer)
            if abs(newer - older) <= self.spacing(newer):
                break
        return newer


class Doubles(NumberType):
    """NumPy's doubles. A zero in double precision needs no refinement: `zero` returns it."""

    name, bits, dtype = "double", _DOUBLE_BITS, float

    @cached_property
    def arithmetic(self) -> Arithmetic:
        return arrays()

    @property
    def scalars(self) -> Arithmetic:
        return _FLOATS

    def array(self, values: Any) -> Any:
        return np.asarray(values, dtype=float)

    def scalar(self, value: Any) -> Any:
        return float(value)

    def finer(self, share: float) -> float:
        return share

    def solved(self, matrix: Any, right: Any) -> Any:
        return np.linalg.solve(matrix, right)

    def least(self, matrix: Any, right: Any) -> Any:
        return np.linalg.lstsq(matrix, right, rcond=None)[0]

    def size(self, vector: Any) -> float:
        return math.hypot(*vector)

    def spacing(self, value: float) -> float:
        return float(np.spacing(value))

    def zero(self, function: Callable[[float], float], near: float) -> float:
        return near


class Finer(NumberType):
    """Numbers with more bits than doubles."""

    def finer(self, share: float) -> Any:
        return self.exact.ldexp(self.exact.mpf(share), _DOUBLE_BITS - self.bits)

    def solved(self, matrix: Any, right: Any) -> Any:
        return solution(self.exact, matrix, right)

    def least(self, matrix: Any, right: Any) -> Any:
        return least_solution(self.exact, matrix, right, self.finer(_DEPENDENT))


class LongDoubles(Finer):
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

    def spacing(self, value: Any) -> Any:
        return np.spacing(np.abs(value))

    def _rounded(self, value: Any) -> Any:
        return np.longdouble(self.exact.nstr(value, 30))


class ManyDigits(Finer):
    """mpmath's numbers, in arrays of objects.

    Args:
        name: what the precision is called.
        bits: the number of reliable bits.
        spare: the number of further bits carried.
    """

    dtype = object

    def __init__(self, name: str, bits: int, spare: int = 0) -> None:
        self.name, self.bits, self._spare = name, bits, spare

    @cached_property
    def context(self) -> Any:
        """The mpmath context that they belong to."""
        return context_of(self.bits + self._spare)

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


_DEPENDENT = 1e-10  # of the largest singular value: smaller ones belong to redundant equations
_FLOATS = Arithmetic.of(math)
_CALLS = (Op.SQRT, Op.SIN, Op.COS, Op.EXP, Op.SINH, Op.COSH)

DOUBLES = Doubles()
_QUADRUPLE = ManyDigits("quadruple", 113)


def numbers_for(precision: Precision) -> NumberType:
    """The numbers of a requested precision.

    Raises:
        NumericError: for an unknown precision, or one that this machine does not have.
    """
    if precision in (None, "double"):
        return DOUBLES
    if precision == "quadruple":
        return _QUADRUPLE
    if precision == "extended":
        if LongDoubles.bits <= _DOUBLE_BITS:
            raise NumericError(
                "extended precision, on a machine whose long double is a double",
                expected="double, quadruple, or a number of decimal digits",
                advice="ask for quadruple, which is computed without it",
            )
        return LongDoubles()
    if isinstance(precision, str) and precision.isdecimal() and len(precision) < _FEWEST:
        precision = int(precision)
    if isinstance(precision, bool) or not isinstance(precision, int):
        raise _unknown(precision)
    if not _FEWEST <= precision <= _MOST:
        raise _unknown(precision)
    return ManyDigits(f"{precision} digits", math.ceil(precision * math.log2(10)) + 4)


def _unknown(precision: object) -> NumericError:
    return NumericError(
        f"precision {precision!r}"[:80],
        expected="double, extended, quadruple, or a number of decimal digits from "
        f"{_FEWEST} to {_MOST}",
    )


@lru_cache(maxsize=64)
def context_of(bits: int) -> Any:
    """The mpmath context of so many bits; the global one has a single precision."""
    import mpmath  # slow to import, and not needed in double precision

    context = mpmath.MPContext()
    context.prec = bits
    return context


def ratio(context: Any, value: Fraction) -> Any:
    """A fraction, rounded to a context."""
    return context.mpf(value.numerator) / value.denominator


def number(context: Any, value: Any) -> Any:
    """A number of any type, rounded to a context."""
    if hasattr(value, "_mpf_"):
        return +context.make_mpf(value._mpf_)
    return context.mpf(value) if isinstance(value, float) else ratio(context, fraction_of(value))


# -- linear equations in numbers of an mpmath context, in NumPy arrays of objects --------------


def solution(context: Any, matrix: Any, right: Any) -> Any:
    """Of linear equations, for one right side or the columns of a matrix."""
    columns = [right.tolist()] if np.ndim(right) == 1 else np.transpose(right).tolist()
    if not np.size(right):
        return np.empty(np.shape(right), dtype=object)
    square = context.matrix(matrix.tolist())
    found = [list(context.lu_solve(square, context.matrix(column))) for column in columns]
    return np.array(found, dtype=object).T.reshape(np.shape(right))


def least_solution(context: Any, matrix: Any, right: Any, dependent: Any) -> Any:
    """The least-squares solution of least norm.

    Args:
        dependent: share of the largest singular value below which others count as zero.
    """
    left, sizes, across = context.svd_r(context.matrix(matrix.tolist()))
    kept = [k for k in range(len(sizes)) if sizes[k] > dependent * max(sizes)]
    shares = {k: sum(left[i, k] * right[i] for i in range(len(right))) / sizes[k] for k in kept}
    found = [sum(across[k, j] * shares[k] for k in kept) for j in range(matrix.shape[1])]
    return np.array(found, dtype=object)

"""The elementary functions used by closed forms: for doubles, or for any number of digits.

Both work elementwise on arrays. Constants are passed as mpmath numbers of a higher precision, and
whole periods are subtracted from the time without rounding, so that an angle after 1e6 turns is as
accurate as one after the first.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from fractions import Fraction
from itertools import count
from typing import Any, NamedTuple, TypeAlias

Array: TypeAlias = Any


class WholeTurns(NamedTuple):
    """A number of turns: a fraction between -1/2 and 1/2, and a whole number."""

    fraction: Array
    whole: Array


class Reals(ABC):
    """Elementwise functions of one type of real number.

    Attributes:
        eps: distance from 1 to the next larger number.
        dtype: NumPy's type of the arrays.
    """

    eps: Any
    dtype: Any
    sin: Any
    cos: Any
    exp: Any
    tanh: Any
    sqrt: Any
    atan2: Any
    rj: Any

    @abstractmethod
    def number(self, value: Any) -> Any:
        """A constant, rounded once."""

    @abstractmethod
    def array(self, values: Any) -> Array:
        """Numbers of any type as an array."""

    @abstractmethod
    def turns(self, times: Array, frequency: Any, offset: Any) -> WholeTurns:
        """frequency · times + offset; the fraction is correct to rounding after any whole turns."""

    @abstractmethod
    def exact(self, number: Any) -> Fraction:
        """A number as an exact fraction."""

    @abstractmethod
    def harmonics(self, angle: Array) -> Iterator[tuple[Array, Array]]:
        """sin kx and cos kx for k = 1, 2, … without end."""


class DoubleReals(Reals):
    """NumPy's doubles."""

    def __init__(self) -> None:
        import numpy
        from flint import acb

        def rj(*arguments: float) -> float:
            return float(acb.elliptic_rj(*map(float, arguments)).real.mid())

        each = numpy.frompyfunc(rj, 4, 1)
        self.eps, self.dtype = 2.0**-52, float
        self.sin, self.cos = numpy.sin, numpy.cos
        self.exp, self.tanh = numpy.exp, numpy.tanh
        self.sqrt, self.atan2 = numpy.sqrt, numpy.arctan2
        self.rj = lambda *given: numpy.asarray(each(*given), dtype=float)

    def number(self, value: Any) -> float:
        return float(value)

    def array(self, values: Any) -> Array:
        import numpy

        return numpy.asarray(values, dtype=float)

    def turns(self, times: Array, frequency: Any, offset: Any) -> WholeTurns:
        import numpy

        # The frequency as a sum of two doubles, and the product with the first without error; whole
        # turns are removed before the small parts are added.
        high = float(frequency)
        product, error = _exact_product(times, high)
        whole = numpy.rint(product)
        start = numpy.rint(float(offset))
        rest = (product - whole) + (error + times * float(frequency - high))
        rest = rest + float(offset - float(start))
        carried = numpy.rint(rest)
        return WholeTurns(rest - carried, whole + start + carried)

    def exact(self, number: Any) -> Fraction:
        return Fraction(float(number))

    def harmonics(self, angle: Array) -> Iterator[tuple[Array, Array]]:
        return ((self.sin(k * angle), self.cos(k * angle)) for k in count(1))


class Digits(Reals):
    """mpmath's numbers, in arrays of objects."""

    def __init__(self, context: Any) -> None:
        from numpy import frompyfunc

        self._context = context
        self.eps, self.dtype = context.eps, object
        for name in ("sin", "cos", "exp", "tanh", "sqrt"):
            setattr(self, name, frompyfunc(getattr(context, name), 1, 1))
        self.atan2 = frompyfunc(context.atan2, 2, 1)
        self.rj = frompyfunc(context.elliprj, 4, 1)

    def number(self, value: Any) -> Any:
        return self._context.convert(value)

    def array(self, values: Any) -> Array:
        import numpy

        convert = numpy.frompyfunc(self._context.convert, 1, 1)
        return numpy.asarray(convert(numpy.asarray(values)), dtype=object)

    def turns(self, times: Array, frequency: Any, offset: Any) -> WholeTurns:
        from numpy import frompyfunc

        total = times * frequency + offset
        whole = frompyfunc(self._context.nint, 1, 1)(total)
        return WholeTurns(total - whole, whole)

    def exact(self, number: Any) -> Fraction:
        mantissa = Fraction(int(number.man)) * Fraction(2) ** int(number.exp)
        return -mantissa if number < 0 else mantissa

    def harmonics(self, angle: Array) -> Iterator[tuple[Array, Array]]:
        """By the addition theorem: the spare digits absorb the rounding of the recurrence."""
        first_sin, first_cos = self.sin(angle), self.cos(angle)
        sin, cos = first_sin, first_cos
        while True:
            yield sin, cos
            sin, cos = sin * first_cos + cos * first_sin, cos * first_cos - sin * first_sin


#: 2²⁷ + 1 splits a double into two halves whose products are exact (T. J. Dekker, 1971).
_SPLITTER = 134217729.0


def _exact_product(a: Array, b: float) -> tuple[Array, Array]:
    """A product of doubles and its rounding error."""
    product = a * b
    a_high, a_low = _halves(a)
    b_high, b_low = _halves(b)
    error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
    return product, error


def _halves(a: Array) -> tuple[Array, Array]:
    scaled = _SPLITTER * a
    high = scaled - (scaled - a)
    return high, a - high

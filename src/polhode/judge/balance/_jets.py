"""Numbers with their first two time derivatives: forward automatic differentiation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Arithmetic, Op

Array: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Jet:
    """A quantity and its first and second rate; each an array over several trial motions.

    Where only the first rate is known, the second one is not a number and must not be used.
    """

    value: Array
    rate: Array
    second: Array

    @classmethod
    def of(cls, value: Jet | float | Array) -> Jet:
        """A constant, or the jet itself."""
        return value if isinstance(value, Jet) else cls(np.asarray(value), _ZERO, _ZERO)

    @property
    def is_constant(self) -> bool:
        """Whether it was made as a constant, whatever its rates are."""
        return self.rate is _ZERO and self.second is _ZERO

    @property
    def dt(self) -> Jet:
        """The first rate, as a jet; its own second rate would be a third one, which is not kept."""
        return Jet(self.rate, self.second, _ZERO)

    def __add__(self, other: Jet | float) -> Jet:
        b = Jet.of(other)
        # Constants are recognised by the shared array _ZERO: it is passed on, never added to.
        if b.is_constant:
            return Jet(self.value + b.value, self.rate, self.second)
        return Jet(self.value + b.value, self.rate + b.rate, self.second + b.second)

    def __neg__(self) -> Jet:
        return Jet(-self.value, -self.rate, -self.second)

    def __sub__(self, other: Jet | float) -> Jet:
        return self + (-Jet.of(other))

    def __mul__(self, other: Jet | float) -> Jet:
        b = Jet.of(other)
        if b.is_constant:
            return self._scaled(b.value)
        if self.is_constant:
            return b._scaled(self.value)
        return Jet(  # Leibniz: (ab)'' = a''b + 2a'b' + ab''
            self.value * b.value,
            self.rate * b.value + self.value * b.rate,
            self.second * b.value + 2 * self.rate * b.rate + self.value * b.second,
        )

    def _scaled(self, factor: Array) -> Jet:
        if self.is_constant:
            return Jet.of(self.value * factor)
        return Jet(self.value * factor, self.rate * factor, self.second * factor)

    def __truediv__(self, other: Jet | float) -> Jet:
        b = Jet.of(other)
        return self * b.through(1 / b.value, -1 / b.value**2, 2 / b.value**3)

    __radd__ = __add__
    __rmul__ = __mul__

    def __rsub__(self, other: float) -> Jet:
        return Jet.of(other) - self

    def __rtruediv__(self, other: float) -> Jet:
        return Jet.of(other) / self

    def through(self, value: Array, slope: Array, curvature: Array) -> Jet:
        """f of this quantity, from f, f' and f'' at its value."""
        if self.is_constant:
            return Jet.of(value)
        # Chain rule: (f(x))'' = f'' x'² + f' x''.
        second = curvature * self.rate**2 + slope * self.second
        return Jet(value, slope * self.rate, second)


_ZERO = np.zeros(())


def _function(
    value: Callable[[Array], Any], slope: Callable[[Array], Any], curvature: Callable[[Array], Any]
) -> Callable[[Any], Jet]:
    def applied(x: Any) -> Jet:
        jet = Jet.of(x)
        return jet.through(value(jet.value), slope(jet.value), curvature(jet.value))

    return applied


def _minus_sine(x: Array) -> Any:
    return -np.sin(x)


#: How programs are run on jets.
JETS = Arithmetic(
    lambda number: float(Fraction(number)),
    np.pi,
    {
        Op.SIN: _function(np.sin, np.cos, _minus_sine),
        Op.COS: _function(np.cos, _minus_sine, lambda x: -np.cos(x)),
        Op.EXP: _function(np.exp, np.exp, np.exp),
        Op.SINH: _function(np.sinh, np.cosh, np.sinh),
        Op.COSH: _function(np.cosh, np.sinh, np.cosh),
        Op.SQRT: _function(np.sqrt, lambda x: 0.5 / np.sqrt(x), lambda x: -0.25 / np.sqrt(x) ** 3),
    },
)

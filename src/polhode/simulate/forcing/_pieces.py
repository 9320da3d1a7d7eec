"""Prescribed functions of time as polynomials between knots."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from polhode.base import NumericError
from polhode.simulate.integrate._stepping import Array

_ROUNDING = 1e-13  # change of velocity, over the largest one, that is none


@dataclass(frozen=True)
class Jump:
    """A jerk: an instant at which a prescribed function or its rate changes at once.

    Attributes:
        time: s.
        value: before and after.
        velocity: before and after, per second.
    """

    time: float
    value: tuple[float, float]
    velocity: tuple[float, float]


@dataclass(frozen=True, eq=False)
class Pieces:
    """A function of time: a polynomial between knots, at rest before the first and after the last.

    At a knot it has what holds just after it. An integrator starts anew at every knot.

    Attributes:
        knots: increasing times, s, shape (pieces + 1,).
        coefficients: of each piece, in rising powers of the time since its knot, shape
            (pieces, powers).
        corners: which knots between the first and the last are jerks.
    """

    knots: Array
    coefficients: Array
    corners: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        shape = np.shape(self.coefficients)
        rising = np.all(np.diff(self.knots) > 0)
        if len(shape) != 2 or shape[0] != len(self.knots) - 1 or not rising:
            raise NumericError(
                f"{len(self.knots)} knots for coefficients of shape {shape}",
                expected="increasing knots, one more than there are polynomials",
            )
        if not (np.all(np.isfinite(self.knots)) and np.all(np.isfinite(self.coefficients))):
            raise NumericError(
                "a prescribed motion that is not finite",
                expected="values of moderate size at times that can be told apart",
            )

    @property
    def start(self) -> float:
        """When it leaves its rest, s."""
        return float(self.knots[0])

    @property
    def end(self) -> float:
        """When it comes to rest, s."""
        return float(self.knots[-1])

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times at which an integrator has to start anew, s."""
        return tuple(self.knots.tolist())

    def piece(self, time: float) -> int:
        """The polynomial that holds from a time on: -1 before the first, their number after."""
        return int(np.searchsorted(self.knots, time, "right")) - 1

    def polynomial(self, piece: int) -> tuple[float, Array]:
        """Time from which a piece is counted, s, and its coefficients; also of both rests."""
        return float(self._begins[piece + 1]), self._table[piece + 1]

    def value(self, time: float | Array) -> Array:
        """Its value, shaped like the times."""
        return self._derivative(time, 0)

    def velocity(self, time: float | Array) -> Array:
        """Its rate, per second."""
        return self._derivative(time, 1)

    def acceleration(self, time: float | Array) -> Array:
        """Its second derivative, per second squared."""
        return self._derivative(time, 2)

    @cached_property
    def jumps(self) -> tuple[Jump, ...]:
        """The jerks in order, with the one at which it comes to rest if there is one."""
        found = (self._jump(knot) for knot in (0, *self.corners, len(self.knots) - 1))
        return tuple(jump for jump in found if self._is_felt(jump))

    def _jump(self, knot: int) -> Jump:
        left, right = self._table[knot], self._table[knot + 1]
        span = self.knots[knot] - self._begins[knot]
        (before, slope), (after, rate) = _from_left(left, span), right[:2].tolist()
        return Jump(float(self.knots[knot]), (before, after), (slope, rate))

    def _is_felt(self, jump: Jump) -> bool:
        (before, after), (slope, rate) = jump.value, jump.velocity
        size, speed = self._sizes
        return abs(after - before) > _ROUNDING * size or abs(rate - slope) > _ROUNDING * speed

    @cached_property
    def _sizes(self) -> tuple[float, float]:
        """Largest value and rate at the knots."""
        table, spans = self._table[1:-1], self._spans[:, None]
        powers = np.arange(table.shape[1])
        values = np.sum(table * spans**powers, axis=1)
        rates = np.sum((table * powers)[:, 1:] * spans ** powers[:-1], axis=1)
        both = np.abs(np.vstack([table[:, :2], np.column_stack([values, rates])]))
        size, speed = np.max(both, axis=0).tolist()
        return size, speed

    @property
    def _spans(self) -> Array:
        return np.diff(self.knots)

    @cached_property
    def _begins(self) -> Array:
        return np.concatenate([self.knots[:1], self.knots])

    @cached_property
    def _table(self) -> Array:
        """Coefficients of the rest before, of all pieces, and of the rest after."""
        table = np.zeros((len(self.knots) + 1, max(2, self.coefficients.shape[1])))
        table[1:-1, : self.coefficients.shape[1]] = self.coefficients
        table[0, 0] = self.coefficients[0, 0]
        table[-1, 0] = _from_left(table[-2], self._spans[-1])[0]
        return table

    def _derivative(self, time: float | Array, order: int) -> Array:
        times = np.asarray(time, dtype=float)
        which = np.searchsorted(self.knots, times, "right")
        since = times - self._begins[which]
        table = self._table
        for _ in range(order):
            table = table[:, 1:] * np.arange(1, table.shape[1])
        result = np.zeros_like(times)
        for column in reversed(range(table.shape[1])):
            result = result * since + table[which, column]
        return result


def _from_left(coefficients: Array, span: float) -> tuple[float, float]:
    """Value and rate at the end of a piece."""
    rates = coefficients[1:] * np.arange(1, len(coefficients))
    value = np.polynomial.polynomial.polyval(span, coefficients)
    rate = np.polynomial.polynomial.polyval(span, rates) if len(rates) else 0.0
    return float(value), float(rate)

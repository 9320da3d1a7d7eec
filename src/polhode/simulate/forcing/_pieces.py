"""Prescribed functions of time as polynomials between knots."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from polhode.base import NumericError
from polhode.simulate.integrate._stepping import Array

_ROUNDING = 1e-13  # a change of value or velocity that counts as none, relative to the largest


@dataclass(frozen=True)
class Jump:
    """An instant at which a prescribed function or its rate jumps.

    Attributes:
        time: s.
        value: before and after it.
        velocity: before and after it, per second.
    """

    time: float
    value: tuple[float, float]
    velocity: tuple[float, float]


@dataclass(frozen=True, eq=False)
class Pieces:
    """A function of time: a polynomial between knots, constant before the first and after the last.

    At a knot it has the value just after it. An integrator restarts at every knot.

    Attributes:
        knots: increasing times, s, shape (pieces + 1,).
        coefficients: of each piece, in increasing powers of the time since its knot, shape
            (pieces, powers).
        corners: indices of the knots between the first and the last where it jumps.
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
                expected="values of moderate size at distinct times",
            )

    @property
    def start(self) -> float:
        """When its first piece begins, before which it is constant, s."""
        return float(self.knots[0])

    @property
    def end(self) -> float:
        """When its last piece ends, after which it is constant, s."""
        return float(self.knots[-1])

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times at which an integrator has to restart, s."""
        return tuple(self.knots.tolist())

    def piece(self, time: float) -> int:
        """Index of the polynomial just after a time: -1 before the first one."""
        return int(np.searchsorted(self.knots, time, "right")) - 1

    def polynomial(self, piece: int) -> tuple[float, Array]:
        """The time that a piece is expanded about, s, and its coefficients; at rest too."""
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
        """All jumps in order, those at the start and at the end included."""
        powers, table = np.arange(self._table.shape[1]), self._table[1:-1]
        spans = self._spans[:, None]
        values = np.sum(table * spans**powers, axis=1)
        rates = np.sum((table * powers)[:, 1:] * spans ** powers[:-1], axis=1)
        ends = np.abs(np.vstack([table[:, :2], np.column_stack([values, rates])]))
        size, speed = np.max(ends, axis=0).tolist()
        found = list[Jump]()
        for knot in (0, *self.corners, len(self.knots) - 1):
            span = self.knots[knot] - self._begins[knot]
            before, slope = _from_left(self._table[knot], span)
            after, rate = self._table[knot + 1][:2].tolist()
            if abs(after - before) > _ROUNDING * size or abs(rate - slope) > _ROUNDING * speed:
                found.append(Jump(float(self.knots[knot]), (before, after), (slope, rate)))
        return tuple(found)

    @property
    def _spans(self) -> Array:
        return np.diff(self.knots)

    @cached_property
    def _begins(self) -> Array:
        return np.concatenate([self.knots[:1], self.knots])

    @cached_property
    def _table(self) -> Array:
        """Coefficients before the first knot, of all pieces, and after the last knot."""
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

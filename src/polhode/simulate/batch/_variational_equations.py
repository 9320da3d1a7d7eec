"""A motion with its derivatives with respect to parameters and start values.

The compiled equations are evaluated on dual numbers (forward differentiation), so that the
variational equations are exact and never written out.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from polhode.algebra import Arithmetic, Expr, Op, Program, Symbol, arrays
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate.integrate._arrays import Array, rows
from polhode.simulate.integrate._integrators import chosen
from polhode.simulate.integrate._stepping import broken

_TOLERANCE = 1e-13  # relative, of Runge–Kutta steps
_ABSOLUTE = 1e-14  # absolute: derivatives start at zero or one


@dataclass(frozen=True)
class Dual:
    """A dual number: a number, or an array of numbers, with derivatives.

    Attributes:
        value: the number.
        slopes: one per quantity that it is differentiated by.
    """

    value: Any
    slopes: Any

    # NumPy then leaves array · Dual to `Dual.__rmul__`, instead of making an array of duals.
    __array_ufunc__ = None

    def __add__(self, other: Any) -> Dual:
        value, slopes = _parts(other)
        return Dual(self.value + value, self.slopes if slopes is None else self.slopes + slopes)

    __radd__ = __add__

    def __neg__(self) -> Dual:
        return Dual(-self.value, -self.slopes)

    def __sub__(self, other: Any) -> Dual:
        value, slopes = _parts(other)
        return Dual(self.value - value, self.slopes if slopes is None else self.slopes - slopes)

    def __rsub__(self, other: Any) -> Dual:
        return Dual(other - self.value, -self.slopes)

    def __mul__(self, other: Any) -> Dual:
        value, slopes = _parts(other)
        own = self.slopes * value
        return Dual(self.value * value, own if slopes is None else own + slopes * self.value)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Dual:
        value, slopes = _parts(other)
        # (a/b)' = (a' − b' a/b) / b
        quotient = self.value / value
        above = self.slopes if slopes is None else self.slopes - slopes * quotient
        return Dual(quotient, above / value)

    def __rtruediv__(self, other: Any) -> Dual:
        quotient = other / self.value
        return Dual(quotient, -(self.slopes * quotient) / self.value)


def _parts(number: Any) -> tuple[Any, Any]:
    return (number.value, number.slopes) if isinstance(number, Dual) else (number, None)


def duals(plain: Arithmetic) -> Arithmetic:
    """The arithmetic of dual numbers, from that of plain ones."""
    f = plain.functions
    slopes: dict[Op, Callable[[Any, Any], Any]] = {
        Op.SQRT: lambda x, y: 1 / (2 * y),
        Op.SIN: lambda x, y: f[Op.COS](x),
        Op.COS: lambda x, y: -f[Op.SIN](x),
        Op.EXP: lambda x, y: y,
        Op.SINH: lambda x, y: f[Op.COSH](x),
        Op.COSH: lambda x, y: f[Op.SINH](x),
    }

    def embedding(op: Op) -> Callable[[Any], Any]:
        def call(number: Any) -> Any:
            if not isinstance(number, Dual):
                return f[op](number)
            value = f[op](number.value)
            return Dual(value, number.slopes * slopes[op](number.value, value))

        return call

    return Arithmetic(plain.number, plain.pi, {op: embedding(op) for op in slopes})


@dataclass(frozen=True)
class ConstantInterval:
    """An interval of time in which the same constants hold.

    Attributes:
        begin: s.
        end: s.
        constants: parameters of the dynamics, in their order.
    """

    begin: float
    end: float
    constants: Array


class VariationalEquations:
    """The equations of one contact mode with their derivatives, compiled once.

    Args:
        dynamics: the equations.
        by: parameters and states at the start by which to differentiate.
        quantities: to be read from the motion.
    """

    def __init__(
        self, dynamics: Dynamics, by: Sequence[Symbol], quantities: Sequence[Expr]
    ) -> None:
        self._dynamics = dynamics
        self._by = tuple(by)
        arguments = (*dynamics.states, *dynamics.parameters, CLOCK)
        self._rates = dynamics.program(dynamics.rates, arguments)
        self._quantities = dynamics.program(quantities, arguments)

    def follow(
        self, start: Array, intervals: Sequence[ConstantInterval], times: Array
    ) -> tuple[Array, Array]:
        """Quantities and their derivatives along one motion.

        Args:
            start: of all states, where the first interval begins.
            intervals: one after the other, from the start on.
            times: s, within them.

        Returns:
            Values, shape (quantities, times), and derivatives, shape (quantities, by, times).

        Raises:
            NumericError: where the motion cannot be continued.
        """
        # The state's own start value has the derivative one, if it is one of `by`; parameters enter
        # through the rates.
        slopes_at_start = np.array([self._slopes(s)[:, 0] for s in self._dynamics.states])
        whole = np.concatenate([start, slopes_at_start.ravel()])
        values = np.empty((len(self._quantities.outputs), len(times)))
        slopes = np.empty((len(values), len(self._by), len(times)))
        begins = [interval.begin for interval in intervals]
        which = np.clip(np.searchsorted(begins, times, "right") - 1, 0, None)
        solved = self._taylor if chosen().name == "heyoka" else self._runge_kutta
        for i, interval in enumerate(intervals):
            here = which == i
            stops = np.append(times[here], interval.end)
            grid = np.unique(np.append(interval.begin, stops))
            # States and then their derivatives, shape (states × (1 + by), times).
            path = solved(whole, interval.constants, grid)
            if not np.all(np.isfinite(path)):
                raise broken(interval.end)
            path = path[:, np.searchsorted(grid, stops)]
            whole = path[:, -1]
            values[:, here], slopes[:, :, here] = self._read(path[:, :-1], interval, times[here])
        return values, slopes

    def _read(self, path: Array, interval: ConstantInterval, times: Array) -> tuple[Array, Array]:
        size = len(self._dynamics.states)
        slopes = path[size:].reshape(size, len(self._by), len(times))
        numbers = [Dual(x, s) for x, s in zip(path[:size], slopes, strict=True)]
        constants = [
            Dual(p, slope) if np.any(slope := self._slopes(s)) else p
            for s, p in self._valued(interval.constants)
        ]
        found = self._quantities.function(duals(arrays()))(*numbers, *constants, times)
        values = rows([_parts(q)[0] for q in found], len(times))
        shape = (len(self._by), len(times))
        changes = [np.broadcast_to(_slopes_of(q, shape), shape) for q in found]
        return values, np.array(changes, dtype=float).reshape(len(found), *shape)

    def _valued(self, parameters: Array) -> list[tuple[Symbol, float]]:
        return list(zip(self._dynamics.parameters, parameters.tolist(), strict=True))

    def _slopes(self, symbol: Symbol) -> Array:
        """Derivatives of a quantity that is given, shape (by, 1)."""
        return np.array([[float(symbol == other)] for other in self._by])

    def _taylor(self, whole: Array, parameters: Array, grid: Array) -> Array:
        taylor = self._compiled
        taylor.time = grid[0]
        taylor.state[:] = whole
        taylor.pars[:] = parameters[: len(taylor.pars)]
        found = np.asarray(taylor.propagate_grid(grid)[-1], dtype=float)
        if len(found) < len(grid):
            raise broken(taylor.time)
        return found.T

    @cached_property
    def _compiled(self) -> Any:
        from polhode.simulate.integrate._heyoka import library

        heyoka = library()
        size, count = len(self._dynamics.states), len(self._by)
        x = [heyoka.make_vars(f"x{i}") for i in range(size)]
        s = [[heyoka.make_vars(f"s{i}_{j}") for j in range(count)] for i in range(size)]
        constants = [
            Dual(heyoka.par[i], self._slopes(p)[:, 0])
            for i, p in enumerate(self._dynamics.parameters)
        ]
        plain = Arithmetic.of(heyoka, lambda value: heyoka.expression(float(value)))
        rows = [np.array(row, dtype=object) for row in s]
        rates = self._evaluated(self._rates, plain, x, rows, constants, heyoka.time)
        values = [heyoka.expression(_parts(rate)[0]) for rate in rates]
        slopes = [heyoka.expression(c) for r in rates for c in _slopes_of(r, (count,))]
        variables = [*x, *(v for row in s for v in row)]
        system = list(zip(variables, [*values, *slopes], strict=True))
        return heyoka.taylor_adaptive(system, [0.0] * len(system), compact_mode=True)

    @staticmethod
    def _evaluated(
        program: Program,
        plain: Arithmetic,
        values: Sequence[Any],
        slopes: Sequence[Any],
        constants: Sequence[Any],
        time: Any,
    ) -> tuple[Any, ...]:
        numbers = [Dual(x, s) for x, s in zip(values, slopes, strict=True)]
        return program.function(duals(plain))(*numbers, *constants, time)

    def _runge_kutta(self, whole: Array, parameters: Array, grid: Array) -> Array:
        from scipy.integrate import solve_ivp

        size, count = len(self._dynamics.states), len(self._by)
        constants = [Dual(p, self._slopes(s)[:, 0]) for s, p in self._valued(parameters)]

        def rate(time: float, whole: Array) -> Array:
            slopes = whole[size:].reshape(size, count)
            found = self._evaluated(
                self._rates, arrays(), list(whole[:size]), list(slopes), constants, time
            )
            values = np.array([float(_parts(r)[0]) for r in found])
            changes = np.array([_slopes_of(r, (count,)) for r in found], dtype=float)
            return np.concatenate([values, changes.ravel()])

        if len(grid) == 1:
            return whole[:, None]
        span = (float(grid[0]), float(grid[-1]))
        settings: dict[str, Any] = {"rtol": _TOLERANCE, "atol": _ABSOLUTE, "t_eval": grid}
        solution = solve_ivp(rate, span, whole, method="DOP853", **settings)
        if solution.status != 0:
            raise broken(float(solution.t[-1]) if len(solution.t) else 0.0)
        return np.asarray(solution.y, dtype=float)


def _slopes_of(number: Any, shape: tuple[int, ...]) -> Any:
    return number.slopes if isinstance(number, Dual) else np.zeros(shape)

"""A motion with its derivatives with respect to parameters and start values.

The compiled equations are differentiated step by step, so that the variational equations are exact
and never written out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from polhode.algebra import Expr, Symbol, SymbolKind, arrays, differentiated
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate.integrate._arrays import Array, rows
from polhode.simulate.integrate._flow import Flow
from polhode.simulate.integrate._integrators import chosen
from polhode.simulate.integrate._stepping import broken


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
        self._states = dynamics.states
        self._by = tuple(by)
        arguments = (*dynamics.states, *dynamics.parameters, CLOCK)
        # Derivatives of the states, those of the first in front. Those of a state by a state and by
        # a parameter have units of their own: as coordinates, they keep those that they have.
        changes = {
            x: [Symbol(f"d {x.published}/d {p.published}", SymbolKind.COORDINATE) for p in by]
            for x in dynamics.states
        }
        along = (*dynamics.states, *(c for row in changes.values() for c in row))
        given = (*along, *dynamics.parameters, CLOCK)
        moving = changes | {s: self._unit(s) for s in dynamics.parameters if s in by}
        rates = differentiated(dynamics.program(dynamics.rates, arguments), given, moving)
        self._read_from = differentiated(
            dynamics.program(quantities, arguments), given, moving
        ).function(arrays())
        self._count = len(quantities)
        self._stepper = chosen().prepare(Flow.of(rates, len(along)), None)

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
        slopes_at_start = np.array([self._unit(s) for s in self._states], dtype=float)
        whole = np.concatenate([start, slopes_at_start.ravel()])
        values = np.empty((self._count, len(times)))
        slopes = np.empty((self._count, len(self._by), len(times)))
        begins = [interval.begin for interval in intervals]
        which = np.clip(np.searchsorted(begins, times, "right") - 1, 0, None)
        for i, interval in enumerate(intervals):
            here = which == i
            # states and then their derivatives, shape (states × (1 + by), times)
            path = self._path(whole, interval, np.append(times[here], interval.end))
            whole = path[:, -1]
            values[:, here], slopes[:, :, here] = self._read(path[:, :-1], interval, times[here])
        return values, slopes

    def _path(self, whole: Array, interval: ConstantInterval, times: Array) -> Array:
        if interval.end <= interval.begin:
            return np.repeat(whole[:, None], len(times), axis=1)
        leg = self._stepper.leg(
            interval.constants, interval.begin, whole, interval.end, lambda *_: True
        )
        if leg.broken:
            raise broken(float(leg.times[-1]))
        return leg.at(times)

    def _read(self, path: Array, interval: ConstantInterval, times: Array) -> tuple[Array, Array]:
        found = rows(self._read_from(*path, *interval.constants.tolist(), times), len(times))
        values, slopes = found[: self._count], found[self._count :]
        return values, slopes.reshape(self._count, len(self._by), len(times))

    def _unit(self, symbol: Symbol) -> list[int]:
        """Derivatives of a quantity that is given."""
        return [int(symbol == other) for other in self._by]

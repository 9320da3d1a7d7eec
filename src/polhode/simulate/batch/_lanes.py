"""Motions integrated side by side, several in the lanes of one vector instruction."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from functools import cached_property
from typing import Any

import numpy as np

from polhode.algebra import Arithmetic, Expr, Matrix, Symbol
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate.batch._batch_integrator import (
    BatchIntegrator,
    BatchTask,
    LaneStop,
    ParameterLayout,
)
from polhode.simulate.batch._batch_stage import BatchArrivals, BatchStage
from polhode.simulate.batch._forcing_intervals import ForcingIntervals, PauseTimes
from polhode.simulate.integrate._heyoka import library
from polhode.simulate.integrate._rows import rows
from polhode.simulate.integrate._stepping import LOOKS, Array

_VECTORS = 2  # that are worked on at once: while one waits for its memory the other goes on


class Lanes:
    """One set of equations for many motions.

    Args:
        dynamics: the equations.
        states: what is integrated.
        rates: of all states; those that are not integrated, nothing that is depends on.
        guards: fall through a least value where a motion ends.
        square: a matrix whose determinant is one more guard, the last.
        tolerance: relative, of one step.
        stretches: of prescribed motions.
        driven: whether the time itself occurs.
    """

    def __init__(
        self,
        dynamics: Dynamics,
        states: Sequence[Symbol],
        rates: dict[Symbol, Expr],
        guards: Sequence[Expr],
        square: Matrix | None,
        tolerance: float | None,
        stretches: ForcingIntervals,
        *,
        driven: bool,
    ) -> None:
        self.states = tuple(states)
        idle = tuple(symbol for symbol in rates if symbol not in states)
        self._rest = [0.0] * len(idle)
        self.arguments = (*states, *idle, *dynamics.parameters, CLOCK)
        self._dynamics = dynamics
        self._rates = [rates[s] for s in states]
        self._sides = tuple(guards)
        self._square = square
        self._tolerance = np.finfo(float).eps if tolerance is None else tolerance
        self._stretches = stretches
        self._fewest = LOOKS if driven else 1

    @property
    def width(self) -> int:
        """How many motions one integrator holds."""
        return _VECTORS * int(library().recommended_simd_size())

    @property
    def guards(self) -> int:
        """How many guards there are."""
        return len(self._sides) + (self._square is not None)

    def values(self, expressions: Sequence[Expr], launch: BatchStage) -> Array:
        """Of many motions where they are taken up, shape (expressions, motions)."""
        function = self._dynamics.function(expressions, self.arguments)
        with np.errstate(all="ignore"):
            found = function(*launch.states, *self._rest, *launch.parameters, launch.begin)
        values: Array = rows(found, launch.count)
        return values

    def guarded(self, launch: BatchStage) -> Array:
        """How far the guards are above their least values, shape (guards, motions)."""
        found = self.values(self._sides, launch)
        if self._square is not None:
            found = np.vstack([found, determinant(self._matrix(launch))])
        return np.asarray(found - launch.least)

    def _matrix(self, launch: BatchStage) -> list[list[Any]]:
        size = len(self._square.rows) if self._square else 0
        entries = [e for row in self._square.rows for e in row] if self._square else []
        found = self.values(entries, launch)
        return [list(found[i * size : (i + 1) * size]) for i in range(size)]

    def follow(self, launch: BatchStage, times: Array) -> BatchArrivals:
        """Integrate to every one of some times.

        Args:
            times: s, increasing, the last of them after every beginning.
        """
        found = BatchArrivals.none_yet(times, launch)
        plan = PauseTimes.of(times, self._stretches)
        symbols = self._stretches.symbols
        moving = np.array([self._dynamics.parameters.index(s) for s in symbols], dtype=np.intp)
        constants = self._constants(launch)
        work = BatchTask(launch, constants, plan, moving, self._fewest, self.guarded, found)
        queue = iter(range(launch.count))
        threads = min(os.cpu_count() or 1, -(-launch.count // self.width))
        if threads:
            crews = [BatchIntegrator(copy(self._compiled), work) for _ in range(threads)]
            with ThreadPoolExecutor(threads) as pool:
                list(pool.map(lambda crew: crew.follow(queue), crews))
        return found

    def _constants(self, launch: BatchStage) -> Array:
        """All parameters of the compiled equations, shape (parameters, motions)."""
        if not self.guards:
            return launch.parameters
        sizes = np.abs(self.guarded(launch))
        unit = 1 / np.where(sizes > 0, sizes, 1.0)
        going = np.ones((1, launch.count))
        return np.vstack([launch.parameters, unit, unit * launch.least, going])

    @cached_property
    def _compiled(self) -> Any:
        """Rates and guards, both of which a last parameter switches off."""
        heyoka = library()
        size, own = len(self.states), len(self._dynamics.parameters)
        states = [heyoka.make_vars(f"x{i}") for i in range(size)]
        constants = [heyoka.par[i] for i in range(own)]
        arithmetic = Arithmetic.of(heyoka, lambda value: heyoka.expression(float(value)))
        entries = [e for row in self._square.rows for e in row] if self._square else []
        wanted = (*self._rates, *self._sides, *entries)
        program = self._dynamics.program(wanted, self.arguments)
        values = program.function(arithmetic)(*states, *self._rest, *constants, heyoka.time)
        rates = [heyoka.expression(value) for value in values[:size]]
        guards = list(values[size : size + len(self._sides)])
        if self._square:
            side = len(self._square.rows)
            flat = values[size + len(guards) :]
            guards.append(determinant([list(flat[i * side :][:side]) for i in range(side)]))
        if not guards:
            return self._batch([(x, rate) for x, rate in zip(states, rates, strict=True)], [])
        places = ParameterLayout(own, len(guards))
        going = heyoka.par[places.going]
        events = [
            heyoka.t_event_batch(
                going * (heyoka.par[places.scale(i)] * guard - heyoka.par[places.least(i)])
                + (1.0 - going),
                direction=heyoka.event_direction.negative,
                callback=LaneStop(places.scale(i), places.going),
            )
            for i, guard in enumerate(guards)
        ]
        return self._batch([(x, going * r) for x, r in zip(states, rates, strict=True)], events)

    def _batch(self, system: list[Any], events: list[Any]) -> Any:
        start = np.zeros((len(self.states), self.width))
        settings = {"t_events": events} if events else {}
        return library().taylor_adaptive_batch(system, start, tol=self._tolerance, **settings)


def determinant(rows: Sequence[Sequence[Any]]) -> Any:
    """Of a square matrix of anything that can be multiplied and added, along its first row."""
    if len(rows) == 1:
        return rows[0][0]
    total: Any = 0.0
    for k, entry in enumerate(rows[0]):
        minor = [[*row[:k], *row[k + 1 :]] for row in rows[1:]]
        term = entry * determinant(minor)
        total = total + term if k % 2 == 0 else total - term
    return total

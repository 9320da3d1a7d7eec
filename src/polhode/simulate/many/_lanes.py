"""Motions integrated side by side, several in the lanes of one vector instruction."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Arithmetic, Expr, Symbol
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate.integrate._heyoka import library
from polhode.simulate.integrate._integrators import LOOKS, Array

NONE = -1
"""The guard of a motion that none has ended."""

_VECTORS = 2  # that are worked on at once: while one waits for its memory the other goes on


@dataclass(frozen=True)
class Arrivals:
    """Where motions are at some times, or at the guard that ended them.

    Attributes:
        states: shape (times, states, motions); from its end on, a motion rests.
        end: how far each went, s.
        guard: which guard ended it, or NONE.
        good: whether the result can be relied on.
    """

    states: Array
    end: Array
    guard: NDArray[np.intp]
    good: NDArray[np.bool_]


class Lanes:
    """One set of equations for many motions.

    Args:
        dynamics: the equations.
        states: what is integrated.
        idle: other states, which nothing that is integrated depends on.
        rates: of the states.
        guards: positive while the motion lasts.
        tolerance: relative, of one step.
        driven: whether the time itself occurs.
    """

    def __init__(
        self,
        dynamics: Dynamics,
        states: Sequence[Symbol],
        idle: Sequence[Symbol],
        rates: Sequence[Expr],
        guards: Sequence[Expr],
        tolerance: float | None,
        *,
        driven: bool,
    ) -> None:
        self.states = tuple(states)
        self._rest = [0.0] * len(idle)
        self.arguments = (*states, *idle, *dynamics.parameters, CLOCK)
        self._dynamics = dynamics
        self._rates = tuple(rates)
        self._guards = tuple(guards)
        self._tolerance = np.finfo(float).eps if tolerance is None else tolerance
        self._looks = LOOKS if driven else 1

    @property
    def width(self) -> int:
        """How many motions one integrator holds."""
        return _VECTORS * int(library().recommended_simd_size())

    def follow(
        self, start: Array, parameters: Array, times: Array, tick: Callable[[int], None]
    ) -> Arrivals:
        """Integrate from time 0 to every one of some times.

        Args:
            start: shape (states, motions).
            parameters: shape (parameters, motions).
            times: s, increasing, above 0.
            tick: told the number of motions that are done.
        """
        count = start.shape[1]
        found = Arrivals(
            np.full((len(times), len(self.states), count), np.nan),
            np.full(count, float(times[-1])),
            np.full(count, NONE, dtype=np.intp),
            np.ones(count, dtype=bool),
        )
        if not count:
            return found
        scale = self._scales(start, parameters)
        threads = min(os.cpu_count() or 1, max(1, count // self.width))
        crews = [_Crew(copy(self._compiled), len(self._guards)) for _ in range(threads)]

        def work(k: int) -> None:
            for rows in _rows(count, self.width, k, threads):
                crews[k].follow(start, parameters, scale, times, self._looks, rows, found)
                tick(len(np.unique(rows)))

        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(work, range(threads)))
        return found

    def _scales(self, start: Array, parameters: Array) -> Array:
        """What brings the guards to order one, shape (guards, motions)."""
        function = self._dynamics.function(self._guards, self.arguments)
        values = function(*start, *self._rest, *parameters, 0.0)
        sizes = [np.broadcast_to(np.abs(v), start.shape[1:]) for v in values]
        rows = np.array(sizes, dtype=float).reshape(len(sizes), start.shape[1])
        return np.asarray(1 / np.where(rows > 0, rows, 1.0))

    @cached_property
    def _compiled(self) -> Any:
        """Rates and guards, both of which a last parameter switches off."""
        heyoka = library()
        size, own = len(self.states), self._dynamics.parameters
        states = [heyoka.make_vars(f"x{i}") for i in range(size)]
        constants = [heyoka.par[i] for i in range(len(own))]
        arithmetic = Arithmetic.of(heyoka, lambda value: heyoka.expression(float(value)))
        program = self._dynamics.program((*self._rates, *self._guards), self.arguments)
        values = program.function(arithmetic)(*states, *self._rest, *constants, heyoka.time)
        rates = [heyoka.expression(value) for value in values[:size]]
        if not self._guards:
            return self._batch([(x, rate) for x, rate in zip(states, rates, strict=True)], [])
        going = heyoka.par[len(own) + len(self._guards)]
        events = [
            heyoka.t_event_batch(
                going * heyoka.par[len(own) + i] * guard + (1.0 - going),
                direction=heyoka.event_direction.negative,
                callback=_Ended(len(own) + i, len(own) + len(self._guards)),
            )
            for i, guard in enumerate(values[size:])
        ]
        return self._batch([(x, going * r) for x, r in zip(states, rates, strict=True)], events)

    def _batch(self, system: list[Any], events: list[Any]) -> Any:
        start = np.zeros((len(self.states), self.width))
        settings = {"t_events": events} if events else {}
        return library().taylor_adaptive_batch(system, start, tol=self._tolerance, **settings)


@dataclass
class _Ended:
    """Stops one lane, and lets the others go on.

    Where the scale of the guard was, which a lane at rest has no use for, the time is kept.
    """

    scale: int
    going: int

    def __call__(self, taylor: Any, _: int, lane: int) -> bool:
        taylor.pars[self.going, lane] = 0.0
        taylor.pars[self.scale, lane] = -taylor.time[lane]
        return True


@dataclass(frozen=True)
class _Crew:
    """One integrator, for one thread."""

    integrator: Any
    guards: int

    def follow(
        self,
        start: Array,
        parameters: Array,
        scale: Array,
        times: Array,
        looks: int,
        rows: NDArray[np.intp],
        found: Arrivals,
    ) -> None:
        """Follow as many motions as there are lanes."""
        taylor = self.integrator
        taylor.set_time(0.0)
        taylor.state[:] = start[:, rows]
        if self.guards:
            going = np.ones((1, len(rows)))
            taylor.pars[:] = np.vstack([parameters[:, rows], scale[:, rows], going])
        else:
            taylor.pars[:] = parameters[: len(taylor.pars), rows]
        for k, (begin, end) in enumerate(pairwise([0.0, *times])):
            longest = (end - begin) / looks if looks > 1 else np.inf
            taylor.propagate_until(float(end), max_delta_t=longest)
            found.states[k][:, rows] = taylor.state
        good = np.all(np.isfinite(taylor.state), axis=0) & (taylor.time == times[-1])
        if self.guards:
            ended = taylor.pars[-1] == 0.0
            kept = taylor.pars[-1 - self.guards : -1]
            found.guard[rows] = np.where(ended, np.argmin(kept, axis=0), NONE)
            found.end[rows] = np.where(ended, -np.min(kept, axis=0), times[-1])
        found.good[rows] = good


def _rows(count: int, width: int, first: int, step: int) -> Iterator[NDArray[np.intp]]:
    """Motions for every filling of the lanes; the last is filled up with repetitions."""
    for begin in range(first * width, count, step * width):
        yield np.minimum(np.arange(begin, begin + width), count - 1)

"""Motions integrated side by side, several in the lanes of one vector instruction."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Arithmetic, Expr, Matrix, Symbol
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate.integrate._heyoka import library
from polhode.simulate.integrate._integrators import LOOKS, Array

NONE = -1
"""The guard of a motion that none has ended."""

_VECTORS = 2  # that are worked on at once: while one waits for its memory the other goes on
_MOST_STEPS = 1_000_000  # between two looks: a motion that needs more is at a singular position


@dataclass(frozen=True)
class Launch:
    """Where motions are taken up, and what ends them.

    Attributes:
        begin: s, shape (motions,).
        states: shape (states, motions).
        parameters: shape (parameters, motions).
        least: value at which a guard has fallen, shape (guards, motions).
    """

    begin: Array
    states: Array
    parameters: Array
    least: Array

    @property
    def count(self) -> int:
        """How many motions there are."""
        return len(self.begin)

    def some(self, which: NDArray[np.intp]) -> Launch:
        """Some of the motions."""
        return Launch(
            self.begin[which],
            self.states[:, which],
            self.parameters[:, which],
            self.least[:, which],
        )


@dataclass(frozen=True)
class Arrivals:
    """Where motions are at some times, or at the guard that ended them.

    Attributes:
        states: shape (times, states, motions); before it is taken up and after its end a motion
            rests.
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
        rates: of all states; those that are not integrated, nothing that is depends on.
        guards: fall through a least value where a motion ends.
        square: a matrix whose determinant is one more guard, the last.
        tolerance: relative, of one step.
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
        self._looks = LOOKS if driven else 1

    @property
    def width(self) -> int:
        """How many motions one integrator holds."""
        return _VECTORS * int(library().recommended_simd_size())

    @property
    def guards(self) -> int:
        """How many guards there are."""
        return len(self._sides) + (self._square is not None)

    def values(self, expressions: Sequence[Expr], launch: Launch) -> Array:
        """Of many motions where they are taken up, shape (expressions, motions)."""
        function = self._dynamics.function(expressions, self.arguments)
        with np.errstate(all="ignore"):
            found = function(*launch.states, *self._rest, *launch.parameters, launch.begin)
        return table([np.broadcast_to(v, launch.begin.shape) for v in found], launch.count)

    def guarded(self, launch: Launch) -> Array:
        """How far the guards are above their least values, shape (guards, motions)."""
        found = self.values(self._sides, launch)
        if self._square is not None:
            found = np.vstack([found, determinant(self._matrix(launch))])
        return np.asarray(found - launch.least)

    def _matrix(self, launch: Launch) -> list[list[Any]]:
        size = len(self._square.rows) if self._square else 0
        entries = [e for row in self._square.rows for e in row] if self._square else []
        found = self.values(entries, launch)
        return [list(found[i * size : (i + 1) * size]) for i in range(size)]

    def follow(self, launch: Launch, times: Array) -> Arrivals:
        """Integrate to every one of some times.

        Args:
            times: s, increasing, the last of them after every beginning.
        """
        count = launch.count
        found = Arrivals(
            np.full((len(times), len(self.states), count), np.nan),
            np.full(count, float(times[-1])),
            np.full(count, NONE, dtype=np.intp),
            np.ones(count, dtype=bool),
        )
        if not count:
            return found
        order = np.argsort(launch.begin, kind="stable")
        sizes = np.abs(self.guarded(launch))
        scale = 1 / np.where(sizes > 0, sizes, 1.0)
        threads = min(os.cpu_count() or 1, max(1, count // self.width))
        crews = [_Crew(copy(self._compiled), self.guards, self._looks) for _ in range(threads)]

        def work(k: int) -> None:
            for rows in _rows(count, self.width, k, threads):
                crews[k].follow(launch, scale, times, order[rows], found)

        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(work, range(threads)))
        return found

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
        places = _Places(own, len(guards))
        going = heyoka.par[places.going]
        events = [
            heyoka.t_event_batch(
                going * (heyoka.par[places.scale(i)] * guard - heyoka.par[places.least(i)])
                + (1.0 - going),
                direction=heyoka.event_direction.negative,
                callback=_Ended(places.scale(i), places.going),
            )
            for i, guard in enumerate(guards)
        ]
        return self._batch([(x, going * r) for x, r in zip(states, rates, strict=True)], events)

    def _batch(self, system: list[Any], events: list[Any]) -> Any:
        start = np.zeros((len(self.states), self.width))
        settings = {"t_events": events} if events else {}
        return library().taylor_adaptive_batch(system, start, tol=self._tolerance, **settings)


def table(rows: Sequence[Any], count: int) -> Array:
    """Rows of so many values, however few of them there are; shape (rows, count)."""
    return np.array(rows, dtype=float).reshape(len(rows), count)


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


@dataclass(frozen=True)
class _Places:
    """Where among the parameters the switch is, and what brings the guards to order one."""

    own: int
    guards: int

    def scale(self, guard: int) -> int:
        return self.own + guard

    def least(self, guard: int) -> int:
        return self.own + self.guards + guard

    @property
    def going(self) -> int:
        return self.own + 2 * self.guards


@dataclass
class _Ended:
    """Stops one lane, and lets the others go on.

    Where the scale of the guard was, which a lane at rest has no use for, the time is kept.
    """

    scale: int
    going: int

    def __call__(self, taylor: Any, _: int, lane: int) -> bool:
        taylor.pars[self.going, lane] = 0.0
        taylor.pars[self.scale, lane] = -1.0 - taylor.time[lane]
        return True


@dataclass(frozen=True)
class _Crew:
    """One integrator, for one thread."""

    integrator: Any
    guards: int
    looks: int

    def follow(
        self,
        launch: Launch,
        scale: Array,
        times: Array,
        rows: NDArray[np.intp],
        found: Arrivals,
    ) -> None:
        """Follow as many motions as there are lanes."""
        taylor = self.integrator
        now = launch.begin[rows]
        taylor.set_time(now)
        taylor.state[:] = launch.states[:, rows]
        taylor.pars[:] = self._constants(launch, scale, rows)[: len(taylor.pars)]
        for k, time in enumerate(times):
            target = np.maximum(now, time)
            spans = target - now
            longest = np.where((spans > 0) & (self.looks > 1), spans / self.looks, np.inf)
            taylor.propagate_until(target, max_delta_t=longest, max_steps=_MOST_STEPS)
            found.states[k][:, rows] = taylor.state
            now = target
        finite = np.all(np.isfinite(taylor.state), axis=0)
        found.good[rows] = finite & (taylor.time == now)
        if self.guards:
            own = len(launch.parameters)
            ended = taylor.pars[-1] == 0.0
            kept = taylor.pars[own : own + self.guards]
            found.guard[rows] = np.where(ended, np.argmin(kept, axis=0), NONE)
            found.end[rows] = np.where(ended, -1.0 - np.min(kept, axis=0), times[-1])

    def _constants(self, launch: Launch, scale: Array, rows: NDArray[np.intp]) -> Array:
        own = launch.parameters[:, rows]
        if not self.guards:
            return own
        unit = scale[:, rows]
        return np.vstack([own, unit, unit * launch.least[:, rows], np.ones((1, len(rows)))])


def _rows(count: int, width: int, first: int, step: int) -> Iterator[NDArray[np.intp]]:
    """Motions for every filling of the lanes; the last is filled up with repetitions."""
    for begin in range(first * width, count, step * width):
        yield np.minimum(np.arange(begin, begin + width), count - 1)

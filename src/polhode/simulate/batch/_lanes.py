"""Motions integrated side by side, several in the lanes of one vector instruction."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Arithmetic, Expr, Matrix, Symbol
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate.batch._forcing_intervals import ForcingIntervals, PauseTimes
from polhode.simulate.integrate._arrays import Array, rows
from polhode.simulate.integrate._heyoka import first_step, library
from polhode.simulate.integrate._stepping import FEWEST_STEPS
from polhode.simulate.integrate._taylor import scales_of

# -- where motions begin, and where they arrive ----------------------------------------------------

NONE = -1
"""Stands for the guard of motions that no guard has ended."""


@dataclass(frozen=True)
class BatchStage:
    """Where motions start in a mode, and what ends them.

    Attributes:
        begin: s, shape (motions,).
        states: shape (states, motions).
        parameters: shape (parameters, motions).
        least: value at which a guard has fallen, shape (guards, motions).
        end: until when they are followed, s, shape (motions,).
    """

    begin: Array
    states: Array
    parameters: Array
    least: Array
    end: Array

    @property
    def count(self) -> int:
        """How many motions there are."""
        return len(self.begin)

    def moved(self, begin: Array, states: Array, parameters: Array) -> BatchStage:
        """The same motions from other states."""
        return replace(self, begin=begin, states=states, parameters=parameters)

    def some(self, which: NDArray[np.intp]) -> BatchStage:
        """Some of the motions."""
        return BatchStage(
            self.begin[which],
            self.states[:, which],
            self.parameters[:, which],
            self.least[:, which],
            self.end[which],
        )


@dataclass(frozen=True)
class BatchArrivals:
    """Where motions are at some times, or at the guard that ended them.

    Attributes:
        states: shape (times, states, motions); not-a-number before a motion starts and from its
            end on, except for the last time, which stands for the end.
        end: how far each went, s.
        guard: which guard ended it, or NONE.
        good: whether the result can be relied on.
    """

    states: Array
    end: Array
    guard: NDArray[np.intp]
    good: NDArray[np.bool_]

    @classmethod
    def none_yet(cls, times: Array, stage: BatchStage) -> BatchArrivals:
        """For motions that have yet to be integrated."""
        count = stage.count
        return cls(
            np.full((len(times), len(stage.states), count), np.nan),
            stage.end.copy(),
            np.full(count, NONE, dtype=np.intp),
            np.ones(count, dtype=bool),
        )


# -- an integrator with many lanes: when a motion is over, the next takes its lane -----------------
#
# Lanes do not influence one another: the result of a motion is the same to the bit whatever the
# other lanes hold.

_BURST = 128  # steps between checks for arrivals: with more, lanes that have arrived wait longer
_MOST_STEPS = 1_000_000  # between two times: a motion that needs more is at a singular position


@dataclass(frozen=True)
class ParameterLayout:
    """Places of the switch and of the scales of guards among the parameters of an integrator.

    Its own parameters come first, then a scale for every guard, then the scaled least values, then
    the switch.
    """

    own: int
    guards: int

    def scale(self, guard: int) -> int:
        """The scale of a guard."""
        return self.own + guard

    def least(self, guard: int) -> int:
        """Its scaled least value."""
        return self.own + self.guards + guard

    @property
    def going(self) -> int:
        """The switch: 1 while the motion goes on, then 0."""
        return self.own + 2 * self.guards


@dataclass
class LaneStop:
    """Stops one lane, and lets the others go on.

    A terminal event would end the integration of all lanes. Instead, the switch sets the rates of
    the lane to zero and its guards to a positive value. The time t of the event is stored as −1 − t
    in place of the scale of the guard, which a stopped lane no longer needs: scales are positive,
    so that this also tells which guard has fallen.
    """

    scale: int
    going: int

    def __call__(self, taylor: Any, _: int, lane: int) -> bool:
        taylor.pars[self.going, lane] = 0.0
        taylor.pars[self.scale, lane] = -1.0 - taylor.time[lane]
        return True


@dataclass(frozen=True)
class BatchTask:
    """Work that several integrators share.

    Attributes:
        stage: the motions.
        constants: all parameters of the integrator, shape (parameters, motions).
        plan: when motions pause.
        moving: places among the parameters of the coefficients in the plan.
        fewest: least number of steps between two pauses.
        guarded: how far the guards of motions are above their least values.
        first: longest first step of each motion, s; infinite where it may be chosen freely.
        found: the results, which the integrators fill in.
    """

    stage: BatchStage
    constants: Array
    plan: PauseTimes
    moving: NDArray[np.intp]
    fewest: int
    guarded: Callable[[BatchStage], Array]
    first: Array
    found: BatchArrivals

    @cached_property
    def places(self) -> ParameterLayout:
        """The layout of the constants."""
        return ParameterLayout(len(self.stage.parameters), len(self.stage.least))


class BatchIntegrator:
    """One integrator, for one thread.

    Args:
        integrator: of heyoka, with any number of lanes.
        work: the motions.
    """

    def __init__(self, integrator: Any, work: BatchTask) -> None:
        self._taylor = integrator
        self._work = work
        # Views of the integrator's arrays: they change during integration.
        self._state, self._constants = integrator.state, integrator.pars
        self._time, self._dtime = integrator.time, integrator.dtime
        width = len(self._time)
        known = work.moving < len(self._constants)
        self._moving = work.moving[known]
        self._held = work.plan.held[known]
        self._rows: list[int | None] = [None] * width
        self._next = [0] * width
        self._bursts = np.zeros(width, dtype=np.intp)
        self._target = np.zeros(width)
        self._longest = np.full(width, np.inf)

    def follow(self, queue: Iterator[int]) -> None:
        """Integrate motions from a queue, which several integrators share, until it is empty."""
        for lane in range(len(self._rows)):
            self._load_next(lane, queue)
        while any(row is not None for row in self._rows):
            self._taylor.propagate_until(self._target, max_delta_t=self._longest, max_steps=_BURST)
            self._bursts += 1
            endless = self._bursts > _MOST_STEPS // _BURST
            lost = endless | ~np.isfinite(self._state).all(axis=0) | ~np.isfinite(self._time)
            for lane in np.flatnonzero(lost).tolist():
                row = self._rows[lane]
                if row is not None:
                    self._work.found.good[row] = False  # to be integrated by itself
                self._load_next(lane, queue)
            for lane in np.flatnonzero(self._time == self._target).tolist():
                self._arrive(lane, queue)

    def _arrive(self, lane: int, queue: Iterator[int]) -> None:
        """A motion has reached a time, and may be over."""
        row, place = self._rows[lane], self._next[lane]
        if row is None:
            self._bursts[lane] = 0
        elif self._is_stopped(lane) or self._target[lane] >= self._work.stage.end[row]:
            self._finish(lane, row)
            self._load_next(lane, queue)
        elif self._target[lane] < self._work.plan.times[place]:
            self._set_target(lane, place)  # the first step, which had to be short, is over
        else:
            sample = self._work.plan.samples[place]
            if sample >= 0:
                self._work.found.states[sample, :, row] = self._state[:, lane]
            self._set_target(lane, place + 1)
            if self._work.plan.abrupt[place]:
                self._check_guards(lane, row, queue)

    def _check_guards(self, lane: int, row: int, queue: Iterator[int]) -> None:
        """End a motion whose guard is below zero after a jump of its forces.

        heyoka finds roots within steps only, not a jump between two of them.
        """
        found, places = self._work.found, self._work.places
        if not places.guards:
            return
        here = self._work.stage.some(np.array([row])).moved(
            self._time[[lane]], self._state[:, [lane]], self._constants[: places.own, [lane]]
        )
        fallen = self._work.guarded(here)[:, 0] < 0
        if np.any(fallen):
            found.states[-1, :, row] = self._state[:, lane]
            found.guard[row] = np.argmax(fallen)
            found.end[row] = self._time[lane]
            self._load_next(lane, queue)

    def _is_stopped(self, lane: int) -> bool:
        """Whether a guard has ended the motion: its rates are then zero."""
        places = self._work.places
        return bool(places.guards and self._constants[places.going, lane] == 0.0)

    def _finish(self, lane: int, row: int) -> None:
        """Record where a motion ends."""
        found, places = self._work.found, self._work.places
        found.states[-1, :, row] = self._state[:, lane]
        if self._is_stopped(lane):
            kept = self._constants[places.own : places.own + places.guards, lane]
            found.guard[row] = np.argmin(kept)
            found.end[row] = -1.0 - np.min(kept)

    def _load_next(self, lane: int, queue: Iterator[int]) -> None:
        """Put the next motion into a lane; if there is none, the lane rests at the first start."""
        taylor, stage = self._taylor, self._work.stage
        row = next(queue, None)
        self._rows[lane] = row
        chosen = row or 0
        # Other lanes may be lost at the same time: they are loaded next.
        late, early = (np.where(np.isfinite(part), part, 0.0) for part in self._dtime)
        late[lane], early[lane] = stage.begin[chosen], 0.0
        taylor.set_dtime(late, early)
        self._state[:, lane] = stage.states[:, chosen]
        self._constants[:, lane] = self._work.constants[: len(self._constants), chosen]
        if self._work.places.guards:
            taylor.reset_cooldowns(lane)
        if row is None:
            self._target[lane] = late[lane]
        else:
            self._set_target(lane, int(self._work.plan.times.searchsorted(late[lane])))
            short = late[lane] + self._work.first[row]
            self._target[lane] = min(self._target[lane], short)

    def _set_target(self, lane: int, place: int) -> None:
        """Let a motion go on to its next pause."""
        work = self._work
        span = work.plan.times[place] - self._time[lane]
        self._next[lane], self._target[lane] = place, work.plan.times[place]
        self._bursts[lane] = 0
        few = span > 0 and work.fewest > 1
        self._longest[lane] = span / work.fewest if few else np.inf
        if len(self._moving):
            self._constants[self._moving, lane] = self._held[:, place]


# Size below which all coordinates, or all speeds, are integrated individually. It is smaller than
# for single motions, since a slip that has just begun is short.
_SMALL = 2.0**-20
_VECTORS = 2  # vectors per integrator: while one waits for memory, the other is computed


class Lanes:
    """One set of equations, compiled for many motions.

    Args:
        dynamics: the equations.
        states: what is integrated.
        rates: of all states; those that are integrated depend on no others.
        guards: fall through a least value where a motion ends.
        square: a matrix whose determinant is one more guard, the last.
        tolerance: relative, of one step.
        intervals: of prescribed motions.
        driven: whether time occurs explicitly.
    """

    def __init__(
        self,
        dynamics: Dynamics,
        states: Sequence[Symbol],
        rates: dict[Symbol, Expr],
        guards: Sequence[Expr],
        square: Matrix | None,
        tolerance: float | None,
        intervals: ForcingIntervals,
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
        self._intervals = intervals
        self._fewest = FEWEST_STEPS if driven else 1

    @property
    def width(self) -> int:
        """How many motions one integrator holds."""
        return _VECTORS * int(library().recommended_simd_size())

    @property
    def guards(self) -> int:
        """How many guards there are."""
        return len(self._sides) + (self._square is not None)

    def values(self, expressions: Sequence[Expr], stage: BatchStage) -> Array:
        """Values where motions start, shape (expressions, motions)."""
        function = self._dynamics.function(expressions, self.arguments)
        with np.errstate(all="ignore"):
            found = function(*stage.states, *self._rest, *stage.parameters, stage.begin)
        values: Array = rows(found, stage.count)
        return values

    def guarded(self, stage: BatchStage) -> Array:
        """How far the guards are above their least values, shape (guards, motions)."""
        found = self.values(self._sides, stage)
        if self._square is not None:
            entries = self.values([e for row in self._square.rows for e in row], stage)
            matrix = entries.reshape(*self._square.shape, -1)
            found = np.vstack([found, determinant([list(row) for row in matrix])])
        return np.asarray(found - stage.least)

    def follow(self, stage: BatchStage, times: Array) -> BatchArrivals:
        """Integrate to each of some times.

        Args:
            times: s, increasing, the last of them after every beginning.
        """
        found = BatchArrivals.none_yet(times, stage)
        plan = PauseTimes.of(times, self._intervals)
        symbols = self._intervals.symbols
        moving = np.array([self._dynamics.parameters.index(s) for s in symbols], dtype=np.intp)
        constants = self._constants(stage)
        first = self._first_steps(stage, constants, found)
        work = BatchTask(stage, constants, plan, moving, self._fewest, self.guarded, first, found)
        queue = iter(np.flatnonzero(found.good).tolist())
        threads = min(os.cpu_count() or 1, -(-stage.count // self.width))
        if threads:
            integrators = [BatchIntegrator(copy(self._compiled), work) for _ in range(threads)]
            with ThreadPoolExecutor(threads) as pool:
                list(pool.map(lambda integrator: integrator.follow(queue), integrators))
        return found

    def _first_steps(self, stage: BatchStage, constants: Array, found: BatchArrivals) -> Array:
        """The longest first steps, s, where heyoka would choose steps that are much too long.

        Motions of small states, which it would integrate with a relative error that is larger than
        rounding, are to be integrated individually.
        """
        first = np.full(stage.count, np.inf)
        taylor = copy(self._compiled)
        known = len(taylor.pars)
        for begin in range(0, stage.count, self.width):
            held = np.arange(begin, begin + self.width).clip(max=stage.count - 1)
            taylor.set_dtime(stage.begin[held], np.zeros(self.width))
            taylor.state[:], taylor.pars[:] = stage.states[:, held], constants[:known, held]
            if self.guards:
                taylor.reset_cooldowns()
            taylor.step(write_tc=True)
            for lane, row in enumerate(held.tolist()):
                first[row], sizes = first_step(taylor.tc[:, :, lane], float(taylor.last_h[lane]))
                state = stage.states[:, row]
                driven = self._fewest > 1
                scales = scales_of(self.states, state, sizes, is_driven=driven, small=_SMALL)
                found.good[row] &= scales is None
        return first

    def _constants(self, stage: BatchStage) -> Array:
        """All parameters of the compiled equations, shape (parameters, motions)."""
        if not self.guards:
            return stage.parameters
        sizes = np.abs(self.guarded(stage))
        unit = 1 / np.where(sizes > 0, sizes, 1.0)
        going = np.ones((1, stage.count))
        return np.vstack([stage.parameters, unit, unit * stage.least, going])

    @cached_property
    def _compiled(self) -> Any:
        """The integrator: its last parameter switches off rates and guards of a lane."""
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
    """The determinant of a square matrix, expanded along its first row, in any arithmetic.

    Expansion needs no pivots, whose choice an expression of heyoka could not make.
    """
    if len(rows) == 1:
        return rows[0][0]
    total: Any = 0.0
    for k, entry in enumerate(rows[0]):
        minor = [[*row[:k], *row[k + 1 :]] for row in rows[1:]]
        term = entry * determinant(minor)
        total = total + term if k % 2 == 0 else total - term
    return total

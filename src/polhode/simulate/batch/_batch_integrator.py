"""An integrator of many lanes: where a motion is over, the next takes its lane.

A motion knows nothing of those beside it: its bits are the same in whatever company.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.simulate.batch._batch_stage import BatchArrivals, BatchStage
from polhode.simulate.batch._forcing_intervals import PauseTimes
from polhode.simulate.integrate._stepping import Array

_BURST = 128  # steps between two looks at who has arrived: fewer cost looks, more cost waiting
_MOST_STEPS = 1_000_000  # between two times: a motion that needs more is at a singular position


@dataclass(frozen=True)
class ParameterLayout:
    """Where among the parameters the switch is, and what brings the guards to order one."""

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
        """Whether the motion goes on."""
        return self.own + 2 * self.guards


@dataclass
class LaneStop:
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
class BatchTask:
    """What is to be done, by several crews.

    Attributes:
        launch: the motions.
        constants: all parameters of the integrator, shape (parameters, motions).
        plan: when motions pause.
        moving: places among the parameters of the coefficients in the plan.
        fewest: steps between two pauses.
        guarded: how far the guards of motions are above their least values.
        found: where what is found goes.
    """

    launch: BatchStage
    constants: Array
    plan: PauseTimes
    moving: NDArray[np.intp]
    fewest: int
    guarded: Callable[[BatchStage], Array]
    found: BatchArrivals

    @cached_property
    def places(self) -> ParameterLayout:
        """Where among the constants what is."""
        return ParameterLayout(len(self.launch.parameters), len(self.launch.least))


class BatchIntegrator:
    """One integrator, for one thread.

    Args:
        integrator: of heyoka, with as many lanes as it likes.
        work: what is to be done.
    """

    def __init__(self, integrator: Any, work: BatchTask) -> None:
        self._taylor = integrator
        self._work = work
        # Views, that change as it goes on.
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
        """Follow motions of a queue, which several crews share, until it is empty."""
        for lane in range(len(self._rows)):
            self._take_up(lane, queue)
        while any(row is not None for row in self._rows):
            self._taylor.propagate_until(self._target, max_delta_t=self._longest, max_steps=_BURST)
            self._bursts += 1
            for lane in np.flatnonzero(self._lost()).tolist():
                self._give_up(lane, queue)
            for lane in np.flatnonzero(self._time == self._target).tolist():
                self._arrive(lane, queue)

    def _lost(self) -> NDArray[np.bool_]:
        """The lanes with motions that cannot be continued."""
        endless = self._bursts > _MOST_STEPS // _BURST
        return np.asarray(endless | ~np.isfinite(self._state).all(axis=0))

    def _give_up(self, lane: int, queue: Iterator[int]) -> None:
        """Leave a motion to whoever follows it by itself."""
        row = self._rows[lane]
        if row is not None:
            self._work.found.good[row] = False
        self._take_up(lane, queue)

    def _arrive(self, lane: int, queue: Iterator[int]) -> None:
        """A motion has come to a time, and may be over."""
        row, place = self._rows[lane], self._next[lane]
        if row is None:
            self._bursts[lane] = 0
        elif self._is_stopped(lane) or self._target[lane] >= self._work.launch.end[row]:
            self._finish(lane, row)
            self._take_up(lane, queue)
        else:
            self._note(lane, row, place)
            self._head_for(lane, place + 1)
            if self._work.plan.abrupt[place]:
                self._look_again(lane, row, queue)

    def _note(self, lane: int, row: int, place: int) -> None:
        """Keep where a motion is, if that was asked for."""
        look = self._work.plan.looks[place]
        if look >= 0:
            self._work.found.states[look, :, row] = self._state[:, lane]

    def _look_again(self, lane: int, row: int, queue: Iterator[int]) -> None:
        """Where forces jump, a guard may fall unseen by the integrator."""
        found, places = self._work.found, self._work.places
        if not places.guards:
            return
        here = self._work.launch.some(np.array([row])).moved(
            self._time[[lane]], self._state[:, [lane]], self._constants[: places.own, [lane]]
        )
        fallen = self._work.guarded(here)[:, 0] < 0
        if np.any(fallen):
            found.states[-1, :, row] = self._state[:, lane]
            found.guard[row] = np.argmax(fallen)
            found.end[row] = self._time[lane]
            self._take_up(lane, queue)

    def _is_stopped(self, lane: int) -> bool:
        """Whether a guard has ended the motion: it rests, and is quickly through."""
        places = self._work.places
        return bool(places.guards and self._constants[places.going, lane] == 0.0)

    def _finish(self, lane: int, row: int) -> None:
        """Keep where a motion ends."""
        found, places = self._work.found, self._work.places
        found.states[-1, :, row] = self._state[:, lane]
        if self._is_stopped(lane):
            kept = self._constants[places.own : places.own + places.guards, lane]
            found.guard[row] = np.argmin(kept)
            found.end[row] = -1.0 - np.min(kept)

    def _take_up(self, lane: int, queue: Iterator[int]) -> None:
        """Put the next motion into a lane; where there is none, it rests where the first starts."""
        taylor, launch = self._taylor, self._work.launch
        row = next(queue, None)
        self._rows[lane] = row
        chosen = row or 0
        late, early = (part.copy() for part in self._dtime)
        late[lane], early[lane] = launch.begin[chosen], 0.0
        taylor.set_dtime(late, early)
        self._state[:, lane] = launch.states[:, chosen]
        self._constants[:, lane] = self._work.constants[: len(self._constants), chosen]
        if self._work.places.guards:
            taylor.reset_cooldowns(lane)
        if row is None:
            self._target[lane] = late[lane]
        else:
            self._head_for(lane, int(self._work.plan.times.searchsorted(late[lane])))

    def _head_for(self, lane: int, place: int) -> None:
        """Let a motion go on to a pause."""
        work = self._work
        span = work.plan.times[place] - self._time[lane]
        self._next[lane], self._target[lane] = place, work.plan.times[place]
        self._bursts[lane] = 0
        few = span > 0 and work.fewest > 1
        self._longest[lane] = span / work.fewest if few else np.inf
        if len(self._moving):
            self._constants[self._moving, lane] = self._held[:, place]

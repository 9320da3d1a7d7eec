"""Drives an integrator from start to end, and puts its legs together."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Symbol, arrays
from polhode.base import NumericError, Progress
from polhode.simulate._flow import Flow, Stage
from polhode.simulate._integrators import Array, Leg, Stepper
from polhode.simulate._quadrature import Integral, integral

_TURNS = 16  # periods after which an angle is counted from zero again
_MOST_STEPS = 4_000_000
_SMALLEST = 1e-14  # length of a step, relative to the whole, that means a singular position

States: TypeAlias = Callable[[Array], Array]


@dataclass(frozen=True)
class Solution:
    """All states at every instant.

    Attributes:
        symbols: the states, in the order of the rows of `at`.
        turned: of large angles: the symbol of the angle less whole turns.
        steps: where the steps of the integrator begin and end, s.
    """

    symbols: tuple[Symbol, ...]
    turned: Mapping[Symbol, Symbol]
    steps: Array
    _at: States

    def at(self, times: Array) -> Array:
        """States, shape (states, times)."""
        return self._at(times)


def integrate(
    flow: Flow,
    stepper: Stepper,
    parameters: Array,
    start: Array,
    duration: float,
    progress: Progress,
) -> Solution:
    """Integrate a flow over [0, duration].

    Args:
        start: of all states, in the order of the flow.

    Raises:
        NumericError: where the motion cannot be continued.
    """
    size = len(flow.core.symbols)
    path = _legs(flow, stepper, parameters, start[:size], duration, progress)
    steps = np.unique(np.concatenate([leg.times for leg in path.legs]))
    at: States = path.at
    known = size
    for stage in flow.stages:
        own = start[known : known + len(stage.symbols)]
        at = _with_stage(at, _rates(flow, stage, parameters), own, steps)
        known += len(stage.symbols)
    return Solution(flow.symbols, flow.turned, steps, at)


@dataclass(frozen=True)
class _Path:
    """Legs one after the other, each with what was taken off its angles before it began.

    Its rows are the states of the core, then the periodic ones once more, less whole turns.
    """

    legs: list[Leg]
    begins: Array
    turned: Array
    periodic: NDArray[np.bool_]

    def at(self, times: Array) -> Array:
        which = np.clip(np.searchsorted(self.begins, times, "right") - 1, 0, None)
        states = np.empty((len(self.periodic), len(times)))
        for i in np.unique(which):
            here = which == i
            states[:, here] = self.legs[i].at(times[here])
        return np.vstack([states + self.turned[which].T, states[self.periodic]])


def _legs(
    flow: Flow,
    stepper: Stepper,
    parameters: Array,
    state: Array,
    duration: float,
    progress: Progress,
) -> _Path:
    """Angles that have grown far are counted from zero again: their rounding would spread."""
    periods = np.array([period or np.inf for period in flow.periods])
    watch = _Watch(_TURNS * periods, duration, progress)
    legs, begins, turned = list[Leg](), list[float](), list[Array]()
    now, offset = 0.0, np.zeros(len(state))
    while now < duration:
        leg = stepper.leg(parameters, now, state, duration, watch)
        legs.append(leg)
        begins.append(now)
        turned.append(offset)
        now = float(leg.times[-1])
        state = leg.at(leg.times[-1:])[:, 0]
        whole = np.round(state / periods) * np.where(np.isfinite(periods), periods, 0.0)
        state, offset = state - whole, offset + whole
    return _Path(legs, np.array(begins), np.array(turned), np.isfinite(periods))


class _Watch:
    """Stops a leg when an angle has grown far; refuses to go on for ever."""

    def __init__(self, limits: Array, duration: float, progress: Progress) -> None:
        self._limits = limits
        self._least = _SMALLEST * duration
        self._progress = progress
        self._steps = 0
        self._before = -np.inf

    def __call__(self, time: float, state: Array) -> bool:
        self._steps += 1
        self._progress.advance()
        if self._steps > _MOST_STEPS:
            raise _endless(time, f"{_MOST_STEPS} steps are not enough to go")
        if time - self._before < self._least:
            raise _endless(time, "the steps become too short to go")
        self._before = time
        return bool(np.all(np.abs(state) < self._limits))


def _endless(time: float, why: str) -> NumericError:
    return NumericError(
        f"{why} beyond t = {time:.9g} s",
        expected="a motion without singular positions, over a duration that can be kept in memory",
        advice="end before that time, or start elsewhere",
    )


def _with_stage(
    inner: States, rates: Callable[[Array, Array], Array], start: Array, steps: Array
) -> States:
    """The states known so far, and below them those of one more stage."""
    found: Integral = integral(lambda times: rates(inner(times), times), steps)

    def at(times: Array) -> Array:
        return np.vstack([inner(times), start[:, None] + found.at(times)])

    return at


def _rates(flow: Flow, stage: Stage, parameters: Array) -> Callable[[Array, Array], Array]:
    function = stage.program.function(arrays())

    def rates(states: Array, times: Array) -> Array:
        later = np.zeros(len(flow.symbols) - len(states))
        values = function(*states, *later, *parameters, times)
        return np.array([np.broadcast_to(value, times.shape) for value in values])

    return rates

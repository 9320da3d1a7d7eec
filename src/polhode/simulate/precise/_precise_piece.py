"""A stretch of a motion within one contact mode, in numbers of higher precision."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from polhode.algebra import Symbol
from polhode.base import Progress
from polhode.simulate._dynamics import Dynamics
from polhode.simulate._segment import TrajectoryPiece
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._driver import SegmentSolution
from polhode.simulate.integrate._flow import Flow, flow_of
from polhode.simulate.integrate._number_types import DOUBLES, NumberType
from polhode.simulate.integrate._series import InitialValueProblem, SeriesIntegrator, TaylorSolution
from polhode.simulate.integrate._stepping import looks_along
from polhode.simulate.integrate._stop_criteria import StepWatch, Stop, StopCriteria

StateValues = Mapping[Symbol, Any]


@dataclass(frozen=True)
class PrecisePiece:
    """A stretch of a motion, and why it ends where it does.

    Attributes:
        symbols: the states.
        series: their powers of time.
        constants: the parameters.
        stop: why it ends.
        mode_begin: when its contact mode was entered, s.
    """

    symbols: tuple[Symbol, ...]
    series: TaylorSolution
    constants: Any
    stop: Stop
    mode_begin: Any

    def state(self, step: int, share: Any, numbers: NumberType) -> dict[Symbol, Any]:
        """All states where a share of a step has passed, in other numbers."""
        values = numbers.array(self.series.state(step, share)).tolist()
        return dict(zip(self.symbols, values, strict=True))

    def part(self, end: Any) -> TrajectoryPiece:
        """Its part up to some instant, as trajectories have it."""
        series, times = self.series, self.series.times
        steps = np.append(times[times < end], end)
        at, rounded = series.at, series.rounded_at
        numbers = series.numbers
        solution = SegmentSolution(self.symbols, {}, steps, self.stop, None, at, numbers, rounded)
        return TrajectoryPiece(times[0], end, solution, numbers.array(self.constants))


@dataclass(frozen=True)
class InDoubles:
    """A stretch as those see it who look out for guards; places count its steps."""

    stretch: PrecisePiece

    @property
    def symbols(self) -> tuple[Symbol, ...]:
        return self.stretch.symbols

    @property
    def turned(self) -> Mapping[Symbol, Symbol]:
        return {}

    @property
    def constants(self) -> Array:
        return np.asarray(DOUBLES.array(self.stretch.constants))

    @property
    def knots(self) -> Array:
        return np.arange(self.stretch.series.steps + 1.0)

    def at(self, places: Array) -> Array:
        return np.asarray(self.stretch.series.rounded_states(places))

    def times(self, places: Array) -> Array:
        return np.asarray(self.stretch.series.rounded_times(places, 0))

    def passed(self, places: Array) -> Array:
        return np.asarray(self.stretch.series.rounded_times(places, self.stretch.mode_begin))


class NumericEquations(Protocol):
    """Equations of motion with numbers."""

    @property
    def dynamics(self) -> Dynamics:
        """The equations."""

    @property
    def parameters(self) -> Any:
        """The constants, in the order of the equations."""


class PieceIntegrator:
    """Makes such stretches.

    Args:
        integrator: Taylor's method.
        numbers: to compute in.
        end: of the motion, s.
        progress: told of every step.
    """

    def __init__(
        self, integrator: SeriesIntegrator, numbers: NumberType, end: Any, progress: Progress
    ) -> None:
        self.numbers = numbers
        self.end = numbers.careful.array([end])[0]
        self.name = integrator.name
        self._integrator = integrator
        self._progress = progress
        self._flows: dict[int, tuple[Dynamics, Flow]] = {}

    def symbols(self, dynamics: Dynamics) -> tuple[Symbol, ...]:
        """The states, in the order of the series."""
        return self._flow(dynamics).core.symbols

    def along(
        self,
        mode: NumericEquations,
        start: StateValues,
        span: tuple[Any, Any],
        watched: StopCriteria,
        mode_begin: Any,
    ) -> PrecisePiece:
        """From a state on, towards the end of a span, or to where what is watched ends it.

        Raises:
            NumericError: where the motion cannot even begin.
        """
        flow, constants = self._flow(mode.dynamics), mode.parameters.tolist()
        begin, end = span
        looks = looks_along(flow)
        if looks > 1:  # steps are not to leap over a pulse
            end = min(end, begin + self.end / looks)
        end = self.numbers.array([end])[0]
        symbols = flow.core.symbols
        own = [start[s] for s in symbols]
        launch = InitialValueProblem(flow.core.program, self.numbers, constants, own, begin, end)
        within = (float(begin), float(end))
        watch = _StopReason(StepWatch(watched, own, within, self._progress, self.numbers))
        series = self._integrator.integrate(launch, watch)
        stop = watch.stop or Stop.TIME
        if watch.stop is None and series.times[-1] < end:
            stop = Stop.STUCK
        return PrecisePiece(symbols, series.without_empty_steps(), constants, stop, mode_begin)

    def _flow(self, dynamics: Dynamics) -> Flow:
        if id(dynamics) not in self._flows:
            self._flows[id(dynamics)] = (dynamics, flow_of(dynamics, reduced=False))
        return self._flows[id(dynamics)][1]


class _StopReason:
    """Remembers why a stretch was stopped."""

    def __init__(self, steps: StepWatch) -> None:
        self.stop: Stop | None = None
        self._steps = steps

    def __call__(self, time: float, step: float, state: Sequence[Any]) -> bool:
        self.stop = self._steps.after(time, step, state)
        return self.stop is None

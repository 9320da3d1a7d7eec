"""Pieces of a trajectory in numbers of higher precision, and where they end.

Events are bracketed in double precision, then refined to the requested precision.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.base import Progress, bisected
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate._mode_integration import StateValues
from polhode.simulate._segment import TrajectoryPiece
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._driver import SegmentSolution
from polhode.simulate.integrate._flow import Flow, flow_of
from polhode.simulate.integrate._number_types import DOUBLES, NumberType
from polhode.simulate.integrate._series import InitialValueProblem, SeriesIntegrator, TaylorSolution
from polhode.simulate.integrate._stepping import fewest_steps
from polhode.simulate.integrate._stop_criteria import StepWatch, Stop, StopCriteria


@dataclass(frozen=True)
class SeriesPiece(TrajectoryPiece):
    """A piece of a trajectory as Taylor series in any precision.

    Attributes:
        series: the states as powers of the time; they may reach beyond the end.
        exact_constants: the parameters, with spare bits.
    """

    series: TaylorSolution = field(repr=False)
    exact_constants: Sequence[Any] = field(repr=False)

    @classmethod
    def of(
        cls,
        symbols: tuple[Symbol, ...],
        series: TaylorSolution,
        constants: Sequence[Any],
        stop: Stop,
    ) -> SeriesPiece:
        """All steps of some series.

        Args:
            symbols: the states.
            constants: the parameters.
            stop: why the series end.
        """
        times, numbers = series.times, series.numbers
        solution = SegmentSolution(
            symbols, {}, times, stop, None, series.at, numbers, series.rounded_at
        )
        return cls(times[0], times[-1], solution, numbers.array(constants), series, constants)

    def state(self, point: PiecePoint, numbers: NumberType) -> dict[Symbol, Any]:
        """All states at a point, in other numbers."""
        values = numbers.array(self.series.state(point.step, point.share)).tolist()
        return dict(zip(self.solution.symbols, values, strict=True))


@dataclass(frozen=True)
class PiecePoint:
    """A point within a piece.

    Attributes:
        step: which of its steps.
        share: of it that has passed.
    """

    step: int
    share: Any


@dataclass(frozen=True)
class InDoubles:
    """A piece in double precision, on which falls of guards are bracketed; places count its steps.

    Attributes:
        piece: in higher precision.
        mode_begin: when its contact mode was entered, s.
    """

    piece: SeriesPiece
    mode_begin: Any

    @property
    def symbols(self) -> tuple[Symbol, ...]:
        return self.piece.solution.symbols

    @property
    def turned(self) -> Mapping[Symbol, Symbol]:
        return {}

    @property
    def constants(self) -> Array:
        return np.asarray(DOUBLES.array(self.piece.exact_constants))

    @property
    def knots(self) -> Array:
        return np.arange(self.piece.series.steps + 1.0)

    def at(self, places: Array) -> Array:
        return np.asarray(self.piece.series.rounded_states(places))

    def times(self, places: Array) -> Array:
        return np.asarray(self.piece.series.rounded_times(places, 0))

    def passed(self, places: Array) -> Array:
        return np.asarray(self.piece.series.rounded_times(places, self.mode_begin))


# -- integration -----------------------------------------------------------------------------------


class NumericEquations(Protocol):
    """Equations of motion with numbers."""

    @property
    def dynamics(self) -> Dynamics:
        """The equations."""

    @property
    def parameters(self) -> Any:
        """The constants, in the order of the equations."""


class SeriesStepper:
    """Integrates such pieces.

    Args:
        integrator: Taylor's method.
        numbers: to compute in.
        end: of the motion, s.
        progress: notified of every step.
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
        criteria: StopCriteria,
    ) -> SeriesPiece:
        """Integrate from a state to the end of a span, or to where the criteria stop it.

        Raises:
            NumericError: where the motion cannot even begin.
        """
        flow, constants = self._flow(mode.dynamics), mode.parameters.tolist()
        begin, end = span
        looks = fewest_steps(flow)
        # A single step must not leap over a pulse of the forcing. The integrator has no limit on
        # its steps, so the span is shortened instead.
        if looks > 1:
            end = min(end, begin + self.end / looks)
        end = self.numbers.array([end])[0]
        symbols = flow.core.symbols
        own = [start[s] for s in symbols]
        problem = InitialValueProblem(flow.core.program, self.numbers, constants, own, begin, end)
        within = (float(begin), float(end))
        steps = StepWatch(criteria, own, within, self._progress, self.numbers)
        reason: Stop | None = None

        def goes_on(time: float, step: float, state: Sequence[Any]) -> bool:
            nonlocal reason
            reason = steps.after(time, step, state)
            return reason is None

        series = self._integrator.integrate(problem, goes_on)
        stop = reason or (steps.broken() if series.times[-1] < end else Stop.TIME)
        return SeriesPiece.of(symbols, series.without_empty_steps(), constants, stop)

    def _flow(self, dynamics: Dynamics) -> Flow:
        if id(dynamics) not in self._flows:
            self._flows[id(dynamics)] = (dynamics, flow_of(dynamics, reduced=False))
        return self._flows[id(dynamics)][1]


# -- where a piece ends ----------------------------------------------------------------------------


def refined_crossing(
    dynamics: Dynamics, positive: Expr, piece: SeriesPiece, place: float
) -> PiecePoint:
    """Where an expression falls through zero, to the rounding of the numbers.

    Args:
        dynamics: whose symbols it is written in.
        place: where it does so in doubles, in steps.
    """
    series, numbers = piece.series, piece.series.numbers
    step = min(int(place), series.steps - 1)
    arguments = (*piece.solution.symbols, *dynamics.parameters, CLOCK)
    function = dynamics.function([positive], arguments, numbers=numbers)

    def value(share: Any) -> Any:
        return function(*series.state(step, share), *piece.constants, series.time(step, share))[0]

    share = numbers.zero(value, place - step)
    return PiecePoint(step, min(max(share, 0), 1))


def slip_end(piece: SeriesPiece, criteria: StopCriteria) -> tuple[PiecePoint, int] | None:
    """Where the first slip vanishes within the last step, and which; None if slips only reverse."""
    if piece.solution.stop is not Stop.VANISHED:
        return None
    series, found = piece.series, list[tuple[PiecePoint, int]]()
    for k, pair in enumerate(criteria.vectors):
        point = _reversal(series, list(pair))
        slip = series.state(point.step, point.share)[list(pair)]
        if float(series.numbers.size(slip)) <= criteria.passing:
            found.append((point, k))
    return min(found, key=lambda end: end[0].share, default=None)


def _reversal(series: TaylorSolution, rows: list[int]) -> PiecePoint:
    """Where a vector is at 90° to what it was when the last step began; else the end of the step.

    This place minimises the length of a vector that passes zero almost on a straight line.
    """
    step, numbers = series.steps - 1, series.numbers
    first = series.state(step, 0)[rows]

    def along(share: Any) -> Any:
        return first @ series.state(step, share)[rows]

    if along(1) > 0:
        return PiecePoint(step, 1)
    coarse = [float(value) for value in first]

    def roughly_along(share: float) -> Any:
        return series.rounded_states(np.array([step + share]))[rows, 0] @ coarse

    near = bisected(roughly_along, 0.0, 1.0)
    return PiecePoint(step, numbers.zero(along, near))

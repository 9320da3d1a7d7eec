"""Where a stretch ends, in numbers of higher precision: a slip vanishes, or a guard falls."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from polhode.algebra import Expr
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate.integrate._crossing import bisected
from polhode.simulate.integrate._series import TaylorSolution
from polhode.simulate.integrate._stop_criteria import Stop, StopCriteria
from polhode.simulate.precise._precise_piece import PrecisePiece


@dataclass(frozen=True)
class PiecePoint:
    """A place within a stretch.

    Attributes:
        step: which of its steps.
        share: of it that has passed.
    """

    step: int
    share: Any


def fallen(dynamics: Dynamics, positive: Expr, stretch: PrecisePiece, place: float) -> PiecePoint:
    """Where an expression falls through zero, to the rounding of the numbers.

    Args:
        dynamics: in whose symbols it is.
        place: where it does so in doubles, in steps.
    """
    series, numbers = stretch.series, stretch.series.numbers
    step = min(int(place), series.steps - 1)
    arguments = (*stretch.symbols, *dynamics.parameters, CLOCK)
    function = dynamics.function([positive], arguments, numbers=numbers)
    constants = numbers.array(stretch.constants)

    def value(share: Any) -> Any:
        return function(*series.state(step, share), *constants, series.time(step, share))[0]

    share = numbers.zero(value, place - step)
    return PiecePoint(step, min(max(share, 0), 1))


def landing(stretch: PrecisePiece, watched: StopCriteria) -> tuple[PiecePoint, int] | None:
    """Where a vector vanishes within the last step, and which; None if they only turn round."""
    if stretch.stop is not Stop.VANISHED:
        return None
    for k, pair in enumerate(watched.vectors):
        spot = _turning(stretch.series, list(pair))
        if _size(stretch.series, spot, list(pair)) <= watched.passing:
            return spot, k
    return None


def _turning(series: TaylorSolution, rows: list[int]) -> PiecePoint:
    """Where a vector is across what it was when the last step began; else the end of the step."""
    step, numbers = series.steps - 1, series.numbers
    first = series.state(step, 0)[rows]

    def along(share: Any) -> Any:
        return first @ series.state(step, share)[rows]

    if along(1) > 0:
        return PiecePoint(step, 1)
    coarse = [float(value) for value in first]
    near = bisected(lambda share: _in_doubles(series, step, share, rows) @ coarse, 0.0, 1.0)
    return PiecePoint(step, numbers.zero(along, near))


def _in_doubles(series: TaylorSolution, step: int, share: float, rows: list[int]) -> Any:
    return series.rounded_states(np.array([step + share]))[rows, 0]


def _size(series: TaylorSolution, spot: PiecePoint, rows: list[int]) -> float:
    return float(series.numbers.size(series.state(spot.step, spot.share)[rows]))

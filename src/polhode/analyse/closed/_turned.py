"""A closed form of a body's attitude, read in the coordinates and speeds of any chart."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from polhode.analyse.closed._chart import Placed, Vec
from polhode.analyse.closed._reals import Array, DoubleReals, Reals
from polhode.analyse.closed._solution import ExactSolution
from polhode.base import NumericError

_STEPS = 64  # of a period, at first
_FINER = 6  # times that steps are halved where an angle goes too far in one
_MOST = 400_000  # steps
_FAR = 1.5  # rad in a step, beyond which a turn might be missed


class Attitude(NamedTuple):
    """How a body lies and turns, along the root's axes.

    Attributes:
        rows: matrix from components along axes fixed in the body.
        axis: of symmetry, or any axis of the body.
        turning: angular velocity, 1/s.
    """

    rows: Sequence[Vec]
    axis: Vec
    turning: Vec


class Attitudes(ABC):
    """The attitude of a body at all times, from its start."""

    @property
    @abstractmethod
    def solution(self) -> ExactSolution:
        """The motion in quantities of its own."""

    @abstractmethod
    def at(self, reals: Reals, times: Array) -> Attitude:
        """At times, s."""

    @property
    @abstractmethod
    def step(self) -> float:
        """Time in which nothing turns far, s."""


@dataclass(frozen=True)
class Turned(ExactSolution):
    """A motion of a body, in the coordinates and speeds of its chart.

    Attributes:
        attitudes: the motion.
        placed: the chart.
    """

    attitudes: Attitudes
    placed: Placed

    @property
    def kind(self) -> str:
        return self.attitudes.solution.kind

    @property
    def period(self) -> Any:
        return self.attitudes.solution.period

    @property
    def figures(self) -> dict[str, Any]:
        return self.attitudes.solution.figures

    def besides(self, reals: Reals, times: Array) -> dict[str, Array]:
        return self.attitudes.solution.besides(reals, times)

    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        found = self.attitudes.at(reals, times)
        angles = self.placed.angles(reals, found.rows, found.axis)
        circle = reals.number(2 * self.placed.data.context.pi)
        turns = self._whole_turns(times, angles)
        whole = [a + circle * n for a, n in zip(angles, turns, strict=True)]
        names = (q.published for q in self.placed.chart.angles)
        speeds = self.placed.speeds(reals, angles, found.turning)
        return {**dict(zip(names, whole, strict=True)), **speeds}

    def _whole_turns(self, times: Array, angles: Sequence[Array]) -> list[Array]:
        """Whole turns to be added to angles at times, counted from the start on."""
        import numpy as np

        moments = np.asarray(times, dtype=float)
        step = self.attitudes.step
        for _ in range(_FINER):
            grid = self._grid(moments, step)
            passed = self._passed(grid)
            if max(float(np.max(np.abs(np.diff(p)), initial=0.0)) for p in passed) < _FAR:
                break
            step = step / 2
        else:
            raise NumericError(
                "a motion through the neighbourhood of a position where its angles are singular",
                expected="angles that change steadily, so that their turns can be counted",
                advice="describe the attitude by other angles",
            )
        places = np.searchsorted(grid, moments)
        return [
            np.rint((p[places] - np.asarray(a, dtype=float)) / (2 * np.pi)).astype(int)
            for p, a in zip(passed, angles, strict=True)
        ]

    def _grid(self, moments: Array, step: float) -> Array:
        import numpy as np

        first, last = min(0.0, float(np.min(moments))), max(0.0, float(np.max(moments)))
        count = int((last - first) / step) + 2
        if count > _MOST:
            raise NumericError(
                f"angles whose turns are counted over {count} steps",
                expected=f"at most {_MOST}",
                advice="ask for times nearer to the start, or use Euler's angles from the vertical",
            )
        return np.unique(np.concatenate([np.linspace(first, last, count), moments.ravel(), [0.0]]))

    def _passed(self, grid: Array) -> list[Array]:
        """The angles along a grid, each step by the shorter way, as they are at the start."""
        import numpy as np

        doubles = DoubleReals()
        found = self.attitudes.at(doubles, grid)
        begun = int(np.searchsorted(grid, 0.0))
        passed = []
        for angle, start in zip(
            self.placed.angles(doubles, found.rows, found.axis), self.placed.begun, strict=True
        ):
            path = np.unwrap(np.broadcast_to(angle, grid.shape))
            turns = np.rint((float(start) - path[begun]) / (2 * np.pi))
            passed.append(path + 2 * np.pi * turns)
        return passed

"""Where motions that go side by side are taken up, and where they arrive."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from polhode.simulate.integrate._integrators import Array

NONE = -1
"""The guard of a motion that none has ended."""


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
        states: shape (times, states, motions); not-a-number before a motion is taken up and after
            its end, but for the last time, which stands for the end.
        end: how far each went, s.
        guard: which guard ended it, or NONE.
        good: whether the result can be relied on.
    """

    states: Array
    end: Array
    guard: NDArray[np.intp]
    good: NDArray[np.bool_]

    @classmethod
    def none_yet(cls, times: Array, states: int, count: int) -> Arrivals:
        """Of motions that have yet to be followed."""
        return cls(
            np.full((len(times), states, count), np.nan),
            np.full(count, float(times[-1])),
            np.full(count, NONE, dtype=np.intp),
            np.ones(count, dtype=bool),
        )

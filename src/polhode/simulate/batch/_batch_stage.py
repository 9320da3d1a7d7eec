"""Where motions that go side by side are taken up, and where they arrive."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from polhode.simulate.integrate._stepping import Array

NONE = -1
"""The guard of a motion that none has ended."""


@dataclass(frozen=True)
class BatchStage:
    """Where motions are taken up, and what ends them.

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
        """The same motions, taken up elsewhere."""
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
        states: shape (times, states, motions); not-a-number before a motion is taken up and from
            its end on, but for the last time, which stands for the end.
        end: how far each went, s.
        guard: which guard ended it, or NONE.
        good: whether the result can be relied on.
    """

    states: Array
    end: Array
    guard: NDArray[np.intp]
    good: NDArray[np.bool_]

    @classmethod
    def none_yet(cls, times: Array, launch: BatchStage) -> BatchArrivals:
        """Of motions that have yet to be followed."""
        count = launch.count
        return cls(
            np.full((len(times), len(launch.states), count), np.nan),
            launch.end.copy(),
            np.full(count, NONE, dtype=np.intp),
            np.ones(count, dtype=bool),
        )

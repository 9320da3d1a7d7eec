"""A solution as Taylor series, step by step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from polhode.simulate.integrate._polynomials import evaluated, pieces_at, powers_of
from polhode.simulate.integrate._stepping import Array

_MISSED = 2  # steps of rounding by which the sum of the steps may miss their end


class TaylorSteps:
    """Steps as they are made.

    Args:
        begin: of the first of them, s.
    """

    def __init__(self, begin: float) -> None:
        self._times = [(begin, 0.0)]
        self._lengths = list[float]()
        self._series = list[Array]()

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self._series)

    def add(self, end: tuple[float, float], length: float, series: Array) -> None:
        """One more.

        Args:
            end: the sum of these, s.
            length: s.
            series: Taylor coefficients about its beginning, shape (states, order + 1).
        """
        self._times.append(end)
        self._lengths.append(length)
        self._series.append(series.copy())

    def leg(self, goal: float, *, broken: bool) -> TaylorLeg:
        """All of them together.

        Args:
            goal: where they were to end, s: there they do where only rounding is in between, for
                what happens at that instant would be passed over.
        """
        times, rests = np.array(self._times).T
        if abs(times[-1] - goal) <= _MISSED * np.spacing(abs(goal)):
            times[-1], rests[-1] = goal, 0.0
        lengths = np.array(self._lengths)
        shares = np.array(self._series)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            powers = powers_of(lengths, shares.shape[2] - 1).T
            np.multiply(
                shares[:, :, 1:], powers[:, None], out=shares[:, :, 1:], where=shares[:, :, 1:] != 0
            )
        return TaylorLeg(times, rests, lengths, shares, broken)


@dataclass(frozen=True)
class TaylorLeg:
    """Taylor series one after the other.

    Attributes:
        times: where the steps begin, and where the last one ends, s, shape (steps + 1,).
        rests: what these leave over of the same in twice as many digits, s.
        lengths: of the steps, s.
        shares: coefficients of the powers of the share of a step, shape (steps, states, order + 1).
        broken: whether it cannot be continued.
    """

    times: Array
    rests: Array
    lengths: Array
    shares: Array
    broken: bool

    def at(self, times: Array) -> Array:
        """States, shape (states, times)."""
        which = pieces_at(self.times, times)
        passed = (times - self.times[which]) - self.rests[which]
        return evaluated(self.shares, which, passed / self.lengths[which])

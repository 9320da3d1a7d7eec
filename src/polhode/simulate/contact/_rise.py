"""The first instants of a contact that has opened: how it rises, and when it closes again."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from polhode.simulate.integrate._integrators import Array

STILL = 1e-14  # approach, relative to the velocities it is the difference of, that is none
_INSTANT = 8  # steps of rounding of the time, over which nothing can be told from a height


@dataclass(frozen=True)
class Rise:
    """A contact that opens.

    Attributes:
        begin: when, s.
        speed: of opening, then, m/s.
        scale: size of what that speed is the difference of, m/s.
    """

    begin: float
    speed: float
    scale: float

    def mean(self, heights: Array, times: Array) -> Array:
        """The mean speed of opening, whose fall through zero is that of the height.

        The height itself begins at zero. So does the mean where a contact opens without speed: it
        is then held off by the rounding that it begins with.
        """
        passed = times - self.begin
        now = passed <= _INSTANT * np.spacing(self.begin)
        mean = np.where(now, self.speed, heights / np.where(now, 1.0, passed))
        still = STILL * self.scale
        return np.asarray(mean + still if abs(self.speed) <= still else mean)


def fall_of(height: float, rise: float, fall: float) -> float:
    """How long something that rises from a height, and falls ever faster, is above the ground."""
    return float(rise + np.sqrt(max(rise * rise - 2 * height * fall, 0.0))) / -fall

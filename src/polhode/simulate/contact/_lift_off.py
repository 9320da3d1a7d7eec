"""The first instants of a contact that has opened: how it rises, and when it closes again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from polhode.simulate.integrate._stepping import Array

STILL = 1e-14  # approach, relative to the velocities it is the difference of, that is none


@dataclass(frozen=True)
class LiftOff:
    """A contact that opens.

    Attributes:
        speed: of opening, at first, m/s.
        still: what of it is rounding, m/s.
    """

    speed: float
    still: float

    def mean(self, heights: Array, passed: Array) -> Array:
        """The mean speed of opening, whose fall through zero is that of the height.

        The height itself begins at zero. So does the mean where a contact opens without speed: it
        is then held off by the rounding that it begins with.

        Args:
            passed: since then, s; zero where nothing can be told from a height yet.
        """
        now = passed == 0
        mean = np.where(now, self.speed, heights / np.where(now, 1.0, passed))
        return np.asarray(mean + self.still if abs(self.speed) <= self.still else mean)


def fall_of(height: Any, rise: Any, fall: Any) -> Any:
    """How long something that rises from a height, and falls ever faster, is above the ground."""
    return (rise + max(rise * rise - 2 * height * fall, 0) ** 0.5) / -fall

"""A state in the one language that all contact modes share."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from polhode.simulate.integrate._number_types import DOUBLES
from polhode.simulate.integrate._stepping import Array

#: Of a state, a time, and the values of extra symbols.
Function = Callable[[Array, float, Sequence[float]], Array]


@dataclass(frozen=True)
class State:
    """A state in the one language that all modes share: that of the mode in which nothing touches.

    Attributes:
        coordinates: of that mode.
        speeds: of that mode.
        work: done so far by everything that is not in the potential, J.
    """

    time: float
    coordinates: Array
    speeds: Array
    work: float = 0.0

    def rounded(self) -> State:
        """The same in doubles."""
        double = DOUBLES.array
        return State(
            float(self.time), double(self.coordinates), double(self.speeds), float(self.work)
        )

    def kicked(self, change: Array, work: Any) -> State:
        """After an instant in which the speeds jumped and work was done."""
        return replace(self, speeds=self.speeds + change, work=self.work + work)

"""What an integrator is to the rest: it steps along a flow, and is looked on."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from polhode.base import NumericError
from polhode.simulate.integrate._flow import Flow

Array = NDArray[np.float64]

#: Steps at least over a stretch that a pulse may drive, so that it is not stepped over.
LOOKS = 64
_SHORTEST = 1e-13  # of the time: within less of it nothing can be missed
_FORESEEN = 12  # degree of a polynomial of time that a step sees whole


def looks_along(flow: Flow) -> int:
    """Steps at least over a stretch of a motion that is driven by the time itself."""
    return int(min(LOOKS, 1 + flow.degree / _FORESEEN))


def longest_step(begin: float, end: float, fewest: int) -> float:
    """Length of a step with which a span takes so many, unless it is as short as rounding, s."""
    return max((end - begin) / fewest, _SHORTEST * max(abs(begin), abs(end)))


class StepCallback(Protocol):
    """Looks on after every step."""

    def __call__(self, time: float, state: list[float]) -> bool:
        """Whether to go on."""
        ...


class Leg(Protocol):
    """A solution over a stretch of time, known at every instant of it."""

    @property
    def broken(self) -> bool:
        """Whether it cannot be continued: an acceleration is not finite."""
        ...

    @property
    def times(self) -> Array:
        """Where its steps begin and end, s."""
        ...

    def at(self, times: Array) -> Array:
        """States, shape (states, times)."""
        ...


class Stepper(Protocol):
    """A compiled flow, ready to be integrated from any state with any parameters."""

    def leg(
        self, parameters: Array, begin: float, state: Array, end: float, watch: StepCallback
    ) -> Leg:
        """Integrate the core from `begin` to `end`, until `watch` says no, or as far as it goes.

        Raises:
            NumericError: where the motion cannot even begin.
        """
        ...


class Integrator(Protocol):
    """A way of integrating flows.

    Attributes:
        name: of the library or method.
        dense: whether a solution is as exact between the steps as at their ends, so that
            quadratures can be done afterwards.
    """

    name: str
    dense: bool

    def prepare(self, flow: Flow, tolerance: float | None) -> Stepper:
        """Compile a flow; the tolerance is relative, None the best that the method holds."""
        ...


def broken(time: float) -> NumericError:
    """The motion cannot be continued."""
    return NumericError(
        f"the motion cannot be continued beyond t = {time:.9g} s",
        expected="finite accelerations",
        advice="it runs into a singular position there: end before, or start elsewhere",
    )

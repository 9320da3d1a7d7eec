"""What stands for a Python function of time, and how closely the function was looked at."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np

from polhode.base import NumericError
from polhode.simulate.forcing._pieces import Pieces
from polhode.simulate.integrate._stepping import Array

Function = Callable[[float], float]

_GOLDEN = (5**0.5 - 1) / 2
_MOST_AGAIN = 1000  # times of one motion at which a function is evaluated again
_NEAR = 1e-9  # of the span: so close to a corner a time is not looked at


@dataclass(frozen=True, eq=False)
class Approximation(Pieces):
    """A Python function of time as polynomials, and how long a departure could have been missed.

    Attributes:
        resolution: s. Whatever the function does for longer than that has been seen; what it does
            for less, such as a pulse between two of the times at which it was evaluated, may
            have been missed.
        function: itself; a copy in another process is without it.
        allowed: by how much it may differ from each polynomial, shape (pieces,).
    """

    resolution: float = 0.0
    function: Function | None = None
    allowed: Array | None = None

    def __repr__(self) -> str:
        return (
            f"a function of time from {self.start:.6g} s to {self.end:.6g} s as "
            f"{len(self.coefficients)} polynomials; what it does for less than "
            f"{self.resolution:.3g} s may have been missed"
        )

    def __getstate__(self) -> dict[str, Any]:
        """Without the function, which need not be one that can be sent to another process."""
        fields = ("knots", "coefficients", "corners", "resolution")
        return {name: getattr(self, name) for name in fields} | {"function": None, "allowed": None}

    def confirm(self, name: str, steps: Array) -> None:
        """Evaluate the function again between the ends of steps of a motion.

        Args:
            name: of what it prescribes.
            steps: increasing times, s.

        Raises:
            NumericError: where it does not have the value that the motion was computed with.
        """
        if self.function is None or self.allowed is None:
            return
        times = self._between(steps)
        values = values_of(self.function, times)
        piece = np.searchsorted(self.knots, times, "right") - 1
        wrong = np.flatnonzero(np.abs(values - self.value(times)) > self.allowed[piece])
        if len(wrong):
            first = wrong[0]
            raise NumericError(
                f"{name} = {values[first]:.6g} at t = {times[first]:.9g} s, where the motion was "
                f"computed with {float(self.value(times[first])):.6g}: the function was evaluated "
                f"before and after, but not there",
                expected=f"a function that does nothing for less than {self.resolution:.3g} s, "
                "and has the same value whenever it is asked for",
                advice="give the motion as polhode.approximated(function, 0, duration, "
                "resolution=...), with what it does shortest as the resolution",
            )

    def _between(self, steps: Array) -> Array:
        """A time within each step, neither at rest nor at a corner.

        Not in the middle: where steps are pieces the function was evaluated there.
        """
        times = steps[:-1] + _GOLDEN * np.diff(steps)
        times = times[:: ceil(len(times) / _MOST_AGAIN) or 1]
        near = _NEAR * (self.end - self.start)
        times = times[(times > self.start + near) & (times < self.end - near)]
        corners = self.knots[list(self.corners)]
        return times[np.all(np.abs(times[:, None] - corners) > near, axis=1)]


def looked_at(left: float, right: float, resolution: float) -> Array:
    """Times between two others, at most a resolution apart, from the ends too.

    Their distances are two in golden ratio, in a sequence without period: evenly spaced times
    could meet every gap of what is periodic itself.
    """
    count = ceil((right - left) / (_GOLDEN * resolution))
    numbers = np.arange(count)
    return left + (right - left) * (numbers + (_GOLDEN * (numbers + 1)) % 1) / count


def values_of(function: Function, times: Array) -> Array:
    """Of a function, at some times.

    Raises:
        NumericError: where it fails, or has no finite value.
    """
    try:
        values = np.array([float(function(t)) for t in times.tolist()])
    except Exception as error:  # whatever a user's function may raise
        raise NumericError(
            f"a prescribed motion that fails between {np.min(times):.6g} s and "
            f"{np.max(times):.6g} s ({error})",
            expected="a function from a time in seconds to a number",
        ) from error
    if not np.all(np.isfinite(values)):
        raise NumericError(
            f"a prescribed motion that is not finite at t = {times[~np.isfinite(values)][0]:.6g} s",
            expected="a number at every time",
        )
    return values

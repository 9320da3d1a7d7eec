"""How many steps a motion takes, and when that is told to lead nowhere."""

from __future__ import annotations

from polhode.base import NumericError

MOST_KEPT = 5_000_000  # states at the beginning of steps, each with its powers of time

# After so many steps, how many it may seem to take in all: those at the start may be tiny.
_GLANCES = {100: 4e12, 4_000: 1e10}


class StepCount:
    """The steps of one motion, over all its stretches."""

    def __init__(self) -> None:
        self._steps = 0
        self._kept = 0.0
        self._begin = 0.0

    def count(self, span: tuple[float, float], time: float, size: float, *, hurries: bool) -> None:
        """One step more.

        Args:
            span: of the stretch, s.
            time: at the end of the step, s.
            size: how many states are kept for it, as doubles.
            hurries: whether nothing is about to happen that would explain short steps.

        Raises:
            NumericError: where there are too many already, or will be.
        """
        begin, end = span
        if self._steps == 0:
            self._begin = begin
        if self._kept + size > MOST_KEPT:
            raise _endless(time, self._steps)
        self._steps += 1
        self._kept += size
        passed = time - self._begin
        expected = _GLANCES.get(self._steps)
        if expected and hurries and end - time > expected / self._steps * passed:
            most = int(MOST_KEPT / self._kept * self._steps)
            raise _hopeless(end, self._steps, most, passed)


def _endless(time: float, most: int) -> NumericError:
    """The motion takes more steps than can be kept."""
    return NumericError(
        f"{most} steps are not enough to go beyond t = {time:.9g} s",
        expected="a motion without singular positions, over a duration that can be kept in memory",
        advice="end before that time, or start elsewhere",
    )


def _hopeless(end: float, steps: int, most: int, passed: float) -> NumericError:
    """The end is out of reach."""
    return NumericError(
        f"a motion up to t = {end:g} s, of which {steps} steps cover {passed:.3g} s",
        expected=f"a duration that {most} steps can cover",
        advice=f"try {most / steps * passed / 100:.0e} s",
    )

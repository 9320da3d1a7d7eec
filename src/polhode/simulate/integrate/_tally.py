"""How many steps a motion takes, and when that is told to lead nowhere."""

from __future__ import annotations

from polhode.base import NumericError

MOST_STEPS = 4_000_000  # of a motion: all of them are kept

# After so many steps, how many it may seem to take in all: those at the start may be tiny.
_GLANCES = {100: 4e12, 4_000: 1e10}


class Tally:
    """The steps of one motion, over all its stretches."""

    def __init__(self) -> None:
        self._steps = 0
        self._begin = 0.0

    def count(self, span: tuple[float, float], time: float, *, hurries: bool) -> None:
        """One step more.

        Args:
            span: of the stretch, s.
            time: at the end of the step, s.
            hurries: whether nothing is about to happen that would explain short steps.

        Raises:
            NumericError: where there are too many already, or will be.
        """
        begin, end = span
        if self._steps == 0:
            self._begin = begin
        self._steps += 1
        if self._steps > MOST_STEPS:
            raise _endless(time)
        passed = time - self._begin
        expected = _GLANCES.get(self._steps)
        if expected and hurries and end - time > expected / self._steps * passed:
            raise _hopeless(end, self._steps, passed)


def _endless(time: float) -> NumericError:
    """The motion takes more steps than can be kept."""
    return NumericError(
        f"{MOST_STEPS} steps are not enough to go beyond t = {time:.9g} s",
        expected="a motion without singular positions, over a duration that can be kept in memory",
        advice="end before that time, or start elsewhere",
    )


def _hopeless(end: float, steps: int, passed: float) -> NumericError:
    """The end is out of reach."""
    return NumericError(
        f"a motion up to t = {end:g} s, of which {steps} steps cover {passed:.3g} s",
        expected=f"a duration that {MOST_STEPS} steps can cover",
        advice=f"try {MOST_STEPS / steps * passed / 100:.0e} s",
    )

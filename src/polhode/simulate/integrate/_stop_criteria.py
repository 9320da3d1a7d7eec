"""What stops an integration: slips that end, too many steps, steps that are too short, pauses.

The end of a slip is detected here, from step to step: its velocity vanishes or reverses. A guard
cannot detect it, since the slip speed touches zero without changing sign.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import Enum
from math import hypot, inf
from operator import mul
from typing import Any

from polhode.base import NumericError, Progress, StopRequested
from polhode.simulate.integrate._number_types import DOUBLES, NumberType

# -- how many steps a motion may take ---------------------------------------------------------

# States at the beginning of steps, summed over all steps. Each is kept with some twenty powers of
# the time, so that this limit is somewhat below a gigabyte.
MOST_KEPT = 5_000_000

# The total number of steps is extrapolated after so many of them, and must not exceed the limit
# beside it. The limits are generous: the first steps of a motion may be tiny.
_EXTRAPOLATED_AT = {100: 4e12, 4_000: 1e10, 100_000: 1e8}


class StepCount:
    """The steps of one motion, over all its pieces."""

    def __init__(self) -> None:
        self._steps = 0
        self._kept = 0.0
        self._begin = 0.0

    def count(
        self, span: tuple[float, float], time: float, size: float, *, no_slip_ends: bool
    ) -> None:
        """Count one more.

        Args:
            span: of the piece, s.
            time: at the end of the step, s.
            size: how many states are kept for it, as doubles.
            no_slip_ends: whether no slip is about to end, which would explain short steps.

        Raises:
            NumericError: where there are too many already, or will be.
        """
        begin, end = span
        if self._steps == 0:
            self._begin = begin
        if self._kept + size > MOST_KEPT:
            raise NumericError(
                f"{self._steps} steps are not enough to go beyond t = {time:.9g} s",
                expected="a motion without singular positions, over a duration that can be kept "
                "in memory",
                advice="end before that time, or start elsewhere",
            )
        self._steps += 1
        self._kept += size
        passed = time - self._begin
        expected = _EXTRAPOLATED_AT.get(self._steps)
        if expected and no_slip_ends and end - time > expected / self._steps * passed:
            most = int(MOST_KEPT / self._kept * self._steps)
            raise NumericError(
                f"a motion up to t = {end:g} s, of which {self._steps} steps cover {passed:.3g} s",
                expected=f"a duration that {most} steps can cover",
                advice=f"try {most / self._steps * passed / 100:.0e} s",
            )


# -- why an integration stops ----------------------------------------------------------------------

# A step this much shorter than the time and the longest step so far: at a singular position the
# integrator shortens its steps without limit.
_SMALLEST = 1e-14
_ALMOST = 100.0  # times the length at which a vector has vanished: this small, it may reverse


class Stop(Enum):
    """Why an integration came to its end."""

    TIME = "the end was reached"
    INTERRUPTED = "the progress asked to stop"
    PAUSE = "guards are to be checked"
    VANISHED = "a watched vector vanished or reversed"
    STUCK = "the motion cannot be continued"


@dataclass(frozen=True)
class StopCriteria:
    """What to watch for while integrating.

    Attributes:
        pause: steps after which to stop, so that guards are checked.
        vectors: places in the core of vectors (slip velocities) that stop it where they vanish.
        least: length, m/s, at which such a vector has vanished.
        passing: the same where it reverses, or where steps become too short.
        over: whether a state is certainly beyond the end of the mode, so that guards are checked
            without waiting for the pause.
        tally: of the steps of the whole motion.
    """

    pause: float = inf
    vectors: tuple[tuple[int, ...], ...] = ()
    least: float = 0.0
    passing: float = 0.0
    over: Callable[[float, Sequence[Any]], bool] = lambda time, state: False
    tally: StepCount = field(default_factory=StepCount)

    def seen(self, state: Sequence[Any]) -> list[list[float]]:
        """The vectors in a state of the core, in doubles."""
        return [[float(state[place]) for place in places] for places in self.vectors]


class _Vanishing:
    """Detects from step to step whether a vector vanishes.

    Args:
        criteria: which vectors, and which lengths count as zero.
        state: at the beginning.
    """

    def __init__(self, criteria: StopCriteria, state: Sequence[Any]) -> None:
        self._criteria = criteria
        self._vectors = criteria.seen(state)
        self._shrinks = [False for _ in self._vectors]

    def at(self, state: Sequence[Any]) -> bool:
        """Whether one vanishes, or reverses, on the way to a state."""
        before, self._vectors = self._vectors, self._criteria.seen(state)
        shrank, self._shrinks = self._shrinks, list(map(_is_shorter, self._vectors, before))
        least = self._criteria.least
        for old, new, was_shrinking in zip(before, self._vectors, shrank, strict=True):
            size, reverses = hypot(*new), sum(map(mul, old, new)) <= 0.0
            # A vector that passes zero at a small distance may reverse over several steps, none of
            # which turns it by more than 90°: its length then has a minimum.
            grows = was_shrinking and size <= _ALMOST * least and not _is_shorter(new, old)
            if reverses or grows or size <= least:
                return True
        return False

    @property
    def is_near(self) -> bool:
        """Whether one is as small as vectors are where they reverse."""
        return any(hypot(*vector) <= self._criteria.passing for vector in self._vectors)


class StepWatch:
    """Reports the steps of an integration to the progress, and says when to stop.

    Args:
        criteria: what may stop it.
        state: at the beginning.
        span: from its beginning to where it is to end, s.
        progress: notified of every step.
        numbers: in which the states are.
    """

    def __init__(
        self,
        criteria: StopCriteria,
        state: Sequence[Any],
        span: tuple[float, float],
        progress: Progress,
        numbers: NumberType = DOUBLES,
    ) -> None:
        self._criteria = criteria
        self._span = span
        self._progress = progress
        self._smallest = float(numbers.finer(_SMALLEST))
        self._size = len(state) * numbers.bits / DOUBLES.bits
        self._longest = 0.0
        self._steps = 0
        self._vanishing = _Vanishing(criteria, state)

    def after(self, time: float, step: float, state: Sequence[Any]) -> Stop | None:
        """Why to stop after a step, if at all.

        Args:
            time: at its end, s.
            step: its length, s; infinite where it is not known.
            state: at its end.

        Raises:
            NumericError: where there are too many steps already, or will be.
        """
        self._steps += 1
        try:
            self._progress.advance()
        except StopRequested:
            return Stop.INTERRUPTED
        no_slip_ends = not self._vanishing.is_near
        self._criteria.tally.count(self._span, time, self._size, no_slip_ends=no_slip_ends)
        if self._vanishing.at(state):
            return Stop.VANISHED
        if step < inf:
            self._longest = max(self._longest, step)
        # Steps also shrink towards the end of a slip, where friction has no direction.
        is_short = step < self._smallest * max(abs(time), self._longest)
        if is_short and time < self._span[1]:
            return self.broken()
        if self._steps >= self._criteria.pause or self._criteria.over(time, state):
            return Stop.PAUSE
        return None

    def broken(self) -> Stop:
        """Why it stops where the integrator has no step left that is long enough."""
        return Stop.VANISHED if self._vanishing.is_near else Stop.STUCK


def _is_shorter(one: list[float], other: list[float]) -> bool:
    return hypot(*one) < hypot(*other)

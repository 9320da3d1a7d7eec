"""What happens along a motion at an instant."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Protocol

from polhode.simulate._segment import Segment
from polhode.simulate.integrate._stop_criteria import Stop


@dataclass(frozen=True)
class ModeSwitch:
    """A change of contact mode, or of the side of an absolute value.

    Attributes:
        time: s.
        kind: what happened.
        before: name of the mode it ended.
        after: name of the mode it began.
    """

    time: float
    kind: str
    before: str
    after: str


@dataclass(frozen=True)
class Event:
    """A change of contact mode, or the start or end of the motion (then one mode is None).

    Attributes:
        time: s.
        kind: what happened: start, slips, sticks, lifts off, touches down, bounces, jerk, crosses
            the edge, goes flat, interrupted, end, or the name of an event that was asked for; of
            the argument of an absolute value: changes sign, stays zero, leaves zero.
        before: name of the mode up to then.
        after: name of the mode from then on.
    """

    time: float
    kind: str
    before: str | None
    after: str | None
    _left: Segment | None = field(default=None, repr=False, compare=False)
    _entered: Segment | None = field(default=None, repr=False, compare=False)

    @cached_property
    def state_before(self) -> Mapping[str, float] | None:
        """Coordinates, speeds and rates just before, by name, SI; None before the start."""
        return None if self._left is None else self._left.state(self.time)

    @cached_property
    def state_after(self) -> Mapping[str, float] | None:
        """Coordinates, speeds and rates just after, by name, SI; None after the end."""
        return None if self._entered is None else self._entered.state(self.time)

    @property
    def divides(self) -> bool:
        """Whether other equations, or other speeds, hold after it than before."""
        left, entered = self._left, self._entered
        return left is not None and entered is not None and left is not entered

    def as_json(self) -> dict[str, Any]:
        """As the command line prints it."""
        return {"time": self.time, "kind": self.kind, "from": self.before, "to": self.after}


class SegmentedMotion(Protocol):
    """Segments of a motion, and the changes of contact mode between them."""

    @property
    def segments(self) -> tuple[Segment, ...]: ...
    @property
    def changes(self) -> tuple[ModeSwitch, ...]: ...
    @property
    def ending(self) -> str: ...


def events_of(motion: SegmentedMotion) -> tuple[Event, ...]:
    """Start, changes of contact mode, and end."""
    first, last = motion.segments[0], motion.segments[-1]
    interrupted = last.parts[-1].solution.stop is Stop.INTERRUPTED
    events = (
        Event(first.begin, "start", None, first.mode),
        *(Event(c.time, c.kind, c.before, c.after) for c in motion.changes),
        Event(last.end, "interrupted" if interrupted else "end", motion.ending, None),
    )
    return placed(events, motion.segments)


def placed(events: Iterable[Event], segments: Sequence[Segment]) -> tuple[Event, ...]:
    """Events of a motion, each between the segments that meet at it."""
    begins = [segment.begin for segment in segments]
    return tuple(_placed(event, segments, begins) for event in events)


def _placed(event: Event, segments: Sequence[Segment], begins: list[float]) -> Event:
    first, last = bisect_left(begins, event.time), bisect_right(begins, event.time)
    near = segments[max(first - 1, 0) : last]
    left = next((s for s in near if s.mode == event.before), near[0])
    entered = next((s for s in reversed(near) if s.mode == event.after), near[-1])
    return replace(
        event,
        _left=None if event.before is None else left,
        _entered=None if event.after is None else entered,
    )

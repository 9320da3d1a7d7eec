"""Events of a motion: changes of contact mode, and requested zero crossings."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import pairwise
from typing import Any, NamedTuple, Protocol

import numpy as np

from polhode.algebra import ZERO, Expr, SymbolKind
from polhode.base import NumericError, look_up
from polhode.model import Contact
from polhode.simulate._segment import Segment
from polhode.simulate.integrate._crossing import roots
from polhode.simulate.integrate._stop_criteria import Stop

_AT_END = 1e-9  # of a segment: a crossing this close to its end counts as being at its end
_INSTANT = 64  # units in the last place of the time: shorter segments are too short for crossings
_BESIDE = 1e-6  # of a step: distance from an end at which the sign beside it is read


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
            the edge, goes flat, interrupted, end, or the name of a requested event; for the
            argument of an absolute value: changes sign, stays zero, leaves zero; for bodies
            without a contact between them: "one meets other".
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
    found = []
    for event in events:
        first, last = bisect_left(begins, event.time), bisect_right(begins, event.time)
        near = segments[max(first - 1, 0) : last]
        left = entered = None
        if event.before is not None:
            left = next((s for s in near if s.mode == event.before), near[0])
        if event.after is not None:
            entered = next((s for s in reversed(near) if s.mode == event.after), near[-1])
        found.append(replace(event, _left=left, _entered=entered))
    return tuple(found)


# -- requested events: expressions that pass through zero ------------------------------------------


class EventCrossing(NamedTuple):
    """Where an expression passes through zero.

    Attributes:
        time: s.
        segment: which of them it is in.
        begins: whether the segment begins there.
    """

    time: float
    segment: int
    begins: bool


def requested_events(segments: Sequence[Segment], wanted: Mapping[str, Expr]) -> list[Event]:
    """An event wherever one of some expressions passes through zero along a motion."""
    return [
        Event(time, name, segments[k].mode, segments[k].mode, segments[k], segments[k])
        for name, expression in wanted.items()
        for time, k, _ in zero_crossings(segments, expression)
    ]


def zero_crossings(segments: Sequence[Segment], expression: Expr) -> Iterator[EventCrossing]:
    """When an expression passes through zero along a motion.

    Where an absolute value changes its side the motion goes on, in another segment: an expression
    that is zero there, as the argument itself is, must be counted once, not twice or never.
    """
    lasting = [k for k, s in enumerate(segments) if s.end - s.begin > _INSTANT * np.spacing(s.end)]
    before = dict(pairwise(lasting))
    quantity = Expr.of(expression)
    seams = {  # where only the side of an absolute value changes
        (i, k)
        for i, k in before.items()
        if segments[i].mode == segments[k].mode and segments[i].dynamics is not segments[k].dynamics
    }
    begun, ended = {k for _, k in seams}, {i for i, _ in seams}
    within = [in_mode(segment, quantity) for segment in segments]
    for i, k in seams:
        if _changes(segments[i], segments[k], within[i], within[k]):
            yield EventCrossing(segments[k].begin, k, begins=True)
    for k in lasting:
        begin, end = segments[k].begin, segments[k].end
        near = _AT_END * (end - begin)
        for time in roots(partial(segments[k].values, [within[k]]), segments[k].steps):
            early, late = time <= begin + near, time >= end - near
            if not ((early and k in begun) or (late and k in ended)):
                yield EventCrossing(time, k, begins=False)


def in_mode(segment: Segment, quantity: Expr) -> Expr:
    """An expression with the reactions of a contact mode; those of open contacts are zero.

    Raises:
        DeclarationError: for a reaction that the system does not have.
        NumericError: for a reaction that Newton's laws do not determine.
    """
    equations = segment.dynamics.equations
    named = [s for s in quantity.symbols() if s.kind is SymbolKind.REACTION]
    elements = getattr(equations.system, "elements", ())
    contacts = [getattr(element, "contact", element) for element in elements]
    of_contacts = {
        contact.component(label)
        for contact in contacts
        if isinstance(contact, Contact)
        for label in (*contact.on.tangents, contact.on.normal)
    }
    for symbol in named:
        known = {*equations.components, *equations.undetermined, *of_contacts}
        look_up(symbol.published, dict.fromkeys(sorted(known)), "reaction of the system")
        if symbol.published in equations.undetermined:
            raise NumericError(
                f"an event of {symbol.published}, which Newton's laws do not determine",
                expected="a reaction that follows from the motion",
            )
    return quantity.subs({s: equations.components.get(s.published, ZERO) for s in named})


def _changes(before: Segment, after: Segment, left: Expr, right: Expr) -> bool:
    """Whether a quantity changes its sign from one segment to the next, where it is an expression.

    At the seam itself it may be zero on both sides, so its sign is read a little beside it.
    """
    earlier, later = before.steps, after.steps
    sides = (
        (before, left, earlier[-1] - _BESIDE * (earlier[-1] - earlier[-2])),
        (after, right, later[0] + _BESIDE * (later[1] - later[0])),
    )
    one, other = (s.values([quantity], np.array([t]))[0, 0] for s, quantity, t in sides)
    return bool(one * other < 0)

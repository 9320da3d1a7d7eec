"""Events of a motion: changes of contact mode, and requested zero crossings."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Any, NamedTuple, Protocol

import numpy as np

from polhode.algebra import ZERO, Expr, SymbolKind
from polhode.base import NumericError, look_up
from polhode.model import ContactLaw
from polhode.simulate._segment import Segment
from polhode.simulate.integrate._arrays import Array, pieces_at
from polhode.simulate.integrate._crossing import NOISE, roots
from polhode.simulate.integrate._stop_criteria import Stop

_INSTANT = 64  # units in the last place of the time: shorter segments are too short for crossings
# Of the terms of an expression, at their largest so far: a value this small is their rounding.
_ZERO = 1e-12
_INSIDE = np.array([0.02, 0.25, 0.5, 0.75, 0.98])  # of an interval: where its sign is read


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

    It has to differ from zero by more than rounding before: where it is zero at the start, or has
    stayed zero for a while, nothing happens. Where it reaches zero at the very end of a contact
    mode, as a height does that vanishes in a landing, it is counted once, whatever follows. Where
    only an absolute value changes its side the motion goes on smoothly: there an expression that
    turns back, as the square of the argument does, only touches zero, which is not counted.
    """
    quantity = Expr.of(expression)
    seen: _SignChanges | None = None
    size = 0.0
    for k, segment in enumerate(segments):
        if segment.end - segment.begin <= _INSTANT * np.spacing(segment.end):
            continue
        found = _sign_changes(segment, in_mode(segment, quantity), size)
        if seen is not None and _passes(seen, found):
            yield EventCrossing(segment.begin, k, begins=True)
        for time in found.times:
            yield EventCrossing(time, k, begins=False)
        seen, size = found, found.size


class _SignChanges(NamedTuple):
    """The signs of an expression along a segment.

    Attributes:
        segment: which it is.
        times: where they change, s.
        first: the first of them; 0 if the expression is zero throughout.
        last: the last of them.
        zero: whether it is zero where the segment begins, and where it ends.
        size: of the terms of the expression, the largest so far.
    """

    segment: Segment
    times: list[float]
    first: int
    last: int
    zero: tuple[bool, bool]
    size: float


def _sign_changes(segment: Segment, quantity: Expr, size: float) -> _SignChanges:
    """The signs of an expression along a segment, but for those of its rounding.

    Args:
        size: of its terms, the largest before.
    """
    begin, end = segment.begin, segment.end
    found = roots(partial(segment.values, [quantity]), segment.steps)
    marks = np.array([begin, *(t for t in found if begin < t < end), end])
    inside = marks[:-1, None] + np.diff(marks)[:, None] * _INSIDE
    times = np.concatenate([[begin], inside.ravel(), [end]])
    terms = [*quantity.summands(), quantity.denominator, quantity]
    *numerator, denominator, values = segment.values(terms, times)
    with np.errstate(all="ignore"):
        sizes = np.sum(np.abs(numerator), axis=0) / np.abs(denominator)
    largest = np.maximum.accumulate(np.fmax(sizes, size))
    rounding = np.maximum(_ZERO * largest, NOISE * _largest_nearby(segment, quantity, times))
    signs = np.where(np.abs(values) > rounding, np.sign(values), 0).astype(int)
    changes, first, last, left = list[float](), 0, 0, begin
    for mark, part in zip(marks[1:].tolist(), signs[1:-1].reshape(-1, len(_INSIDE)), strict=True):
        sign = int(np.sign(np.sum(part)))
        if sign and last and sign != last:
            changes.append(left)
        if sign:
            first, last, left = first or sign, sign, mark
    zero = bool(signs[0] == 0), bool(signs[-1] == 0)
    return _SignChanges(segment, changes, first, last, zero, float(largest[-1]))


def _largest_nearby(segment: Segment, quantity: Expr, times: Array) -> Array:
    """The largest value of an expression within the integrator's step around each time."""
    steps = segment.steps
    which = pieces_at(steps, times)
    every, back = np.unique(which, return_inverse=True)
    inside = steps[every, None] + (steps[every + 1] - steps[every])[:, None] * _INSIDE
    values = segment.values([quantity], inside.ravel())[0].reshape(inside.shape)
    return np.asarray(np.max(np.abs(values), axis=1)[back], dtype=float)


def _passes(before: _SignChanges, after: _SignChanges) -> bool:
    """Whether an expression reaches or passes zero where one segment follows another."""
    if not (before.last and before.zero[1] and after.zero[0]):
        return False
    left, entered = before.segment, after.segment
    is_smooth = left.mode == entered.mode and left.dynamics is not entered.dynamics
    return not is_smooth or before.last != after.first


def in_mode(segment: Segment, quantity: Expr) -> Expr:
    """An expression with the reactions of a contact mode; those of open contacts are zero.

    Raises:
        DeclarationError: for a reaction that the system does not have.
        NumericError: for a reaction that Newton's laws do not determine.
    """
    equations = segment.dynamics.equations
    named = [s for s in quantity.symbols() if s.kind is SymbolKind.REACTION]
    elements = getattr(equations.system, "elements", ())
    open_ = {name for element in elements for name in element.absent()}
    laws = [element for element in elements if isinstance(element, ContactLaw)]
    of_contacts = open_ | {name for law in laws for name in law.components}
    for symbol in named:
        known = {*equations.components, *equations.undetermined, *of_contacts}
        look_up(symbol.published, dict.fromkeys(sorted(known)), "reaction of the system")
        if symbol.published in equations.undetermined:
            raise NumericError(
                f"an event of {symbol.published}, which Newton's laws do not determine",
                expected="a reaction that follows from the motion",
            )
    return quantity.subs({s: equations.components.get(s.published, ZERO) for s in named})

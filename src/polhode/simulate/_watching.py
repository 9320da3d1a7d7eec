"""Events that were asked for: expressions that pass through zero."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from polhode.algebra import Expr
from polhode.simulate._event import Event
from polhode.simulate._segment import Segment
from polhode.simulate._trajectory import Trajectory
from polhode.simulate.integrate._crossing import roots
from polhode.simulate.integrate._stepping import Array

_THERE = 1e-9  # of a segment: as good as at its end
_INSTANT = 64  # steps of rounding of the time: a segment that is over sooner shows nothing
_BESIDE = 1e-6  # of a step: where the sign is looked at beside an end


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


def with_events(trajectory: Trajectory, wanted: Mapping[str, Expr]) -> Trajectory:
    """The same motion with an event wherever one of some expressions passes through zero."""
    segments = trajectory.segments
    found = [
        Event(time, name, segments[k].mode, segments[k].mode, segments[k], segments[k])
        for name, expression in wanted.items()
        for time, k, _ in passages(segments, expression)
    ]
    first, *changes, last = trajectory.events
    between = sorted([*changes, *found], key=lambda event: event.time)
    return replace(trajectory, events=(first, *between, last))


def passages(segments: Sequence[Segment], expression: Expr) -> Iterator[EventCrossing]:
    """When an expression passes through zero along a motion.

    Where an absolute value changes its side, one motion goes on: an expression that passes through
    zero there, as the argument itself does, would be seen on both sides or on none.
    """
    lasting = [k for k, s in enumerate(segments) if s.end - s.begin > _INSTANT * np.spacing(s.end)]
    before = dict(pairwise(lasting))
    seams = {(i, k) for i, k in before.items() if _goes_on(segments[i], segments[k])}
    begun, ended = {k for _, k in seams}, {i for i, _ in seams}
    for i, k in seams:
        if _changes(segments[i], segments[k], expression):
            yield EventCrossing(segments[k].begin, k, begins=True)
    for k in lasting:
        begin, end = segments[k].begin, segments[k].end
        near = _THERE * (end - begin)
        for time in _inside(segments[k], expression):
            early, late = time <= begin + near, time >= end - near
            if not ((early and k in begun) or (late and k in ended)):
                yield EventCrossing(time, k, begins=False)


def _goes_on(before: Segment, after: Segment) -> bool:
    """Whether only the side of an absolute value differs."""
    return before.mode == after.mode and before.dynamics is not after.dynamics


def _changes(before: Segment, after: Segment, expression: Expr) -> bool:
    """Whether the sign beside a seam is another on either side of it."""
    earlier, later = before.steps, after.steps
    sides = (
        (before, earlier[-1] - _BESIDE * (earlier[-1] - earlier[-2])),
        (after, later[0] + _BESIDE * (later[1] - later[0])),
    )
    one, other = (s.values([Expr.of(expression)], np.array([t]))[0, 0] for s, t in sides)
    return bool(one * other < 0)


def _inside(segment: Segment, expression: Expr) -> list[float]:
    """When an expression passes through zero within a segment."""

    def values(times: Array) -> Array:
        return segment.values([Expr.of(expression)], times)

    return roots(values, segment.steps)

"""Events that were asked for: expressions that pass through zero."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from polhode.algebra import Expr
from polhode.simulate._event import Event
from polhode.simulate._segment import Segment
from polhode.simulate._trajectory import Trajectory
from polhode.simulate.integrate._crossing import roots
from polhode.simulate.integrate._stepping import Array


def with_events(trajectory: Trajectory, wanted: Mapping[str, Expr]) -> Trajectory:
    """The same motion with an event wherever one of some expressions passes through zero."""
    found = [
        Event(time, name, segment.mode, segment.mode, segment, segment)
        for name, expression in wanted.items()
        for segment in trajectory.segments
        for time in passages(segment, expression)
    ]
    first, *changes, last = trajectory.events
    between = sorted([*changes, *found], key=lambda event: event.time)
    return replace(trajectory, events=(first, *between, last))


def passages(segment: Segment, expression: Expr) -> list[float]:
    """When an expression passes through zero within a segment."""

    def values(times: Array) -> Array:
        return segment.values([Expr.of(expression)], times)

    return roots(values, segment.steps)

"""Integrates the equations of one contact mode, piece by piece, up to the end of the mode.

The loop is the same in all precisions, and whether contacts are kept as declared or may change:
only the `PieceIntegrator` differs.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Protocol

from polhode.algebra import Symbol
from polhode.derive import Guard
from polhode.simulate._absolute_values import (
    Instant,
    SideChange,
    SideChangeCount,
    Sides,
    name_of_change,
    sides_after,
)
from polhode.simulate._dynamics import Dynamics
from polhode.simulate._event import ModeSwitch
from polhode.simulate._segment import Segment, TrajectoryPiece

StateValues = Mapping[Symbol, Any]


@dataclass(frozen=True)
class PieceEnd:
    """A piece of a trajectory, and how it ends.

    Attributes:
        piece: up to its end.
        state: at its end, in the numbers from which the motion goes on, and in the independent
            speeds of the equations with which it does.
        time: of its end, s, in the same numbers.
        guard: the guard that ends the piece, if one does.
        is_last: whether the mode is left here although no guard has fallen: the run was
            interrupted, or a support jerks.
    """

    piece: TrajectoryPiece
    state: StateValues
    time: Any
    guard: Guard | None
    is_last: bool = False


class PieceIntegrator(Protocol):
    """Integrates the equations of one mode, in one type of numbers."""

    @property
    def name(self) -> str:
        """Name of the mode."""

    @property
    def whole(self) -> Dynamics:
        """The equations with absolute values in them."""

    @property
    def dynamics(self) -> Dynamics:
        """The same on the sides of all absolute values that the motion is on.

        They are other equations once the motion has gone over to other independent speeds.
        """

    def put_on(self, sides: Sides) -> None:
        """Go on with the equations on other sides."""

    def instant(self, state: StateValues, time: Any) -> Instant:
        """A state, with the constants that hold there."""

    def stored_time(self, time: Any) -> Any:
        """A time in the numbers in which trajectories keep it."""

    def next(
        self, state: StateValues, now: Any, end: Any, before: TrajectoryPiece | None
    ) -> PieceEnd:
        """The next piece: up to a guard, a change of the forcing, a pause for checks, or the end.

        It may also end where other speeds have to be independent. `dynamics` are then theirs.

        Args:
            before: the piece that it continues, if it does so on the same sides.
        """


@dataclass(frozen=True)
class ModeRun:
    """A motion within one mode.

    Attributes:
        segments: consecutive ones, each on one set of sides of absolute values.
        switches: the changes of sides between them.
        last: the end of the last piece.
    """

    segments: tuple[Segment, ...]
    switches: tuple[ModeSwitch, ...]
    last: PieceEnd


def integrate_mode(
    pieces: PieceIntegrator,
    state: StateValues,
    begin: Any,
    end: Any,
    side_changes: SideChangeCount,
) -> ModeRun:
    """Integrate up to the guard that ends a mode, at most to a time.

    Where an absolute value changes its side, or other speeds become independent, the mode goes on
    with other equations.

    Raises:
        NumericError: where the motion cannot be continued.
    """
    segments, switches = list[Segment](), list[ModeSwitch]()
    run, since, now = list[TrajectoryPiece](), begin, begin
    while True:
        dynamics = pieces.dynamics
        found = pieces.next(state, now, end, run[-1] if run else None)
        run.append(found.piece)
        state, now, guard = found.state, found.time, found.guard
        is_over = found.is_last or now >= end
        has_other_speeds = pieces.dynamics is not dynamics
        if is_over or guard is not None or has_other_speeds:
            ends = (pieces.stored_time(since), pieces.stored_time(now))
            segments.append(Segment(pieces.name, *ends, dynamics, tuple(run)))
        if has_other_speeds:
            run, since = [], now
        if isinstance(guard, SideChange):
            side_changes.count(now, guard)
            before = pieces.dynamics.sides
            after = sides_after(pieces.whole, pieces.instant(state, now), before, guard)
            # Sides may turn out the same: then the guard fell by rounding, and there is no event.
            if after != before:
                kind = name_of_change(guard, after)
                switches.append(ModeSwitch(pieces.stored_time(now), kind, pieces.name, pieces.name))
            pieces.put_on(after)
            run, since = [], now
            found = replace(found, guard=None)
        if is_over or found.guard is not None:
            return ModeRun(tuple(segments), tuple(switches), found)

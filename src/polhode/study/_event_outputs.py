"""Outputs that tell what happened: events, modes, fates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from polhode.simulate import Trajectory
from polhode.study._columns import Array
from polhode.study._counts import whole
from polhode.study._motions import Motions
from polhode.study._output import CodeTable, FromEnds, Plain, Single


@dataclass(frozen=True)
class Duration(FromEnds, Single):
    """How long the motion went on, s: shorter than asked for where it could not be continued."""

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its value."""
        return run.duration

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Its values, shape (motions,)."""
        return motions.end


@dataclass(frozen=True)
class EventTime(FromEnds, Single):
    """When something happened, s.

    Args:
        kind: of the event, such as "slips", "sticks", "goes flat".
        occurrence: 0 for the first time.
    """

    kind: str
    occurrence: int = 0

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its value."""
        times = [event.time for event in run.events if event.kind == self.kind]
        return times[self.occurrence] if self.occurrence < len(times) else np.nan

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Its values, shape (motions,)."""
        here = motions.event_codes((self.kind,)) == 0
        wanted = here & (np.cumsum(here, axis=1) == self.occurrence + 1)
        found = np.where(wanted, motions.events[0], -np.inf)
        return np.where(np.any(wanted, axis=1), np.max(found, axis=1, initial=-np.inf), np.nan)


@dataclass(frozen=True)
class EventCount(FromEnds, Single):
    """How often something happened.

    Args:
        kind: of the event.
    """

    kind: str

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its value."""
        return float(sum(event.kind == self.kind for event in run.events))

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Its values, shape (motions,)."""
        return np.asarray(np.sum(motions.event_codes((self.kind,)) == 0, axis=1), dtype=float)


@dataclass(frozen=True)
class EventTimes(FromEnds, Plain):
    """When anything happened, s, in order; without start and end.

    Args:
        most: how many events are kept.
    """

    most: int

    def __post_init__(self) -> None:
        whole(self.most, "events to be kept")

    @property
    def shape(self) -> tuple[int, ...]:
        return (self.most,)

    def of(self, run: Trajectory, legend: CodeTable) -> Array:
        """Their values, shape (most,)."""
        return _padded([event.time for event in run.events[1:-1]], self.most, np.nan)

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Their values, shape (motions, most)."""
        return _first(motions.events[0], self.most, np.nan)


@dataclass(frozen=True)
class EventKinds(FromEnds):
    """What happened, in order, as codes; without start and end.

    Args:
        most: how many events are kept.
    """

    most: int

    def __post_init__(self) -> None:
        whole(self.most, "events to be kept")

    @property
    def shape(self) -> tuple[int, ...]:
        return (self.most,)

    def labels(self, legend: CodeTable) -> tuple[str, ...]:
        """The kinds."""
        return legend.kinds

    def of(self, run: Trajectory, legend: CodeTable) -> Array:
        """Their codes, shape (most,)."""
        codes = [_code(event.kind, legend.kinds) for event in run.events[1:-1]]
        return _padded(codes, self.most, -1)

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Their codes, shape (motions, most)."""
        return _first(motions.event_codes(legend.kinds), self.most, -1.0)


@dataclass(frozen=True)
class EndMode(FromEnds):
    """The contact mode that the motion ends in, as a code."""

    @property
    def shape(self) -> tuple[int, ...]:
        return ()

    def labels(self, legend: CodeTable) -> tuple[str, ...]:
        """The modes."""
        return legend.modes

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its code."""
        return _code(run.mode, legend.modes)

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Its codes, shape (motions,)."""
        return motions.coded(motions.seen.last, legend.modes)


@dataclass(frozen=True)
class Fate(FromEnds):
    """What becomes of a motion, as a code: the first of some events that happens to it, or none.

    A start in which a contact slips already counts as slipping.

    Args:
        kinds: the events that decide; for a disk on the ground those that end its rolling.
        otherwise: what it is called where none of them happens within the time.
    """

    kinds: tuple[str, ...] = ("goes flat", "slips", "lifts off")
    otherwise: str = "stays up"

    @property
    def shape(self) -> tuple[int, ...]:
        return ()

    def labels(self, legend: CodeTable) -> tuple[str, ...]:
        """What may become of it."""
        return (self.otherwise, *self.kinds)

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its code."""
        if "slips" in self.kinds and "sliding" in str(run.segments[0].mode):
            return 1.0 + self.kinds.index("slips")
        decided = [event.kind for event in run.events if event.kind in self.kinds]
        return 1.0 + self.kinds.index(decided[0]) if decided else 0.0

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Its codes, shape (motions,)."""
        codes = np.hstack([motions.event_codes(self.kinds), np.full((len(motions.end), 1), -1.0)])
        found = 1.0 + np.take_along_axis(codes, np.argmax(codes >= 0, axis=1)[:, None], 1)[:, 0]
        if "slips" not in self.kinds:
            return found
        at_once = np.array(["sliding" in mode for mode in motions.seen.first])
        return np.where(at_once, 1.0 + self.kinds.index("slips"), found)


#: Outputs that tell of contacts that pull, which nobody looks for while many motions go on at once.
OF_EVENTS = (EventTime, EventCount, EventTimes, EventKinds)


def _padded(values: Sequence[float], size: int, filling: float) -> Array:
    kept = list(values[:size])
    return np.array(kept + [filling] * (size - len(kept)), dtype=float)


def _first(values: Array, size: int, filling: float) -> Array:
    """The first values of every motion, filled up; shape (motions, size)."""
    rest = np.full((len(values), size), filling)
    return np.hstack([values, rest])[:, :size]


def _code(name: str, names: tuple[str, ...]) -> float:
    return float(names.index(name)) if name in names else -1.0

"""Outputs that tell what happened: events, modes, fates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from polhode.simulate import Trajectory
from polhode.study._columns import Array
from polhode.study._motions import Motions
from polhode.study._output import FromEnds, Legend, Plain, Single


@dataclass(frozen=True)
class Duration(FromEnds, Single):
    """How long the motion went on, s: shorter than asked for where it could not be continued."""

    def of(self, run: Trajectory, legend: Legend) -> float:
        """Its value."""
        return run.duration

    def of_many(self, motions: Motions, legend: Legend) -> Array:
        """Its values, shape (motions,)."""
        return motions.flights.end


@dataclass(frozen=True)
class EventTime(FromEnds, Single):
    """When something happened, s.

    Args:
        kind: of the event, such as "slips", "sticks", "goes flat".
        occurrence: 0 for the first time.
    """

    kind: str
    occurrence: int = 0

    def of(self, run: Trajectory, legend: Legend) -> float:
        """Its value."""
        times = [event.time for event in run.events if event.kind == self.kind]
        return times[self.occurrence] if self.occurrence < len(times) else np.nan

    def of_many(self, motions: Motions, legend: Legend) -> Array:
        """Its values, shape (motions,)."""
        happened = motions.by_ending({self.kind: 1.0}, 0.0)
        return np.where((happened > 0) & (self.occurrence == 0), motions.flights.end, np.nan)


@dataclass(frozen=True)
class EventCount(FromEnds, Single):
    """How often something happened.

    Args:
        kind: of the event.
    """

    kind: str

    def of(self, run: Trajectory, legend: Legend) -> float:
        """Its value."""
        return float(sum(event.kind == self.kind for event in run.events))

    def of_many(self, motions: Motions, legend: Legend) -> Array:
        """Its values, shape (motions,)."""
        return motions.by_ending({self.kind: 1.0}, 0.0)


@dataclass(frozen=True)
class EventTimes(FromEnds, Plain):
    """When anything happened, s, in order; without start and end.

    Args:
        most: how many events are kept.
    """

    most: int

    @property
    def shape(self) -> tuple[int, ...]:
        return (self.most,)

    def of(self, run: Trajectory, legend: Legend) -> Array:
        """Their values, shape (most,)."""
        return _padded([event.time for event in run.events[1:-1]], self.most, np.nan)

    def of_many(self, motions: Motions, legend: Legend) -> Array:
        """Their values, shape (motions, most)."""
        ended = motions.flights.ending >= 0
        return _first(np.where(ended, motions.flights.end, np.nan), self.most, np.nan)


@dataclass(frozen=True)
class EventKinds(FromEnds):
    """What happened, in order, as codes; without start and end.

    Args:
        most: how many events are kept.
    """

    most: int

    @property
    def shape(self) -> tuple[int, ...]:
        return (self.most,)

    def labels(self, legend: Legend) -> tuple[str, ...]:
        """The kinds."""
        return legend.kinds

    def of(self, run: Trajectory, legend: Legend) -> Array:
        """Their codes, shape (most,)."""
        codes = [_code(event.kind, legend.kinds) for event in run.events[1:-1]]
        return _padded(codes, self.most, -1)

    def of_many(self, motions: Motions, legend: Legend) -> Array:
        """Their codes, shape (motions, most)."""
        codes = {kind: float(i) for i, kind in enumerate(legend.kinds)}
        return _first(motions.by_ending(codes, -1.0), self.most, -1.0)


@dataclass(frozen=True)
class EndMode(FromEnds):
    """The contact mode that the motion ends in, as a code."""

    @property
    def shape(self) -> tuple[int, ...]:
        return ()

    def labels(self, legend: Legend) -> tuple[str, ...]:
        """The modes."""
        return legend.modes

    def of(self, run: Trajectory, legend: Legend) -> float:
        """Its code."""
        return _code(run.mode, legend.modes)

    def of_many(self, motions: Motions, legend: Legend) -> Array:
        """Its codes, shape (motions,)."""
        return motions.by_mode({mode: float(i) for i, mode in enumerate(legend.modes)}, -1.0)


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

    def labels(self, legend: Legend) -> tuple[str, ...]:
        """What may become of it."""
        return (self.otherwise, *self.kinds)

    def of(self, run: Trajectory, legend: Legend) -> float:
        """Its code."""
        if "slips" in self.kinds and "sliding" in str(run.segments[0].mode):
            return 1.0 + self.kinds.index("slips")
        decided = [event.kind for event in run.events if event.kind in self.kinds]
        return 1.0 + self.kinds.index(decided[0]) if decided else 0.0

    def of_many(self, motions: Motions, legend: Legend) -> Array:
        """Its codes, shape (motions,)."""
        return motions.by_ending({kind: 1.0 + i for i, kind in enumerate(self.kinds)}, 0.0)


#: Outputs that tell of contacts that pull, which nobody looks for while many motions go on at once.
OF_EVENTS = (EventTime, EventCount, EventTimes, EventKinds)


def _padded(values: Sequence[float], size: int, filling: float) -> Array:
    kept = list(values[:size])
    return np.array(kept + [filling] * (size - len(kept)), dtype=float)


def _first(values: Array, size: int, filling: float) -> Array:
    """One value per motion, followed by nothing; shape (motions, size)."""
    rest = np.full((len(values), max(size - 1, 0)), filling)
    return np.hstack([values[:, None], rest])[:, :size]


def _code(name: str, names: tuple[str, ...]) -> float:
    return float(names.index(name)) if name in names else -1.0

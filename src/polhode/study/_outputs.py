"""The outputs that are kept of every motion of an ensemble.

Nothing else of a motion is kept, so memory grows with the outputs alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from polhode.algebra import Expr, Symbol, as_symbol
from polhode.base import DeclarationError, NumericError
from polhode.simulate import Trajectory
from polhode.study._columns import Array, whole
from polhode.study._output import (
    CodeTable,
    Motions,
    Output,
    Quantity,
    Single,
    largest,
)

# -- events, modes, fates --------------------------------------------------------------------------


@dataclass(frozen=True)
class Duration(Single):
    """Duration of the motion, s; less than requested where it could not be continued."""

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its value."""
        return run.duration

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Its values, shape (motions,)."""
        return motions.end


@dataclass(frozen=True)
class EventTime(Single):
    """Time of an event, s.

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
        is_kind = motions.event_codes((self.kind,)) == 0
        # The n-th event of this kind is the one at which their running count reaches n.
        is_sought = is_kind & (np.cumsum(is_kind, axis=1) == self.occurrence + 1)
        times = np.where(is_sought, motions.events[0], -np.inf)
        return np.where(np.any(is_sought, axis=1), np.max(times, axis=1, initial=-np.inf), np.nan)


@dataclass(frozen=True)
class EventCount(Single):
    """Number of events of a kind.

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
class _FirstEvents(Single):
    """Of the events between start and end, in order, the first few.

    Args:
        most: how many events are kept.
    """

    most: int

    def __post_init__(self) -> None:
        whole(self.most, "events to be kept")

    @property
    def shape(self) -> tuple[int, ...]:
        return (self.most,)


@dataclass(frozen=True)
class EventTimes(_FirstEvents):
    """Times of all events, s, in order, without start and end.

    Args:
        most: how many events are kept.
    """

    def of(self, run: Trajectory, legend: CodeTable) -> Array:
        """Their values, shape (most,)."""
        return _padded([event.time for event in run.events[1:-1]], self.most, np.nan)

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Their values, shape (motions, most)."""
        return _first(motions.events[0], self.most, np.nan)


@dataclass(frozen=True)
class EventKinds(_FirstEvents):
    """Kinds of all events as codes, in order, without start and end.

    Args:
        most: how many events are kept.
    """

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
class EndMode(Single):
    """The contact mode at the end of the motion, as a code."""

    def labels(self, legend: CodeTable) -> tuple[str, ...]:
        """The modes."""
        return legend.modes

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its code."""
        return _code(run.mode, legend.modes)

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Its codes, shape (motions,)."""
        return motions.coded(motions.results.last, legend.modes)


@dataclass(frozen=True)
class Fate(Single):
    """The outcome of a motion as a code: the first of some events, or none of them.

    Of a disk on the ground: it goes flat where the sine of its tilt comes down to `near_flat`,
    0.001 unless it is given; it slips where friction no longer holds it, and at a start in which
    it slides; it lifts off where the ground would have to pull. A motion without any of these may
    end anywhere: also at a tilt of one degree, or a moment before it slips.

    Args:
        kinds: the events that decide; for a disk on the ground those that end its rolling.
        otherwise: label of motions in which none of them happens.
    """

    kinds: tuple[str, ...] = ("goes flat", "slips", "lifts off")
    otherwise: str = "none of these"

    def labels(self, legend: CodeTable) -> tuple[str, ...]:
        """The possible outcomes."""
        return (self.otherwise, *self.kinds)

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its code."""
        if "slips" in self.kinds and "sliding" in str(run.segments[0].mode):
            return 1.0 + self.kinds.index("slips")
        decided = [event.kind for event in run.events if event.kind in self.kinds]
        return 1.0 + self.kinds.index(decided[0]) if decided else 0.0

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Its codes, shape (motions,)."""
        # The added column of -1 makes the outcome 0 where none of the events happens.
        codes = np.hstack([motions.event_codes(self.kinds), np.full((len(motions.end), 1), -1.0)])
        fates = 1.0 + np.take_along_axis(codes, np.argmax(codes >= 0, axis=1)[:, None], 1)[:, 0]
        if "slips" not in self.kinds:
            return fates
        slides_at_start = np.array(["sliding" in mode for mode in motions.results.first])
        return np.where(slides_at_start, 1.0 + self.kinds.index("slips"), fates)


#: Outputs of events, among them those of contacts that pull, which batches do not detect.
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


@dataclass(frozen=True)
class Final(Single):
    """A quantity at the end of the motion, SI.

    Args:
        quantity: a published name or an expression.
    """

    quantity: Quantity

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its value."""
        return float(run.evaluate(self.quantity, run.duration))

    @property
    def reads(self) -> tuple[Quantity, ...]:
        return (self.quantity,)

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Its values, shape (motions,)."""
        return motions.at_end(self.quantity)


@dataclass(frozen=True)
class Maximum(Single):
    """The largest value of a quantity along the motion, SI, found to rounding between steps."""

    quantity: Quantity

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its value."""
        return largest(run, self.quantity, 1.0)[0]


@dataclass(frozen=True)
class Minimum(Single):
    """The least value of a quantity along the motion, SI, found to rounding between steps."""

    quantity: Quantity

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its value."""
        return -largest(run, self.quantity, -1.0)[0]


@dataclass(frozen=True)
class TimeSeries(Single):
    """A quantity at some times, SI; not-a-number after the end of the motion.

    Args:
        quantity: a published name or an expression.
        times: s, increasing.
    """

    quantity: Quantity
    times: tuple[float, ...]

    def __post_init__(self) -> None:
        if not all(time >= 0 for time in self.times):
            raise NumericError(f"the times {self.times}", expected="times from 0 on, s")

    @property
    def shape(self) -> tuple[int, ...]:
        return (len(self.times),)

    def of(self, run: Trajectory, legend: CodeTable) -> Array:
        """Its values, shape (times,)."""
        times = np.array(self.times, dtype=float)
        inside = times <= run.duration
        values = np.full(len(times), np.nan)
        values[inside] = run.evaluate(self.quantity, times[inside])
        return values

    @property
    def reads(self) -> tuple[Quantity, ...]:
        return (self.quantity,)

    @property
    def sample_times(self) -> tuple[float, ...]:
        return self.times

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Its values, shape (motions, times)."""
        return np.stack([motions.at(self.quantity, time) for time in self.times], axis=1)


Outputs: TypeAlias = Mapping[str, Output]


def outputs_of(given: Mapping[str, Output | Quantity] | Sequence[Output | Quantity]) -> Outputs:
    """Outputs by name; a quantity alone stands for its value at the end, "mode" for the mode.

    Raises:
        DeclarationError: for none at all, or an output that needs a name.
    """
    several = (given,) if isinstance(given, str) else given
    named = several if isinstance(several, Mapping) else {_name(one): one for one in several}
    if not named:
        raise DeclarationError(
            "no outputs", expected="quantities to keep of every motion, such as ['theta', 'mode']"
        )
    return {name: _output(one) for name, one in named.items()}


def _name(given: Output | Quantity) -> str:
    if isinstance(given, str):
        return given
    if isinstance(given, Symbol):
        return given.published
    if isinstance(given, Expr):
        return as_symbol(given).published
    raise DeclarationError(
        f"{given} without a name",
        expected="a mapping from names to outputs",
        advice="write outputs={'a name': ...}",
    )


def _output(given: Output | Quantity) -> Output:
    if given == "mode":
        return EndMode()
    if isinstance(given, str | Symbol | Expr):
        return Final(given)
    if not isinstance(given, Output):
        raise DeclarationError(
            f"the output {given!r}", expected="a quantity, or an output such as Maximum('theta')"
        )
    return given

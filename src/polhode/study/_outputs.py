"""What is kept of every motion of an ensemble.

Whatever else a motion was is forgotten at once, so that memory grows with the outputs alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

import numpy as np

from polhode.algebra import Expr, Symbol, as_symbol
from polhode.base import DeclarationError
from polhode.derive import Automaton
from polhode.simulate import Trajectory
from polhode.study._columns import Array
from polhode.study._extremes import Quantity, largest

KINDS = (
    "slips",
    "sticks",
    "lifts off",
    "touches down",
    "bounces",
    "crosses the edge",
    "goes flat",
    "jerk",
)
AS_DECLARED, NEAR_FLAT = "as declared", "near-flat"


@dataclass(frozen=True)
class Legend:
    """What the codes in the results stand for: each is a place in one of these lists.

    Attributes:
        modes: contact modes.
        kinds: of events.
    """

    modes: tuple[str, ...]
    kinds: tuple[str, ...]


def legend_of(subject: Any, events: Sequence[str]) -> Legend:
    """The modes and events that motions of a system may show."""
    modes: list[str] = [AS_DECLARED]
    kinds: list[str] = [*KINDS]
    if isinstance(subject, Automaton):
        modes += subject.names
        kinds += [f"{contact.name} pulls" for contact in subject.contacts]
    return Legend((*dict.fromkeys(modes), NEAR_FLAT), (*dict.fromkeys([*kinds, *events]),))


class Output(Protocol):
    """Something that is kept of a motion: numbers, as many of every motion."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the numbers of one motion."""
        ...

    def labels(self, legend: Legend) -> tuple[str, ...]:
        """What the numbers stand for where they are codes: places in this list."""
        ...

    def of(self, run: Trajectory, legend: Legend) -> Array | float:
        """The numbers of one motion; not-a-number, or -1 for codes, for what did not happen."""
        ...


@dataclass(frozen=True)
class _Plain:
    """Numbers that are no codes."""

    def labels(self, legend: Legend) -> tuple[str, ...]:
        return ()


@dataclass(frozen=True)
class _Single(_Plain):
    """One number."""

    @property
    def shape(self) -> tuple[int, ...]:
        return ()


@dataclass(frozen=True)
class Final(_Single):
    """A quantity at the end of the motion, SI.

    Args:
        quantity: a published name or an expression.
    """

    quantity: Quantity

    def of(self, run: Trajectory, legend: Legend) -> float:
        """Its value."""
        return float(run.evaluate(self.quantity, run.duration))


@dataclass(frozen=True)
class Largest(_Single):
    """The largest value of a quantity along the motion, SI, found to rounding between steps."""

    quantity: Quantity

    def of(self, run: Trajectory, legend: Legend) -> float:
        """Its value."""
        return largest(run, self.quantity, 1.0)


@dataclass(frozen=True)
class Least(_Single):
    """The least value of a quantity along the motion, SI, found to rounding between steps."""

    quantity: Quantity

    def of(self, run: Trajectory, legend: Legend) -> float:
        """Its value."""
        return -largest(run, self.quantity, -1.0)


@dataclass(frozen=True)
class Series(_Plain):
    """A quantity at some times, SI; not-a-number after the end of the motion.

    Args:
        quantity: a published name or an expression.
        times: s, increasing.
    """

    quantity: Quantity
    times: tuple[float, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        return (len(self.times),)

    def of(self, run: Trajectory, legend: Legend) -> Array:
        """Its values, shape (times,)."""
        times = np.array(self.times, dtype=float)
        inside = times <= run.duration
        values = np.full(len(times), np.nan)
        values[inside] = run.evaluate(self.quantity, times[inside])
        return values


@dataclass(frozen=True)
class Duration(_Single):
    """How long the motion went on, s: shorter than asked for where it could not be continued."""

    def of(self, run: Trajectory, legend: Legend) -> float:
        """Its value."""
        return run.duration


@dataclass(frozen=True)
class EventTime(_Single):
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


@dataclass(frozen=True)
class EventCount(_Single):
    """How often something happened.

    Args:
        kind: of the event.
    """

    kind: str

    def of(self, run: Trajectory, legend: Legend) -> float:
        """Its value."""
        return float(sum(event.kind == self.kind for event in run.events))


@dataclass(frozen=True)
class EventTimes(_Plain):
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


@dataclass(frozen=True)
class EventKinds:
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


@dataclass(frozen=True)
class EndMode:
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


@dataclass(frozen=True)
class Fate:
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


Outputs: TypeAlias = Mapping[str, Output]


def outputs_of(asked: Mapping[str, Output | Quantity] | Sequence[Output | Quantity]) -> Outputs:
    """Outputs by name; a quantity alone stands for its value at the end, "mode" for the mode.

    Raises:
        DeclarationError: for none at all, or an output that needs a name.
    """
    given = asked if isinstance(asked, Mapping) else {_name(one): one for one in asked}
    if not given:
        raise DeclarationError(
            "no outputs", expected="what to keep of every motion, such as ['theta', 'mode']"
        )
    return {name: _output(one) for name, one in given.items()}


def _name(asked: Output | Quantity) -> str:
    if isinstance(asked, str):
        return asked
    if isinstance(asked, Symbol):
        return asked.published
    if isinstance(asked, Expr):
        return as_symbol(asked).published
    raise DeclarationError(
        f"{asked} without a name", expected="outputs={'a name': ...}", advice="give it a name"
    )


def _output(asked: Output | Quantity) -> Output:
    if asked == "mode":
        return EndMode()
    return Final(asked) if isinstance(asked, str | Symbol | Expr) else asked


def _padded(values: Sequence[float], size: int, filling: float) -> Array:
    kept = list(values[:size])
    return np.array(kept + [filling] * (size - len(kept)), dtype=float)


def _code(name: str, names: tuple[str, ...]) -> float:
    return float(names.index(name)) if name in names else -1.0

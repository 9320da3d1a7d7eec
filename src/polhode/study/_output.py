"""What an output of an ensemble is, and what the codes among outputs stand for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from polhode.derive import Automaton
from polhode.simulate import Trajectory
from polhode.study._columns import Array
from polhode.study._extremes import Quantity
from polhode.study._motions import Motions

KINDS = (
    "slips",
    "sticks",
    "lifts off",
    "touches down",
    "bounces",
    "crosses the edge",
    "goes flat",
    "jerk",
    "turns round",
)
SIGNS = ("changes sign", "stays zero", "leaves zero")
"""What happens to arguments of absolute values."""
AS_DECLARED, NEAR_FLAT = "as declared", "near-flat"


@dataclass(frozen=True)
class CodeTable:
    """What the codes in the results stand for: each is a place in one of these lists.

    Attributes:
        modes: contact modes.
        kinds: of events.
    """

    modes: tuple[str, ...]
    kinds: tuple[str, ...]


def legend_of(subject: Any, events: Sequence[str]) -> CodeTable:
    """The modes and events that motions of a system may show."""
    modes: list[str] = [AS_DECLARED]
    kinds: list[str] = [*KINDS]
    if isinstance(subject, Automaton):
        modes += subject.names
        kinds += [f"{contact.name} pulls" for contact in subject.contacts]
    return CodeTable(
        (*dict.fromkeys(modes), NEAR_FLAT), (*dict.fromkeys([*kinds, *events, *SIGNS]),)
    )


@runtime_checkable
class Output(Protocol):
    """Something that is kept of a motion: numbers, as many of every motion."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the numbers of one motion."""
        ...

    def labels(self, legend: CodeTable) -> tuple[str, ...]:
        """What the numbers stand for where they are codes: places in this list."""
        ...

    def of(self, run: Trajectory, legend: CodeTable) -> Array | float:
        """The numbers of one motion; not-a-number, or -1 for codes, for what did not happen."""
        ...


@runtime_checkable
class Quick(Output, Protocol):
    """An output that can be read from many motions at once.

    Attributes:
        reads: the quantities it is made of.
        looks: times at which it reads them, s, besides the end.
    """

    @property
    def reads(self) -> tuple[Quantity, ...]: ...
    @property
    def looks(self) -> tuple[float, ...]: ...

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """The numbers of all motions, shape (motions, *shape)."""
        ...


class FromEnds:
    """Reads nothing but how motions end."""

    @property
    def reads(self) -> tuple[Quantity, ...]:
        return ()

    @property
    def looks(self) -> tuple[float, ...]:
        return ()


@dataclass(frozen=True)
class Plain:
    """Numbers that are no codes."""

    def labels(self, legend: CodeTable) -> tuple[str, ...]:
        return ()


@dataclass(frozen=True)
class Single(Plain):
    """One number."""

    @property
    def shape(self) -> tuple[int, ...]:
        return ()

"""What an output of an ensemble is, and what the codes among outputs stand for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, Symbol
from polhode.derive import Automaton
from polhode.simulate import Trajectory
from polhode.simulate.batch import LAST, BatchResults
from polhode.study._columns import Array

Quantity: TypeAlias = str | Symbol | Expr

_PER_STEP = 4  # values per step of the integrator among which a maximum is looked for
_NARROWED = 40  # times that the interval around it is narrowed, by about 3 each


def largest(run: Trajectory, quantity: Quantity, sign: float) -> float:
    """The largest value of sign · quantity, which is smooth within a step of the integrator."""

    def values(times: Array) -> Array:
        return sign * run.evaluate(quantity, times)

    ends = np.unique(np.concatenate([segment.steps for segment in run.segments]))
    ends = ends[ends <= run.duration]
    inside = np.linspace(0.0, 1.0, _PER_STEP, endpoint=False)
    grid = np.append((ends[:-1, None] + np.diff(ends)[:, None] * inside).ravel(), run.duration)
    found = values(grid)
    best = int(np.argmax(found))
    left, right = grid[max(best - 1, 0)], grid[min(best + 1, len(grid) - 1)]
    return max(float(found[best]), _narrowed(values, left, right))


def _narrowed(values: Callable[[Array], Array], left: float, right: float) -> float:
    """The largest value between two times, on ever finer grids around the best so far."""
    best = -np.inf
    for _ in range(_NARROWED):
        times = np.linspace(left, right, 7)
        found = values(times)
        k = int(np.argmax(found))
        best = max(best, float(found[k]))
        left, right = times[max(k - 1, 0)], times[min(k + 1, 6)]
        if right - left <= 1e-9 * max(abs(right), 1e-300):
            break
    return best


@dataclass(frozen=True)
class Motions:
    """Motions that were simulated as a batch, as outputs read them.

    Attributes:
        results: their states at the sample times, and their events.
    """

    results: BatchResults

    @property
    def end(self) -> Array:
        """Time at which each ended, s."""
        return self.results.end

    def at_end(self, quantity: Quantity) -> Array:
        """A quantity at the end of every motion, shape (motions,)."""
        return self.results.values(quantity, LAST)

    def at(self, quantity: Quantity, time: float) -> Array:
        """A quantity at a sample time; not-a-number where the motion has ended before."""
        sample = int(np.searchsorted(self.results.times, time))
        if sample < len(self.results.times) - 1:
            return self.results.values(quantity, sample)
        return np.where(time <= self.end, self.at_end(quantity), np.nan)

    def coded(self, names: list[str], known: tuple[str, ...]) -> Array:
        """The index of each name among those that are known, or -1."""
        places = {name: float(i) for i, name in enumerate(known)}
        return np.array([places.get(name, -1.0) for name in names])

    @cached_property
    def events(self) -> tuple[Array, NDArray[np.intp], tuple[str, ...]]:
        """Times and codes of events, each of shape (motions, most), and the kinds by code."""
        found = self.results.events()
        return found.times, found.codes, found.kinds

    def event_codes(self, known: tuple[str, ...]) -> Array:
        """Kinds of the events, as indices among those that are known, or -1."""
        _, codes, kinds = self.events
        return self.coded([*kinds, ""], known)[codes]


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
"""Events of the arguments of absolute values."""
AS_DECLARED, NEAR_FLAT = "as declared", "near-flat"


@dataclass(frozen=True)
class CodeTable:
    """What the codes in the results stand for: each is an index in one of these lists.

    Attributes:
        modes: contact modes.
        kinds: of events.
    """

    modes: tuple[str, ...]
    kinds: tuple[str, ...]


def legend_of(subject: Any, events: Sequence[str]) -> CodeTable:
    """The modes and events that motions of a system may have."""
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
    """Numbers that are kept of a motion, equally many of every motion."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the numbers of one motion."""
        ...

    def labels(self, legend: CodeTable) -> tuple[str, ...]:
        """If the numbers are codes, indices in this list; empty if they are not."""
        ...

    def of(self, run: Trajectory, legend: CodeTable) -> Array | float:
        """The numbers of one motion; not-a-number, or -1 for codes, if something did not happen."""
        ...


@runtime_checkable
class Quick(Output, Protocol):
    """An output that can be read from a batch of motions.

    Attributes:
        reads: the quantities it is made of.
        sample_times: times at which it reads them, s, besides the end.
    """

    @property
    def reads(self) -> tuple[Quantity, ...]: ...
    @property
    def sample_times(self) -> tuple[float, ...]: ...

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """The numbers of all motions, shape (motions, *shape)."""
        ...


class FromEnds:
    """An output that samples no quantity along the motion."""

    @property
    def reads(self) -> tuple[Quantity, ...]:
        return ()

    @property
    def sample_times(self) -> tuple[float, ...]:
        return ()


@dataclass(frozen=True)
class Plain:
    """An output of numbers that are not codes."""

    def labels(self, legend: CodeTable) -> tuple[str, ...]:
        return ()


@dataclass(frozen=True)
class Single(Plain):
    """An output of one number."""

    @property
    def shape(self) -> tuple[int, ...]:
        return ()

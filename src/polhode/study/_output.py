"""The protocol of an ensemble's outputs, and the meanings of their codes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, Symbol
from polhode.derive import Automaton
from polhode.model import AT_APEX, AT_POLE, MISFIT, NO_FOOT, STEEP
from polhode.simulate import Trajectory
from polhode.simulate.batch import LAST, BatchResults
from polhode.study._columns import Array

Quantity: TypeAlias = str | Symbol | Expr

_PER_STEP = 4  # values per step of the integrator among which the largest is sought
_NARROWED = 40  # times at most that the interval around it is narrowed, by a factor of 3 each


def largest(run: Trajectory, quantity: Quantity, sign: float) -> tuple[float, float]:
    """The largest value of sign · quantity, SI, and its time, s.

    The quantity is smooth within a step of the integrator.
    """

    def values(times: Array) -> Array:
        return sign * run.evaluate(quantity, times)

    ends = np.unique(np.concatenate([segment.steps for segment in run.segments]))
    ends = ends[ends <= run.duration]
    inside = np.linspace(0.0, 1.0, _PER_STEP, endpoint=False)
    grid = np.append((ends[:-1, None] + np.diff(ends)[:, None] * inside).ravel(), run.duration)
    sampled = values(grid)
    k = int(np.argmax(sampled))
    best, at = float(sampled[k]), float(grid[k])
    left, right = grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)]
    # Ever finer grids around the best sample. Near a smooth maximum the value is flat: a time good
    # to 1e-9 gives it to rounding, and anything finer would only compare noise.
    for _ in range(_NARROWED):
        times = np.linspace(left, right, 7)
        sampled = values(times)
        k = int(np.argmax(sampled))
        best, at = max((best, at), (float(sampled[k]), float(times[k])))
        left, right = times[max(k - 1, 0)], times[min(k + 1, 6)]
        if right - left <= 1e-9 * max(abs(right), 1e-300):
            break
    return best, at


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
        """A quantity at a sample time; not-a-number where the motion ends earlier."""
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
    MISFIT,
    NO_FOOT,
    AT_POLE,
    AT_APEX,
    STEEP,
)
SIGNS = ("changes sign", "stays zero", "leaves zero")
"""Events of the arguments of absolute values."""
AS_DECLARED, NEAR_FLAT = "as declared", "near-flat"


@dataclass(frozen=True)
class CodeTable:
    """Meanings of the codes in the results: each is an index in one of these lists.

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
    """Numbers kept of a motion, the same count for every motion."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the numbers of one motion."""

    def labels(self, legend: CodeTable) -> tuple[str, ...]:
        """The list in which the numbers are indices if they are codes; empty if they are not."""

    def of(self, run: Trajectory, legend: CodeTable) -> Array | float:
        """The numbers of one motion; not-a-number, or -1 for codes, for events that are absent."""


@runtime_checkable
class Quick(Output, Protocol):
    """An output that can be read from a batch of motions.

    Attributes:
        reads: the quantities it needs.
        sample_times: times at which it reads them, s, besides the end.
    """

    @property
    def reads(self) -> tuple[Quantity, ...]: ...
    @property
    def sample_times(self) -> tuple[float, ...]: ...

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """The numbers of all motions, shape (motions, *shape)."""


@dataclass(frozen=True)
class Single:
    """An output of one number that is no code and samples no quantity, unless it says otherwise."""

    @property
    def shape(self) -> tuple[int, ...]:
        return ()

    def labels(self, legend: CodeTable) -> tuple[str, ...]:
        return ()

    @property
    def reads(self) -> tuple[Quantity, ...]:
        return ()

    @property
    def sample_times(self) -> tuple[float, ...]:
        return ()

"""Pieces of a trajectory, and the segments that they make up: one for every contact mode."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.base import NumericError
from polhode.simulate._dynamics import CLOCK, Dynamics, moving
from polhode.simulate.integrate._arrays import Array, ascending, occurring, rows
from polhode.simulate.integrate._driver import SegmentSolution
from polhode.simulate.integrate._number_types import DOUBLES, NumberType

# States at the last few sets of times are kept, since quantities are read one after the other at
# the same times. Larger sets are not: they would take much memory, and are rarely read twice.
_RECENT = 4
_FEW = 10_000


@dataclass(frozen=True)
class TrajectoryPiece:
    """A piece of a trajectory from one integration, with the constants that hold on it.

    It ends before its solution does if an event was found on it.
    """

    begin: float
    end: float
    solution: SegmentSolution = field(repr=False)
    constants: Array = field(repr=False)

    def states(self, times: Array) -> Array:
        """States, shape (states, times); the last few sets of them are kept."""
        if len(times) > _FEW:
            return self.solution.at(times)
        key = tuple(times.tolist()) if times.dtype == object else times.tobytes()
        if key not in self._recent:
            if len(self._recent) >= _RECENT:
                self._recent.pop(next(iter(self._recent)))
            self._recent[key] = self.solution.at(times)
        return self._recent[key]

    @property
    def angles_replaced(self) -> frozenset[Symbol]:
        """The declared angles in place of which others were integrated, near gimbal lock."""
        return frozenset()

    @property
    def replaced_at_start(self) -> Mapping[Symbol, float]:
        """These angles where it begins, followed over turns, and their rates if they matter."""
        return {}

    def as_integrated(self, dynamics: Dynamics) -> tuple[Dynamics, TrajectoryPiece]:
        """The equations that were integrated, and this piece in their states."""
        return dynamics, self

    def values(self, dynamics: Dynamics, expressions: Sequence[Expr], times: Array) -> Array:
        """Values of expressions in symbols of the equations, shape (expressions, times)."""
        return values_of(dynamics, self, expressions, times)

    def rounded(self) -> TrajectoryPiece:
        """The same in doubles."""
        constants = DOUBLES.array(self.constants)
        return TrajectoryPiece(
            float(self.begin), float(self.end), self.solution.rounded(), constants
        )

    @cached_property
    def _recent(self) -> dict[Hashable, Array]:
        return {}


@dataclass(frozen=True)
class Segment:
    """A part of a trajectory within one contact mode.

    Attributes:
        mode: its name.
        begin: s.
        end: s.
        dynamics: the equations that hold.
        parts: its pieces, in order.
    """

    mode: str
    begin: float
    end: float
    dynamics: Dynamics
    parts: tuple[TrajectoryPiece, ...] = field(repr=False)

    @property
    def steps(self) -> Array:
        """Where the steps of the integrator begin and end, s."""
        inside = [p.solution.steps[p.solution.steps < p.end] for p in self.parts]
        return ascending([*inside, np.array([self.begin, self.end])])

    @property
    def numbers(self) -> NumberType:
        """The type of its numbers."""
        return self.parts[0].solution.numbers

    def rounded(self) -> Segment:
        """The same in doubles."""
        parts = tuple(part.rounded() for part in self.parts)
        return replace(self, begin=parts[0].begin, end=parts[-1].end, parts=parts)

    @property
    def as_integrated(self) -> Segment:
        """The same in the angles in which all of it was integrated, if it was in one choice."""
        described = [part.as_integrated(self.dynamics) for part in self.parts]
        dynamics = described[0][0]
        if any(own is not dynamics for own, _ in described):
            return self
        return replace(self, dynamics=dynamics, parts=tuple(part for _, part in described))

    def state(self, time: float) -> dict[str, float]:
        """Coordinates, speeds and rates at an instant within it, ends included, by name."""
        named = moving(self.dynamics)
        values = self.values(named.values(), self.numbers.array([time]))[:, 0]
        return dict(zip(named, map(self.numbers.scalar, values), strict=True))

    def values(self, expressions: Iterable[Expr], times: Array) -> Array:
        """Values of expressions in any symbol of the mode, shape (expressions, times)."""
        wanted = list(expressions)
        begins = np.array([part.begin for part in self.parts])
        which = np.clip(np.searchsorted(begins, times, "right") - 1, 0, None)
        found = np.empty((len(wanted), len(times)), dtype=self.numbers.dtype)
        for i in occurring(which):
            here = which == i
            found[:, here] = self.parts[i].values(self.dynamics, wanted, times[here])
        return found


def cut(segments: Sequence[Segment], end: float) -> tuple[Segment, ...]:
    """The segments of a motion up to an instant, which is after its start."""
    found = []
    for segment in segments:
        if segment.begin < end:
            last = min(segment.end, end)
            parts = (p for p in segment.parts if p.begin < last)
            ended = tuple(replace(p, end=min(p.end, last)) for p in parts)
            found.append(replace(segment, end=last, parts=ended))
    return tuple(found)


def values_of(
    dynamics: Dynamics, part: TrajectoryPiece, expressions: Sequence[Expr], times: Array
) -> Array:
    """Values of expressions within a piece, shape (expressions, times)."""
    solution = part.solution
    arguments = (*solution.symbols, *dynamics.parameters, CLOCK)
    numbers = solution.numbers
    function = dynamics.function(expressions, arguments, solution.turned, numbers)
    try:
        with np.errstate(all="ignore"):
            values = function(*part.states(times), *part.constants, times)
    except ArithmeticError as error:
        raise NumericError(
            f"a quantity without a finite value between {float(times[0]):g} s and "
            f"{float(times[-1]):g} s",
            expected="one that is defined at every requested time",
            advice="request it at other times",
        ) from error
    found: Array = rows(values, len(times), numbers.dtype)
    return found


def state_at(part: TrajectoryPiece, time: float) -> dict[Symbol, float]:
    """All states at an instant, by symbol."""
    values = part.solution.at(np.array([time]))[:, 0]
    return dict(zip(part.solution.symbols, (float(v) for v in values), strict=True))

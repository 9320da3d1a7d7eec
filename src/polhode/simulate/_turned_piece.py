"""Pieces of a trajectory that are integrated in turned angles and read in the declared ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.simulate._dynamics import WORK, Dynamics
from polhode.simulate._other_angles import OtherAngles, States
from polhode.simulate._segment import TrajectoryPiece, values_of
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._driver import SegmentSolution

_FINE = 0.5  # rad: angles that change less from one instant to the next are followed over turns
_INSTANT = 4  # units in the last place of the time: nothing is resolved within


@dataclass(frozen=True)
class TurnedPiece(TrajectoryPiece):
    """A piece that was integrated in turned angles; its solution gives the declared states.

    Attributes:
        angles: the declared ones and the turned ones.
        turned: the same piece in the latter.
        before: the declared angles where it begins, and their rates where these are known.
    """

    angles: OtherAngles = field(repr=False)
    turned: TrajectoryPiece = field(repr=False)
    before: States = field(repr=False)

    @property
    def angles_replaced(self) -> frozenset[Symbol]:
        return frozenset(q for attitude in self.angles.chosen for q in attitude.angles)

    @property
    def replaced_at_start(self) -> States:
        return self.before

    def as_integrated(self, dynamics: Dynamics) -> tuple[Dynamics, TrajectoryPiece]:
        return self.angles.turned, replace(self.turned, end=self.end)

    def values(self, dynamics: Dynamics, expressions: Sequence[Expr], times: Array) -> Array:
        known = self.angles.counterparts
        found = np.empty((len(expressions), len(times)))
        groups: list[tuple[list[int], Dynamics, TrajectoryPiece]] = [
            ([i for i, e in enumerate(expressions) if e not in known], dynamics, self),
            (
                [i for i, e in enumerate(expressions) if e in known],
                self.angles.turned,
                self.turned,
            ),
        ]
        for places, own, piece in groups:
            wanted = [known.get(expressions[i], expressions[i]) for i in places]
            if places:
                found[places] = values_of(own, piece, wanted, times)
        return found


def turned_piece(
    angles: OtherAngles, turned: TrajectoryPiece, before: States, constants: Array
) -> TurnedPiece:
    """A piece in declared states.

    Args:
        angles: the declared ones and the turned ones.
        turned: the piece in these.
        before: the declared state where it begins, or the angles of it that are replaced.
        constants: of the declared equations.
    """
    own = {q for attitude in angles.chosen for q in attitude.angles}
    states = _DeclaredStates(angles, turned, before)
    kept = {s: float(before[s]) for s in before if s.base() in own}
    solution = SegmentSolution(states.symbols, {}, states.steps, turned.solution.stop, None, states)
    return TurnedPiece(turned.begin, turned.end, solution, constants, angles, turned, kept)


_SAMPLES = 5  # times within a step at which the rates of its angles are read


class _DeclaredStates:
    """The declared states at any times of a piece, with angles that are followed over turns."""

    def __init__(self, angles: OtherAngles, turned: TrajectoryPiece, before: States) -> None:
        self._angles = angles
        self._turned = turned
        self._choices = angles.choices(before, turned.begin)
        declared = angles.declared.states
        self._places = [declared.index(q) for a in angles.chosen for q in a.angles]
        steps = turned.solution.steps
        steps = np.append(steps[steps < turned.end], turned.end)
        times, self.steps = self._resolved(steps)
        raw = self._followed_angles(times)
        first = np.array([before[declared[i]] for i in self._places])
        changes = _within_half_a_turn(np.diff(raw, axis=1))
        self._times = times
        self._followed = first[:, None] + np.cumsum(
            np.concatenate([_within_half_a_turn(raw[:, :1] - first[:, None]), changes], axis=1),
            axis=1,
        )

    @property
    def symbols(self) -> tuple[Symbol, ...]:
        """Of the declared states, of all velocities, and of the work where it is beside these."""
        known = (*self._angles.declared.states, *self._angles.velocities)
        return (*known, WORK) if self._work_is_beside else known

    @property
    def _work_is_beside(self) -> bool:
        return WORK in self._turned.solution.symbols and WORK not in self._angles.declared.states

    def __call__(self, times: Array) -> Array:
        own, constants = self._own(times), self._turned.constants
        states = self._angles.declared_motion(own, constants, times, self._choices)
        for i, followed in zip(self._places, self._followed, strict=True):
            near = np.interp(times, self._times, followed)
            states[i] += 2 * np.pi * np.round((near - states[i]) / (2 * np.pi))
        if self._work_is_beside:
            solution = self._turned.solution
            work = solution.at(times)[solution.symbols.index(WORK)]
            states = np.vstack([states, work])
        return states

    def _followed_angles(self, times: Array) -> Array:
        """The declared angles, within one turn."""
        own, constants = self._own(times), self._turned.constants
        found: Array = self._angles.declared_states(own, constants, times, self._choices)
        return found[self._places]

    def _own(self, times: Array) -> Array:
        """The states in the turned angles."""
        solution = self._turned.solution
        places = [solution.symbols.index(s) for s in self._angles.turned.states]
        found: Array = solution.at(times)[places]
        return found

    def _resolved(self, steps: Array) -> tuple[Array, Array]:
        """Times between which angles change little, and steps between which they are smooth."""
        pieces = [
            np.linspace(begin, end, count, endpoint=False)
            for (begin, end), count in zip(pairwise(steps), self._parts(steps), strict=True)
        ]
        times = np.append(np.concatenate(pieces), steps[-1:])
        fine = list[Array]()
        while True:
            changes = _within_half_a_turn(np.diff(self._followed_angles(times), axis=1))
            large = np.max(np.abs(changes), axis=0) > _FINE
            large &= np.diff(times) > _INSTANT * np.spacing(times[1:])
            middles = (times[:-1] + times[1:])[large] / 2
            if not len(middles):
                break
            fine.append(middles)
            times = np.sort(np.concatenate([times, middles]))
        return times, np.sort(np.concatenate([steps, *fine]))

    def _parts(self, steps: Array) -> list[int]:
        """Into how many parts each step is divided so that no angle turns far, poles left aside."""
        angles = self._angles
        wanted = [Expr.generator(q.derivative()) for a in angles.chosen for q in a.turned]
        times = np.linspace(steps[:-1], steps[1:], _SAMPLES)  # shape (samples, steps)
        rates = values_of(angles.turned, self._turned, wanted, times.T.ravel())
        by_step = np.abs(rates).reshape(len(wanted), -1, _SAMPLES)
        fastest = np.max(by_step, axis=(0, 2)) * 2
        return [1 + int(turned) for turned in fastest * np.diff(steps) / _FINE]


def _within_half_a_turn(angles: Array) -> Array:
    found: Array = angles - 2 * np.pi * np.round(angles / (2 * np.pi))
    return found

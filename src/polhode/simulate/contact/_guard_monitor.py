"""Detects the end of a contact mode: lift-off, landing, slip that begins or ends, an edge.

A mode lasts while the expressions of its guards stay positive (`derive` writes them): the normal
force, for lift-off; friction in reserve below μ_s N, for slip; the height of an open contact, for
landing. `GuardMonitor.first_fall` finds the first to fall through zero on a piece of the motion.
The end of a slip is detected during integration (`StopCriteria`); `sticking_guard` is its guard.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from polhode.algebra import Symbol
from polhode.base import NumericError
from polhode.derive import Guard
from polhode.simulate._absolute_values import first_end_of_side
from polhode.simulate._dynamics import CLOCK
from polhode.simulate._gimbal_lock import broken_at
from polhode.simulate._independent_speeds import SpeedDependence
from polhode.simulate._segment import TrajectoryPiece
from polhode.simulate.contact._contact_kinematics import NO_NORMAL_SPEED, ContactKinematics, LiftOff
from polhode.simulate.contact._hybrid_system import CompiledMode, HybridSystem
from polhode.simulate.contact._mode_expressions import vanishing_expression
from polhode.simulate.contact._mode_state import ModeState, beyond, directions_of
from polhode.simulate.contact._select_mode import painleve
from polhode.simulate.contact._transition import index_of
from polhode.simulate.integrate._arrays import Array, probed, rows
from polhode.simulate.integrate._crossing import first_fall
from polhode.simulate.integrate._stop_criteria import Stop

# An integrator stops a little before the determinant of the mass matrix, which sliding friction
# enters, reaches zero: below this share of its largest value on the piece, sliding jams there.
_JAMMED = 1e-6
# Within this many units in the last place of the time after a contact opens, its height over the
# time that has passed is rounding over rounding: the initial speed is used instead.
_INSTANT = 8


class DenseOutput(Protocol):
    """The states along a piece in double precision, as functions of a place.

    Places increase with time: they are times in double precision, and count the Taylor steps in
    higher precision, where times of events may be too close together to differ as doubles.
    """

    @property
    def symbols(self) -> tuple[Symbol, ...]:
        """The states."""

    @property
    def turned(self) -> Mapping[Symbol, Symbol]:
        """For large angles, the symbol of the angle less whole turns."""

    @property
    def constants(self) -> Array:
        """Values of the parameters."""

    @property
    def knots(self) -> Array:
        """The places between which everything is smooth."""

    def at(self, places: Array) -> Array:
        """States, shape (states, places)."""

    def times(self, places: Array) -> Array:
        """Times of some places, s."""

    def passed(self, places: Array) -> Array:
        """Time since the mode was entered, s; zero where heights are still only rounding."""


@dataclass(frozen=True)
class _DoubleOutput:
    """A piece in double precision, whose places are times; its mode was entered at `begin`, s."""

    piece: TrajectoryPiece
    begin: float

    @property
    def symbols(self) -> tuple[Symbol, ...]:
        return self.piece.solution.symbols

    @property
    def turned(self) -> Mapping[Symbol, Symbol]:
        return self.piece.solution.turned

    @property
    def constants(self) -> Array:
        return self.piece.constants

    @property
    def knots(self) -> Array:
        return self.piece.solution.steps

    def at(self, places: Array) -> Array:
        return self.piece.solution.at(places)

    def times(self, places: Array) -> Array:
        return places

    def passed(self, places: Array) -> Array:
        passed = places - self.begin
        return np.where(passed <= _INSTANT * np.spacing(self.begin), 0.0, passed)


#: Guards at some places, of the states there or of others.
_GuardValues = Callable[..., Array]


def _time(output: DenseOutput, place: float) -> float:
    return float(output.times(np.array([place]))[0])


@dataclass(frozen=True)
class GuardMonitor:
    """Finds where the guards of a mode fall along a piece of the motion.

    Attributes:
        hybrid: the modes.
        near_flat: value at which an expression that must stay positive counts as zero.
        mode: the one that the motion is in.
        entry: where it was entered.
    """

    hybrid: HybridSystem
    near_flat: float
    mode: CompiledMode
    entry: ModeState

    @cached_property
    def points(self) -> list[ContactKinematics]:
        """The contacts where the mode is entered."""
        return self.hybrid.touching.at(self.entry.shared, beyond(self.entry.phases))

    def cut(self, piece: TrajectoryPiece) -> tuple[TrajectoryPiece, Guard | None]:
        """A piece up to the first guard that falls, and that guard."""
        output = _DoubleOutput(piece, self.entry.shared.time)
        fall = self.first_fall(output)
        if fall is not None:
            return replace(piece, end=fall[0]), fall[1]
        if piece.solution.stop is Stop.STUCK:
            raise self.broken(output)
        return piece, self.sticking_guard(piece.solution.vanished)

    def first_fall(self, output: DenseOutput) -> tuple[float, Guard] | None:
        """The place at which the first guard falls, and that guard.

        Raises:
            NumericError: where sliding jams before.
        """
        fall, failure = self._first_fall(output), self._first_failure(output)
        if fall is None or failure is None:
            return fall or failure
        return min(fall, failure, key=lambda found: found[0])

    def _first_failure(self, output: DenseOutput) -> tuple[float, Guard] | None:
        """Where contacts whose forces are open no longer hold."""
        forces = self.mode.open_forces
        if forces is None or not self._are_decided:
            return None
        arguments = (*output.symbols, *self.mode.dynamics.parameters, CLOCK)
        wanted = forces.table.expressions
        function = self.mode.dynamics.function(wanted, arguments, output.turned)

        def values(places: Array) -> Array:
            with np.errstate(all="ignore"):
                given = (*output.at(places), *output.constants, output.times(places))
                found: Array = rows(function(*given), len(places))
                return found

        return forces.first_failure(values, output.knots, self.hybrid.static_coefficients)

    @cached_property
    def _are_decided(self) -> bool:
        """Whether the open forces leave it open what holds; then the bodies are at rest."""
        forces, entry = self.mode.open_forces, self.entry.rounded()
        directions = directions_of(entry)
        values = self.mode.balances(entry.state, entry.shared.time, directions)
        return forces is not None and forces.are_decided(values)

    def _first_fall(self, output: DenseOutput) -> tuple[float, Guard] | None:
        # A slip speed touches zero without a change of sign: its end is found step by step.
        watched = [g for g in self.mode.mode.guards if g.kind not in self._ignored]
        watched += self.mode.side_guards
        if not (watched or self.mode.can_jam):
            return None
        values, sides = self._values(output, watched), self.mode.side_guards

        def uncertainty(places: Array) -> Array:
            with np.errstate(all="ignore"):
                moved = values(places, lambda at: probed(output.at(at)))
                found = np.abs(moved - values(places))
            return np.where(np.isfinite(found), found, 0.0)

        if sides:
            fall = first_end_of_side(values, output.knots, len(watched) - len(sides))
        else:
            fall = first_fall(values, output.knots, uncertainty)
        if fall is None:
            return None
        if fall.guard == len(watched):  # the determinant, which follows the guards
            raise self._jammed(output, fall.time)
        return fall.time, watched[fall.guard]

    @cached_property
    def _ignored(self) -> tuple[str, ...]:
        """Kinds of guards that are not watched for a fall.

        The centre of mass of a body on a post, which the plane stands for, may be below it.
        """
        heights = [g.positive for g in self.mode.mode.guards if g.kind == "falls flat"]
        if not heights:
            return ("sticks",)
        found = self.mode.function(heights)(self.entry.state, self.entry.shared.time, ())
        return ("sticks", "falls flat") if np.any(found <= 0) else ("sticks",)

    def broken(self, output: DenseOutput) -> NumericError:
        """Why a motion cannot be continued: Painlevé's paradox, or a singular position."""
        last = output.knots[-1]
        if self.mode.can_jam:
            reserves = self._values(output, [])(output.knots)[-1]
            if reserves[-1] <= _JAMMED * np.max(reserves):
                return self._jammed(output, last)
        state = dict(zip(output.symbols, output.at(np.array([last]))[:, 0], strict=True))
        lost = SpeedDependence(self.mode.dynamics).lost_at(state, output.constants)
        if lost:
            return NumericError(
                f"the motion cannot be continued beyond t = {_time(output, last):.9g} s, where "
                f"{lost}",
                expected="independent speeds that determine all others, in every contact mode",
                advice="choose others with System(..., independent=[...]) or speeds={...}",
            )
        return broken_at(self.mode.mode.equations, state, _time(output, last))

    def _jammed(self, output: DenseOutput, place: float) -> NumericError:
        return painleve(", ".join(e.name for e in self.mode.sliding), _time(output, place))

    def _values(self, output: DenseOutput, watched: list[Guard]) -> _GuardValues:
        """The guards as functions of the place, and where sliding may jam the determinant.

        Friction μ N makes the mass matrix depend on μ and the direction of slip. Forces and
        accelerations of sliding are unique while its determinant is positive (without friction it
        always is); Painlevé's paradox begins where it vanishes.
        """
        mode = self.mode
        expressions = [vanishing_expression(guard, self.near_flat) for guard in watched]
        size = len(mode.mode.equations.speeds)
        masses = mode.mode.equations.mass.entries if mode.can_jam else []
        arguments = (*output.symbols, *mode.dynamics.parameters, CLOCK)
        wanted = [*expressions, *masses]
        function = mode.dynamics.function(wanted, arguments, output.turned)
        speeds = self._initial_speeds(watched)

        def evaluate(places: Array, states: Callable[[Array], Array] = output.at) -> Array:
            with np.errstate(all="ignore"):
                found = function(*states(places), *output.constants, output.times(places))
            values: Array = rows(found, len(places))
            for k, rise in speeds.items():
                values[k] = rise.mean(values[k], output.passed(places))
            own = values[: len(expressions)]
            if not mode.can_jam:
                return own
            matrices = values[len(expressions) :].T.reshape(-1, size, size)
            with np.errstate(all="ignore"):
                return np.vstack([own, np.linalg.det(matrices)])

        return evaluate

    def _initial_speeds(self, watched: list[Guard]) -> dict[int, LiftOff]:
        """Initial speeds at guards that start at zero, by their places among those watched.

        Such a guard is the height of a contact that has just opened, or the distance to an edge
        that has just been crossed.
        """
        found, entry = {}, self.entry
        for k, guard in enumerate(watched):
            i = index_of(guard, self.hybrid)
            if i < 0:
                continue
            point, is_beyond = self.points[i], entry.phases[i].is_beyond
            still = float(self.hybrid.numbers.finer(NO_NORMAL_SPEED) * point.scale)
            if guard.kind == "touches down" and entry.gaps.get(i) == 0.0:
                found[k] = LiftOff(float(point.velocity[2]), still)
            if guard.kind == "crosses the edge" and entry.edge_distances[i] == 0.0:
                found[k] = LiftOff(float(point.leaving(is_beyond=is_beyond)), still)
        return found

    def sticking_guard(self, vanished: int | None) -> Guard | None:
        """The guard of the contact whose slip has ended, if one has."""
        if vanished is None:
            return None
        i = sorted(self.entry.slips)[vanished]
        name = self.hybrid.automaton.contacts[i].name
        return next(
            g
            for g in self.mode.mode.guards
            if g.kind == "sticks" and g.contact and g.contact.name == name
        )

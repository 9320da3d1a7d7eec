"""Goes through attitudes at which angles are singular, in angles counted from turned axes.

Near gimbal lock a motion is integrated with the equations of the same system in other angles
(`derive.with_turned_angles`), and its states are converted back wherever they are read: the
coordinates and speeds remain those of the declaration. Energy, power, and forces along axes that do
not depend on the choice are computed from the other angles, and keep all digits. The declared
angles and their rates lose those that they cannot carry: an angle that has to turn by half a turn
while the axis passes at a distance ε of the pole is known to rounding over ε.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import chain, pairwise
from typing import Any, cast

import numpy as np

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.base import ByIdentity, PolhodeError
from polhode.derive import derive_in_parts, with_turned_angles
from polhode.model import System
from polhode.simulate._absolute_values import Instant
from polhode.simulate._dynamics import CLOCK, WORK, Dynamics
from polhode.simulate._gimbal_lock import NumericAttitude, attitudes_of, passes_straight
from polhode.simulate._segment import TrajectoryPiece, values_of
from polhode.simulate._three_angles import AT_POLE, AttitudeAxes, PoleChoice
from polhode.simulate.integrate._arrays import Array, rows
from polhode.simulate.integrate._driver import SegmentSolution
from polhode.simulate.integrate._stepping import IntegratedEquations, Integrator

_ALIKE = 1e-8  # relative difference of two descriptions of one state that counts as rounding
_FINE = 0.5  # rad: angles that change less from one instant to the next are followed over turns
_INSTANT = 4  # units in the last place of the time: nothing is resolved within
_OFF = 1.0  # rad from the pole: where the two descriptions are compared

States = Mapping[Symbol, Any]


class TurnedEquations(IntegratedEquations):
    """The equations of a system with some of its angles counted from turned axes.

    Args:
        dynamics: in the declared angles.
        chosen: the attitudes whose angles are counted otherwise.
        integrator: of the motion.
        tolerance: of its steps.
    """

    def __init__(
        self,
        dynamics: Dynamics,
        chosen: Iterable[NumericAttitude],
        integrator: Integrator,
        tolerance: float | None,
    ) -> None:
        self.declared = dynamics
        self.chosen = tuple(chosen)
        system = cast(System, dynamics.equations.system)
        turned = with_turned_angles(system, (a.declared for a in self.chosen))
        equations = derive_in_parts(turned)
        super().__init__(replace(dynamics, equations=equations), integrator, tolerance)
        self._is_same: bool | None = None

    def overshoot(self) -> Callable[[float, Sequence[float]], bool]:
        """Whether the declared angles are regular again, or these no longer, at a step's end."""
        core = self.flow.core.symbols
        seen = [(a, [core.index(q) for q in a.turned[:2] if q in core]) for a in self.chosen]
        seen = [(a, places) for a, places in seen if len(places) == 2]

        def over(time: float, state: Sequence[float]) -> bool:
            sines = [(a, *a.geometry.sines(state[i], state[j])) for a, (i, j) in seen]
            left = bool(sines) and all(declared > a.far for a, declared, _ in sines)
            return left or any(own < a.near for a, _, own in sines)

        return over

    # -- states -----------------------------------------------------------------------------------

    @cached_property
    def _to_turned(self) -> _Conversion:
        return _Conversion(self.declared, self.dynamics, self.chosen, to_turned=True)

    @cached_property
    def _to_declared(self) -> _Conversion:
        return _Conversion(self.dynamics, self.declared, self.chosen, to_turned=False)

    def turned_states(self, states: Array, constants: Array, times: Array) -> Array:
        """The states of these equations, shape (states, times), from the declared ones."""
        return self._to_turned(states, constants, times, [PoleChoice()] * len(self.chosen))

    def state(self, declared: States, constants: Array, time: float) -> Array:
        """The state of these equations, from a declared one."""
        known = np.array([[declared[s]] for s in self.declared.states])
        found: Array = self.turned_states(known, constants, np.array([time]))[:, 0]
        return found

    def declared_states(
        self, states: Array, constants: Array, times: Array, choices: Sequence[PoleChoice]
    ) -> Array:
        """The declared states, with angles within one turn, from those of these equations.

        Args:
            choices: by attitude.
        """
        return self._to_declared(states, constants, times, choices)

    def choices(self, state: States, time: float) -> list[PoleChoice]:
        """How a motion from a declared state is described, by attitude.

        From the pole itself, the second angle goes the way it was started; while the motion stays
        there, the first angle goes on as it was started.
        """
        found = []
        for attitude in self.chosen:
            first, angle, _ = attitude.angles
            sine = np.sin(state[angle] - attitude.geometry.offset)
            if abs(sine) <= AT_POLE:
                sine = state.get(angle.derivative(), 0.0)
            side, rate = 1.0 if sine >= 0 else -1.0, state.get(first.derivative(), 0.0)
            found.append(PoleChoice(side, state[first], rate, time))
        return found

    def is_same_motion(self, state: States, numbers: Callable[[Dynamics], Array]) -> bool:
        """Whether both descriptions agree on energy, power and accelerations, compared once.

        They may not where a force acts along axes between the rotations, which the declaration
        names by a label only.

        Args:
            state: a declared one; compared is one with the same positions and other speeds, and
                with regular angles.
            numbers: the constants of some equations.
        """
        if self._is_same is None:
            self._is_same = self._agrees(state, numbers)
        return self._is_same

    def _agrees(self, state: States, numbers: Callable[[Dynamics], Array]) -> bool:
        regular = {a.angles[1]: a.geometry.offset + _OFF for a in self.chosen}
        moving = {u: state[u] + 0.3 + 0.2 * k for k, u in enumerate(self.declared.equations.speeds)}
        there = {**state, **regular, **moving}
        own = np.array([[there[s]] for s in self.declared.states])
        time, constants = np.zeros(1), numbers(self.declared)
        turned = self.turned_states(own, constants, time)
        first = self._to_turned.signature(own, constants, time)
        second = self._to_declared.signature(turned, numbers(self.dynamics), time)
        scale = np.max(np.abs(first)) + np.max(np.abs(second))
        return bool(np.all(np.abs(first - second) <= _ALIKE * scale))

    # -- quantities -------------------------------------------------------------------------------

    @cached_property
    def counterparts(self) -> dict[Expr, Expr]:
        """Expressions in the turned angles, by those in the declared angles that mean the same."""
        declared, turned = self.declared.equations, self.dynamics.equations
        table = {declared.energy: turned.energy, declared.power: turned.power}
        still = [e.energy.subs(dict.fromkeys(e.speeds, 0)) for e in (declared, turned)]
        table[still[0]] = still[1]
        lines = getattr(declared, "lines", ())
        for line in lines:
            frame = line.direction.triad
            if all(a.declared.is_same_along(frame) for a in self.chosen):
                table[declared.components[line.name]] = turned.components[line.name]
        return table


def _angular_velocity(place: int) -> Symbol:
    """A component of an angular velocity along axes from which angles are counted."""
    return Symbol(f"component {place} of an angular velocity", SymbolKind.SPEED)


class _Conversion:
    """Converts states from one description to the other.

    Args:
        source, target: the equations.
        chosen: attitudes whose angles differ.
        to_turned: whether the target has the turned angles.
    """

    def __init__(
        self,
        source: Dynamics,
        target: Dynamics,
        chosen: Sequence[NumericAttitude],
        *,
        to_turned: bool,
    ) -> None:
        self._source = source
        self._target = target
        self._to_turned = to_turned
        self._geometries = [a.geometry for a in chosen]
        self._before = [a.angles if to_turned else a.turned for a in chosen]
        self._after = [a.turned if to_turned else a.angles for a in chosen]
        self._arguments = (*source.states, *source.parameters, CLOCK)
        angles = {q for after in self._after for q in after}
        known = source.equations.kinematics
        own = dict(target.equations.system.speeds)
        for symbol, _ in source.equations.system.speeds:
            own.pop(symbol, None)
        self._speeds = [s for s in target.states if s in own]
        self._common = [s for s in target.states if s.base() not in angles and s not in own]
        turning = [
            component.subs(known)  # whose terms that are infinite in gimbal lock cancel
            for a, before in zip(chosen, self._before, strict=True)
            for component in a.declared.angular_velocity(before)
        ]
        self._function = source.function(
            [*map(Expr.generator, self._common), *turning], self._arguments
        )
        omega = [tuple(map(_angular_velocity, range(3 * k, 3 * k + 3))) for k in range(len(chosen))]
        rates: dict[Symbol, Expr] = {}
        for attitude, components in zip(chosen, omega, strict=True):
            rates |= attitude.declared.rates([Expr.generator(w) for w in components])
        self._speeds_function = source.function(
            [own[s].subs(own).subs(rates) for s in self._speeds],
            (*self._arguments, *(q for after in self._after for q in after), *chain(*omega)),
        )

    def __call__(
        self, states: Array, constants: Array, times: Array, choices: Sequence[PoleChoice]
    ) -> Array:
        with np.errstate(all="ignore"):
            values = rows(self._function(*states, *constants, times), len(times))
        known = dict(zip(self._common, values, strict=False))
        turning = values[len(self._common) :].reshape(len(self._geometries), 3, len(times))
        turn = [g.turned if self._to_turned else g.turned_back for g in self._geometries]
        turning = np.array([t(w) for t, w in zip(turn, turning, strict=True)])
        angles = np.empty_like(turning)
        for k, geometry in enumerate(self._geometries):
            attitude = geometry.attitude(self._angles_before(states, k))
            other = AttitudeAxes(turn[k](attitude.third), turn[k](attitude.mark))
            angles[k] = geometry.angles(other, choices[k], times)
            known |= zip(self._after[k], angles[k], strict=True)
            turned_rates = geometry.rates(angles[k], turning[k], choices[k])
            known |= zip((q.derivative() for q in self._after[k]), turned_rates, strict=True)
        if self._speeds:
            arguments = (*states, *constants, times, *chain(*angles), *chain(*turning))
            with np.errstate(all="ignore"):
                found = rows(self._speeds_function(*arguments), len(times))
            known |= zip(self._speeds, found, strict=True)
        return np.array([known[s] for s in self._target.states])

    def signature(self, states: Array, constants: Array, times: Array) -> Array:
        """Energy, power, and angular accelerations in the declared axes, in the source."""
        equations = self._source.equations
        rates = [Expr.generator(q.derivative()) for angles in self._before for q in angles]
        second = [Expr.generator(q.derivative().derivative()) for a in self._before for q in a]
        wanted = (equations.energy, equations.power, *rates, *second)
        values = rows(self._source.function(wanted, self._arguments)(*states, *constants, times), 1)
        found = [values[:2]]
        size = 3 * len(self._geometries)
        for k, geometry in enumerate(self._geometries):
            first, then = (values[2 + i + 3 * k : 5 + i + 3 * k] for i in (0, size))
            turning = geometry.angular_acceleration(self._angles_before(states, k), first, then)
            found.append(turning if self._to_turned else geometry.turned_back(turning))
        return np.concatenate(found)

    def _angles_before(self, states: Array, k: int) -> Array:
        places = [self._source.states.index(q) for q in self._before[k]]
        found: Array = states[places]
        return found


# -- pieces ----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class TurnedPiece(TrajectoryPiece):
    """A piece that was integrated in turned angles; its solution gives the declared states.

    Attributes:
        equations: in turned angles.
        turned: the same piece in these.
    """

    equations: TurnedEquations = field(repr=False)
    turned: TrajectoryPiece = field(repr=False)

    @property
    def angles_replaced(self) -> frozenset[Symbol]:
        return frozenset(q for attitude in self.equations.chosen for q in attitude.angles)

    def values(self, dynamics: Dynamics, expressions: Sequence[Expr], times: Array) -> Array:
        known = self.equations.counterparts
        found = np.empty((len(expressions), len(times)))
        groups: list[tuple[list[int], Dynamics, TrajectoryPiece]] = [
            ([i for i, e in enumerate(expressions) if e not in known], dynamics, self),
            (
                [i for i, e in enumerate(expressions) if e in known],
                self.equations.dynamics,
                self.turned,
            ),
        ]
        for places, own, piece in groups:
            wanted = [known.get(expressions[i], expressions[i]) for i in places]
            if places:
                found[places] = values_of(own, piece, wanted, times)
        return found


def turned_piece(
    equations: TurnedEquations, turned: TrajectoryPiece, before: States, constants: Array
) -> TurnedPiece:
    """A piece in declared states.

    Args:
        equations: in turned angles.
        turned: the piece in these.
        before: the declared state where it begins.
        constants: of the declared equations.
    """
    states = _DeclaredStates(equations, turned, before)
    work = (WORK,) if WORK in turned.solution.symbols else ()
    solution = SegmentSolution(
        (*equations.declared.states, *work),
        {},
        states.steps,
        turned.solution.stop,
        None,
        states,
    )
    return TurnedPiece(turned.begin, turned.end, solution, constants, equations, turned)


_SAMPLES = 5  # times within a step at which the rates of its angles are read


class _DeclaredStates:
    """The declared states at any times of a piece, with angles that are followed over turns."""

    def __init__(self, equations: TurnedEquations, turned: TrajectoryPiece, before: States) -> None:
        self._equations = equations
        self._turned = turned
        self._choices = equations.choices(before, turned.begin)
        declared = equations.declared.states
        self._angles = [declared.index(q) for a in equations.chosen for q in a.angles]
        steps = turned.solution.steps
        steps = np.append(steps[steps < turned.end], turned.end)
        times, self.steps = self._resolved(steps)
        raw = self._raw(times)[self._angles]
        first = np.array([before[declared[i]] for i in self._angles])
        changes = _within_half_a_turn(np.diff(raw, axis=1))
        self._times = times
        self._followed = first[:, None] + np.cumsum(
            np.concatenate([_within_half_a_turn(raw[:, :1] - first[:, None]), changes], axis=1),
            axis=1,
        )

    def __call__(self, times: Array) -> Array:
        states = self._raw(times)
        for i, followed in zip(self._angles, self._followed, strict=True):
            near = np.interp(times, self._times, followed)
            states[i] += 2 * np.pi * np.round((near - states[i]) / (2 * np.pi))
        solution = self._turned.solution
        if WORK in solution.symbols:
            work = solution.at(times)[solution.symbols.index(WORK)]
            states = np.vstack([states, work])
        return states

    def _raw(self, times: Array) -> Array:
        solution, equations = self._turned.solution, self._equations
        values = solution.at(times)
        places = [solution.symbols.index(s) for s in equations.dynamics.states]
        own = values[places]
        return equations.declared_states(own, self._turned.constants, times, self._choices)

    def _resolved(self, steps: Array) -> tuple[Array, Array]:
        """Times between which angles change little, and steps between which they are smooth."""
        pieces = [
            np.linspace(begin, end, count, endpoint=False)
            for (begin, end), count in zip(pairwise(steps), self._parts(steps), strict=True)
        ]
        times = np.append(np.concatenate(pieces), steps[-1:])
        fine = list[Array]()
        while True:
            changes = _within_half_a_turn(np.diff(self._raw(times)[self._angles], axis=1))
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
        equations = self._equations
        wanted = [Expr.generator(q.derivative()) for a in equations.chosen for q in a.turned]
        times = np.linspace(steps[:-1], steps[1:], _SAMPLES)  # shape (samples, steps)
        rates = values_of(equations.dynamics, self._turned, wanted, times.T.ravel())
        by_step = np.abs(rates).reshape(len(wanted), -1, _SAMPLES)
        fastest = np.max(by_step, axis=(0, 2)) * 2
        return [1 + int(turned) for turned in fastest * np.diff(steps) / _FINE]


def _within_half_a_turn(angles: Array) -> Array:
    found: Array = angles - 2 * np.pi * np.round(angles / (2 * np.pi))
    return found


# -- when to go over ------------------------------------------------------------------------------


class AttitudeChoices:
    """The equations of one system in all choices of angles that a motion needs.

    Args:
        dynamics: in the declared angles.
        integrator: of the motion.
        tolerance: of its steps.
    """

    def __init__(self, dynamics: Dynamics, integrator: Integrator, tolerance: float | None) -> None:
        self._dynamics = dynamics
        self._integrator = integrator
        self._tolerance = tolerance
        self._known: dict[tuple[int, ...], TurnedEquations | None] = {}

    @cached_property
    def attitudes(self) -> tuple[NumericAttitude, ...]:
        """Those that can be described otherwise."""
        if self._dynamics.undecided:
            return ()
        found = attitudes_of(ByIdentity(self._dynamics.equations))
        return tuple(attitude for attitude in found if attitude.can_be_turned)

    def needed(self, state: States, here: Instant, *, is_turned: bool) -> tuple[int, ...]:
        """The attitudes that are near a pole, and do not pass straight through it."""
        near = [
            i
            for i, a in enumerate(self.attitudes)
            if a.geometry.is_near_pole(state[a.angles[1]], a.far if is_turned else a.near)
        ]
        rates = partial(here.values, self._dynamics)
        return tuple(
            i
            for i in near
            if is_turned or not passes_straight(self.attitudes[i], here.state, rates)
        )

    def equations(
        self, needed: tuple[int, ...], state: States, numbers: Callable[[Dynamics], Array]
    ) -> TurnedEquations | None:
        """The equations in which these attitudes are regular; None if there are none."""
        if not needed:
            return None
        if needed not in self._known:
            self._known[needed] = self._derived(needed)
        found = self._known[needed]
        return found if found is not None and found.is_same_motion(state, numbers) else None

    def _derived(self, needed: tuple[int, ...]) -> TurnedEquations | None:
        try:
            chosen = [self.attitudes[i] for i in needed]
            return TurnedEquations(self._dynamics, chosen, self._integrator, self._tolerance)
        except PolhodeError:  # what was declared along the axes between needs them as they are
            return None

    def overshoot(
        self, core: Sequence[Symbol], near: Iterable[int]
    ) -> Callable[[float, Sequence[float]], bool] | None:
        """Whether an attitude has come near a pole at the end of a step, in the declared angles.

        Args:
            core: the states that are integrated.
            near: attitudes that are near one already.
        """
        others = [a for i, a in enumerate(self.attitudes) if i not in set(near)]
        places = [(core.index(a.angles[1]), a) for a in others if a.angles[1] in core]
        if not places:
            return None
        return lambda time, state: any(a.geometry.is_near_pole(state[i], a.near) for i, a in places)

    def near(self, state: States) -> tuple[int, ...]:
        """The attitudes that are near a pole."""
        return tuple(
            i
            for i, a in enumerate(self.attitudes)
            if a.geometry.is_near_pole(state[a.angles[1]], a.near)
        )

"""The contact modes of a system, compiled: equations, forces, slips, and maps between modes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from typing import Any, cast

import numpy as np

from polhode.algebra import Compiled, Expr, Symbol, compile_program
from polhode.base import ByIdentity, NumericError
from polhode.derive import Automaton, Mode
from polhode.model import ContactLaw, DryFriction, Frame, Phase, Slipping
from polhode.simulate._absolute_values import Instant, Sides, guards_of_sides, sides_at
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate._gimbal_lock import NumericAttitude, attitudes_of, broken_at
from polhode.simulate._independent_speeds import SpeedDependence
from polhode.simulate._other_angles import OtherAngles
from polhode.simulate.contact._auxiliary_states import dynamics_of
from polhode.simulate.contact._contact_kinematics import Function, State, Touching
from polhode.simulate.contact._mode_expressions import (
    closing_rates_of,
    contact_forces_of,
    projection_of,
    shared_state_of,
    slip_rates_of,
)
from polhode.simulate.contact._open_forces import OpenForces
from polhode.simulate.forcing._prescribed_motion import PrescribedMotion
from polhode.simulate.integrate._arrays import Array, rows
from polhode.simulate.integrate._number_types import DOUBLES, NumberType
from polhode.simulate.integrate._stepping import IntegratedEquations, Integrator

Constants = Mapping[Symbol, float]

#: The attitudes whose angles are counted from turned axes, by their places.
Chart = tuple[int, ...]

_SINGULAR = 1e15  # condition of a mass matrix with a diagonal of ones that is rounding


class HybridSystem:
    """The modes of one system with one set of parameter values.

    Args:
        automaton: the modes.
        drive: the prescribed motions.
        constants: value of every parameter.
        integrator: integrates the modes.
        tolerance: of its steps.
        numbers: the type of numbers to compute with.
        in_doubles: the same system in doubles; None if this is in doubles.
    """

    def __init__(
        self,
        automaton: Automaton,
        drive: PrescribedMotion,
        constants: Constants,
        integrator: Integrator,
        tolerance: float | None,
        numbers: NumberType = DOUBLES,
        in_doubles: HybridSystem | None = None,
    ) -> None:
        self.numbers = numbers
        self.in_doubles = in_doubles or self
        self.declared = automaton
        self._in_angles: dict[Chart, Automaton] = {(): automaton}
        self._known: dict[_Description, tuple[Automaton, _Modes, list[Touching]]] = {}
        self._describe((), ())
        self.drive = drive
        self.set_constants(constants)
        self.integrator = integrator
        self.tolerance = tolerance
        self._functions: dict[tuple[Expr, tuple[Symbol, ...]], Compiled] = {}
        self._other_angles: dict[tuple[int, int], OtherAngles] = {}
        self.possible_charts: dict[Chart, bool] = {}

    def set_constants(self, constants: Constants) -> None:
        """Take other values of the same parameters, for another motion from the beginning."""
        self._held = self.drive.constants(0.0)
        self.constants: Constants = dict(constants) | dict(self._held)
        self._describe((), self.speeds_in(()))
        #: The declared angles in place of which others are counted, as followed over turns.
        self.declared_angles: dict[Symbol, float] = {}

    def update_forcing(self, now: float) -> None:
        """Take the coefficients of the prescribed motions that hold from an instant on."""
        held = self.drive.constants(now)
        if held is not self._held:
            self._held = held
            self.constants = {**self.constants, **held}

    def mode(self, phases: tuple[Phase, ...]) -> CompiledMode:
        """A mode, compiled when it is first needed."""
        if phases not in self._modes:
            self._modes[phases] = CompiledMode(self, self.automaton.mode(phases))
        return self._modes[phases]

    def on_speeds(self, speeds: tuple[Symbol, ...]) -> None:
        """Go on with the modes on other independent speeds, or without any on those declared.

        Shared states are in terms of them, too.
        """
        if self.in_doubles is not self:
            self.in_doubles.on_speeds(speeds)
        self._describe(self.chart, speeds)

    def in_angles(self, chart: Chart) -> None:
        """Go on with the modes in other angles, on the speeds that correspond to the present."""
        self._describe(chart, self.speeds_in(chart))

    def speeds_in(self, chart: Chart) -> tuple[Symbol, ...]:
        """The speeds in other angles that correspond to the present independent ones."""
        chosen = [self.attitudes[i] for i in {*chart} ^ {*self.chart}]
        names = {
            one: other
            for attitude in chosen
            for pair in zip(attitude.angles, attitude.turned, strict=True)
            for one, other in (pair, pair[::-1])
        }
        return tuple(Symbol(names.get(u.base(), u).name, u.kind, u.order) for u in self.speeds)

    def _describe(self, chart: Chart, speeds: tuple[Symbol, ...]) -> None:
        self.chart, self.speeds = chart, speeds
        self.automaton, self._modes, self._touching = self._described(chart, speeds)
        self.__dict__.pop("separated", None)

    def _described(
        self, chart: Chart, speeds: tuple[Symbol, ...]
    ) -> tuple[Automaton, _Modes, list[Touching]]:
        """The modes in some angles and on some speeds, with what is compiled of them."""
        if chart not in self._in_angles:
            turned = (self.attitudes[i].declared for i in chart)
            self._in_angles[chart] = self.declared.in_turned_angles(turned)
        if (chart, speeds) not in self._known:
            modes = self._in_angles[chart]
            modes = modes.on_speeds(speeds) if speeds else modes
            self._known[chart, speeds] = modes, {}, []
        return self._known[chart, speeds]

    @cached_property
    def attitudes(self) -> tuple[NumericAttitude, ...]:
        """The attitudes whose angles can be counted otherwise near gimbal lock; in doubles only.

        The components of all contact forces mean the same then, and no absolute values occur.
        """
        modes = self.declared
        equations, given = modes.separated.equations, self.drive.expressions
        plain = dynamics_of(modes, modes.separated, given, self.constants)
        if self.in_doubles is not self or plain.undecided:
            return ()
        frames = {
            cast(Frame, contact.on.axes[label].triad)
            for contact in modes.contacts
            for label in (*contact.on.tangents, contact.on.normal)
        }
        return tuple(
            attitude
            for attitude in attitudes_of(ByIdentity(equations))
            if attitude.can_be_turned and all(map(attitude.declared.is_same_along, frames))
        )

    def angles_between(
        self, declared: Dynamics, turned: Dynamics, chosen: Iterable[int]
    ) -> OtherAngles:
        """A mode in two choices of angles, from the places of the attitudes that differ."""
        key = id(declared), id(turned)
        if key not in self._other_angles:
            attitudes = [self.attitudes[i] for i in chosen]
            self._other_angles[key] = OtherAngles(declared, turned, attitudes)
        return self._other_angles[key]

    def dynamics_in(self, chart: Chart, phases: tuple[Phase, ...]) -> Dynamics:
        """A mode in other angles, on the speeds that correspond to the present ones."""
        modes, known, _ = self._described(chart, self.speeds_in(chart))
        if phases not in known:
            mode, given = modes.mode(phases), self.drive.expressions
            dynamics = dynamics_of(modes, mode, given, self.constants)
            known[phases] = CompiledMode(self, mode, dynamics)
        return known[phases].dynamics

    def value(self, expression: Expr) -> Any:
        """The value of an expression of constants."""
        known = tuple(self.constants)
        if (expression, known) not in self._functions:
            function = compile_program([expression], known).function(self.numbers.scalars)
            self._functions[expression, known] = function
        found = self._functions[expression, known](*self.constants.values())[0]
        return self.numbers.scalar(found)

    def closing_with(self, i: int) -> frozenset[int]:
        """A contact and the couples beside its force, by their places in the declaration."""
        contacts = self.automaton.contacts
        return frozenset(k for k, c in enumerate(contacts) if c.pressed_by == contacts[i].name)

    @cached_property
    def separated(self) -> CompiledMode:
        """The mode in which nothing touches."""
        return self.mode(self.automaton.separated.phases)

    @property
    def static_coefficients(self) -> list[float]:
        """Of static friction, of all contacts; infinite for those without a limit."""
        return [
            float(self.value(c.mu_static)) if isinstance(c, DryFriction) else np.inf
            for c in self.automaton.contacts
        ]

    @property
    def touching(self) -> Touching:
        """The kinematics of all contacts, from the shared state."""
        if not self._touching:
            own = Touching(self.automaton, self.separated.function, self.numbers)
            self._touching.append(own)
        return self._touching[0]


_Modes = dict[tuple[Phase, ...], "CompiledMode"]
_Description = tuple[Chart, tuple[Symbol, ...]]  # the angles, and the independent speeds


class CompiledMode(IntegratedEquations):
    """One contact mode, compiled and with parameter values.

    All functions are compiled when they are first needed: most modes are only ever tried.
    """

    def __init__(self, hybrid: HybridSystem, mode: Mode, dynamics: Dynamics | None = None) -> None:
        self.mode = mode
        self._hybrid = hybrid
        self._numbers = hybrid.numbers
        self._last: tuple[Constants, Array, list[float]] = ({}, np.empty(0), [])
        self._by_sides: dict[int, CompiledMode] = {}
        found = dynamics or dynamics_of(
            hybrid.automaton, mode, hybrid.drive.expressions, hybrid.constants
        )
        super().__init__(found, hybrid.integrator, hybrid.tolerance)
        self.side_guards = guards_of_sides(self.dynamics)

    def on(self, sides: Sides) -> CompiledMode:
        """The same mode on given sides of all absolute values."""
        dynamics = self.dynamics.on(sides)
        if dynamics is self.dynamics:
            return self
        if id(dynamics) not in self._by_sides:
            self._by_sides[id(dynamics)] = CompiledMode(self._hybrid, self.mode, dynamics)
        return self._by_sides[id(dynamics)]

    def instant(self, state: Mapping[Symbol, Any], time: Any) -> Instant:
        """An instant of a motion in this mode."""
        return Instant(state, self.parameters, time, self._numbers)

    @property
    def parameters(self) -> Array:
        """The constants, in the order of the programs; those of prescribed motions change."""
        return self._current[1]

    @property
    def _current(self) -> tuple[Constants, Array, list[float]]:
        """The mapping that the constants were read from; the constants as an array and as a list.

        `HybridSystem` replaces the mapping when a value changes, so identity is enough to compare.
        """
        if self._last[0] is not self._hybrid.constants:
            known = self._hybrid.constants
            values = self._numbers.array([known[s] for s in self.dynamics.parameters])
            self._last = (known, values, values.tolist())
        return self._last

    def rest(self, state: Mapping[Symbol, float], time: float) -> Array:
        """A state as the flow takes it: less the parts that are known functions of time."""
        return self.flow.rest(state, self.parameters, time)

    @cached_property
    def sides(self) -> Compiled:
        """Expressions that are positive where the equations hold, of core, parameters and time."""
        given = (*self.flow.core.symbols, *self.dynamics.parameters, CLOCK)
        return self.dynamics.program(self.watched_sides, given).function()

    @cached_property
    def watched_sides(self) -> tuple[Expr, ...]:
        """These expressions; none that depends on a state outside the core, such as one at rest."""
        outside = set(self.dynamics.states).difference(self.flow.core.symbols)
        sides = (guard.positive for guard in self.mode.guards if guard.ends_before)
        return tuple(side for side in sides if outside.isdisjoint(side.symbols()))

    def function(self, expressions: Iterable[Expr], extra: Sequence[Symbol] = ()) -> Function:
        """Expressions as a function of the state, the time and values of extra symbols."""
        states = tuple(s for s in self.dynamics.states if s not in self.dynamics.auxiliary)
        known = (*states, *extra, *self.dynamics.parameters, CLOCK)
        if self.dynamics.undecided:
            return self._function_by_sides(tuple(expressions), states, tuple(extra))
        compiled = self.dynamics.program(expressions, known).function(self._numbers.scalars)

        def values(state: Array, time: float, more: Sequence[float] = ()) -> Array:
            constants = self._current[2]
            try:
                found = compiled(*state[: len(states)].tolist(), *more, *constants, time)
            except (ArithmeticError, ValueError) as error:
                raise singular(time) from error
            return np.asarray(self._numbers.array(found))

        return values

    def _function_by_sides(
        self, expressions: tuple[Expr, ...], states: tuple[Symbol, ...], extra: tuple[Symbol, ...]
    ) -> Function:
        """Such a function where absolute values occur: it uses the sides that each state is on."""
        known: dict[int, Function] = {}

        def values(state: Array, time: float, more: Sequence[float] = ()) -> Array:
            now = dict(zip(states, state[: len(states)].tolist(), strict=True))
            mode = self.on(sides_at(self.dynamics, self.instant(now, time)))
            if id(mode) not in known:
                known[id(mode)] = mode.function(expressions, extra)
            return known[id(mode)](state, time, more)

        return values

    @cached_property
    def dependence(self) -> SpeedDependence:
        """How the dependent speeds follow from the independent ones."""
        return SpeedDependence(self.dynamics)

    # -- to and from the shared state -----------------------------------------------------------

    @cached_property
    def embedding(self) -> Callable[[Any, Mapping[Symbol, Any], Any], State]:
        """Maps a time, a state of this mode and the work done to the shared state."""
        separated = self._hybrid.automaton.separated
        size = len(separated.equations.coordinates)
        function = self.function(shared_state_of(self.mode, separated))
        own = [s for s in self.dynamics.states if s not in self.dynamics.auxiliary]

        def embedding(time: Any, state: Mapping[Symbol, Any], work: Any) -> State:
            values = function(self._numbers.array([state[s] for s in own]), time, ())
            return State(time, values[:size], values[size:], work)

        return embedding

    @cached_property
    def _projection(self) -> Function:
        """The shared speeds in this mode, rest + P u: `rest`, then the matrix P row by row."""
        rest, columns = projection_of(self.mode, self._hybrid.automaton.separated)
        return self.function(rest + columns)

    def coordinates(self, shared: State) -> Array:
        """Those of this mode, of all that the modes share."""
        names = self._hybrid.separated.mode.equations.coordinates
        values = dict(zip(names, shared.coordinates, strict=True))
        found: Array = self._numbers.array([values[s] for s in self.mode.equations.coordinates])
        return found

    def allowed(self, shared: State) -> tuple[Array, Array]:
        """The shared speeds in this mode as rest + P u: `rest`, and P, its motions in columns."""
        size, count = len(self.mode.equations.speeds), len(shared.speeds)
        state = np.concatenate([self.coordinates(shared), self._numbers.array(np.zeros(size))])
        found = self._projection(state, shared.time, ())
        return found[:count], found[count:].reshape(count, size)

    def entered(self, shared: State) -> tuple[Array, Array]:
        """Coordinates and speeds of this mode: the shared speeds, projected on its motions.

        Constraints act by impulses along their reactions, which do no work on any motion that the
        constraints allow. With the columns of P for these motions, momentum along them is kept:
        Pᵀ M P u = Pᵀ M (u_shared − rest).
        """
        separated, numbers = self._hybrid.separated, self._numbers
        coordinates = self.coordinates(shared)
        rest, allowed = self.allowed(shared)
        momentum = separated.mass(shared) @ (shared.speeds - rest)
        reduced = allowed.T @ separated.mass(shared) @ allowed
        return coordinates, numbers.solved(reduced, allowed.T @ momentum)

    @cached_property
    def mass(self) -> Callable[[State], Array]:
        """The mass matrix, if this is the mode in which nothing touches, of the shared state."""
        matrix = self.mode.equations.mass
        entries = self.function([e for row in matrix.rows for e in row])

        def mass(shared: State) -> Array:
            state = np.concatenate([shared.coordinates, shared.speeds])
            found = entries(state, shared.time, ()).reshape(matrix.shape)
            if _is_singular(np.asarray(found, dtype=float)):
                known = dict(zip(self.mode.equations.coordinates, shared.coordinates, strict=True))
                raise broken_at(self.mode.equations, known, float(shared.time))
            return found

        return mass

    # -- forces and slips -----------------------------------------------------------------------

    @property
    def directions(self) -> tuple[Symbol, ...]:
        """Symbols for the direction and speed of slip, contact after contact."""
        return tuple(s for e in self.sliding for s in (*e.direction, e.slip_speed))

    @property
    def sliding(self) -> tuple[Slipping, ...]:
        """The contacts that slide with friction."""
        return tuple(e for e in self.mode.equations.system.elements if isinstance(e, Slipping))

    def sliding_at(self, contact: ContactLaw) -> Slipping:
        """A contact as it slides with friction."""
        return next(e for e in self.sliding if e.name == contact.name)

    @cached_property
    def contact_forces(self) -> Function:
        """Force along the two tangents and the normal of every contact, shape (contacts, 3).

        A function of the state, the time, and the directions and speeds of slip.
        """
        count = 3 * len(self.mode.touches)
        found = self._at_contacts
        return lambda state, time, directions: found(state, time, directions)[:count].reshape(-1, 3)

    @cached_property
    def _at_contacts(self) -> Function:
        """The forces at all contacts, their normal accelerations and the rates of their slips.

        They have most of their terms in common, and so are one program. Forces of which some are
        open are left out.
        """
        return self.function(self._expressions_at_contacts, self.directions)

    @cached_property
    def _expressions_at_contacts(self) -> tuple[Expr, ...]:
        forces = contact_forces_of(self.mode) if not self.mode.undetermined else []
        return (*forces, *closing_rates_of(self.mode), *self.slip_changes)

    @cached_property
    def open_forces(self) -> OpenForces | None:
        """Its contacts, where Newton's laws leave some of their forces open; else None."""
        open_ = self.mode.undetermined
        return OpenForces(self.mode, self._hybrid.automaton.contacts) if open_ else None

    @cached_property
    def balances(self) -> Function:
        """The balances of the bodies, as `derive.BalanceTable` has them.

        A function of the state, the time, and the directions and speeds of slip.
        """
        return self.function(self.mode.balances.expressions, self.directions)

    @cached_property
    def closing_rates(self) -> Function:
        """Normal acceleration of every contact, m/s², shape (contacts,).

        A function of the state, the time, and the directions and speeds of slip.
        """
        found, count = self._at_contacts, len(self.mode.touches)

        def closing_rates(state: Array, time: float, directions: Sequence[float]) -> Array:
            values = found(state, time, directions)
            rates: Array = values[len(values) - 3 * count : len(values) - 2 * count]
            return rates

        return closing_rates

    @cached_property
    def room_rates(self) -> Function:
        """Second rate of the distance of every contact to its edge, m/s², shape (contacts,)."""
        rate = self.mode.equations.kinetics.rate
        second = [touch.edge_distance.chain(rate).chain(rate) for touch in self.mode.touches]
        return self.function(second, self.directions)

    @cached_property
    def can_jam(self) -> bool:
        """Whether friction enters the mass matrix, so that sliding may jam."""
        entries = self.mode.equations.mass.entries
        return any(set(self.directions) & entry.symbols() for entry in entries)

    @cached_property
    def jamming(self) -> Callable[[Array, Any, Sequence[float]], float]:
        """Determinant of the mass matrix over that without friction; not positive where it jams."""
        if not self.can_jam:
            return lambda state, time, directions: 1.0
        matrix = self.mode.equations.mass
        entries = self.function([e for row in matrix.rows for e in row], self.directions)

        def jamming(state: Array, time: Any, directions: Sequence[float]) -> float:
            with_friction, without = (
                np.linalg.det(entries(state, time, d).reshape(matrix.shape))
                for d in (directions, [0.0] * len(directions))
            )
            return float(with_friction / without)

        return jamming

    @cached_property
    def slip_changes(self) -> tuple[Expr, ...]:
        """Rates of the slip velocities of all contacts, m/s²."""
        return slip_rates_of(self.mode)

    def slip_rates_along(self, state: Array, time: float, directions: Sequence[Any]) -> Array:
        """`slip_rates` for arrays of directions, shape (contacts, 2, directions)."""
        states = tuple(s for s in self.dynamics.states if s not in self.dynamics.auxiliary)
        known = (*states, *self.directions, *self.dynamics.parameters, CLOCK)
        function = self.dynamics.function(self._expressions_at_contacts, known)
        with np.errstate(all="ignore"):
            found = function(*state[: len(states)], *directions, *self.parameters, time)
        count = max(np.size(direction) for direction in directions)
        slips = found[len(found) - len(self.slip_changes) :]
        rates: Array = rows(slips, count)
        return rates.reshape(-1, 2, count)

    @cached_property
    def slip_rates(self) -> Function:
        """Rate of the slip velocity of every contact, m/s², shape (contacts, 2)."""
        found, count = self._at_contacts, len(self.slip_changes)

        def slip_rates(state: Array, time: float, directions: Sequence[float]) -> Array:
            values = found(state, time, directions)
            return values[len(values) - count :].reshape(-1, 2)

        return slip_rates


def _is_singular(mass: Array) -> bool:
    """Whether some motion has no inertia, as that of two angles in gimbal lock."""
    sizes = np.sqrt(np.diag(mass))
    scaled = mass / np.outer(sizes, sizes)
    return not bool(np.all(np.isfinite(scaled)) and np.linalg.cond(scaled) < _SINGULAR)


def singular(time: float) -> NumericError:
    """The error for an expression without a finite value."""
    return NumericError(
        f"the equations have no finite value at t = {float(time):.9g} s",
        expected="a motion away from singular positions",
        advice="start elsewhere, or end before that time",
    )

"""One motion in two choices of angles: as declared, and counted from turned axes.

The coordinates and speeds remain those of the declaration wherever they are read. Energy, power,
and forces along axes that do not depend on the choice are computed from the other angles, and keep
all digits. The declared angles and their rates lose those that they cannot carry: an angle that
has to turn by half a turn while the axis passes at a distance ε of the pole is known to rounding
over ε.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import chain
from typing import Any

import numpy as np

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate._gimbal_lock import NumericAttitude
from polhode.simulate._three_angles import AT_POLE, AttitudeAxes, PoleChoice
from polhode.simulate.integrate._arrays import Array, rows

_ALIKE = 1e-8  # relative difference of two descriptions of one state that counts as rounding
_OFF = 1.0  # rad from the pole: where the two descriptions are compared

States = Mapping[Symbol, Any]


class OtherAngles:
    """The equations of one motion in the declared angles, and with some of them counted otherwise.

    Args:
        declared: in the declared angles.
        turned: in the others.
        chosen: the attitudes whose angles differ.
    """

    def __init__(
        self, declared: Dynamics, turned: Dynamics, chosen: Iterable[NumericAttitude]
    ) -> None:
        self.declared = declared
        self.turned = turned
        self.chosen = tuple(chosen)
        self._is_same: bool | None = None

    # -- states -----------------------------------------------------------------------------------

    @cached_property
    def _to_turned(self) -> _Conversion:
        return _Conversion(self.declared, self.turned, self.chosen, (), to_turned=True)

    @cached_property
    def _to_declared(self) -> _Conversion:
        return _Conversion(self.turned, self.declared, self.chosen, (), to_turned=False)

    @cached_property
    def _to_motion(self) -> _Conversion:
        return _Conversion(
            self.turned, self.declared, self.chosen, self.velocities, to_turned=False
        )

    @cached_property
    def velocities(self) -> tuple[Symbol, ...]:
        """Rates and dependent speeds of the declaration, and accelerations.

        They are known in the other angles where the declared ones do not determine them. The
        declared angles have accelerations in their own equations alone.
        """
        known, equations = self.declared.states, self.declared.equations
        angles = {q for attitude in self.chosen for q in attitude.angles}
        rates = [q.derivative() for q in equations.coordinates]
        chosen = dict(equations.system.speeds)
        speeds = [s for s in (*rates, *equations.speeds, *equations.dependent) if s not in chosen]
        second = [s.derivative() for s in speeds if s.base() not in angles]
        return tuple(s for s in dict.fromkeys((*speeds, *second)) if s not in known)

    def turned_states(self, states: Array, constants: Array, times: Array) -> Array:
        """The states in the other angles, shape (states, times), from the declared ones."""
        return self._to_turned(states, constants, times, [PoleChoice()] * len(self.chosen))

    def state(self, declared: States, constants: Array, time: float) -> Array:
        """The state in the other angles, from a declared one."""
        known = np.array([[declared[s]] for s in self.declared.states])
        found: Array = self.turned_states(known, constants, np.array([time]))[:, 0]
        return found

    def declared_states(
        self, states: Array, constants: Array, times: Array, choices: Sequence[PoleChoice]
    ) -> Array:
        """The declared states, with angles within one turn, from those in the other angles.

        Args:
            choices: by attitude.
        """
        return self._to_declared(states, constants, times, choices)

    def declared_motion(
        self, states: Array, constants: Array, times: Array, choices: Sequence[PoleChoice]
    ) -> Array:
        """The same, and `velocities` after them."""
        return self._to_motion(states, constants, times, choices)

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
        second = self._to_declared.signature(turned, numbers(self.turned), time)
        scale = np.max(np.abs(first)) + np.max(np.abs(second))
        return bool(np.all(np.abs(first - second) <= _ALIKE * scale))

    # -- quantities -------------------------------------------------------------------------------

    @cached_property
    def counterparts(self) -> dict[Expr, Expr]:
        """Expressions in the other angles, by those in the declared angles that mean the same."""
        declared: Any = self.declared.equations  # attributes that not all equations have
        turned: Any = self.turned.equations
        table = {declared.energy: turned.energy, declared.power: turned.power}
        still = [e.energy.subs(dict.fromkeys(e.speeds, 0)) for e in (declared, turned)]
        table[still[0]] = still[1]
        for name, frame in _reactions(declared):
            if all(a.declared.is_same_along(frame) for a in self.chosen):
                table[declared.components[name]] = turned.components[name]
        for name, power in getattr(declared, "powers", {}).items():
            table[power] = turned.powers[name]
        return table


def _reactions(equations: Any) -> Iterator[tuple[str, Any]]:
    """The reaction components with the frames along whose axes they are."""
    for line in getattr(equations, "lines", ()):
        yield line.name, line.direction.triad
    kinetics = getattr(equations, "kinetics", None)
    if kinetics is None:
        return
    for element in kinetics.elements:
        for friction in element.friction(kinetics.places):
            yield from ((r.name, r.direction.triad) for r in friction.sliding)


def _angular_velocity(place: int) -> Symbol:
    """A component of an angular velocity along axes from which angles are counted."""
    return Symbol(f"component {place} of an angular velocity", SymbolKind.SPEED)


class _Conversion:
    """Converts states from one description to the other.

    Args:
        source, target: the equations.
        chosen: attitudes whose angles differ.
        more: further symbols of the target to be found.
        to_turned: whether the target has the turned angles.
    """

    def __init__(
        self,
        source: Dynamics,
        target: Dynamics,
        chosen: Sequence[NumericAttitude],
        more: Sequence[Symbol],
        *,
        to_turned: bool,
    ) -> None:
        self._source = source
        self._wanted = (*target.states, *more)
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
        self._common = [s for s in self._wanted if s.base() not in angles and s not in own]
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
        return np.array([known[s] for s in self._wanted])

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

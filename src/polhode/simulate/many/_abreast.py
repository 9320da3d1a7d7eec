"""Many motions at once, for as long as each stays in the contact mode it starts in.

Only what cannot go wrong is done here: a motion that leaves its first mode, or whose start there is
any doubt about, is left to be followed by itself.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, Matrix, Symbol
from polhode.base import look_up
from polhode.derive import Automaton
from polhode.simulate._dynamics import CLOCK, WORK, Dynamics, EquationsOfMotion
from polhode.simulate._follow import AS_DECLARED
from polhode.simulate._names import Name, by_name
from polhode.simulate._readable import readable
from polhode.simulate._values import idle_parameters, read_parameters, read_values
from polhode.simulate.contact._checks import can_be_followed, check_numbers
from polhode.simulate.contact._machine import Machine
from polhode.simulate.forcing._drive import Drive, drive_of
from polhode.simulate.integrate._integrators import Array, chosen
from polhode.simulate.many._lanes import NONE, Lanes

_CLEAR = 1e-9  # of a guard at the start, relative to the largest: further from zero is no doubt


_ROUNDING = 1e-9  # relative, of principal moments that a flat body is at the limit of


@dataclass(frozen=True)
class Plan:
    """What is common to all motions.

    Attributes:
        parameters: of one of them: names and values as `simulate` takes them.
        start: likewise.
        duration: s.
        forcing: prescribed motions.
        tolerance: relative, of one step.
        near_flat: as in `simulate`.
        until: events that end a motion.
    """

    parameters: Mapping[Name, Any]
    start: Mapping[Name, Any]
    duration: float
    forcing: Mapping[Name, Any]
    tolerance: float | None
    near_flat: float
    until: Collection[str]


@dataclass(frozen=True)
class Ending:
    """What ends the motions of a mode.

    Attributes:
        positive: while the mode lasts.
        kind: of the event; empty where the motion is to be followed by itself from there.
        mode: that it ends in.
    """

    positive: Expr
    kind: str
    mode: str


@dataclass(frozen=True)
class Flights:
    """Motions in their first mode, at some times and at their ends.

    Attributes:
        kept: which of them are complete; the others are to be followed by themselves.
        end: how far each went, s.
        ending: place among the endings, or -1.
    """

    kept: NDArray[np.bool_]
    end: Array
    ending: NDArray[np.intp]
    _states: Array
    _parameters: Array
    _times: Array
    _mode: Abreast

    def values(self, quantity: str | Symbol | Expr, time: int) -> Array:
        """A quantity at one of the times, or at the end where that is earlier; shape (motions,).

        Time 0 is the start, and -1 the end.
        """
        clock = np.minimum(self._times[time], self.end)
        return self._mode.values(quantity, self._states[time], self._parameters, clock)


class Abreast:
    """The first contact mode of a system, for many motions at once.

    Attributes:
        mode: its name.
        endings: what may end it.
    """

    def __init__(
        self,
        dynamics: Dynamics,
        mode: str,
        endings: Sequence[Ending],
        plan: Plan,
        quantities: Collection[str | Symbol | Expr],
        numbers: Mapping[Symbol, float],
    ) -> None:
        self.mode = mode
        self.endings = tuple(endings)
        self._dynamics = dynamics
        self._plan = plan
        self._numbers = numbers
        self._start = self._read_start(plan.start)
        self._states = self._needed(quantities)

    def follow(
        self, count: int, columns: Mapping[str, Array], times: Array, tick: Callable[[int], None]
    ) -> Flights:
        """All motions together.

        Args:
            count: of motions.
            columns: SI values of what differs, by published name, shape (motions,).
            times: s, increasing, above 0, the last of them the duration.
            tick: told the number of motions that are done.
        """
        constants = self._filled(self._dynamics.parameters, self._numbers, columns, count)
        begin = self._filled(self._dynamics.states, self._start, columns, count)
        fine = self._fine(begin, constants)
        place = {s: i for i, s in enumerate(self._dynamics.states)}
        rest = np.zeros(count)
        own = np.array([begin[place[s]] if s in place else rest for s in self._states])
        found = Flights(
            kept=fine,
            end=np.full(count, times[-1]),
            ending=np.full(count, NONE),
            _states=np.full((len(times) + 1, *own.shape), np.nan),
            _parameters=constants,
            _times=np.append(0.0, times),
            _mode=self,
        )
        which = np.flatnonzero(fine)
        arrivals = self._lanes.follow(own[:, which], constants[:, which], times, tick)
        alone = np.array([not ending.kind for ending in self.endings] + [False])
        found._states[:, :, which] = np.concatenate([own[None, :, which], arrivals.states])
        found.kept[which] = arrivals.good & ~alone[arrivals.guard]
        found.end[which] = arrivals.end
        found.ending[which] = arrivals.guard
        return found

    def values(
        self, quantity: str | Symbol | Expr, states: Array, parameters: Array, clock: Array
    ) -> Array:
        """A quantity of many motions, shape (motions,)."""
        function = self._dynamics.function([self._expression(quantity)], self._lanes.arguments)
        with np.errstate(all="ignore"):
            (found,) = function(*states, *[0.0] * len(self._idle), *parameters, clock)
        return np.array(np.broadcast_to(found, clock.shape), dtype=float)

    # -- what is integrated ---------------------------------------------------------------------

    def _expression(self, quantity: str | Symbol | Expr) -> Expr:
        if isinstance(quantity, Expr):
            return quantity
        name = quantity if isinstance(quantity, str) else quantity.published
        return look_up(name, self._readable, "quantity of this system")

    @cached_property
    def _readable(self) -> dict[str, Expr]:
        return readable(self._dynamics, {})

    @property
    def _rates(self) -> dict[Symbol, Expr]:
        dynamics = self._dynamics
        rates = dict(zip(dynamics.states, dynamics.rates, strict=True))
        return rates | {WORK: dynamics.equations.power}

    def _needed(self, quantities: Collection[str | Symbol | Expr]) -> tuple[Symbol, ...]:
        """The states that what is asked for depends on, and those that these depend on."""
        rates = self._rates
        asked = [self._expression(quantity) for quantity in quantities]
        wanted = self._read([*asked, *(ending.positive for ending in self.endings)])
        while wanted != (more := wanted | self._read([rates[s] for s in wanted])):
            wanted = more
        return tuple(s for s in rates if s in wanted) or tuple(self._dynamics.states)

    def _read(self, expressions: Sequence[Expr]) -> set[Symbol]:
        given = (*self._rates, *self._dynamics.parameters, CLOCK)
        places = self._dynamics.program(expressions, given).reads
        return {given[i] for i in places} & set(self._rates)

    @property
    def _idle(self) -> tuple[Symbol, ...]:
        return tuple(symbol for symbol in self._rates if symbol not in self._states)

    @cached_property
    def _lanes(self) -> Lanes:
        rates = self._rates
        return Lanes(
            self._dynamics,
            self._states,
            self._idle,
            [rates[s] for s in self._states],
            [ending.positive for ending in self.endings],
            self._plan.tolerance,
            driven=bool(self._dynamics.prescribed),
        )

    # -- starts ---------------------------------------------------------------------------------

    def _read_start(self, start: Mapping[Name, Any]) -> dict[Symbol, float]:
        """Start values of one motion.

        Raises:
            DeclarationError: for one that is no state of this mode.
        """
        names = by_name(self._dynamics.states)
        dimensions = getattr(self._dynamics.equations, "dimensions", {})
        return read_values(start, names, "state of this mode", dimensions, self._numbers)

    @staticmethod
    def _filled(
        symbols: Sequence[Symbol],
        common: Mapping[Symbol, float],
        columns: Mapping[str, Array],
        count: int,
    ) -> Array:
        """Values of symbols, shape (symbols, motions): what differs, what is common, or zero."""
        return np.array(
            [columns.get(s.published, np.full(count, common.get(s, 0.0))) for s in symbols]
        )

    def _fine(self, begin: Array, parameters: Array) -> NDArray[np.bool_]:
        """Starts that are regular and clear of every guard, and numbers that bodies can have."""
        dynamics = self._dynamics
        guards = [ending.positive for ending in self.endings]
        rates = self._at_start(dynamics.rates, begin, parameters)
        clear = self._at_start(guards, begin, parameters)
        least = _CLEAR * np.max(np.abs(np.nan_to_num(clear)), axis=1, initial=0.0, keepdims=True)
        fine = np.all(np.isfinite(rates), axis=0) & np.all(clear > least, axis=0)
        for symbol, values in zip(dynamics.parameters, parameters, strict=True):
            fine &= (values > 0) | (not symbol.positive)
        mass = dynamics.equations.mass
        if mass == mass.T:
            fine &= self._moments(mass, begin, parameters, fine)[:, 0] > 0
        for body in getattr(dynamics.equations.system, "bodies", ()):
            fine &= self._at_start([body.mass], begin, parameters)[0] > 0
            first, second, third = self._moments(body.inertia, begin, parameters, fine).T
            fine &= (first >= 0) & (first + second >= third * (1 - _ROUNDING))
        return np.asarray(fine, dtype=bool)

    def _moments(
        self, matrix: Matrix, begin: Array, parameters: Array, fine: NDArray[np.bool_]
    ) -> Array:
        """Eigenvalues of a symmetric matrix at every start, rising; shape (motions, size)."""
        size = len(matrix.rows)
        entries = self._at_start([e for row in matrix.rows for e in row], begin, parameters)
        usual = np.where(fine, entries, np.eye(size).reshape(-1, 1)).T
        return np.asarray(np.linalg.eigvalsh(usual.reshape(-1, size, size)))

    def _at_start(self, expressions: Sequence[Expr], begin: Array, parameters: Array) -> Array:
        """Values at every start, shape (expressions, motions)."""
        with np.errstate(all="ignore"):
            found = self._dynamics.function(expressions)(*begin, *parameters, 0.0)
        values = [np.broadcast_to(v, begin.shape[1:]) for v in found]
        return np.array(values, dtype=float).reshape(len(values), begin.shape[1])


def abreast(
    subject: Automaton | EquationsOfMotion,
    plan: Plan,
    quantities: Collection[str | Symbol | Expr],
) -> Abreast | None:
    """The first mode of a system for many motions; None where they cannot be followed at once.

    Raises:
        DeclarationError: for numbers that are not known, missing or impossible.
    """
    integrator = chosen()
    if integrator.name != "heyoka":
        return None
    if isinstance(subject, Automaton) and not (subject.contacts and can_be_followed(subject)):
        subject = subject.together.equations
    if not isinstance(subject, Automaton):
        return _as_declared(subject, plan, quantities)
    drive = drive_of(subject.functions, plan.forcing, plan.duration)
    if drive.pieces:
        return None
    equations = subject.together.equations
    idle = idle_parameters(equations, plan.parameters)
    common = Dynamics(equations, drive.expressions, (*subject.parameters, *idle))
    numbers = read_parameters(common, plan.parameters)
    machine = Machine(subject, drive, numbers, integrator, plan.tolerance)
    check_numbers(machine)
    mode = machine.mode(subject.together.phases)
    name, guards = mode.mode.name, mode.mode.guards
    endings = [_ending(guard.kind, guard.positive, name, plan) for guard in guards]
    return Abreast(mode.dynamics, name, endings, plan, quantities, numbers)


def _ending(kind: str, positive: Expr, mode: str, plan: Plan) -> Ending:
    if kind == "near-flat":
        return Ending(positive - plan.near_flat, "goes flat", kind)
    return Ending(positive, kind if kind in plan.until else "", mode)


def _as_declared(
    equations: EquationsOfMotion, plan: Plan, quantities: Collection[str | Symbol | Expr]
) -> Abreast | None:
    drive: Drive = drive_of(equations.functions, plan.forcing, plan.duration)
    if drive.pieces or equations.closures:
        return None
    dynamics = Dynamics(equations, drive.expressions, idle_parameters(equations, plan.parameters))
    numbers = read_parameters(dynamics, plan.parameters)
    endings = [Ending(side, "", AS_DECLARED) for side in equations.assumed_positive]
    return Abreast(dynamics, AS_DECLARED, endings, plan, quantities, numbers)

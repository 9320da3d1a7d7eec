"""A computed motion, and everything that can be read from it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from polhode.algebra import ZERO, Expr, Symbol, arrays
from polhode.base import NumericError, look_up
from polhode.simulate._csv import write_csv
from polhode.simulate._drift import Drift, drift_of
from polhode.simulate._driver import Solution
from polhode.simulate._dynamics import CLOCK, Dynamics, EquationsOfMotion
from polhode.simulate._flow import WORK
from polhode.simulate._integrators import Array

_MOST_CHECKED = 20_000  # instants at which the drift is looked at


@dataclass(frozen=True)
class Event:
    """A change of contact mode, or the start or end of the motion (then one mode is None)."""

    time: float
    kind: str
    before: str | None
    after: str | None

    def as_json(self) -> dict[str, Any]:
        """As the command line prints it."""
        return {"time": self.time, "kind": self.kind, "from": self.before, "to": self.after}


@dataclass(frozen=True)
class Trajectory:
    """A motion over [0, duration], known at every instant.

    Quantities are read by published name (`run["theta"]`, `run["F_z"]`, `run["energy"]`) or as
    any expression in symbols of the system. All are in SI units.

    Attributes:
        dynamics: the equations of motion and prescribed functions behind it.
        parameters: value of every parameter by name.
        duration: s.
        t: times of the samples, s.
        mode: name of the contact mode.
        events: start and end.
        assumed: start values that were not given, by name.
        seconds: time spent to derive, compile and integrate.
        integrator: what integrated it.
        invariants: expressions that the motion should keep constant, watched by `drift`.
    """

    dynamics: Dynamics
    parameters: Mapping[str, float]
    duration: float
    t: Array
    mode: str
    events: tuple[Event, ...]
    assumed: Mapping[str, float]
    seconds: Mapping[str, float]
    integrator: str
    invariants: Mapping[str, Expr]
    _solution: Solution = field(repr=False)

    @property
    def equations(self) -> EquationsOfMotion:
        """The equations of motion."""
        return self.dynamics.equations

    @cached_property
    def quantities(self) -> dict[str, Expr]:
        """Everything that can be read by name.

        "power" is that of all that is not in the potential, "work" what it did since the start.
        """
        equations = self.equations
        rates = (*equations.speeds, *equations.kinematics, *equations.dependent)
        moving = (*equations.coordinates, *rates, *(rate.derivative() for rate in rates))
        symbols = (CLOCK, *moving, *self.dynamics.parameters, *equations.functions)
        return {
            **{symbol.published: Expr.generator(symbol) for symbol in symbols},
            **equations.components,
            "energy": equations.energy,
            "power": equations.power,
            "work": Expr.generator(WORK) if WORK in self._solution.symbols else ZERO,
            **self.invariants,
        }

    def at(self, t: float | Array) -> dict[str, Array]:
        """Coordinates, speeds and rates at one or more times, by name; shaped like `t`."""
        return self.table(self._states, t)

    def __getitem__(self, name: str | Symbol | Expr) -> Array:
        """A quantity at the sample times `t`, shape (samples,)."""
        return self.evaluate(name)

    def evaluate(self, quantity: str | Symbol | Expr, t: float | Array | None = None) -> Array:
        """A quantity, by name or as an expression, at some times (the samples); shaped like them.

        Raises:
            DeclarationError: for a name or symbol that the system does not have.
            NumericError: for a time outside the motion, or an undetermined reaction.
        """
        times = self.t if t is None else self._times(t)
        return np.asarray(self._values([self._expression(quantity)], times)[0])

    def table(self, names: Iterable[str], t: float | Array | None = None) -> dict[str, Array]:
        """Several quantities by name, computed together."""
        times, names = self.t if t is None else self._times(t), list(names)
        values = self._values([self._expression(name) for name in names], times)
        return dict(zip(names, values, strict=True))

    @property
    def reactions(self) -> tuple[str, ...]:
        """Names of the reaction components that Newton's laws determine."""
        loose = self.equations.undetermined
        return tuple(name for name in self.equations.components if name not in loose)

    @cached_property
    def final(self) -> dict[str, Any]:
        """Everything at the end of the motion, by name, and the mode it ends in."""
        names = (*self._states, *self.reactions, "energy")
        values = self.table(names, self.duration)
        return {**{name: float(value) for name, value in values.items()}, "mode": self.mode}

    @cached_property
    def drift(self) -> Drift:
        """Largest drift of energy, constraints and invariants over the steps and samples."""
        steps = self._solution.steps
        picked = steps[:: len(steps) // _MOST_CHECKED + 1]
        times = np.unique(np.concatenate([[0.0], picked, self.t, [self.duration]]))
        return drift_of(
            self.dynamics,
            self.invariants,
            self.evaluate("work", times),
            lambda expressions: self._values(expressions, times),
        )

    def to_csv(self, path: str | Path, names: Iterable[str] | None = None) -> None:
        """Write the samples: by default coordinates, speeds, rates, reactions and energy.

        A line that begins with # says what the file was made with. A file already there is
        replaced only once the new one is complete.

        Raises:
            StoreError: where the file cannot be written.
        """
        chosen = list(names) if names is not None else [*self._states, *self.reactions, "energy"]
        origin = {
            "system": self.equations.system.name,
            "mode": self.mode,
            "parameters": dict(self.parameters),
            "assumed": dict(self.assumed),
            "integrator": self.integrator,
        }
        write_csv(Path(path), {"t": self.t, **self.table(chosen)}, origin)

    @cached_property
    def _states(self) -> tuple[str, ...]:
        equations = self.equations
        symbols = (*self.dynamics.states, *equations.kinematics, *equations.dependent)
        return tuple(dict.fromkeys(symbol.published for symbol in symbols))

    def _expression(self, quantity: str | Symbol | Expr) -> Expr:
        if isinstance(quantity, Symbol):
            return Expr.generator(quantity)
        if not isinstance(quantity, str):
            return Expr.of(quantity)
        if quantity in self.equations.undetermined:
            raise NumericError(
                f"the reaction {quantity} is not determined by Newton's laws",
                expected=f"one of {', '.join(self.reactions)}",
                advice="evaluate equations.least[...] for the choice of least forces",
            )
        return look_up(quantity, self.quantities, "quantity of this system")

    def _times(self, t: float | Array) -> Array:
        times = np.asarray(t, dtype=float)
        if not np.all((times >= 0) & (times <= self.duration)):
            raise NumericError(
                f"times from {np.min(times):g} s to {np.max(times):g} s",
                expected=f"times within the motion, from 0 to {self.duration:g} s",
            )
        return times

    def _values(self, expressions: Iterable[Expr], times: Array) -> Array:
        """Values of expressions, shape (expressions, *shape of times)."""
        arguments = (*self._solution.symbols, *self.dynamics.parameters, CLOCK)
        program = self.dynamics.program(expressions, arguments, self._solution.turned)
        states = self._solution.at(times.ravel()).reshape(-1, *times.shape)
        with np.errstate(all="ignore"):
            values = program.function(arrays())(*states, *self.parameters.values(), times)
        return np.array([np.broadcast_to(value, times.shape) for value in values])

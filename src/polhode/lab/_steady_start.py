"""Whether a steady motion can be started from, and whether the contacts hold on it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from polhode.algebra import FLOATS, Expr, Symbol, compile_program, pi
from polhode.analyse import ContactForces, contact_forces
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.model import Contact, Coulomb, System
from polhode.simulate import Dynamics, read_parameters, read_start

Values = Mapping[str, float]
Name = str | Symbol | Expr

_PI = 3.141592653589793


@dataclass(frozen=True)
class SteadyStart:
    """Steady motions of one system as starts.

    Attributes:
        equations: of motion with every contact touching, and sticking where it can.
        system: as it is declared, with the friction of its contacts.
    """

    equations: Equations
    system: System

    def is_possible(self, state: Values) -> bool:
        """Whether a run can start from a state: not where the coordinates are singular.

        Args:
            state: parameters, coordinates and speeds in SI units, by published name.
        """
        own = (*self.equations.coordinates, *self.equations.speeds)
        constants = {s.published: s for s in self._dynamics.parameters}
        try:
            given: dict[Name, Any] = {n: v for n, v in state.items() if n in constants}
            numbers = read_parameters(self._dynamics, given)
            names = (s.published for s in own)
            start: dict[Name, Any] = {name: state[name] for name in names if name in state}
            read_start(self._dynamics, start, numbers)
        except PolhodeError:
            return False
        return True

    def broken(self, state: Values) -> str:
        """Which contact does not hold on a steady motion, and why; empty where all do."""
        for name, (forces, friction) in self._contacts.items():
            normal = value(forces.normal, state)
            if not normal > 0:
                return f"{name} lifts off: it would have to pull"
            needed = abs(value(forces.tangential, state)) / normal
            if friction is not None and not needed <= value(friction, state):
                return f"{name} slips: it needs a coefficient of friction of {needed:.3g}"
        return ""

    @cached_property
    def _dynamics(self) -> Dynamics:
        return Dynamics(self.equations, {})

    @cached_property
    def _contacts(self) -> dict[str, tuple[ContactForces, Expr | None]]:
        """Forces of every contact, and the friction that there is where it can slide."""
        found: dict[str, tuple[ContactForces, Expr | None]] = {}
        for element in self.system.elements:
            if isinstance(element, Contact):
                friction = element.mu_static if isinstance(element, Coulomb) else None
                found[element.name] = (contact_forces(self.equations, element.name), friction)
        return found


def value(expression: Expr, known: Values) -> float:
    """An expression of known quantities, the others being zero; not a number where undefined."""
    symbols: tuple[Symbol, ...] = tuple(expression.symbols())
    values = {**known, **{s.published: _PI for s in pi.symbols()}}
    function = compile_program([expression], symbols).function(FLOATS)
    try:
        return float(function(*(values.get(s.published, 0.0) for s in symbols))[0])
    except (ArithmeticError, ValueError):
        return float("nan")

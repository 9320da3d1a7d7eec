"""Steady motions of a system, their stability, and where a state stands relative to them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import isfinite, prod
from typing import Any

import numpy as np

from polhode.algebra import FLOATS, ZERO, Expr, Symbol, compile_program, eliminate, pi
from polhode.analyse import (
    Branch,
    Condition,
    ContactForces,
    Stability,
    SteadyMotion,
    Truth,
    contact_forces,
    invariants,
    stability,
    steady,
)
from polhode.base import NumericError, PolhodeError
from polhode.derive import Equations
from polhode.model import Contact, Coulomb, System
from polhode.simulate import Dynamics, read_parameters, read_start
from polhode.view import equation, state_unit, typeset

Values = Mapping[str, float]
Name = str | Symbol | Expr

# Values set by sliders are rounded: such a state is on a family only to a few digits.
_NEAR = 1e-5  # residual over the size of its terms, below which a state is on a family
_LARGEST = 1e15  # larger values are shown as undefined
_REMEMBERED = 512  # typeset formulas: the same ones are shown for every position of a slider
_LONGEST = 1500  # characters of a formula that is still shown


@dataclass(frozen=True)
class SteadyStart:
    """Whether runs of one system can start from its steady motions, and stay on them.

    Attributes:
        equations: of motion with every contact touching, and sticking where it can.
        system: as it is declared, with the friction of its contacts.
    """

    equations: Equations
    system: System

    def is_possible(self, state: Values) -> bool:
        """Whether a run can start from a state; not if the coordinates are singular there.

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
        """Which contact lifts off or slips on a steady motion, and why; empty if all hold."""
        for name, (forces, friction) in self._contacts.items():
            normal = value(forces.normal, state)
            if not normal > 0:  # including values that are not a number
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
        """Forces of every contact, and its coefficient of static friction if it can slide."""
        found: dict[str, tuple[ContactForces, Expr | None]] = {}
        for element in self.system.elements:
            if isinstance(element, Contact):
                friction = element.mu_static if isinstance(element, Coulomb) else None
                found[element.name] = (contact_forces(self.equations, element.name), friction)
        return found


def value(expression: Expr, known: Values) -> float:
    """An expression at known values, others being zero; not-a-number where undefined."""
    symbols: tuple[Symbol, ...] = tuple(expression.symbols())
    values = {**known, **{s.published: math.pi for s in pi.symbols()}}
    function = compile_program([expression], symbols).function(FLOATS)
    try:
        return float(function(*(values.get(s.published, 0.0) for s in symbols))[0])
    except (ArithmeticError, ValueError):
        return float("nan")


# -- families --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class SteadyFamily:
    """A family of steady motions with what is known of its stability.

    Attributes:
        motion: the family.
        system: that it is a motion of, with its contacts.
    """

    motion: SteadyMotion
    system: System

    @cached_property
    def judged(self) -> Stability | NumericError:
        """Its stability, or why these coordinates cannot decide it."""
        try:
            return stability(self.motion)
        except NumericError as undecided:
            return undecided

    def standing(self, state: Values) -> dict[str, Any]:
        """The family as plain data, with every quantity's value at a state.

        Conditions apply to states on the family: only there is a `verdict` given, for all of them
        together. For a state off the family they are evaluated at the steady motion with the same
        free quantities, if there is one.

        Args:
            state: parameters, coordinates and speeds in SI units, by published name.
        """
        there = {**state, **self._held(state)}
        is_here, is_there = (self._distance(s) < _NEAR for s in (state, there))
        document: dict[str, Any] = {
            "formula": _formula(self.motion.latex()),
            "spoken": str(self.motion)[:_LONGEST],
            "on": _finite(self._distance(state)),
            "here": is_here,
            "broken": self._start.broken(there) if is_here else "",
            "branches": [self._branch(branch, there) for branch in self.motion.branches],
            "set": {n: v for n, v in self._held(state).items() if isfinite(v)},
            "startable": self._is_possible(there),
            "verdict": "",
        }
        if isinstance(self.judged, NumericError):
            return document | {"undecided": str(self.judged), "conditions": [], "frequencies": []}
        if is_here and not document["broken"]:
            document["verdict"] = self._verdict(self.judged, there)
        return document | {
            "stable": self.judged.truth.value,
            "conditions": [_condition(c, there, is_there) for c in self.judged.conditions],
            "frequencies": [_named(e, there, is_there) for e in self.judged.frequencies],
            "growth": [_named(e, there, is_there) for e in self.judged.growth],
            "loss": self.judged.loss,
        }

    @cached_property
    def _start(self) -> SteadyStart:
        return SteadyStart(self.motion.reduced.equations, self.system)

    @cached_property
    def _is_singular(self) -> bool:
        """Whether the coordinates are singular (det M = 0) all along the family, exactly."""
        mass = self.motion.reduced.equations.mass.rows
        rows = [[entry.subs(self.motion.fixed) for entry in row] for row in mass]
        return bool(eliminate(rows, [ZERO] * len(rows)).free)

    def _is_possible(self, start: Values) -> bool:
        on_it = self._distance(start) < _NEAR and not self._is_singular
        return on_it and self._start.is_possible(start)

    def _verdict(self, judged: Stability, here: Values) -> str:
        """Whether a state on the family is stable, by all conditions together."""
        if judged.truth is not Truth.OPEN:
            return "stable" if judged.truth is Truth.ALWAYS else "unstable"
        holding = (value(c.expression, here) > 0 for c in judged.conditions)
        return "stable" if all(holding) else "unstable"

    def _branch(self, branch: Branch, here: Values) -> dict[str, Any]:
        name, equations = branch.quantity.symbol, self.motion.reduced.equations
        rate = value(branch.value, here)
        there = {**here, name.published: rate} if name and isfinite(rate) else {}
        return {
            "formula": _formula(f"{branch.quantity.latex()} = {branch.value.latex()}"),
            "name": name.published if name else "",
            "unit": state_unit(name, equations) if name else "",
            "value": _finite(rate),
            "startable": bool(there) and self._is_possible(there),
        }

    def _held(self, state: Values) -> dict[str, float]:
        """Values of the quantities that the family determines."""
        return {s.published: value(e, state) for s, e in self.motion.fixed.items()}

    def _distance(self, state: Values) -> float:
        """Distance of a state from the family: the largest residual of its conditions, each
        divided by the sum of the sizes of its terms, with sines and cosines taken as one."""
        return max((_departure(e, state) for e in self.motion.conditions), default=0.0)


def _departure(expression: Expr, state: Values) -> float:
    # Divided by its terms, a residual is free of dimensions. Sines and cosines count as one: the
    # size must not vanish with them where the condition holds because they do.
    known = {"pi": np.pi, **state}
    size = sum(
        abs(number)
        * prod(
            abs(known.get(g.published, 0.0)) ** power
            for g, power in powers.items()
            if isinstance(g, Symbol)
        )
        for powers, number in expression.numerator.terms()
    )
    return abs(value(expression.numerator, state)) / size if size else 0.0


def families_of(equations: Equations, system: System) -> list[SteadyFamily]:
    """All families; none where there is no steady motion or none can be found.

    Args:
        equations: of motion with every contact touching, and sticking where it can.
        system: as it is declared, with the friction of its contacts.
    """
    try:
        return [SteadyFamily(motion, system) for motion in steady(equations)]
    except PolhodeError:
        return []


def _condition(condition: Condition, here: Values, is_on: bool) -> dict[str, Any]:
    """An inequality, and the ratio of the sum of its positive terms to that of its negative ones.

    The ratio is one at the threshold. Off the family it is not defined.
    """
    if condition.truth is not Truth.OPEN:
        return {"formula": "", "spoken": condition.truth.value, "ratio": None}
    stated = {"formula": _formula(condition.latex()), "spoken": str(condition)[:_LONGEST]}
    if not is_on:
        return {**stated, "ratio": None}
    terms = [value(term, here) for term in condition.expression.summands()]
    above, below = sum(t for t in terms if t > 0), -sum(t for t in terms if t < 0)
    ratio = above / below if below else float("inf")
    return {**stated, "holds": above > below, "ratio": _finite(ratio)}


def _named(expression: Expr, here: Values, is_on: bool) -> dict[str, Any]:
    found = _finite(value(expression, here)) if is_on else None
    return {"formula": _formula(expression.latex()), "value": found, "on": is_on}


@lru_cache(_REMEMBERED)
def _formula(latex: str) -> str:
    return typeset(latex) if len(latex) <= _LONGEST else ""


def _finite(value: float) -> float | None:
    """None for a value that is undefined or unreasonably large."""
    return value if isfinite(value) and abs(value) < _LARGEST else None


# -- first integrals -------------------------------------------------------------------------------


def invariants_of(equations: Equations) -> list[dict[str, Any]]:
    """First integrals with their names and meanings, typeset; none where they cannot be found."""
    try:
        found = invariants(equations)
    except PolhodeError:
        return []
    typeset = (equation("", Expr.generator(Symbol(i.name)), i.expression) for i in found)
    return [
        {"name": i.name, "meaning": i.meaning, "pieces": list(made.pieces), "spoken": made.spoken}
        for i, made in zip(found, typeset, strict=True)
    ]

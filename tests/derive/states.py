"""Equations put into numbers at given states, and the random states to put them at."""

from __future__ import annotations

import cmath
from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from typing import Any

import numpy as np
import pytest

from polhode.algebra import FLOATS, Arithmetic, Expr, Symbol, compile_program, variables
from polhode.derive import Equations

Values = Mapping[str, Any]
Evaluator = Callable[[Values], tuple[Any, ...]]
Named = Callable[[Values], dict[str, Any]]
COMPLEX = Arithmetic.of(cmath)


class Numeric:
    """Equations as functions of numbers, which are given by published name."""

    def __init__(self, equations: Equations) -> None:
        self.equations = equations

    def at(self, **values: float) -> dict[str, float]:
        """Rates, dependent speeds, accelerations, reactions, power, and both energies' rates.

        Reactions that are not determined are the least ones.
        """
        known = values | self._accelerations(values)
        known |= self._dependent_values(known)
        known |= {rate_name(name): rate for name, rate in self._changes(known).items()}
        return known | self._forces_and_power(known)

    def _accelerations(self, values: Values) -> dict[str, float]:
        system = np.array(self._system(values))
        size = len(self.equations.speeds)
        mass, forcing = system[: size * size].reshape(size, size), system[size * size :]
        names = [s.published for s in self.equations.acceleration_symbols]
        return dict(zip(names, np.linalg.solve(mass, forcing).tolist(), strict=True))

    def _changes(self, known: Values) -> dict[str, float]:
        """Rates along the motion by a complex step: exact to rounding."""
        step = 1e-30
        ahead = {n: v + 1j * step * known.get(rate_name(n), 0.0) for n, v in known.items()}
        moved = self._moved(ahead)
        return {name: later.imag / step for name, later in moved.items()}

    @cached_property
    def _system(self) -> Evaluator:
        entries = [e for row in self.equations.mass.rows for e in row]
        return evaluator([*entries, *self.equations.forcing])

    @cached_property
    def _moving(self) -> dict[str, Expr]:
        equations = self.equations
        given = {**equations.kinematics, **equations.dependent}
        named = {s.published: e for s, e in given.items() if s not in equations.speeds}
        return named | {"T": equations.kinetic_energy, "V": equations.potential_energy}

    @cached_property
    def _dependent_values(self) -> Named:
        return by_name(self._moving)

    @cached_property
    def _moved(self) -> Named:
        return by_name(self._moving, COMPLEX)

    @cached_property
    def _forces_and_power(self) -> Named:
        return by_name({**self.equations.least, "power": self.equations.power})


def rate_name(name: str) -> str:
    """x → x_dot, x_dot → x_ddot, omega_3 → omega_3_dot."""
    return f"{name.removesuffix('_dot')}_ddot" if name.endswith("_dot") else f"{name}_dot"


def by_name(expressions: Mapping[str, Expr], numbers: Arithmetic = FLOATS) -> Named:
    """Named expressions as a function of a dictionary of numbers to another."""
    found = evaluator(expressions.values(), numbers)
    return lambda values: dict(zip(expressions, found(values), strict=True))


def evaluator(expressions: Iterable[Expr], numbers: Arithmetic = FLOATS) -> Evaluator:
    """The expressions as a function of a dictionary of numbers, by published name."""
    wanted = list(expressions)
    arguments = sorted(variables(wanted) - {Symbol("pi")}, key=lambda s: s.published)
    program = compile_program(wanted, arguments).function(numbers)
    return lambda values: program(*(values[s.published] for s in arguments))


def value(expression: Expr, values: Values) -> float:
    """One expression in numbers."""
    return float(evaluator([expression])(values)[0])


def agree(found: Values, expected: Values, names: Iterable[str], tolerance: float = 1e-12) -> None:
    """Both have the same numbers under these names, relative to the largest of them."""
    chosen = list(names)
    scale = max(1.0, *(abs(expected[name]) for name in chosen))
    ours = {name: found[name] for name in chosen}
    theirs = {name: expected[name] for name in chosen}
    assert ours == pytest.approx(theirs, rel=tolerance, abs=tolerance * scale)


def draw(names: str, seed: int, **fixed: float) -> dict[str, float]:
    """Numbers at random: velocities of either sign, angles of any size, parameters positive.

    `theta` and `lambda_` stay between 0.2 and 2.9, where the sine is positive.
    """
    rng = np.random.default_rng(seed)
    return {name: _one(name, rng) for name in names.split()} | fixed


POLAR = ("theta", "lambda_")
PLACES = ("phi", "psi", "alpha", "beta", "gamma", "chi", "x", "y", "z", "X", "Y")
MOVING = ("omega", "v", "Omega")


def _one(name: str, rng: np.random.Generator) -> float:
    if name in POLAR:
        return float(rng.uniform(0.2, 2.9))
    if name.endswith(("_dot", "_ddot")) or name.split("_")[0] in (*PLACES, *MOVING, "theta"):
        return float(rng.uniform(-3, 3))
    return float(rng.uniform(0.3, 2))

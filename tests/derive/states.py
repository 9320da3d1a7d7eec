"""Equations put into numbers at given states, and the random states to put them at."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any

import numpy as np
import pytest

from polhode.algebra import Expr, Symbol, compile_program, eliminate, variables
from polhode.derive import Equations

Values = Mapping[str, float]


class Numeric:
    """Equations as functions of numbers, which are given by published name."""

    def __init__(self, equations: Equations) -> None:
        self.equations = equations

    def at(self, **values: float) -> dict[str, float]:
        """Rates, dependent speeds, accelerations, reactions, and the rates of both energies.

        Reactions that are not determined are the least ones.
        """
        system = self._system(values)
        size = len(self.equations.speeds)
        mass, forcing = np.array(system[: size * size]), np.array(system[size * size :])
        found = np.linalg.solve(mass.reshape(size, size), forcing) if size else forcing
        names = (s.published for s in self.equations.acceleration_symbols)
        known = {**values, **dict(zip(names, map(float, found), strict=True))}
        return known | dict(zip(self._answers, self._read(known), strict=True))

    @cached_property
    def _system(self) -> Any:
        entries = [e for row in self.equations.mass.rows for e in row]
        return evaluator([*entries, *self.equations.forcing])

    @cached_property
    def _read(self) -> Any:
        return evaluator(self._answers.values())

    @cached_property
    def _answers(self) -> dict[str, Expr]:
        equations, motion = self.equations, self.equations.kinetics
        told = {**equations.kinematics, **equations.dependent}
        named = {s.published: e for s, e in told.items() if s not in equations.speeds}
        rates = {
            s.derivative().published: e.chain(motion.rate)
            for s, e in told.items()
            if s not in equations.speeds
        }
        energies = {"T": equations.kinetic_energy, "V": equations.potential_energy}
        changes = {f"{name}_dot": e.chain(motion.rate) for name, e in energies.items()}
        return named | rates | energies | changes | equations.least | {"power": equations.power}


def evaluator(expressions: Iterable[Expr]) -> Any:
    """The expressions as a function of a dictionary of numbers, by published name."""
    wanted = list(expressions)
    arguments = sorted(variables(wanted) - {Symbol("pi")}, key=lambda s: s.published)
    program = compile_program(wanted, arguments).function()
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


def lagrange(equations: Equations) -> tuple[Expr, ...]:
    """Lagrange's equations of a holonomic system, one for every independent speed.

    d/dt ∂L/∂q̇ - ∂L/∂q for every coordinate, summed with the rate of it that a unit of the speed
    makes: virtual work in the motions that the speed alone makes.
    """
    motion = equations.kinetics
    on_rates = equations.lagrangian.subs(_speeds_in_rates(equations))
    coordinates = {s: Expr.generator(s) for s in equations.coordinates}
    forces = {s: on_rates.diff(q.dt()).dt() - on_rates.diff(q) for s, q in coordinates.items()}
    settled = {s: _on_speeds(force, equations) for s, force in forces.items()}
    return tuple(
        sum(
            (settled[s] * motion.kinematics[s.derivative()].diff(u) for s in coordinates),
            Expr.constant(0),
        )
        for u in equations.speeds
    )


def _on_speeds(expression: Expr, equations: Equations) -> Expr:
    """With rates of coordinates, and rates of those, put in terms of speeds and accelerations."""
    rates = {s: e for s, e in equations.kinematics.items() if s not in equations.speeds}
    second = {s.derivative(): e.chain(equations.kinetics.rate) for s, e in rates.items()}
    return expression.subs({**rates, **second})


def _speeds_in_rates(equations: Equations) -> dict[Symbol, Expr]:
    """The independent speeds as the rates of coordinates make them."""
    still = dict.fromkeys(equations.speeds, 0)
    rows = {r: [e.diff(u) for u in equations.speeds] for r, e in equations.kinematics.items()}
    carried = {r: e.subs(still) for r, e in equations.kinematics.items()}
    moving = [r for r, row in rows.items() if any(row)]
    right = [Expr.generator(r) - carried[r] for r in moving]
    solved = eliminate([rows[r] for r in moving], right).solved
    return {u: solved[i][1] for i, u in enumerate(equations.speeds)}

"""Simulation and closed form after a million turns, and near the separatrix in many digits.

The equations that are integrated are compiled as `simulate` does, but with all of heyoka's
optimisations, so that a million turns take a minute. Only what determines its own course is
integrated, and the angle that grows: counted apart, from zero every ten turns, as large angles
loosen every tolerance.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import pi
from typing import Any

import numpy as np
import pytest

from analyse.systems import equations
from polhode.algebra import FLOATS, Arithmetic, Expr, Symbol, compile_program
from polhode.analyse import ClosedForm, closed_form
from polhode.derive import Equations
from proof.ledger import Ledger

LEGS, TURNS_OF_LEG = 100_000, 10
EPS = 2.0**-52


@dataclass(frozen=True)
class LongRun:
    """Some states of a system, integrated by themselves.

    Attributes:
        equations: of the system.
        names: of the states.
        values: of these at the start, and of all that is constant.
    """

    equations: Equations
    names: tuple[str, ...]
    values: Mapping[str, Any]

    @cached_property
    def known(self) -> dict[str, Symbol]:
        """Every symbol that has a value, by its name."""
        derived = self.equations
        everything = (*derived.coordinates, *derived.speeds, *derived.parameters)
        return {s.published: s for s in everything if s.published in self.values}

    def compiled(self, number: Any, **precision: Any) -> Any:
        """heyoka's integrator of numbers made by `number`."""
        heyoka = pytest.importorskip("heyoka")
        constant = [name for name in self.known if name not in self.names]
        arguments = tuple(self.known[name] for name in (*self.names, *constant))
        rates = [self.equations.rate(Expr.generator(self.known[name])) for name in self.names]
        function = compile_program(rates, arguments).function(Arithmetic.of(heyoka))
        states = [heyoka.make_vars(f"x{i}") for i in range(len(self.names))]
        fixed = [heyoka.par[i] for i in range(len(constant))]
        return heyoka.taylor_adaptive(
            list(zip(states, function(*states, *fixed), strict=True)),
            np.array([number(self.values[name]) for name in self.names]),
            pars=np.array([number(self.values[name]) for name in constant]),
            **precision,
        )

    def legs(self, duration: float, growing: tuple[str, ...]) -> Iterator[dict[str, float]]:
        """The state after each leg, the growing angles with all their turns."""
        taylor = self.compiled(float, tol=EPS)
        turned = dict.fromkeys(growing, Fraction(0))
        while True:
            taylor.time = 0.0
            taylor.propagate_until(duration)
            state = dict(zip(self.names, map(float, taylor.state), strict=True))
            for name in growing:
                turned[name] += Fraction(state[name])
                state[name] = float(turned[name])
                taylor.state[self.names.index(name)] = 0.0
            yield state

    @cached_property
    def energy(self) -> Any:
        """J, as a function of a state."""
        names, symbols = tuple(self.known), tuple(self.known.values())
        function = compile_program([self.equations.energy], symbols).function(FLOATS)
        return lambda state: function(*({**self.values, **state}[name] for name in names))[0]


def entered(record_property, campaign: str, part: str, errors: list[float], bounds) -> None:
    """Enter the worst of the errors in the ledger, and judge it."""
    allowed, condition = bounds
    worst = int(np.argmax(errors))
    ledger = Ledger(campaign, part, len(errors))
    ledger.error(errors[worst], allowed, condition, f"after {worst + 1} of {len(errors)}")
    record_property("ledger", ledger.row())
    assert not ledger.failures, ledger.failures


def compare(run: LongRun, exact: ClosedForm, growing: tuple[str, ...], record_property) -> None:
    """Energy and every angle or rate, at the ends of all legs.

    An error of the energy changes the period by as much as the conditioning says, and that grows
    to an angle turn by turn: no integration can hold the angle better than its energy allows.
    """
    campaign = f"a million turns of {exact.name}"
    # A binary fraction, so that the times at the ends of legs are exact.
    duration = round(TURNS_OF_LEG * exact.period * 2**20) / 2**20
    expected = exact.at(duration * np.arange(1, LEGS + 1))
    begun = run.energy({})
    energies, angles = [], []
    for leg, state in zip(range(LEGS), run.legs(duration, growing), strict=False):
        energies.append(abs(run.energy(state) / begun - 1))
        angles.append(max(abs(state[name] - expected[name][leg]) for name in run.names))
    condition = exact.conditioning + exact.stepwise_conditioning
    entered(record_property, campaign, "energy", energies, (1e-12, 1.0))
    allowed = 2 * pi * LEGS * TURNS_OF_LEG * condition * max(energies)
    entered(record_property, campaign, "angle", angles, (allowed, condition))


SPEEDS = ("omega_1", "omega_2", "omega_3")


def test_free_body_for_a_million_rotations(record_property):
    numbers, start = {"I_1": 1, "I_2": 2, "I_3": 3}, dict(zip(SPEEDS, (0.3, 1.0, 2.0), strict=True))
    free = equations("tennis-racquet")
    run = LongRun(free, SPEEDS, numbers | start)
    compare(run, closed_form(free, numbers, start), (), record_property)


def test_top_released_from_rest_for_a_million_nutations(record_property):
    numbers = {"M": 1, "a": 1, "I_1": 1, "I_2": 1, "g": 2}
    start = {"theta": 1.0, "theta_dot": 0.0, "phi": 0.0, "phi_dot": 0.0, "omega_1": 6.0}
    top = equations("gyroscope")
    exact = closed_form(top, numbers, start)
    assert exact.kind == "cusps"
    run = LongRun(top, ("theta", "theta_dot", "phi", "phi_dot"), numbers | start)
    compare(run, exact, ("phi",), record_property)


@pytest.mark.parametrize("perturbation", ["1e-8", "1e-20"])
def test_flips_near_the_separatrix_in_many_digits(perturbation, record_property):
    """A disturbance d of the middle axis is in the integrals as d²: of 96 digits 40 are spent."""
    heyoka = pytest.importorskip("heyoka")
    numbers = {"I_1": 1, "I_2": 2, "I_3": 3}
    start = dict(zip(SPEEDS, (perturbation, "1", perturbation), strict=True))
    free = equations("tennis-racquet")
    exact = closed_form(free, numbers, start, digits=90)
    run = LongRun(free, SPEEDS, numbers | start)

    def many(value: Any) -> Any:
        return heyoka.real(str(value), 320)

    taylor = run.compiled(many, fp_type=heyoka.real, tol=many("1e-94"), compact_mode=True)
    errors = []
    for flips in range(1, 5):
        end = exact.data.context.nstr(flips * exact.period / 2 + exact.data.context.mpf(3) / 4, 96)
        taylor.propagate_until(many(end))
        expected = exact.at(end)
        state = dict(zip(SPEEDS, taylor.state, strict=True))
        errors.append(max(_apart(state[name], expected[name], exact) for name in SPEEDS))
    condition = exact.stepwise_conditioning
    bounds = (1e-92 * condition, condition)
    entered(record_property, f"four flips from {perturbation}", "angular velocity", errors, bounds)


def _apart(found: Any, expected: Any, exact: ClosedForm) -> float:
    return float(abs(exact.data.context.mpf(str(found)) - expected))

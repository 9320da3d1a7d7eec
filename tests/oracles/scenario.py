"""From the text's variables to placed bodies and back.

A scenario says where the parts are for given text variables. Everything else follows: the twists
are affine in the text's speeds, so their rates give the speeds' rates; derivatives are complex
steps, exact to round-off. Three things are verified every time, so that a slip in a placement
cannot pass: the velocities obey the constraints, the parts move as their velocities say, and the
speeds' rates reproduce the bodies' accelerations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import numpy as np

from .constraints import Constraint, Parts
from .newton_euler import Accelerations, Wrench, bodies_of, solve, supports_of, weights
from .parts import Array, zero

STEP = 1e-30
TOLERANCE = 1e-9
LAB_AXES = ("x", "y", "z")
TRIAD = ("1", "2", "3")


class Numbers(SimpleNamespace):
    """Parameters and variables of a system, by name."""


def numbers(given: Mapping[str, Any], *, needs: str, zero: str = "", **more: Any) -> Numbers:
    """The named numbers, those of `zero` being 0 unless given; a misspelt or missing one raises."""
    defaults = dict.fromkeys(zero.split(), 0.0)
    expected = {*needs.split(), *defaults}
    if set(needs.split()) - set(given) or set(given) - expected:
        raise TypeError(f"given {sorted(given)}; needs {needs}; may have {zero}")
    return Numbers(**{**defaults, **given, **more})


@dataclass(frozen=True, kw_only=True)
class Scenario:
    """Parts placed by `state`; `speeds` are the entries of it whose rates are sought.

    `rates` gives the known rates of the other entries that change, some read off the placed parts.
    """

    place: Callable[[Numbers], Parts]
    state: Numbers
    rates: Callable[[Numbers, Parts], Mapping[str, Any]]
    speeds: str
    constraints: Mapping[str, Constraint]
    gravity: Array = field(default_factory=zero)

    def answer(self) -> Answer:
        parts = self.place(self.state)
        self._require_constraints_hold(parts)
        flow = self._stepped(self.rates(self.state, parts))
        _require_parts_move_as_said(parts, flow)
        motion = solve(parts, self.constraints, weights(parts, self.gravity))
        speeds = self.speeds.split()
        per_speed = [_twist_rates(self._stepped({speed: 1.0})) for speed in speeds]
        wanted = _stacked(motion) - _twist_rates(flow)
        rates = np.linalg.lstsq(np.transpose(per_speed), wanted, rcond=None)[0]
        _require_equal(rates @ per_speed, wanted, "the speeds cannot express these accelerations")
        return Answer(
            parts, motion, self.gravity, dict(zip(speeds, map(float, rates), strict=True))
        )

    def _stepped(self, rates: Mapping[str, Any]) -> Parts:
        """The parts an imaginary instant later."""
        moved = {n: getattr(self.state, n) + 1j * STEP * rate for n, rate in rates.items()}
        return self.place(Numbers(**{**vars(self.state), **moved}))

    def _require_constraints_hold(self, parts: Parts) -> None:
        for name, constraint in self.constraints.items():
            residual = constraint.rows(parts).residual
            _require_equal(residual, 0 * residual, f"the velocities break the constraint {name}")


@dataclass(frozen=True)
class Answer:
    parts: Parts
    motion: Accelerations
    gravity: Array
    speed_rates: Mapping[str, float]

    def reaction(self, constraint: str, part: str) -> Wrench:
        """Force, and torque about the centre of mass, of a constraint on a body."""
        return self.motion.reactions[constraint][part]

    def report(self, *components: Mapping[str, float]) -> dict[str, float]:
        """Rates of the speeds and of both energies, with the given components."""
        report = {rate_name(speed): rate for speed, rate in self.speed_rates.items()}
        for each in components:
            report |= each
        return report | {"T_dot": self.kinetic_power, "V_dot": -self.weight_power}

    @property
    def kinetic_power(self) -> float:
        """Rate of the kinetic energy, from the accelerations: Σ m v·a + ω·Iα."""
        return sum(
            float(body.mass * body.velocity @ self.motion.linear[name])
            + float(body.omega @ body.inertia @ self.motion.angular[name])
            for name, body in bodies_of(self.parts).items()
        )

    @property
    def weight_power(self) -> float:
        bodies = bodies_of(self.parts).values()
        return sum(float(body.mass * self.gravity @ body.velocity) for body in bodies)


def rate_name(speed: str) -> str:
    """theta_dot → theta_ddot, omega_3 → omega_3_dot."""
    return f"{speed.removesuffix('_dot')}_ddot" if speed.endswith("_dot") else f"{speed}_dot"


def components(symbol: str, vector: Array, labels: Iterable[str], axes: Array) -> dict[str, float]:
    """Named components of a lab vector on the columns of `axes`."""
    values = np.transpose(axes) @ vector
    return {f"{symbol}_{label}": float(v) for label, v in zip(labels, values, strict=True)}


def lab_force(answer: Answer, symbol: str, constraint: str, body: str) -> dict[str, float]:
    force = answer.reaction(constraint, body).force
    return components(symbol, force, LAB_AXES, np.eye(3))


def _twist_rates(parts: Parts) -> Array:
    return np.concatenate([body.twist.imag for body in bodies_of(parts).values()]) / STEP


def _stacked(motion: Accelerations) -> Array:
    return np.concatenate([[*motion.linear[b], *motion.angular[b]] for b in motion.linear])


def _require_parts_move_as_said(parts: Parts, flow: Parts) -> None:
    for name, part in parts.items():
        moved = flow[name]
        what = f"the placement of {name} does not move as its "
        _require_equal(moved.position.imag / STEP, part.velocity, what + "velocity says")
        _require_equal(moved.rotation.imag / STEP, part.rotation_rate, what + "spin says")
    for name, support in supports_of(parts).items():
        what = f"the placement of {name} does not move as its accelerations say"
        _require_equal(flow[name].twist.imag / STEP, support.twist_rate, what)


def _require_equal(found: Array, expected: Array, complaint: str) -> None:
    if not np.allclose(found, expected, rtol=TOLERANCE, atol=TOLERANCE):
        raise AssertionError(f"{complaint}: {found} against {expected}")

"""Shocks: what a body that lands with friction does in the instant of touching.

The normal impulse p grows; the velocity of the point of contact changes at the rate W f, with W
the inverse inertia felt there and f the force per normal force: (−μ ŝ, 1) while it slips, what
keeps it from slipping while it sticks. Compression ends where the normal velocity vanishes,
restitution where the normal force has given back e² of the work of compression (Stronge), which
never adds energy. W is positive definite: where a shock drives the bodies together (Painlevé's
paradox) f · W f > 0 makes the slip shrink, so that every shock ends.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from polhode.base import NumericError
from polhode.simulate.integrate._integrators import Array

_STICKS = 1e-13  # slip, relative to the velocity before, that has vanished
_PHASES = 100
_ANGLES = 72


@dataclass(frozen=True)
class Shock:
    """The outcome of a shock.

    Attributes:
        impulse: along the support twice, and away from it, N s.
        velocity: of the point of contact afterwards, m/s.
        sticks: whether it ends without slip.
    """

    impulse: Array
    velocity: Array
    sticks: bool


@dataclass(frozen=True)
class Roughness:
    """What resists at the contact: coefficients of kinetic and static friction, and restitution."""

    kinetic: float
    static: float
    restitution: float


def smooth_shock(felt: Array, velocity: Array, restitution: float) -> Shock:
    """A shock without friction."""
    impulse = np.array([0.0, 0.0, -(1 + restitution) * velocity[2] / felt[2, 2]])
    return Shock(impulse, velocity + felt @ impulse, sticks=False)


def rough_shock(felt: Array, velocity: Array, restitution: float) -> Shock:
    """A shock on a support that allows no slip at all.

    What it gives back is a part of the energy that the point of contact brought, no more.
    """
    inertia = np.linalg.inv(felt)
    brought = velocity @ inertia @ velocity
    rebound = min(restitution * -velocity[2], float(np.sqrt(brought / inertia[2, 2])))
    after = np.array([0.0, 0.0, rebound])
    return Shock(inertia @ (after - velocity), after, sticks=True)


def coulomb_shock(
    felt: Array, velocity: Array, roughness: Roughness, where: str = "a contact"
) -> Shock:
    """A shock with Coulomb's friction and Stronge's restitution.

    Args:
        felt: inverse inertia felt at the point of contact, 1/kg.
        velocity: of that point before, m/s.
        where: what an error calls the contact and the instant.

    Raises:
        NumericError: where friction jams and the shock never ends, or slip has no one direction.
    """
    course = _Course(felt, velocity, roughness, where)
    while not course.done:
        course.advance()
    return Shock(course.impulse, course.velocity, course.sticks)


class _Course:
    """The course of a shock over the normal impulse, phase by phase."""

    def __init__(self, felt: Array, velocity: Array, roughness: Roughness, where: str) -> None:
        self.where = where
        self.felt = felt
        self.roughness = roughness
        self.velocity = velocity.copy()
        self.impulse = np.zeros(3)
        self.sticks = False
        self.done = False
        self._scale = float(np.linalg.norm(velocity))
        self._stored = 0.0
        self._compressing = True
        self._phases = 0
        self._force = np.array([0.0, 0.0, 1.0])

    def advance(self) -> None:
        """Go on to the next change: from slip to stick, or from compression to restitution."""
        self._phases += 1
        slip = self.velocity[:2]
        if self.sticks or np.linalg.norm(slip) <= _STICKS * self._scale:
            self._hold()
        else:
            self._slide()
        if self._phases > _PHASES:
            raise NumericError(
                f"a shock at {self.where} that does not end",
                expected="compression that ends with restitution",
                advice="lower the friction coefficient",
            )

    def _hold(self) -> None:
        """Without slip: friction as it is needed, if the static limit allows; else it slips on."""
        inertia = np.linalg.inv(self.felt)
        needed = inertia[:, 2] / inertia[2, 2]
        self.velocity[:2] = 0.0
        if np.hypot(*needed[:2]) <= self.roughness.static:
            self.sticks = True
            self._straight(needed)
            return
        direction = _onset(self.felt, self.roughness.kinetic, self.where)
        self._straight(np.array([*(-self.roughness.kinetic * direction), 1.0]))

    def _straight(self, force: Array) -> None:
        """A constant force per normal impulse, until compression or restitution ends."""
        rate = self.felt @ force
        start = self.velocity[2]
        if self._compressing:
            length = -start / rate[2]
            self._stored += start * start / (2 * rate[2])
        else:
            left = self.roughness.restitution**2 * self._stored
            # ∫ v dp from v = start: start p + rate p²/2 = left
            root = np.sqrt(max(start * start + 2 * rate[2] * left, 0.0))
            length = (root - start) / rate[2]
        self.impulse = self.impulse + force * length
        self.velocity = self.velocity + rate * length
        self._turn()

    def _turn(self) -> None:
        if self._compressing and self.roughness.restitution > 0:
            self._compressing = False
            self.velocity[2] = 0.0
            return
        if self._compressing:
            self.velocity[2] = 0.0
        self.done = True

    def _slide(self) -> None:
        """Friction against a slip that may turn; over an arc of impulse up to the next change."""
        if _is_isotropic(self.felt):
            self._slide_straight()
            return
        slip = self.velocity[:2]
        unit = self._scale
        start = np.array(
            [
                np.log(np.hypot(*slip) / unit),
                np.arctan2(slip[1], slip[0]),
                self.velocity[2] / unit,
                *(self.impulse / unit),
                0.0,
            ]
        )
        last, turned = self._turning(start)
        size, angle = np.exp(last[0]), last[1]
        self.velocity = unit * np.array([size * np.cos(angle), size * np.sin(angle), last[2]])
        self.impulse = unit * last[3:6]
        work = unit**2 * last[6]
        self._stored -= work if self._compressing else work / self.roughness.restitution**2
        if turned:
            self._turn()
        else:
            self.velocity[:2] = 0.0

    def _turning(self, start: Array) -> tuple[Array, bool]:
        """Slip up to its end, or else to that of compression or restitution (then True).

        With the slip ρ (cos ψ, sin ψ) and dp = ρ dτ, log ρ and ψ change at rates that depend on ψ
        alone: nothing is singular where the slip vanishes, which is at infinite τ. States, in units
        of the velocity before: log ρ, ψ, normal velocity, impulse, work of the normal impulse.
        """
        from scipy.integrate import solve_ivp  # slow to import, and rarely needed

        kinetic = self.roughness.kinetic
        budget = self.roughness.restitution**2 * self._stored / self._scale**2

        def rates(_: float, y: Array) -> Array:
            size, c, s = np.exp(y[0]), np.cos(y[1]), np.sin(y[1])
            force = np.array([-kinetic * c, -kinetic * s, 1.0])
            x, across, up = self.felt @ force
            along, turning = x * c + across * s, across * c - x * s
            return np.array([along, turning, size * up, *(size * force), size * y[2]])

        def stuck(_: float, y: Array) -> float:
            return float(y[0] - np.log(_STICKS))

        def turned(_: float, y: Array) -> float:
            return float(y[2]) if self._compressing else float(y[6] - budget)

        for event in (stuck, turned):
            event.terminal = True  # type: ignore[attr-defined]
        found = solve_ivp(
            rates,
            (0.0, np.inf),
            start,
            method="DOP853",
            rtol=1e-13,
            atol=1e-15,
            events=(stuck, turned),
        )
        return found.y[:, -1], bool(found.t_events[1].size)

    def _slide_straight(self) -> None:
        """Where friction cannot turn the slip, everything is linear in the impulse."""
        slip = self.velocity[:2]
        size = float(np.hypot(*slip))
        direction = slip / size
        kinetic = self.roughness.kinetic
        force = np.array([*(-kinetic * direction), 1.0])
        rate = self.felt @ force
        slowing = -float(rate[:2] @ direction)
        to_stick = size / slowing if slowing > 0 else np.inf
        start = self.velocity[2]
        if self._compressing:
            to_turn = -start / rate[2]
        else:
            left = self.roughness.restitution**2 * self._stored
            to_turn = (np.sqrt(max(start**2 + 2 * rate[2] * left, 0.0)) - start) / rate[2]
        length = min(to_stick, to_turn)
        work = start * length + rate[2] * length**2 / 2
        if self._compressing:
            self._stored -= work
        else:
            self._stored -= work / max(self.roughness.restitution**2, 1e-300)
        self.impulse = self.impulse + force * length
        self.velocity = self.velocity + rate * length
        if to_stick < to_turn:
            self.velocity[:2] = 0.0
        else:
            self._turn()


def _is_isotropic(felt: Array) -> bool:
    """Whether friction along any direction changes the velocity along that direction alone."""
    plane = felt[:2, :2]
    size = np.max(np.abs(felt))
    even = abs(plane[0, 0] - plane[1, 1]) <= 1e-14 * size and abs(plane[0, 1]) <= 1e-14 * size
    return bool(even and np.max(np.abs(felt[:2, 2])) <= 1e-14 * size)


def _onset(felt: Array, friction: float, where: str) -> Array:
    """Direction in which slip grows from nothing during the shock.

    Raises:
        NumericError: where there is none, or more than one.
    """
    from scipy.optimize import brentq  # slow to import, and rarely needed

    def rate(angle: float) -> Array:
        along = np.array([np.cos(angle), np.sin(angle)])
        change = felt @ np.array([*(-friction * along), 1.0])
        return np.array([change[:2] @ along, change[1] * along[0] - change[0] * along[1]])

    def across(angle: float) -> float:
        return float(rate(angle)[1])

    grid = np.linspace(0.0, 2 * np.pi, _ANGLES + 1)
    values = [across(angle) for angle in grid]
    found = [
        float(brentq(across, a, b, xtol=1e-15, rtol=1e-15))
        for a, b, u, v in zip(grid[:-1], grid[1:], values[:-1], values[1:], strict=True)
        if u * v < 0 or u == 0
    ]
    growing = [angle for angle in found if rate(angle)[0] > 0]
    if len(growing) != 1:
        raise NumericError(
            f"a shock at {where} in which slip can begin in {len(growing)} directions",
            expected="one direction in which slip grows against the friction it brings",
            advice="the rigid body with this friction has no unique motion from here",
        )
    return np.array([np.cos(growing[0]), np.sin(growing[0])])

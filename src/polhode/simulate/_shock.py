"""Shocks: what a body that lands with friction does in the instant of touching.

The normal impulse p grows; the velocity of the point of contact changes at the rate W f, with W
the inverse inertia felt there and f the force per normal force: (−μ ŝ, 1) while it slips, what
keeps it from slipping while it sticks. Compression ends where the normal velocity vanishes,
restitution where the normal force has given back e² of the work of compression (Stronge), which
never adds energy.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from polhode.base import NumericError
from polhode.simulate._integrators import Array

_STICKS = 1e-13  # slip, relative to the velocity before, that has vanished
_PHASES = 100


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


def coulomb_shock(felt: Array, velocity: Array, roughness: Roughness) -> Shock:
    """A shock with Coulomb's friction and Stronge's restitution.

    Raises:
        NumericError: where friction jams and the shock never ends.
    """
    course = _Course(felt, velocity, roughness)
    while not course.done:
        course.advance()
    return Shock(course.impulse, course.velocity, course.sticks)


class _Course:
    """The course of a shock over the normal impulse, phase by phase."""

    def __init__(self, felt: Array, velocity: Array, roughness: Roughness) -> None:
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
                "a shock whose friction jams",
                expected="friction low enough for compression to end",
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
        direction = _onset(self.felt, self.roughness.kinetic)
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
        from scipy.integrate import solve_ivp  # slow to import, and rarely needed

        kinetic = self.roughness.kinetic
        before = self._stored
        budget = self.roughness.restitution**2 * before

        def rates(_: float, y: Array) -> Array:
            slip = y[:2] / np.hypot(y[0], y[1])
            force = np.array([-kinetic * slip[0], -kinetic * slip[1], 1.0])
            change = self.felt @ force
            return np.array([*change, *force, y[2]])

        def stuck(_: float, y: Array) -> float:
            return float(np.hypot(y[0], y[1]) - _STICKS * self._scale)

        def turned(_: float, y: Array) -> float:
            return float(y[2]) if self._compressing else float(y[6] - budget)

        for event in (stuck, turned):
            event.terminal = True  # type: ignore[attr-defined]
        start = np.array([*self.velocity, *self.impulse, 0.0])
        most = 4 * (1 + self.roughness.restitution) * self._scale / _least_gain(self.felt, kinetic)
        found = solve_ivp(
            rates,
            (0.0, most),
            start,
            method="DOP853",
            rtol=1e-13,
            atol=1e-16 * self._scale,
            events=(stuck, turned),
        )
        last = found.y[:, -1]
        self.velocity, self.impulse = last[:3].copy(), last[3:6].copy()
        if self._compressing:
            self._stored = before - last[6]
        else:
            self._stored = before - last[6] / max(self.roughness.restitution**2, 1e-300)
        if found.t_events[1].size:
            self._turn()
        elif found.t_events[0].size:
            self.velocity[:2] = 0.0

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


def _least_gain(felt: Array, friction: float) -> float:
    """Smallest rise of the normal velocity per normal impulse, whatever the direction of slip."""
    lost = friction * float(np.hypot(felt[2, 0], felt[2, 1]))
    return max(float(felt[2, 2]) - lost, 1e-3 * float(felt[2, 2]))


def _onset(felt: Array, friction: float) -> Array:
    """Direction in which slip grows from nothing during the shock."""
    angles = np.linspace(0.0, 2 * np.pi, 721)
    along = np.array([np.cos(angles), np.sin(angles)])
    force = np.vstack([-friction * along, np.ones_like(angles)])
    rates = (felt @ force)[:2]
    across = rates[1] * along[0] - rates[0] * along[1]
    growing = np.sum(rates * along, axis=0)
    best = np.argmin(np.where(growing > 0, np.abs(across), np.inf))
    return np.asarray(along[:, best])

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
from typing import Any

import numpy as np

from polhode.base import NumericError
from polhode.simulate.contact._slip_reversal import STICKS, SlipReversal
from polhode.simulate.integrate._number_types import DOUBLES, NumberType
from polhode.simulate.integrate._stepping import Array

_STRAIGHT = 1e-14  # of what an impulse does: what it does across the slip that is nothing
_PHASES = 100
_ANGLES = 72


@dataclass(frozen=True)
class Impact:
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

    kinetic: Any
    static: Any
    restitution: Any


def smooth_impact(felt: Array, velocity: Array, restitution: Any) -> Impact:
    """A shock without friction."""
    impulse = np.array([0.0, 0.0, -(1 + restitution) * velocity[2] / felt[2, 2]])
    return Impact(impulse, velocity + felt @ impulse, sticks=False)


def rough_impact(
    felt: Array, velocity: Array, restitution: Any, numbers: NumberType = DOUBLES
) -> Impact:
    """A shock on a support that allows no slip at all.

    What it gives back is a part of the energy that the point of contact brought, no more.
    """
    inertia = _inverse(felt, numbers)
    brought = velocity @ inertia @ velocity
    rebound = min(restitution * -velocity[2], (brought / inertia[2, 2]) ** 0.5)
    after = np.array([0.0, 0.0, rebound])
    return Impact(inertia @ (after - velocity), after, sticks=True)


def coulomb_impact(
    felt: Array,
    velocity: Array,
    roughness: Roughness,
    where: str = "a contact",
    numbers: NumberType = DOUBLES,
) -> Impact:
    """A shock with Coulomb's friction and Stronge's restitution.

    Args:
        felt: inverse inertia felt at the point of contact, 1/kg.
        velocity: of that point before, m/s.
        where: what an error calls the contact and the instant.
        numbers: what is computed with.

    Raises:
        NumericError: where friction jams and the shock never ends, or slip has no one direction.
    """
    course = _ImpactCourse(felt, velocity, roughness, where, numbers)
    while not course.done:
        course.advance()
    return Impact(course.impulse, course.velocity, course.sticks)


class _ImpactCourse:
    """The course of a shock over the normal impulse, phase by phase."""

    def __init__(
        self, felt: Array, velocity: Array, roughness: Roughness, where: str, numbers: NumberType
    ) -> None:
        self.where = where
        self.felt = felt
        self.roughness = roughness
        self.velocity = velocity.copy()
        self.impulse = numbers.array(np.zeros(3))
        self.sticks = False
        self.done = False
        self._numbers = numbers
        self._scale = numbers.size(velocity)
        self._stored: Any = 0.0
        self._compressing = True
        self._phases = 0
        self._force = np.array([0.0, 0.0, 1.0])

    def advance(self) -> None:
        """Go on to the next change: from slip to stick, or from compression to restitution."""
        self._phases += 1
        size = self._numbers.size(self.velocity[:2])
        if self.sticks or size <= self._numbers.finer(STICKS) * self._scale:
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
        inertia = _inverse(self.felt, self._numbers)
        needed = inertia[:, 2] / inertia[2, 2]
        self.velocity[:2] = 0.0
        if self._numbers.size(needed[:2]) <= self.roughness.static:
            self.sticks = True
            self._straight(needed)
            return
        direction = _onset(self.felt, self.roughness.kinetic, self.where, self._numbers)
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
            root = max(start * start + 2 * rate[2] * left, 0) ** 0.5
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
        if not self._turns():
            self._slide_straight()
            return
        unit, bounce = self._scale, self.roughness.restitution**2
        budget = None if self._compressing else bounce * self._stored / unit**2
        start = self.velocity / unit
        turn = SlipReversal(self.felt, self.roughness.kinetic, start, budget).turned(self._numbers)
        self.velocity = unit * turn.velocity
        self.impulse = self.impulse + unit * turn.impulse
        work = unit**2 * turn.work
        self._stored -= work if self._compressing else work / bounce
        if turn.over:
            self._turn()
        else:
            self.velocity[:2] = 0.0

    def _slide_straight(self) -> None:
        """Where friction cannot turn the slip, everything is linear in the impulse."""
        direction, force = self._resisted()
        rate = self.felt @ force
        slowing = -(rate[:2] @ direction)
        size = self._numbers.size(self.velocity[:2])
        to_stick = size / slowing if slowing > 0 else np.inf
        start = self.velocity[2]
        to_turn = self._to_turn(rate[2])
        length = min(to_stick, to_turn)
        work = start * length + rate[2] * length**2 / 2
        if self._compressing:
            self._stored -= work
        else:
            self._stored -= work / self.roughness.restitution**2
        self.impulse = self.impulse + force * length
        self.velocity = self.velocity + rate * length
        if to_stick < to_turn:
            self.velocity[:2] = 0.0
        else:
            self._turn()

    def _turns(self) -> bool:
        """Whether friction turns the slip that it opposes."""
        direction, force = self._resisted()
        rate = self.felt @ force
        across = rate[1] * direction[0] - rate[0] * direction[1]
        return bool(abs(across) > self._numbers.finer(_STRAIGHT) * np.max(np.abs(self.felt)))

    def _resisted(self) -> tuple[Array, Array]:
        """Direction of the slip, and the force per normal force that opposes it."""
        slip = self.velocity[:2]
        direction = slip / self._numbers.size(slip)
        return direction, np.array([*(-self.roughness.kinetic * direction), 1.0])

    def _to_turn(self, rate: Any) -> Any:
        """Impulse up to the end of compression or restitution, if the slip lasts so long.

        Args:
            rate: of the normal velocity.
        """
        start = self.velocity[2]
        if self._compressing:
            return -start / rate if rate > 0 else np.inf
        left = self.roughness.restitution**2 * self._stored
        square = start**2 + 2 * rate * left
        if square < 0:
            return np.inf
        return (square**0.5 - start) / rate if rate != 0 else left / start


def _inverse(felt: Array, numbers: NumberType) -> Array:
    return np.asarray(numbers.solved(felt, numbers.array(np.eye(3))))


def _onset(felt: Array, friction: Any, where: str, numbers: NumberType) -> Array:
    """Direction in which slip grows from nothing during the shock.

    Raises:
        NumericError: where there is none, or more than one.
    """
    from scipy.optimize import brentq  # slow to import, and rarely needed

    def rate(angle: Any) -> Array:
        along = np.array(numbers.direction(angle))
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
    angle = numbers.zero(lambda angle: rate(angle)[1], growing[0])
    return np.array(numbers.direction(angle))

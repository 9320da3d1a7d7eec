"""Impacts with friction: Routh's process along the normal impulse, with Stronge's restitution.

The normal impulse p grows, and the velocity of the point of contact changes at the rate
dv/dp = W f. W is the inverse effective mass at that point, f the force per normal force: (−μ ŝ, 1)
during slip, during stick the force that keeps it from slipping. Compression ends where the normal
velocity vanishes, restitution where the normal force has returned e² of the work of compression
(Stronge's energetic coefficient), which never adds energy. W is positive definite: where friction
drives the bodies together (Painlevé's paradox), f · W f > 0 makes the slip shrink, so that every
impact ends.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import hypot
from typing import Any

import numpy as np

from polhode.algebra import Expr, Program, Symbol, SymbolKind, compile_program, sqrt
from polhode.base import NumericError, bisected
from polhode.simulate._dynamics import CLOCK
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._crossing import bracketed_zeros
from polhode.simulate.integrate._flow import Flow
from polhode.simulate.integrate._integrators import chosen
from polhode.simulate.integrate._number_types import DOUBLES, NumberType
from polhode.simulate.integrate._series import InitialValueProblem, TaylorSolution

# -- slip that friction turns during an impact -----------------------------------------------------
#
# With the slip velocity ρ (cos ψ, sin ψ) the direction turns at the rate dψ/dp ~ 1/ρ, which is
# singular where the slip vanishes. With dp = ρ dτ instead, log ρ and ψ change at rates that depend
# on ψ alone; the slip vanishes at infinite τ, and ends where it is small enough.

STICKS = 1e-13  # slip, relative to the velocity before, that has vanished
_LONGEST = 10**9  # end of τ, never reached: τ grows only as −log ρ


@dataclass(frozen=True)
class SlipReversalResult:
    """The end of such a slip.

    Attributes:
        velocity: of the point of contact.
        impulse: since the beginning.
        work: of its normal part.
        over: whether compression or restitution has ended; if not, the slip has.
    """

    velocity: Array
    impulse: Array
    work: Any
    over: bool


@dataclass(frozen=True)
class SlipReversal:
    """Slip against friction, with velocities and inverse masses scaled to order one.

    Impulses and works are then of order one as well, so that the absolute tolerances of the
    integration are relative ones, whatever the units.

    Attributes:
        inverse_mass: inverse effective mass at the point of contact.
        kinetic: friction coefficient.
        velocity: of that point before.
        budget: work of restitution; None during compression, which ends when the approach does.
    """

    inverse_mass: Array
    kinetic: Any
    velocity: Array
    budget: Any

    def turned(self, numbers: NumberType) -> SlipReversalResult:
        """Up to the end of the slip, or of compression or restitution."""
        return self._in_doubles() if numbers is DOUBLES else self._in_series(numbers)

    # States: velocity, impulse, work of the normal impulse. In Cartesian components their rates
    # need a square root only, no exponential, sine or cosine.

    @property
    def _constants(self) -> list[Any]:
        return [*self.inverse_mass.ravel().tolist(), self.kinetic]

    @property
    def _start(self) -> list[Any]:
        return [*self.velocity.tolist(), 0, 0, 0, 0]

    def _goes_on(self, state: Sequence[float], least: float) -> bool:
        x, y, z, *_, work = state
        return hypot(x, y) > least and self._left(z, work) < 0

    def _in_doubles(self) -> SlipReversalResult:
        leg = (
            chosen()
            .prepare(_flow(), None)
            .leg(
                np.array(self._constants, dtype=float),
                0.0,
                np.array(self._start, dtype=float),
                float(_LONGEST),
                lambda _, state: self._goes_on(state, STICKS),
            )
        )

        def still(time: float) -> float:
            state = leg.at(np.array([time]))[:, 0]
            return -float(self._left(state[2], state[6]))

        before, end = map(float, leg.times[-2:])
        over = still(end) <= 0
        last = leg.at(np.array([bisected(still, before, end) if over else end]))[:, 0]
        return SlipReversalResult(last[:3], last[3:6], last[6], over)

    def _in_series(self, numbers: NumberType) -> SlipReversalResult:
        from polhode.simulate.integrate._flint import PowerSeries

        least = float(numbers.finer(STICKS))

        def goes_on(time: float, step: float, state: Sequence[Any]) -> bool:
            return self._goes_on([float(value) for value in state], least)

        given = self._constants, self._start
        problem = InitialValueProblem(_program(), numbers, *given, 0, _LONGEST)
        series = PowerSeries().integrate(problem, goes_on)
        share, over = self._end(series)
        last = series.state(series.steps - 1, share)
        return SlipReversalResult(last[:3], last[3:6], last[6], over)

    def _end(self, series: TaylorSolution) -> tuple[Any, bool]:
        """The share of the last step after which compression or restitution ends, if it does."""
        step, numbers = series.steps - 1, series.numbers

        def left(state: Any) -> Any:
            return self._left(state[2], state[6])

        if left(series.state(step, 1)) < 0:
            return 1, False

        def rough(share: float) -> float:
            return -float(left(series.rounded_states(np.array([step + share]))[:, 0]))

        return numbers.zero(lambda s: left(series.state(step, s)), bisected(rough, 0.0, 1.0)), True

    def _left(self, velocity: Any, work: Any) -> Any:
        """Rises through zero where compression or restitution ends."""
        return velocity if self.budget is None else work - self.budget


@cache
def _flow() -> Flow:
    program = _program()
    return Flow.of(program, len(program.outputs))


@cache
def _program() -> Program:
    """Rates of velocity, impulse and work with respect to τ, where the normal force is ρ."""
    states = [
        Symbol(name, SymbolKind.SPEED) for name in ("x", "y", "z", "p_x", "p_y", "p_z", "work")
    ]
    inverse_mass = [[Symbol(f"w_{i}{j}", SymbolKind.PARAMETER) for j in range(3)] for i in range(3)]
    kinetic = Symbol("mu", SymbolKind.PARAMETER)
    x, y, z = map(Expr.generator, states[:3])
    size = sqrt(x * x + y * y)
    force = [-Expr.generator(kinetic) * x, -Expr.generator(kinetic) * y, size]
    rates = [
        sum((Expr.generator(w) * f for w, f in zip(row, force, strict=True)), Expr.of(0))
        for row in inverse_mass
    ]
    arguments = (*states, *(w for row in inverse_mass for w in row), kinetic, CLOCK)
    return compile_program([*rates, *force, size * z], arguments)


_STRAIGHT = 1e-14  # of the largest effect of an impulse: less than this across the slip is rounding
_PHASES = 100  # changes between slip, stick, compression and restitution; a few are usual
_ANGLES = 72  # directions, 5° apart, between which those of a slip that resumes are bracketed


@dataclass(frozen=True)
class Impact:
    """The outcome of an impact.

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
    """Coefficients of a contact: kinetic and static friction, and restitution."""

    kinetic: Any
    static: Any
    restitution: Any


def smooth_impact(inverse_mass: Array, velocity: Array, restitution: Any) -> Impact:
    """An impact without friction."""
    impulse = np.array([0.0, 0.0, -(1 + restitution) * velocity[2] / inverse_mass[2, 2]])
    return Impact(impulse, velocity + inverse_mass @ impulse, sticks=False)


def rough_impact(
    inverse_mass: Array,
    velocity: Array,
    restitution: tuple[Any, Any],
    numbers: NumberType = DOUBLES,
) -> Impact:
    """An impact on a support that allows no slip at all, or that reverses it.

    The rebound takes at most the energy that the point of contact brought: with oblique approach
    Newton's coefficient alone could add energy. So does the slip, of what the rebound has left.

    Args:
        restitution: of the velocities along the normal and along the support.
    """
    normal, along = restitution
    inertia = _inverse(inverse_mass, numbers)
    brought = velocity @ inertia @ velocity
    rebound = min(normal * -velocity[2], (brought / inertia[2, 2]) ** 0.5)
    up = np.array([0.0, 0.0, rebound])
    back = np.array([*(-along * velocity[:2]), 0.0])
    # the largest share s of the reversed slip with the energy (s back + up)² no more than brought
    square, mixed = back @ inertia @ back, back @ inertia @ up
    left = brought - up @ inertia @ up
    share: Any = 1
    if square + 2 * mixed > left:
        share = max((mixed**2 + square * left) ** 0.5 - mixed, 0) / square
    after = up + share * back
    return Impact(inertia @ (after - velocity), after, sticks=not along)


def coulomb_impact(
    inverse_mass: Array,
    velocity: Array,
    roughness: Roughness,
    where: str = "a contact",
    numbers: NumberType = DOUBLES,
) -> Impact:
    """An impact with Coulomb friction and Stronge's energetic restitution.

    Args:
        inverse_mass: inverse effective mass at the point of contact, W = J M⁻¹ Jᵀ, 1/kg.
        velocity: of that point before, m/s.
        where: what an error calls the contact and the instant.
        numbers: the type of numbers to compute with.

    Raises:
        NumericError: where the impact does not end, or slip can begin in no or several directions.
    """
    course = _ImpactCourse(inverse_mass, velocity, roughness, where, numbers)
    while not course.done:
        course.advance()
    return Impact(course.impulse, course.velocity, course.sticks)


class _ImpactCourse:
    """The course of an impact over the normal impulse, phase by phase.

    `_stored` is the work of compression that restitution has yet to return (before the factor e²).
    """

    def __init__(
        self,
        inverse_mass: Array,
        velocity: Array,
        roughness: Roughness,
        where: str,
        numbers: NumberType,
    ) -> None:
        self.where = where
        self.inverse_mass = inverse_mass
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
                f"an impact at {self.where} that does not end",
                expected="compression that ends with restitution",
                advice="lower the friction coefficient",
            )

    def _hold(self) -> None:
        """Without slip: it sticks if static friction suffices, else slip resumes."""
        # The force f per normal force for which W f has no tangential part: f ~ W⁻¹ ẑ.
        inertia = _inverse(self.inverse_mass, self._numbers)
        needed = inertia[:, 2] / inertia[2, 2]
        self.velocity[:2] = 0.0
        if self._numbers.size(needed[:2]) <= self.roughness.static:
            self.sticks = True
            self._straight(needed)
            return
        direction = _onset(self.inverse_mass, self.roughness.kinetic, self.where, self._numbers)
        self._straight(np.array([*(-self.roughness.kinetic * direction), 1.0]))

    def _straight(self, force: Array) -> None:
        """A constant force per normal impulse, until compression or restitution ends."""
        rate = self.inverse_mass @ force
        start = self.velocity[2]
        if self._compressing:
            length = -start / rate[2]
            self._stored += start * start / (2 * rate[2])
        else:
            left = self.roughness.restitution**2 * self._stored
            # ∫ v dp from v = start: start p + rate p²/2 = left. Rounding may make the root of a
            # restitution that is about to end imaginary.
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
        """Slip, whose direction friction may turn, up to the next change."""
        slip = self.velocity[:2]
        direction = slip / self._numbers.size(slip)
        force = np.array([*(-self.roughness.kinetic * direction), 1.0])  # per normal force
        rate = self.inverse_mass @ force
        across = rate[1] * direction[0] - rate[0] * direction[1]
        straight = self._numbers.finer(_STRAIGHT) * np.max(np.abs(self.inverse_mass))
        if not abs(across) > straight:
            self._slide_straight(direction, force)
            return
        speed, bounce = self._scale, self.roughness.restitution**2
        mass = 1 / np.max(np.abs(self.inverse_mass))
        budget = None if self._compressing else bounce * self._stored / (mass * speed**2)
        reversal = SlipReversal(
            mass * self.inverse_mass, self.roughness.kinetic, self.velocity / speed, budget
        )
        turn = reversal.turned(self._numbers)
        self.velocity = speed * turn.velocity
        self.impulse = self.impulse + mass * speed * turn.impulse
        # During compression the work of the normal force is negative, and stored; restitution
        # returns it with the factor e², so that the limit e² · stored falls by the work done.
        work = mass * speed**2 * turn.work
        self._stored -= work if self._compressing else work / bounce
        if turn.over:
            self._turn()
        else:
            self.velocity[:2] = 0.0

    def _slide_straight(self, direction: Array, force: Array) -> None:
        """Where friction does not turn the slip, everything is linear in the impulse."""
        rate = self.inverse_mass @ force
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

    def _to_turn(self, rate: Any) -> Any:
        """Impulse up to the end of compression or restitution, were the slip to last; or infinite.

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


def _inverse(inverse_mass: Array, numbers: NumberType) -> Array:
    return np.asarray(numbers.solved(inverse_mass, numbers.array(np.eye(3))))


def _onset(inverse_mass: Array, friction: Any, where: str, numbers: NumberType) -> Array:
    """The direction in which slip resumes during an impact.

    Raises:
        NumericError: where there is none, or more than one.
    """

    def rate(angle: Any) -> Array:
        along = np.array(numbers.direction(angle))
        change = inverse_mass @ np.array([*(-friction * along), 1.0])
        return np.array([change[:2] @ along, change[1] * along[0] - change[0] * along[1]])

    def across(angle: float) -> float:
        return float(rate(angle)[1])

    grid = np.linspace(0.0, 2 * np.pi, _ANGLES + 1)
    found = bracketed_zeros(across, grid, [across(angle) for angle in grid])
    # A root of the transverse rate is a direction of slip only if the slip grows along it.
    growing = [angle for angle in found if rate(angle)[0] > 0]
    if len(growing) != 1:
        raise NumericError(
            f"an impact at {where} in which slip can begin in {len(growing)} directions",
            expected="one direction in which slip grows against the friction that opposes it",
            advice="lower the friction coefficient: a rigid body with this friction has no unique "
            "motion from here",
        )
    angle = numbers.zero(lambda angle: rate(angle)[1], growing[0])
    return np.array(numbers.direction(angle))

"""A gyrocompass, free or driven by a motor: exact in Ω, and to first order for comparison."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import permutations
from typing import Any

from polhode.algebra import ZERO, Expr, Symbol, cos, sin
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._reals import Array, Reals
from polhode.analyse.closed._solution import ExactSolution, Solvable, is_constant, rates
from polhode.analyse.closed._swing import SHIFTS, Swinging, SwingSolution, swinging
from polhode.derive import Equations


@dataclass(frozen=True)
class Gyrocompass(Solvable):
    """θ̈ = sin θ (p + q cos θ + r ω), ω̇ = s θ̇ sin θ.

    The whole spin n = ω + s cos θ is constant, so that θ swings with A = -(p + r n) and
    B = q - r s. With a motor, or with no rotor at all, ω does not occur.

    Attributes:
        angle: θ, of the axle from the north.
        rate: θ̇, a speed of the equations.
        spin: ω, relative to the Earth; None where a motor keeps it constant.
        push: p, 1/s².
        second: q, 1/s², of the second order in Ω.
        drag: r, 1/s.
        gain: s, 1/s.
        shift: added to the coordinate to give θ, rad.
    """

    angle: Symbol
    rate: Symbol
    spin: Symbol | None
    push: Expr
    second: Expr
    drag: Expr
    gain: Expr
    shift: Expr = ZERO

    name = "gyrocompass"
    formula = (
        r"\ddot\theta = -A\sin\theta + B\sin\theta\cos\theta, \quad "
        r"2\dot x^2 = (E - A)x^4 + 2(E + B)x^2 + (E + A), \quad x = \tan\frac{\theta}{2}"
    )

    @property
    def parts(self) -> dict[str, Expr]:
        return {
            "A": -(self.push + self.drag * self.whole_spin),
            "B": self.second - self.drag * self.gain,
        }

    @property
    def state(self) -> tuple[Symbol, ...]:
        swing = (self.angle, self.rate)
        return (*swing, self.spin) if self.spin else swing

    @property
    def whole_spin(self) -> Expr:
        """n = ω + s cos θ, 1/s; zero where ω does not occur."""
        if self.spin is None:
            return ZERO
        return Expr.generator(self.spin) + self.gain * cos(self._theta)

    @property
    def _theta(self) -> Expr:
        return Expr.generator(self.angle) + self.shift

    @property
    def first_order(self) -> Expr:
        """A to the first order in Ω, in which the spin ω is constant."""
        return -(self.push + (self.drag * Expr.generator(self.spin) if self.spin else ZERO))

    def solve(self, data: Data) -> ExactSolution:
        theta, rate = self._theta, Expr.generator(self.rate)
        shift = data.number(self.shift)
        A, B = self.parts.values()
        approximate = None
        if data.number(self.first_order):
            approximate = swinging(data, self.first_order, ZERO, theta, rate).shifted(shift)
        return GyrocompassSwing(
            self.angle,
            self.rate,
            swinging(data, A, B, theta, rate).shifted(shift),
            self.spin,
            approximate,
            abs(data.number(A)) - data.number(B),
            data.number(self.whole_spin),
            data.number(self.gain),
            shift,
        )


@dataclass(frozen=True)
class GyrocompassSwing(SwingSolution):
    """The axle swinging about the north.

    Attributes:
        spin: ω, where it changes.
        approximate: the motion to first order in Ω; None if there is no term of that order.
        stiffness: square of the frequency of small swings, exact in Ω, 1/s².
        whole_spin: n = ω + s cos θ, 1/s.
        gain: s, 1/s.
        shift: added to the coordinate to give θ, rad.
    """

    spin: Symbol | None
    approximate: Swinging | None
    stiffness: Any
    whole_spin: Any
    gain: Any
    shift: Any

    @property
    def figures(self) -> dict[str, Any]:
        """With the frequency of small swings, 1/s, and the period to first order in Ω, s."""
        found = self.motion.figures
        if self.stiffness > 0:
            found |= {"small_swing_frequency": self.motion.swing.phase.context.sqrt(self.stiffness)}
        period = self.approximate and self.approximate.swing.period
        return {**found, "first_order_period": period} if period else found

    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        found = super().at(reals, times)
        if self.spin is None:
            return found
        theta = found[self.angle.published]
        cosine = reals.cos(theta + reals.number(self.shift) if self.shift else theta)
        spin = reals.number(self.whole_spin) - reals.number(self.gain) * cosine
        return {**found, self.spin.published: spin}

    def besides(self, reals: Reals, times: Array) -> dict[str, Array]:
        """The angle and its rate to the first order in Ω, where ω is constant."""
        if self.approximate is None:
            return {}
        names = (f"first_order_{s.published}" for s in (self.angle, self.rate))
        return dict(zip(names, self.approximate.at(reals, times), strict=True))


def recognise(equations: Equations) -> Gyrocompass | None:
    """The equations as those of a swing, with a rotor whose spin may change or without one."""
    angles, accelerations = rates(equations), equations.accelerations
    moving = [s for s in equations.speeds if accelerations[s.derivative()]]
    if len(moving) not in (1, 2):
        return None
    for rate, *others in permutations(moving):
        if rate not in angles:
            continue
        angle, spin = angles[rate], others[0] if others else None
        for shift in SHIFTS:
            theta, drag, gain = Expr.generator(angle) + shift, ZERO, ZERO
            pull = accelerations[rate.derivative()] / sin(theta)
            if spin is not None:
                drag = pull.diff(spin)
                gain = accelerations[spin.derivative()] / (Expr.generator(rate) * sin(theta))
                pull = pull - drag * Expr.generator(spin)
            second = -pull.diff(angle) / sin(theta)
            push = pull - second * cos(theta)
            if all(map(is_constant, (push, second, drag, gain))):
                return Gyrocompass(angle, rate, spin, push, second, drag, gain, shift)
    return None

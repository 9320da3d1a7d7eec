"""A body that swings about a fixed axis under gravity, such as a gyroscope in a vertical plane."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from polhode.algebra import ZERO, Expr, Symbol, sin
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._solution import ExactSolution, Solvable, is_constant, rates
from polhode.analyse.closed._swing import SHIFTS, SwingSolution, swinging
from polhode.derive import Equations


@dataclass(frozen=True)
class Pendulum(Solvable):
    """θ̈ = μ sin θ.

    Attributes:
        angle: θ, from the upright where μ is positive.
        rate: θ̇, a speed of the equations.
        strength: μ, 1/s².
        shift: added to the coordinate to give θ, rad.
    """

    angle: Symbol
    rate: Symbol
    strength: Expr
    shift: Expr = ZERO

    name = "pendulum"
    formula = (
        r"\ddot\theta = \mu\sin\theta, \quad "
        r"\tan\frac{\vartheta}{2} = \frac{k}{k'}\operatorname{cn}(\sqrt{|\mu|}\,t + u_0), "
        r"\frac{1}{k'}\operatorname{sc}\frac{\sqrt{|\mu|}\,t + u_0}{k} \text{ or } "
        r"\sinh(\sqrt{|\mu|}\,t + u_0)"
    )

    @property
    def parts(self) -> dict[str, Expr]:
        return {r"\mu": self.strength}

    @property
    def state(self) -> tuple[Symbol, ...]:
        return self.angle, self.rate

    def solve(self, data: Data) -> ExactSolution:
        theta, rate = Expr.generator(self.angle) + self.shift, Expr.generator(self.rate)
        lowest = data.context.pi if data.number(self.strength) > 0 else data.context.zero
        shift = data.number(self.shift)
        motion = swinging(data, -self.strength, ZERO, theta, rate).shifted(shift)
        return PendulumSwing(self.angle, self.rate, motion, lowest - shift)


@dataclass(frozen=True)
class PendulumSwing(SwingSolution):
    """The swing or rotation of a pendulum, with the times of its first passages.

    Attributes:
        lowest: θ at the lowest point, rad.
    """

    lowest: Any

    @property
    def figures(self) -> dict[str, Any]:
        """With the times to the next passage of the horizontal and of the lowest point, s."""
        quarter = self.motion.swing.phase.context.pi / 2
        level = [self.motion.first_arrival(self.lowest + side * quarter) for side in (1, -1)]
        arrivals = {
            "time_to_horizontal": min((t for t in level if t is not None), default=None),
            "time_to_lowest": self.motion.first_arrival(self.lowest),
        }
        found = {name: time for name, time in arrivals.items() if time is not None}
        return {**self.motion.figures, **found}


def recognise(equations: Equations) -> Pendulum | None:
    """The equations as those of a pendulum, besides angles and spins that change uniformly."""
    angles = rates(equations)
    moving = [s for s in equations.speeds if equations.accelerations[s.derivative()]]
    if len(moving) != 1 or moving[0] not in angles:
        return None
    angle = angles[moving[0]]
    for shift in SHIFTS:
        theta = Expr.generator(angle) + shift
        strength = equations.accelerations[moving[0].derivative()] / sin(theta)
        if is_constant(strength):
            return Pendulum(angle, moving[0], strength, shift)
    return None

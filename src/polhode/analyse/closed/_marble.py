"""A marble on a turntable: a circle, on which a tilt superposes a steady drift."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import Any

from polhode.algebra import Expr, Symbol
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._reals import Array, Reals
from polhode.analyse.closed._solution import ExactSolution, Solvable, is_constant, rates
from polhode.base import NumericError
from polhode.derive import Equations

Pair = tuple[Any, Any]


@dataclass(frozen=True)
class Circling(Solvable):
    """v̇ = Λ ẑ × v + c in a plane, with constant Λ and c.

    Attributes:
        place: coordinates in the plane.
        velocity: their rates, speeds of the equations.
        rate: Λ, 1/s.
        push: c, m/s².
    """

    place: tuple[Symbol, Symbol]
    velocity: tuple[Symbol, Symbol]
    rate: Expr
    push: tuple[Expr, Expr]

    name = "circling"
    formula = (
        r"\mathbf{r} = \mathbf{R} + \mathbf{v}_d t + \boldsymbol{\rho}, \quad "
        r"\dot{\boldsymbol{\rho}} = \Lambda\,\hat{\mathbf{z}} \times \boldsymbol{\rho}, \quad "
        r"\mathbf{v}_d = \hat{\mathbf{z}} \times \mathbf{c}/\Lambda"
    )

    @property
    def parts(self) -> dict[str, Expr]:
        return {r"\Lambda": self.rate, "c_1": self.push[0], "c_2": self.push[1]}

    @property
    def state(self) -> tuple[Symbol, ...]:
        return self.velocity

    def check(self, data: Data) -> None:
        if data.number(self.rate) == 0:
            raise NumericError(
                f"{self.rate} = 0: the marble does not circle",
                expected="a turntable that turns",
                advice="simulate it, or take the uniformly accelerated motion",
            )

    def solve(self, data: Data) -> ExactSolution:
        rate = data.number(self.rate)
        x, y, vx, vy = (data.number(Expr.generator(s)) for s in self.place + self.velocity)
        # v̇ = Λ ẑ × v + c vanishes at v = ẑ × c/Λ, about which the velocity turns with Λ
        drift = (data.number(-self.push[1] / self.rate), data.number(self.push[0] / self.rate))
        arm = ((vy - drift[1]) / rate, -(vx - drift[0]) / rate)
        names = tuple(s.published for s in self.place + self.velocity)
        centre = (x - arm[0], y - arm[1])
        return CircularMotion(data.context, names, rate, centre, arm, drift)


@dataclass(frozen=True)
class CircularMotion(ExactSolution):
    """A circle whose centre drifts.

    Attributes:
        names: of both coordinates and both velocities.
        rate: angular velocity on the circle, 1/s.
        centre: of the circle at t = 0, m.
        arm: from the centre to the marble at t = 0, m.
        drift: velocity of the centre, m/s.
    """

    context: Any
    names: tuple[str, ...]
    rate: Any
    centre: Pair
    arm: Pair
    drift: Pair

    @property
    def kind(self) -> str:
        return "circle with drift" if any(self.drift) else "circle"

    @property
    def period(self) -> Any:
        return 2 * self.context.pi / abs(self.rate)

    @property
    def figures(self) -> dict[str, Any]:
        return {
            "centre_1": self.centre[0],
            "centre_2": self.centre[1],
            "radius": self.context.hypot(*self.arm),
            "angular_rate": self.rate,
            "drift_1": self.drift[0],
            "drift_2": self.drift[1],
        }

    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        frequency = self.rate / (2 * self.context.pi)
        angle = reals.turns(times, frequency, 0).fraction * reals.number(2 * self.context.pi)
        cos, sin = reals.cos(angle), reals.sin(angle)
        (a, b), (u, v), (x, y) = (map(reals.number, p) for p in (self.arm, self.drift, self.centre))
        rate = reals.number(self.rate)
        along, across = a * cos - b * sin, a * sin + b * cos
        moving = (
            x + u * times + along,
            y + v * times + across,
            u - rate * across,
            v + rate * along,
        )
        return dict(zip(self.names, moving, strict=True))


def recognise(equations: Equations) -> Circling | None:
    """The equations as those of a body that circles in a plane."""
    places, accelerations = rates(equations), equations.accelerations
    for first, second in combinations((s for s in equations.speeds if s in places), 2):
        row = accelerations[first.derivative()], accelerations[second.derivative()]
        rate = row[1].diff(first)
        v, w = Expr.generator(first), Expr.generator(second)
        push = (row[0] + rate * w, row[1] - rate * v)
        if rate and all(map(is_constant, (rate, *push))):
            return Circling((places[first], places[second]), (first, second), rate, push)
    return None

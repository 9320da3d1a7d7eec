"""A free rigid body in any angles: its angular momentum is constant in space."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from polhode.algebra import Expr, Matrix, Row, Symbol, Vector
from polhode.analyse.closed._attitude import Attitude, Attitudes, Chart, Placed, Turned, scalar
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._free_body import FreeBody, FreeRotation
from polhode.analyse.closed._reals import Array, Digits, Reals
from polhode.analyse.closed._solution import ExactSolution, Solvable, is_constant
from polhode.derive import Equations
from polhode.model import Body

_NAMES = ("omega_1", "omega_2", "omega_3")


@dataclass(frozen=True)
class TurnedFreeBody(Solvable):
    """A free body by the angles of its principal axes.

    Attributes:
        chart: the angles.
        moments: of inertia about the axes.
        omega: angular velocity along them.
    """

    chart: Chart
    moments: Row
    omega: Row

    name = FreeBody.name
    formula = FreeBody.formula

    @property
    def parts(self) -> dict[str, Expr]:
        return {f"I_{i}": moment for i, moment in enumerate(self.moments, 1)}

    @property
    def state(self) -> tuple[Symbol, ...]:
        return (*self.chart.angles, *self.chart.speeds)

    def solve(self, data: Data) -> ExactSolution:
        rotation = FreeRotation.start(data, self.moments, self.omega, _NAMES)
        placed = Placed(self.chart, data)
        return Turned(Tumbling(rotation, placed), placed)


@dataclass(frozen=True)
class Tumbling(Attitudes):
    """The attitude of a free body.

    Attributes:
        rotation: its angular velocity, and its attitude to its angular momentum.
        placed: its chart.
    """

    rotation: FreeRotation
    placed: Placed

    @property
    def solution(self) -> ExactSolution:
        return self.rotation

    @property
    def step(self) -> float:
        return 0.25 * float(min(self.rotation.moments) / self.rotation.momentum)

    def at(self, reals: Reals, times: Array) -> Attitude:
        found, omega = (
            self.rotation.besides(reals, times)["attitude"],
            self.rotation.at(reals, times),
        )
        fixed = [[found[..., i, j] for j in range(3)] for i in range(3)]
        space = [[reals.number(c) for c in row] for row in self._space]
        rows = [
            [sum(space[i][k] * fixed[k][j] for k in range(3)) for j in range(3)] for i in range(3)
        ]
        turning = [scalar(row, [omega[name] for name in _NAMES]) for row in rows]
        return Attitude(rows, [row[2] for row in rows], turning)

    @cached_property
    def _space(self) -> Sequence[Sequence[Any]]:
        """The directions at rest that the attitude is given by, along the root's axes."""
        exact = Digits(self.placed.data.context)
        begun = self.rotation.besides(exact, exact.array(0))["attitude"]
        start = self.placed.start
        return [[scalar(start[i], begun[k]) for k in range(3)] for i in range(3)]


def recognise(equations: Equations) -> TurnedFreeBody | None:
    """A body with three angles, different moments and nothing that turns it."""
    return next((f for b in equations.system.bodies if (f := _read(equations, b))), None)


def _read(equations: Equations, body: Body) -> TurnedFreeBody | None:
    moments = tuple(body.inertia[i, i] for i in range(3))
    if body.inertia != Matrix.diagonal(moments) or not all(map(is_constant, moments)):
        return None
    chart = Chart.of(equations, body, body.axes[body.axes.labels[2]].components)
    if chart is None or len(chart.angles) != 3 or len(set(moments)) < 3:
        return None
    omega = equations.kinetics.velocities[body][1].express(body.axes).components
    along = Vector(tuple(i * w for i, w in zip(moments, omega, strict=True)), body.axes)
    still = not any(map(equations.rate, along.express(body.axes.root).components))
    return TurnedFreeBody(chart, moments, omega) if still else None

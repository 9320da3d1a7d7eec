"""Slip that friction turns during a shock, over an arc of the impulse.

With the slip ρ (cos ψ, sin ψ) and dp = ρ dτ for the normal impulse, log ρ and ψ change at rates
that depend on ψ alone: nothing is singular where the slip vanishes, which is at infinite τ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import hypot
from typing import Any

import numpy as np

from polhode.algebra import Expr, Program, Symbol, SymbolKind, compile_program, sqrt
from polhode.simulate.integrate._crossing import bisected
from polhode.simulate.integrate._number_types import DOUBLES, NumberType
from polhode.simulate.integrate._series import InitialValueProblem, TaylorSolution
from polhode.simulate.integrate._stepping import Array

STICKS = 1e-13  # slip, relative to the velocity before, that has vanished
_LONGEST = 10**9  # τ, which grows but as the logarithm of a slip that vanishes


@dataclass(frozen=True)
class SlipReversalResult:
    """What came of it.

    Attributes:
        velocity: of the point of contact.
        impulse: since the beginning.
        work: of its normal part.
        over: whether compression or restitution ended; else the slip vanished.
    """

    velocity: Array
    impulse: Array
    work: Any
    over: bool


@dataclass(frozen=True)
class SlipReversal:
    """Slip against friction, from a velocity of the size of one.

    Attributes:
        felt: inverse inertia felt at the point of contact.
        kinetic: friction coefficient.
        velocity: of that point before.
        budget: work of restitution; None during compression, which ends with the approach.
    """

    felt: Array
    kinetic: Any
    velocity: Array
    budget: Any

    def turned(self, numbers: NumberType) -> SlipReversalResult:
        """Up to the end of the slip, or of compression or restitution."""
        return self._in_doubles() if numbers is DOUBLES else self._in_series(numbers)

    def _in_doubles(self) -> SlipReversalResult:
        """States: log ρ, ψ, normal velocity, impulse, work of the normal impulse."""
        from scipy.integrate import solve_ivp  # slow to import, and rarely needed

        x, y, z = self.velocity
        start = np.array([np.log(np.hypot(x, y)), np.arctan2(y, x), z, 0.0, 0.0, 0.0, 0.0])

        def rates(_: float, y: Array) -> Array:
            size, c, s = np.exp(y[0]), np.cos(y[1]), np.sin(y[1])
            force = np.array([-self.kinetic * c, -self.kinetic * s, 1.0])
            x, across, up = self.felt @ force
            along, turning = x * c + across * s, across * c - x * s
            return np.array([along, turning, size * up, *(size * force), size * y[2]])

        def stuck(_: float, y: Array) -> float:
            return float(y[0] - np.log(STICKS))

        def over(_: float, y: Array) -> float:
            return float(self._left(y[2], y[6]))

        for event in (stuck, over):
            event.terminal = True  # type: ignore[attr-defined]
        found = solve_ivp(
            rates,
            (0.0, np.inf),
            start,
            method="DOP853",
            rtol=1e-13,
            atol=1e-15,
            events=(stuck, over),
        )
        last = found.y[:, -1]
        size, angle = np.exp(last[0]), last[1]
        velocity = np.array([size * np.cos(angle), size * np.sin(angle), last[2]])
        return SlipReversalResult(velocity, last[3:6], last[6], bool(found.t_events[1].size))

    def _in_series(self, numbers: NumberType) -> SlipReversalResult:
        """States: velocity, impulse, work of the normal impulse."""
        from polhode.simulate.integrate._flint import PowerSeries

        constants = [*self.felt.ravel().tolist(), self.kinetic]
        start = [*self.velocity.tolist(), 0, 0, 0, 0]
        least = float(numbers.finer(STICKS))

        def goes_on(time: float, step: float, state: Sequence[Any]) -> bool:
            x, y, z, *_, work = map(float, state)
            return hypot(x, y) > least and self._left(z, work) < 0

        launch = InitialValueProblem(_program(), numbers, constants, start, 0, _LONGEST)
        series = PowerSeries().integrate(launch, goes_on)
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
def _program() -> Program:
    """Rates of velocity, impulse and work, by τ."""
    states = [
        Symbol(name, SymbolKind.SPEED) for name in ("x", "y", "z", "p_x", "p_y", "p_z", "work")
    ]
    felt = [[Symbol(f"w_{i}{j}", SymbolKind.PARAMETER) for j in range(3)] for i in range(3)]
    kinetic = Symbol("mu", SymbolKind.PARAMETER)
    x, y, z = map(Expr.generator, states[:3])
    size = sqrt(x * x + y * y)
    force = [-Expr.generator(kinetic) * x, -Expr.generator(kinetic) * y, size]
    rates = [
        sum((Expr.generator(w) * f for w, f in zip(row, force, strict=True)), Expr.of(0))
        for row in felt
    ]
    arguments = (*states, *(w for row in felt for w in row), kinetic)
    return compile_program([*rates, *force, size * z], arguments)

"""A symmetric body recognised by its axis, the vertical, and its constants of motion.

For a body symmetric about e the momenta about e and about the vertical u are constant,

    ω·e = n,    α = (e × ė)·u + κ n e·u,

and so is the energy: ė² + 2μ e·u for a top; ė² + ε ṡ² + 2γ s for a coin on a smooth table, with the
sine s of the angle between e and u. These three constants determine the motion of e in Euler's
angles from u, in whatever angles the equations are written.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from polhode.algebra import ONE, ZERO, Expr, Row, dot, principal_root, solve
from polhode.analyse._symmetry import symmetry_axes
from polhode.analyse.closed._attitude import (
    Attitude,
    AttitudeFamily,
    AttitudeSolution,
    Chart,
    NumericChart,
    cross,
    product,
    scalar,
)
from polhode.analyse.closed._axle import Names
from polhode.analyse.closed._coin import CoinIntegrals, CoinNutation, SpinningCoin
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._heavy_top import HeavyTop, InitialAngles, Integrals, nutation
from polhode.analyse.closed._reals import Array, DoubleReals, Reals
from polhode.analyse.closed._solution import ExactSolution, Solvable, is_constant
from polhode.base import NumericError
from polhode.derive import Equations
from polhode.model import Gravity

#: Names of Euler's angles in a solution that is later expressed in other angles.
_NAMES = Names("theta", "phi", "theta_dot", "phi_dot", "psi")


@dataclass(frozen=True)
class Axis:
    """The axis e of a symmetric body and the vertical u, along the root's axes.

    Attributes:
        chart: the body's coordinates.
        e: the axis.
        u: the vertical.
        n: ω·e.
        ratio: κ, the moment of inertia about the axis over that across it.
        e_rate: ė along the motion.
    """

    chart: Chart
    e: Row
    u: Row
    n: Expr
    ratio: Expr
    e_rate: Row

    @property
    def cosine(self) -> Expr:
        """e·u."""
        return dot(self.e, self.u)

    @property
    def cosine_rate(self) -> Expr:
        """ė·u."""
        return dot(self.e_rate, self.u)

    @property
    def beta(self) -> Expr:
        """Momentum about the axis, κ n."""
        return self.ratio * self.n

    @property
    def alpha(self) -> Expr:
        """Momentum about the vertical."""
        return dot(_cross(self.e, self.e_rate), self.u) + self.beta * self.cosine

    @property
    def squared_rate(self) -> Expr:
        """ė²."""
        return dot(self.e_rate, self.e_rate)

    def initial_angles(self, data: Data) -> InitialAngles:
        """Euler's angles at the start, with φ = ψ = 0 there.

        Raises `NumericError` for an axis along the vertical, where φ is not defined.
        """
        sine2 = data.number(1 - self.cosine**2)
        if sine2 == 0:
            raise NumericError(
                "an axis that passes through the vertical",
                expected="an axis that leans",
                advice="tilt it a little at the start, or simulate it",
            )
        sine = data.context.sqrt(sine2)
        return InitialAngles(
            theta=data.context.atan2(sine, data.number(self.cosine)),
            theta_dot=-data.number(self.cosine_rate) / sine,
            phi=data.context.zero,
            psi=data.context.zero,
            spin=data.number(self.n),
            names=_NAMES,
        )


def axes(equations: Equations) -> Iterator[Axis]:
    """Every way of reading the equations as those of a symmetric body's axis."""
    root, loads = equations.system.root, equations.system.loads
    verticals = [g.up for g in loads if isinstance(g, Gravity) and g.up is not None]
    verticals += [root[label] for label in reversed(root.labels)]
    distinct = dict.fromkeys(v.express(root).components for v in verticals)
    for body in equations.system.bodies:
        for axis in symmetry_axes(body):
            chart = Chart.of(equations, body, axis.components)
            if chart is None:
                continue
            e = axis.express(body.axes.root).components
            e_rate = tuple(map(equations.rate, e))
            n = equations.kinetics.velocities[body][1].dot(axis)
            spins = len(chart.angles) == 3
            if spins and equations.rate(n):
                continue
            for u in distinct:
                found = _with_ratio(
                    equations, Axis(chart, e, u, n if spins else ZERO, ZERO, e_rate)
                )
                if found is not None:
                    yield found


def _with_ratio(equations: Equations, axis: Axis) -> Axis | None:
    """The axis with the κ that makes the momentum about the vertical constant."""
    slope = axis.n * axis.cosine_rate
    rate = equations.rate(dot(_cross(axis.e, axis.e_rate), axis.u))
    if not rate:
        return axis
    ratio = -rate / slope if slope else ONE * axis.cosine
    return replace(axis, ratio=ratio) if is_constant(ratio) else None


def _cross(a: Row, b: Row) -> Row:
    return tuple(cross(a, b))


@dataclass(frozen=True)
class SymmetricFamily(AttitudeFamily):
    """A symmetric body whose axis follows Euler's angles from the vertical, in any angles.

    Attributes:
        axis: of the body, and the vertical.
    """

    axis: Axis

    def solve(self, data: Data) -> ExactSolution:
        return SymmetricAttitude(NumericChart(self.chart, data), self.euler_angles(data), self.axis)

    @abstractmethod
    def euler_angles(self, data: Data) -> ExactSolution:
        """θ, φ and ψ from the vertical, and the rates of the first two."""


@dataclass(frozen=True)
class TopInAnyAngles(SymmetricFamily):
    """A symmetric top.

    Attributes:
        weight: μ = M g a/I, 1/s², positive where gravity pulls the axis down.
    """

    weight: Expr

    name = HeavyTop.name
    formula = HeavyTop.formula

    @property
    def parts(self) -> dict[str, Expr]:
        return {r"\kappa": self.axis.ratio, r"\mu": self.weight}

    def euler_angles(self, data: Data) -> ExactSolution:
        axis = self.axis
        energy = axis.squared_rate + 2 * self.weight * axis.cosine
        integrals = Integrals(axis.alpha, axis.beta, energy, 2 * self.weight)
        return nutation(data, integrals, axis.initial_angles(data))


@dataclass(frozen=True)
class CoinInAnyAngles(SymmetricFamily):
    """A coin on a smooth table.

    Attributes:
        lift: ε, m a² over the moment of inertia about a diameter.
        weight: γ, m g a over the latter, 1/s².
    """

    lift: Expr
    weight: Expr

    name = SpinningCoin.name
    formula = SpinningCoin.formula

    @property
    def parts(self) -> dict[str, Expr]:
        return {r"\epsilon": self.lift, r"\kappa": self.axis.ratio, r"\gamma": self.weight}

    def euler_angles(self, data: Data) -> ExactSolution:
        axis, start = self.axis, self.axis.initial_angles(data)
        minus, plus = (data.number(axis.alpha + sign * axis.beta) for sign in (-1, 1))
        weight, lift, spin = map(data.number, (self.weight, self.lift, axis.n))
        s, c = data.context.sin(start.theta), data.number(axis.cosine)
        rate = start.theta_dot
        turning = (data.number(axis.alpha) - data.number(axis.beta) * c) / s**2
        energy = (1 + lift * c**2) * rate**2 + (turning * s) ** 2 + 2 * weight * s
        fall = s * c * turning**2 - data.number(axis.beta) * turning * s - weight * c
        integrals = CoinIntegrals(data.context, energy, minus, plus, weight, lift, spin)
        libration = integrals.libration(start.theta, rate, fall, data.digits)
        zero = data.context.zero
        return CoinNutation(libration, integrals, zero, (zero, zero), _NAMES)


@dataclass(frozen=True)
class SymmetricAttitude(AttitudeSolution):
    """The attitude of a symmetric body from Euler's angles of its axis.

    Attributes:
        axis: of the body, and the vertical.
    """

    axis: Axis

    @cached_property
    def step(self) -> float:
        import numpy as np

        period = float(self.solution.period or 1.0)
        moments = np.linspace(0.0, period, 33)
        found = self.solution.at(DoubleReals(), moments)
        rates = np.abs(found["theta_dot"]) + np.abs(found["phi_dot"])
        fastest = float(np.max(rates)) + abs(float(self.placed.data.number(self.axis.n)))
        return min(period / 64, 0.25 / max(fastest, 1e-300))  # a quarter of a radian at most

    @cached_property
    def _initial_triad(self) -> tuple[list[Any], list[Any], list[Any]]:
        """The horizontal direction of the initial lean, the one across it, the vertical."""
        data = self.placed.data
        e, u = [data.number(c) for c in self.axis.e], [data.number(c) for c in self.axis.u]
        lean = [a - scalar(e, u) * b for a, b in zip(e, u, strict=True)]
        size = data.context.sqrt(scalar(lean, lean))
        ahead = [c / size for c in lean]
        return ahead, cross(u, ahead), u

    @cached_property
    def _fixed_axes(self) -> list[list[Any]]:
        """Constant components of the body's axes along those of Euler's angles."""
        e = [self.placed.data.number(c) for c in self.axis.e]
        node = self._initial_triad[1]  # ψ is counted from the horizontal
        return product([node, cross(e, node), e], self.placed.initial_attitude)

    def attitude(self, reals: Reals, times: Array) -> Attitude:
        found = self.solution.at(reals, times)
        ahead, side, up = (list(map(reals.number, v)) for v in self._initial_triad)
        s, c = reals.sin(found["theta"]), reals.cos(found["theta"])
        cos, sin = reals.cos(found["phi"]), reals.sin(found["phi"])
        level = [cos * a + sin * b for a, b in zip(ahead, side, strict=True)]
        node = [cos * b - sin * a for a, b in zip(ahead, side, strict=True)]
        e = [s * v + c * w for v, w in zip(level, up, strict=True)]
        falling = [c * v - s * w for v, w in zip(level, up, strict=True)]
        rates = found["theta_dot"], found["phi_dot"] * s
        e_rate = [rates[0] * f + rates[1] * m for f, m in zip(falling, node, strict=True)]
        spin = reals.number(self.placed.data.number(self.axis.n))
        turning = [w + spin * a for w, a in zip(cross(e, e_rate), e, strict=True)]
        cos, sin = reals.cos(found["psi"]), reals.sin(found["psi"])
        first = [cos * a + sin * b for a, b in zip(node, cross(e, node), strict=True)]
        columns = zip(first, cross(e, first), e, strict=True)
        fixed = [[reals.number(entry) for entry in row] for row in self._fixed_axes]
        return Attitude(product(list(columns), fixed), e, turning)


def recognise(equations: Equations) -> Solvable | None:
    """The equations as those of a symmetric top or of a coin on a smooth table."""
    for axis in axes(equations):
        if not axis.cosine_rate:
            continue
        gain = equations.rate(axis.squared_rate)
        weight = -gain / (2 * axis.cosine_rate)
        if is_constant(weight):
            return TopInAnyAngles(axis.chart, axis, weight)
        rise = equations.rate(principal_root(1 - axis.cosine**2))
        coin = _coin(axis, gain, equations.rate(rise**2), 2 * rise)
        if coin is not None:
            return coin
    return None


def _coin(axis: Axis, gain: Expr, lifting: Expr, raising: Expr) -> CoinInAnyAngles | None:
    """Constants ε and γ with gain + ε lifting + γ raising = 0.

    Solved at two arbitrary choices of the speeds, then verified for all.
    """
    speeds = axis.chart.speeds
    choices = [{s: Expr.of(k + (i * 3 + 1) % 5) for i, s in enumerate(speeds)} for k in (1, 3)]
    rows = [[e.subs(choice) for e in (lifting, raising)] for choice in choices]
    try:
        lift, weight = solve(rows, [-gain.subs(choice) for choice in choices])
    except ZeroDivisionError:
        return None
    if not (is_constant(lift) and is_constant(weight)):
        return None
    whole = gain + lift * lifting + weight * raising
    return None if whole else CoinInAnyAngles(axis.chart, axis, lift, weight)

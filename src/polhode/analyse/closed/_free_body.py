"""A rigid body that turns freely: Jacobi's elliptic functions, and sech and tanh.

A < B < C are the moments of inertia along three axes in that order, and the polhode runs round the
axis of C, or, with A and C exchanged, round that of A. Then (Landau and Lifshitz, Mechanics, § 37)

    ω_A = a cn u, ω_B = ± b sn u, ω_C = ± c dn u.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import Any

from polhode.algebra import ZERO, Expr, Matrix, Row, Symbol, Vector
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
from polhode.analyse.closed._elliptic import EllipticPhase
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._reals import Array, Digits, Reals
from polhode.analyse.closed._solution import ExactSolution, Solvable, is_constant
from polhode.derive import Equations

Three = tuple[Any, ...]

#: Names of the angular velocities in a solution that is later expressed in angles.
_NAMES = ("omega_1", "omega_2", "omega_3")


@dataclass(frozen=True)
class FreeBody(Solvable):
    """Euler's equations without torque.

    Attributes:
        speeds: ω₁, ω₂, ω₃ along the principal axes.
        moments: of inertia about them.
    """

    speeds: tuple[Symbol, Symbol, Symbol]
    moments: tuple[Expr, Expr, Expr]

    name = "free body"
    formula = (
        r"\omega_A = a\operatorname{cn}(\lambda t + u_0), \quad "
        r"\omega_B = \pm b\operatorname{sn}(\lambda t + u_0), \quad "
        r"\omega_C = \pm c\operatorname{dn}(\lambda t + u_0), \quad "
        r"\lambda^2 = \frac{(C - B)(L^2 - 2TA)}{ABC}, \quad "
        r"k'^2 = \frac{(C - A)(L^2 - 2TB)}{(C - B)(L^2 - 2TA)}"
    )

    @property
    def parts(self) -> dict[str, Expr]:
        return {f"I_{i}": moment for i, moment in enumerate(self.moments, 1)}

    @property
    def state(self) -> tuple[Symbol, ...]:
        return self.speeds

    def solve(self, data: Data) -> ExactSolution:
        names = tuple(s.published for s in self.speeds)
        return FreeRotation.start(
            data, self.moments, tuple(map(Expr.generator, self.speeds)), names
        )


def _excess(moments: Three, omega: Three, axis: int) -> Expr:
    """L² - 2 T I_j = Σ I_i (I_i - I_j) ω_i² for one axis j, without subtracting L² and 2 T I_j."""
    terms = (
        moment * (moment - moments[axis]) * w**2 for moment, w in zip(moments, omega, strict=True)
    )
    return sum(terms, start=ZERO)


@dataclass(frozen=True)
class FreeRotation(ExactSolution):
    """One free rotation.

    The momentum L is fixed in space. Directions across it are measured from the one in which the
    body's axis that the polhode encircles (on a separatrix, the middle one) leans from L at t = 0.

    Attributes:
        speeds: published names of ω₁, ω₂, ω₃.
        order: positions of the axes called A, B, C.
        moments: I₁, I₂, I₃, kg m².
        amplitudes: of ω along the axes A, B, C with their signs, 1/s.
        phase: of Jacobi's functions.
        momentum: L, kg m²/s.
    """

    context: Any
    speeds: tuple[str, ...]
    order: tuple[int, ...]
    moments: Three
    amplitudes: Three
    phase: EllipticPhase
    momentum: Any

    @classmethod
    def start(
        cls, data: Data, inertia: Three, rates: Three, names: tuple[str, ...]
    ) -> FreeRotation:
        """From a start that is not steady, with moments and angular velocity as expressions."""
        moments = tuple(map(data.number, inertia))
        order = tuple(sorted(range(3), key=lambda i: moments[i]))
        if data.number(_excess(inertia, rates, order[1])) < 0:
            order = order[::-1]
        first, second, third = order
        A, B, C = (moments[i] for i in order)
        of_a, of_b, of_c = (data.number(_excess(inertia, rates, i)) for i in order)
        sqrt = data.context.sqrt
        rate = sqrt((C - B) * of_a / (A * B * C))
        m1 = (C - A) * of_b / ((C - B) * of_a)
        sizes = (sqrt(of_c / (A * (A - C))), sqrt(of_c / (B * (B - C))), sqrt(of_a / (C * (C - A))))
        omega = tuple(map(data.number, rates))
        # Signs of ω along A, B, C where cn, sn and dn are positive. That of A may be chosen, except
        # on a separatrix, where cn never changes sign. That of B follows from
        # B ω̇_B = ± (C - A) ω_C ω_A, with + if the axes A, B, C are right-handed.
        a_sign = -1 if m1 == 0 and omega[first] < 0 else 1
        c_sign = 1 if omega[third] > 0 else -1
        is_cyclic = order in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
        signs = (a_sign, a_sign * c_sign * (1 if is_cyclic == (C > A) else -1), c_sign)
        amplitudes = tuple(sign * size for sign, size in zip(signs, sizes, strict=True))
        sn, cn = omega[second] / amplitudes[1], omega[first] / amplitudes[0]
        return cls(
            data.context,
            names,
            order,
            moments,
            amplitudes,
            EllipticPhase.through(data.context, rate, sn, cn, m1),
            sqrt(sum((moment * w) ** 2 for moment, w in zip(moments, omega, strict=True))),
        )

    @property
    def kind(self) -> str:
        if self.phase.m1 == 0:
            return "separatrix"
        return f"about axis {self.order[2] + 1}"

    @property
    def period(self) -> Any:
        """Of the angular velocity along the body's axes, s."""
        half = self.phase.half_period
        return None if half is None else 2 * half

    @property
    def figures(self) -> dict[str, Any]:
        """Momentum, complementary parameter, turn about the momentum in a period (rad)."""
        found = {"momentum": self.momentum, "m_1": self.phase.m1}
        if self.period is None:
            return found
        steady, varying, n1 = self._precession
        turn = steady * self.period + 2 * varying * self.phase.third_kind_half(n1)
        return {**found, "precession_per_period": turn}

    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        return dict(zip(self.speeds, self._omega(reals, times), strict=True))

    def besides(self, reals: Reals, times: Array) -> dict[str, Array]:
        """The attitude, and the precession about L of the axis that the polhode encircles.

        "precession" is the angle of that axis about L since t = 0; "herpolhode_1" and
        "herpolhode_2" are ω along two fixed directions across L; "attitude", of shape (..., 3, 3),
        has these directions and that of L as rows, in components along the body's axes.
        """
        import numpy

        omega = self._omega(reals, times)
        if self.phase.m1 == 0:  # 2 T B = L², with which the rate of the middle axis is L/B
            turned = reals.number(self.momentum / self.moments[self.order[1]]) * times
        else:
            steady, varying, n1 = self._precession
            periodic = reals.number(varying) * self.phase.third_kind(reals, times, n1)
            turned = reals.number(steady) * times + periodic
        axes = self._axes(reals, omega, turned)
        first, second, _ = (sum(e * w for e, w in zip(axis, omega, strict=True)) for axis in axes)
        return {
            "precession": turned,
            "herpolhode_1": first,
            "herpolhode_2": second,
            "attitude": numpy.stack([numpy.stack(axis, axis=-1) for axis in axes], axis=-2),
        }

    def _omega(self, reals: Reals, times: Array) -> list[Array]:
        point = self.phase.at(reals, times)
        found: list[Array] = [None, None, None]
        functions = (point.cn, point.sn, point.dn)
        for position, amplitude, function in zip(
            self.order, self.amplitudes, functions, strict=True
        ):
            found[position] = reals.number(amplitude) * function
        return found

    @property
    def _precession(self) -> Three:
        """χ̇ = first + second/(cn² + third sn²), of the axis of C about L.

        From χ̇ = L (A ω_A² + B ω_B²)/(A² ω_A² + B² ω_B²) (Landau and Lifshitz, Mechanics, § 37).
        """
        A, B, C = (self.moments[i] for i in self.order)
        return (
            self.momentum / C,
            self.momentum * (C - A) / (A * C),
            B * (C - A) / (A * (C - B)),
        )

    def _axes(
        self, reals: Reals, omega: list[Array], turned: Array
    ) -> tuple[list[Array], list[Array], list[Array]]:
        """Directions fixed in space, by components along the body's axes: across L, and along."""
        lead = self.order[1] if self.phase.m1 == 0 else self.order[2]
        along = [
            reals.number(moment / self.momentum) * w
            for moment, w in zip(self.moments, omega, strict=True)
        ]
        others = [i for i in range(3) if i != lead]
        lean = reals.sqrt(sum(along[i] ** 2 for i in others))
        out = [-along[lead] * along[i] / lean for i in range(3)]
        out[lead] = lean
        side = cross(along, out)
        cos, sin = reals.cos(turned), reals.sin(turned)
        first = [cos * o - sin * s for o, s in zip(out, side, strict=True)]
        second = [sin * o + cos * s for o, s in zip(out, side, strict=True)]
        return first, second, along


@dataclass(frozen=True)
class FreeBodyInAnyAngles(AttitudeFamily):
    """A free body in any angles of its principal axes: its angular momentum is fixed in space.

    Attributes:
        moments: of inertia about the axes.
        omega: angular velocity along them.
    """

    moments: Row
    omega: Row

    name = FreeBody.name
    formula = FreeBody.formula

    @property
    def parts(self) -> dict[str, Expr]:
        return {f"I_{i}": moment for i, moment in enumerate(self.moments, 1)}

    def solve(self, data: Data) -> ExactSolution:
        rotation = FreeRotation.start(data, self.moments, self.omega, _NAMES)
        return FreeAttitude(NumericChart(self.chart, data), rotation)


@dataclass(frozen=True)
class FreeAttitude(AttitudeSolution):
    """The attitude of a free body, from the solution relative to its angular momentum."""

    solution: FreeRotation

    @property
    def step(self) -> float:
        return 0.25 * float(min(self.solution.moments) / self.solution.momentum)

    @cached_property
    def _initial_axes(self) -> list[list[Any]]:
        """The fixed directions of the solution, along the root's axes."""
        exact = Digits(self.placed.data.context)
        rows = self.solution.besides(exact, exact.array(0))["attitude"]
        return [[scalar(line, row) for row in rows] for line in self.placed.initial_attitude]

    def attitude(self, reals: Reals, times: Array) -> Attitude:
        found = self.solution.besides(reals, times)["attitude"]
        omega = self.solution.at(reals, times)
        relative = [[found[..., i, j] for j in range(3)] for i in range(3)]
        space = [[reals.number(c) for c in row] for row in self._initial_axes]
        rows = product(space, relative)
        turning = [scalar(row, [omega[name] for name in _NAMES]) for row in rows]
        return Attitude(rows, [row[2] for row in rows], turning)


def recognise(equations: Equations) -> FreeBody | None:
    """Three speeds that obey Euler's equations, with moments from the mass matrix.

    I₁ ω̇₁ = (I₂ - I₃) ω₂ ω₃ and cyclic (Goldstein, Classical Mechanics, § 5.5).
    """
    rows = equations.mass.rows
    for i, j, k in combinations(range(len(equations.speeds)), 3):
        speeds = (equations.speeds[i], equations.speeds[j], equations.speeds[k])
        moments = (rows[i][i], rows[j][j], rows[k][k])
        (I_1, I_2, I_3), (w1, w2, w3) = moments, map(Expr.generator, speeds)
        torques = ((I_2 - I_3) * w2 * w3, (I_3 - I_1) * w3 * w1, (I_1 - I_2) * w1 * w2)
        rates = (equations.accelerations[s.derivative()] for s in speeds)
        agree = all(I * rate == M for I, rate, M in zip(moments, rates, torques, strict=True))
        if agree and any(torques) and all(map(is_constant, moments)):
            return FreeBody(speeds, moments)
    return None


def recognise_in_any_angles(equations: Equations) -> FreeBodyInAnyAngles | None:
    """A body with three angles and three different moments on which no torque acts."""
    for body in equations.system.bodies:
        moments = tuple(body.inertia[i, i] for i in range(3))
        if body.inertia != Matrix.diagonal(moments) or not all(map(is_constant, moments)):
            continue
        chart = Chart.of(equations, body, body.axes[body.axes.labels[2]].components)
        if chart is None or len(chart.angles) != 3 or len(set(moments)) < 3:
            continue
        omega = equations.kinetics.velocities[body][1].express(body.axes).components
        spin = Vector(tuple(i * w for i, w in zip(moments, omega, strict=True)), body.axes)
        if not any(map(equations.rate, spin.express(body.axes.root).components)):
            return FreeBodyInAnyAngles(chart, moments, omega)
    return None

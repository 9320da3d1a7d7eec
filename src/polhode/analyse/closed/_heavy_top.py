"""The heavy symmetric top with one point fixed; without gravity, the free symmetric body.

With α = φ̇ sin² θ + β cos θ, β = κ n and ε = θ̇² + φ̇² sin² θ + 2 μ cos θ, all constant,
y = sin² θ/2 obeys

    4 ẏ² = 4 y (1 - y) (ε - 2μ + 4μ y) - (α - β + 2β y)²

and runs between two roots of the cubic as y_a cn² u + y_b sn² u, and z = cos² θ/2 = 1 - y
likewise, so that nothing cancels near either vertical. Then φ̇ = (α - β)/4y + (α + β)/4z
(Whittaker, Analytical Dynamics, § 71). Where μ is negative, y and z change places.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from polhode.algebra import Expr, Symbol, cos, sin
from polhode.analyse.closed._axle import Axle, Names, axles
from polhode.analyse.closed._elliptic import EllipticPhase
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._reals import Array, Reals
from polhode.analyse.closed._solution import ExactSolution, Solvable, is_constant
from polhode.base import NumericError
from polhode.derive import Equations

Pair = tuple[Any, Any]


@dataclass(frozen=True)
class Integrals:
    """Constants of the motion of a top.

    Attributes:
        alpha: momentum about the vertical divided by the transverse moment of inertia, 1/s.
        beta: momentum about the axle divided by the same, 1/s.
        energy: ε, twice the energy without the spin's, divided by the same, 1/s².
        weight: 2 μ, 1/s².
    """

    alpha: Expr
    beta: Expr
    energy: Expr
    weight: Expr


@dataclass(frozen=True)
class InitialAngles:
    """Angles and rates at t = 0, and their names."""

    theta: Any
    theta_dot: Any
    phi: Any
    psi: Any
    spin: Any
    names: Names


@dataclass(frozen=True)
class Nutation(ExactSolution):
    """One nutation, in v = y, or v = z where gravity pulls towards θ = 0.

    Attributes:
        phase: u.
        above: v where cn² is 1, and where sn² is.
        below: 1 - v at the same.
        momenta: 2 v(1 - v) φ̇ where v, and where 1 - v, is zero: α - β and α + β, 1/s.
        inverted: whether v is z.
        beta: momentum about the axle, 1/s.
        pattern: "waves", "loops" or "cusps".
        start: angles and rates at t = 0.
    """

    context: Any
    phase: EllipticPhase
    above: Pair
    below: Pair
    momenta: Pair
    inverted: bool
    beta: Any
    pattern: str
    start: InitialAngles

    @property
    def kind(self) -> str:
        return self.pattern if self.phase.m1 else "separatrix"

    @property
    def period(self) -> Any:
        """Of the nutation, s."""
        return self.phase.half_period

    @property
    def figures(self) -> dict[str, Any]:
        """Turning angles (rad), extremes of φ̇ (rad/s), turn of φ in one nutation (rad)."""
        context, ends = self.context, list(zip(self.above, self.below, strict=True))
        halves = [context.atan2(context.sqrt(v), context.sqrt(w)) for v, w in ends]
        angles = (context.pi - 2 * h if self.inverted else 2 * h for h in halves)
        least, greatest = sorted(angles)
        # extremes of φ̇: at both turning angles, and where it is stationary in between
        product = self.momenta[0] * self.momenta[1]
        if product > 0:
            # φ̇ is stationary where the two terms change alike: v/(1 - v) = √(α - β)/√(α + β).
            ratio = context.sqrt(self.momenta[0] / self.momenta[1])
            inner = (ratio / (1 + ratio), 1 / (1 + ratio))
            low, high = sorted(self.above)
            ends += [inner] if low < inner[0] < high else []
        rates = [
            sum(
                momentum / (4 * v)
                for momentum, v in zip(self.momenta, end, strict=True)
                if momentum
            )
            for end in ends
        ]
        if self.pattern == "cusps":
            rates[rates.index(min(rates, key=abs))] = context.zero
        found = {
            "m_1": self.phase.m1,
            "theta_1": least,
            "theta_2": greatest,
            "phi_dot_least": min(rates),
            "phi_dot_greatest": max(rates),
        }
        if self.period is None:
            return found
        turn = sum(
            momentum / (4 * v[0]) * self.phase.third_kind_half(v[1] / v[0])
            for momentum, v in zip(self.momenta, (self.above, self.below), strict=True)
            if momentum
        )
        return {
            **found,
            "precession_per_nutation": turn,
            "mean_precession": turn / self.period,
        }

    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        names = self.start.names
        point = self.phase.at(reals, times)
        cn2, sn2 = point.cn * point.cn, point.sn * point.sn
        above, below = (
            reals.number(v[0]) * cn2 + reals.number(v[1]) * sn2 for v in (self.above, self.below)
        )
        rate = reals.number(2 * (self.above[1] - self.above[0]) * self.phase.rate)
        angle_rate = rate * point.sn * point.cn * point.dn / reals.sqrt(above * below)
        angle = 2 * reals.atan2(reals.sqrt(above), reals.sqrt(below))
        # The two terms of ∫ φ̇ dt, rad.
        turns = [
            reals.number(momentum / (4 * v[0])) * self.phase.third_kind(reals, times, v[1] / v[0])
            if momentum
            else 0 * times
            for momentum, v in zip(self.momenta, (self.above, self.below), strict=True)
        ]
        found = {
            **self._placed(reals, angle, angle_rate),
            names.phi: reals.number(self.start.phi) + turns[0] + turns[1],
            names.phi_rate: sum(
                reals.number(momentum / 4) / v
                for momentum, v in zip(self.momenta, (above, below), strict=True)
            ),
        }
        if names.psi:
            y_turn, z_turn = turns[::-1] if self.inverted else turns
            steady = reals.number(self.start.spin - self.beta) * times
            found[names.psi] = reals.number(self.start.psi) + steady - y_turn + z_turn
        return found

    def _placed(self, reals: Reals, angle: Array, rate: Array) -> dict[str, Array]:
        """θ and θ̇ on the side of the vertical, and in the whole turn, of the start."""
        names, context, start = self.start.names, self.context, self.start.theta
        side = 1 if context.sin(start) > 0 else -1
        flip = -1 if self.inverted else 1
        base = context.pi if self.inverted else context.zero
        whole = 2 * context.pi * context.nint((start - side * context.pi / 2) / (2 * context.pi))
        return {
            names.theta: reals.number(whole + side * base) + side * flip * angle,
            names.theta_rate: side * flip * rate,
        }


def nutation(data: Data, integrals: Integrals, start: InitialAngles) -> Nutation:
    """The nutation from a start that is not steady.

    Raises `NumericError` where the axle passes exactly through the vertical.
    """
    context, i = data.context, integrals
    inverted = data.number(i.weight) < 0
    sign = -1 if inverted else 1
    weight, beta = sign * data.number(i.weight), sign * data.number(i.beta)
    momenta = (data.number(i.alpha - sign * i.beta), data.number(i.alpha + sign * i.beta))
    levels = (data.number(i.energy - sign * i.weight), data.number(i.energy + sign * i.weight))
    above = _roots(context, levels[0], 2 * weight, momenta[0], 2 * beta)
    below = _roots(context, levels[1], -2 * weight, momenta[1], -2 * beta)
    # With the third root v₀, v̇² = 4μ (v - v₀)(v - low)(high - v) is solved by
    # v = high cn² u + low sn² u with u̇² = μ (high - v₀) and m₁ = (low - v₀)/(high - v₀). The roots
    # for 1 - v come from a cubic of their own, so that none is a difference of close numbers.
    (low, high), (high_below, low_below) = above[-2:], below[:2]
    rate, m1 = context.sqrt(levels[0] + beta**2) / 2, context.one
    if weight:
        rate = context.sqrt(weight * (high - above[0]) / 2)
        m1 = (low - above[0]) / (high - above[0])
    if high_below == 0 or (low == 0 and m1):
        raise NumericError(
            f"an axle that passes through the vertical, where {start.names.phi} jumps",
            expected=f"a start from which {start.names.theta} stays away from 0 and pi",
            advice=(
                "use a motion in a vertical plane, change the momentum a little, or use more "
                "digits= if it does stay away"
            ),
        )
    at_ends = [momentum + 2 * beta * v for momentum, v in ((momenta[0], low), (momenta[0], high))]
    return Nutation(
        context,
        _phase(context, start, inverted, rate, (high, low), m1),
        (high, low),
        (high_below, low_below),
        momenta,
        inverted,
        data.number(i.beta),
        _pattern(data, integrals, at_ends[0] * at_ends[1]),
        start,
    )


def _roots(context: Any, level: Any, slope: Any, momentum: Any, gain: Any) -> list[Any]:
    """The roots of 4v(1 - v)(level + slope v) - (momentum + gain v)², ascending; all are real."""
    cubic = [
        -(momentum**2),
        4 * level - 2 * momentum * gain,
        4 * (slope - level) - gain**2,
        -4 * slope,
    ]
    zeros = next(n for n, coefficient in enumerate(cubic) if coefficient)
    rest = cubic[zeros:] if slope else cubic[zeros:-1]
    found = context.polyroots(rest[::-1], maxsteps=500, extraprec=context.prec)
    return sorted([context.zero] * zeros + [context.re(root) for root in found])


def _phase(
    context: Any, start: InitialAngles, inverted: bool, rate: Any, ends: Pair, m1: Any
) -> EllipticPhase:
    sine, cosine = context.sin(start.theta / 2), context.cos(start.theta / 2)
    v = cosine**2 if inverted else sine**2
    v_rate = sine * cosine * start.theta_dot * (-1 if inverted else 1)
    high, low = ends
    dn = context.sqrt(m1 + (1 - m1) * (v - low) / (high - low))
    # Near its extremes cn² determines u badly; sine and cosine of twice the amplitude do so well:
    # v - (high + low)/2 = (high - low)/2 · cos 2 am u, and v̇ = -(high - low) sin 2 am u · u̇ dn.
    twice_sine = -2 * v_rate / (rate * dn)
    amplitude = context.atan2(twice_sine, 2 * (2 * v - high - low)) / 2
    return EllipticPhase.through(context, rate, context.sin(amplitude), context.cos(amplitude), m1)


def _pattern(data: Data, integrals: Integrals, product: Any) -> str:
    """By the signs of φ̇ at the turning angles: cusps where it is exactly zero at one of them.

    There cos θ = α/β and θ̇ = 0, hence ε = 2μ α/β.
    """
    alpha, beta = integrals.alpha, integrals.beta
    at_rest = data.number(integrals.energy * beta - integrals.weight * alpha) == 0
    if at_rest and abs(data.number(alpha)) < abs(data.number(beta)):
        return "cusps"
    return "loops" if product < 0 else "waves"


@dataclass(frozen=True)
class HeavyTop(Solvable):
    """θ̈ = sin θ (φ̇² cos θ - κ n φ̇ + μ) for an axle; a spherical pendulum has no n.

    Attributes:
        axle: roles of coordinates and speeds.
        weight: μ = M g a/I, 1/s², positive where θ is from the upward vertical.
    """

    axle: Axle
    weight: Expr

    name = "symmetric top"
    formula = (
        r"\sin^2\frac{\theta}{2} = y_a\operatorname{cn}^2(wt + u_0) + "
        r"y_b\operatorname{sn}^2(wt + u_0), \quad "
        r"\dot\phi = \frac{\alpha - \beta\cos\theta}{\sin^2\theta}, \quad \beta = \kappa\omega"
    )

    @property
    def parts(self) -> dict[str, Expr]:
        return {r"\kappa": self.axle.ratio, r"\mu": self.weight}

    @property
    def state(self) -> tuple[Symbol, ...]:
        return self.axle.state

    def check(self, data: Data) -> None:
        theta = Expr.generator(self.axle.theta)
        if data.number(sin(theta)) == 0:
            raise NumericError(
                f"a sleeping top: {theta} is vertical at the start, where "
                f"{self.axle.names.phi} is not defined",
                expected="an axle that leans",
                advice=(
                    "an upright top in steady motion has no period; "
                    "use other angles (Cardan's) for motions through the vertical"
                ),
            )

    def solve(self, data: Data) -> Nutation:
        axle = self.axle
        theta, phi, theta_dot, phi_dot = map(
            Expr.generator, (axle.theta, axle.phi, axle.theta_rate, axle.phi_rate)
        )
        beta = axle.ratio * axle.n
        alpha = phi_dot * sin(theta) ** 2 + beta * cos(theta)
        energy = theta_dot**2 + (phi_dot * sin(theta)) ** 2 + 2 * self.weight * cos(theta)
        start = InitialAngles(
            theta=data.number(theta),
            theta_dot=data.number(theta_dot),
            phi=data.number(phi),
            psi=data.number(Expr.generator(axle.psi)) if axle.psi else data.context.zero,
            spin=data.number(axle.n),
            names=axle.names,
        )
        return nutation(data, Integrals(alpha, beta, energy, 2 * self.weight), start)


def recognise(equations: Equations) -> HeavyTop | None:
    """The equations as those of a symmetric top in Euler's angles, under gravity or none."""
    for axle in axles(equations):
        theta, turning = Expr.generator(axle.theta), Expr.generator(axle.phi_rate)
        pull = equations.accelerations[axle.theta_rate.derivative()] / sin(theta)
        weight = pull - turning**2 * cos(theta) + axle.ratio * axle.n * turning
        if is_constant(weight):
            return HeavyTop(axle, weight)
    return None

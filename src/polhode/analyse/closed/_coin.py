"""A coin that spins on a smooth table: quadrature between turning angles, as a Fourier series.

For a libration q̇² = F(q) between two turning points, q = mean - half cos s makes the rate
ṡ = √G(s) regular, and the trapezoidal rule in s converges exponentially, as its integrand is
periodic and analytic (Trefethen and Weideman, SIAM Review 56 (2014) 385). The period is ∫ ds/√G,
and every quantity of the motion is a series in the phase M = 2πt/T, as in Kepler's problem.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice
from typing import Any, NamedTuple

from polhode.algebra import ZERO, Expr, Symbol, cos, sin
from polhode.analyse.closed._axle import Axle, Names, axles
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._reals import Array, Reals
from polhode.analyse.closed._solution import ExactSolution, Solvable, is_constant
from polhode.base import NumericError
from polhode.derive import Equations

#: Fewest and most nodes.
_FEWEST, _MOST = 64, 2048


class FourierSeries(NamedTuple):
    """s = M + Σ b_k sin kM, and φ = drift · t + Σ c_k sin kM for every angle that follows q.

    Attributes:
        lags: b₁, b₂, …
        swings: c₁, c₂, … of each angle.
        start: M at t = 0.
    """

    lags: list[Any]
    swings: tuple[list[Any], ...]
    start: Array


class _Nodes(NamedTuple):
    """Midpoints of s, with dt/ds and the rates of the angles that follow q at each."""

    s: list[Any]
    delay: list[Any]
    rates: list[tuple[Any, ...]]

    @property
    def mean_delay(self) -> Any:
        return sum(self.delay) / len(self.delay)


@dataclass(frozen=True, eq=False)
class Libration:
    """A motion between turning points.

    Attributes:
        context: of the constants.
        ends: least and greatest q.
        square: F(q).
        angle_rates: rates of the angles that follow q.
        start: s at t = 0.
        digits: decimal digits of the period.
    """

    context: Any
    ends: tuple[Any, Any]
    square: Callable[[Any], Any]
    angle_rates: Callable[[Any], tuple[Any, ...]]
    start: Any
    digits: int
    _series: dict[Reals, FourierSeries] = field(default_factory=dict, repr=False)

    @property
    def period(self) -> Any:
        """Of the libration, s."""
        return 2 * self.context.pi * self._nodes.mean_delay

    @cached_property
    def drifts(self) -> tuple[Any, ...]:
        """Mean rates of the angles that follow q, 1/s."""
        nodes = self._nodes
        return tuple(
            sum(rate * delay for rate, delay in zip(rates, nodes.delay, strict=True))
            / sum(nodes.delay)
            for rates in zip(*nodes.rates, strict=True)
        )

    def at(self, reals: Reals, times: Array) -> tuple[Array, Array, list[Array]]:
        """q, q̇ and the angles that follow q, which are 0 at t = 0."""
        if reals not in self._series:
            self._series[reals] = self._expanded(reals)
        lags, swings, start = self._series[reals]
        frequency = 2 * self.context.pi / self.period
        turns = reals.turns(times, 1 / self.period, 0)
        M = turns.fraction * reals.number(2 * self.context.pi) + start
        s = M + _sines(reals, lags, M)
        terms = enumerate(zip(lags, reals.harmonics(M), strict=False), 1)
        slope = 1 + sum((k * b * cos for k, (b, (_, cos)) in terms), start=0 * M)  # ds/dM
        s_rate = reals.number(frequency) * slope
        low, high = (reals.number(end) for end in self.ends)
        half = (high - low) / 2
        angles = [
            reals.number(drift) * times + _sines(reals, swing, M) - _sines(reals, swing, start)
            for drift, swing in zip(self.drifts, swings, strict=True)
        ]
        return (
            (low + high) / 2 - half * reals.cos(s),
            half * reals.sin(s) * s_rate,
            angles,
        )

    @cached_property
    def _nodes(self) -> _Nodes:
        """As many as needed: their number is doubled until the period no longer changes."""
        coarse = self._at_nodes(_FEWEST)
        while len(coarse.s) < _MOST:
            fine = self._at_nodes(2 * len(coarse.s))
            change = abs(fine.mean_delay / coarse.mean_delay - 1)
            if change < self.context.mpf(10) ** -(self.digits + 2):
                return fine
            coarse = fine
        raise _too_sharp()

    def _at_nodes(self, count: int) -> _Nodes:
        context, (low, high) = self.context, self.ends
        mean, half = (low + high) / 2, (high - low) / 2
        # midpoints, as at the turning points dt/ds is 0/0; half a period, by symmetry
        s = [(j + context.mpf(0.5)) * context.pi / count for j in range(count)]
        q = [mean - half * context.cos(angle) for angle in s]
        delay = [
            half * context.sin(angle) / context.sqrt(self.square(place))
            for angle, place in zip(s, q, strict=True)
        ]
        return _Nodes(s, delay, [self.angle_rates(place) for place in q])

    def _expanded(self, reals: Reals) -> FourierSeries:
        nodes = self._nodes
        while len(nodes.s) <= _MOST:
            found = self._from_nodes(reals, nodes)
            if found is not None:
                return found
            nodes = self._at_nodes(2 * len(nodes.s))
        raise _too_sharp()

    def _from_nodes(self, reals: Reals, nodes: _Nodes) -> FourierSeries | None:
        """The series, or None if they have not converged on that many nodes."""
        count, mean = len(nodes.s), nodes.mean_delay
        s, delay = reals.array(nodes.s), reals.array([d / mean for d in nodes.delay])
        orders = range(1, count // 2)
        # First M(s) = s + Σ a_k sin ks, from dM/ds = (dt/ds)/mean; then its inverse s(M), whose
        # coefficients are b_k = (2/πk) ∫ cos kM ds, as those of Kepler's equation (Bessel).
        at_s = [cos for _, cos in islice(reals.harmonics(s), count // 2 - 1)]
        advances = [2 * (delay * wave).sum() / (k * count) for k, wave in enumerate(at_s, 1)]
        M = s + _sines(reals, advances, s)
        at_M = (cos for _, cos in reals.harmonics(M))
        waves = [2 * cos / (k * count) for k, cos in zip(orders, at_M, strict=False)]
        lags = [wave.sum() for wave in waves]
        weights = [
            reals.array([(rate - drift) * d for rate, d in zip(rates, nodes.delay, strict=True)])
            for drift, rates in zip(self.drifts, zip(*nodes.rates, strict=True), strict=True)
        ]
        swings = [[(wave * weight).sum() for wave in waves] for weight in weights]
        # below sixteen roundings the coefficients are noise of the sums over the nodes
        smallest = max(16 * reals.eps, reals.number(self.context.mpf(10) ** -(self.digits + 2)))
        if max(map(abs, lags[-count // 16 :])) > smallest:
            return None  # the tail has not decayed
        kept = max((k for k in orders if abs(lags[k - 1]) > smallest / 256), default=1)
        start = reals.array(reals.number(self.start))
        kept_swings = tuple(swing[:kept] for swing in swings)
        return FourierSeries(lags[:kept], kept_swings, start + _sines(reals, advances, start))


def _sines(reals: Reals, coefficients: list[Any], angle: Array) -> Array:
    terms = zip(coefficients, reals.harmonics(angle), strict=False)
    return sum((b * sin for b, (sin, _) in terms), start=0 * angle)


def _too_sharp() -> NumericError:
    return NumericError(
        f"a motion too sharply peaked for a series of {_MOST} nodes",
        expected="turning points away from equilibria and from singular positions",
        advice="change the start a little, or simulate it",
    )


@dataclass(frozen=True)
class SpinningCoin(Solvable):
    """(1 + ε cos² θ) θ̈ = sin θ cos θ (ε θ̇² + φ̇²) - κ n φ̇ sin θ - γ cos θ for an axle.

    Attributes:
        axle: roles of coordinates and speeds.
        lift: ε, m a² divided by the moment of inertia about a diameter.
        weight: γ, m g a divided by the latter, 1/s².
    """

    axle: Axle
    lift: Expr
    weight: Expr

    name = "spinning coin"
    formula = (
        r"t = \int \frac{\sqrt{1 + \epsilon\cos^2\theta}\,d\theta}{\sqrt{2E - 2\gamma\sin\theta "
        r"- (\alpha - \beta\cos\theta)^2/\sin^2\theta}}, \quad "
        r"\dot\phi = \frac{\alpha - \beta\cos\theta}{\sin^2\theta}, \quad \beta = \kappa\omega"
    )

    @property
    def parts(self) -> dict[str, Expr]:
        return {r"\epsilon": self.lift, r"\kappa": self.axle.ratio, r"\gamma": self.weight}

    @property
    def state(self) -> tuple[Symbol, ...]:
        return self.axle.state

    def solve(self, data: Data) -> ExactSolution:
        axle = self.axle
        theta, phi, theta_dot, phi_dot = map(
            Expr.generator, (axle.theta, axle.phi, axle.theta_rate, axle.phi_rate)
        )
        s, c, beta = sin(theta), cos(theta), axle.ratio * axle.n
        alpha = phi_dot * s**2 + beta * c
        swing = (1 + self.lift * c**2) * theta_dot**2
        energy = swing + (phi_dot * s) ** 2 + 2 * self.weight * s
        fall = s * c * phi_dot**2 - beta * phi_dot * s - self.weight * c
        constants = (energy, alpha - beta, alpha + beta, self.weight, self.lift, axle.n)
        integrals = CoinIntegrals(data.context, *map(data.number, constants))
        start = data.number(theta)
        whole = 2 * data.context.pi * data.context.nint(start / (2 * data.context.pi) - 0.25)
        rates = (data.number(theta_dot), data.number(fall))
        libration = integrals.libration(start - whole, *rates, data.digits)
        angles = (data.number(phi), data.number(Expr.generator(axle.psi) if axle.psi else ZERO))
        return CoinNutation(libration, integrals, whole, angles, axle.names)


@dataclass(frozen=True)
class CoinIntegrals:
    """Constants of the motion.

    Attributes:
        energy: twice the energy without the spin's, divided by the moment about a diameter, 1/s².
        minus: α - β, momenta about the vertical and the axis divided by that moment, 1/s.
        plus: α + β.
        weight: γ.
        lift: ε.
        spin: n.
    """

    context: Any
    energy: Any
    minus: Any
    plus: Any
    weight: Any
    lift: Any
    spin: Any

    def azimuth_rate(self, sin: Any, cos: Any) -> Any:
        """φ̇; elementwise where the constants and arguments are arrays."""
        return (self.minus * (1 + cos) + self.plus * (1 - cos)) / (2 * sin * sin)

    def square(self, theta: Any) -> Any:
        """θ̇²."""
        sin, cos = self.context.sin(theta), self.context.cos(theta)
        turning = (self.azimuth_rate(sin, cos) * sin) ** 2
        return (self.energy - turning - 2 * self.weight * sin) / (1 + self.lift * cos**2)

    def angle_rates(self, theta: Any) -> tuple[Any, Any]:
        """φ̇ and ψ̇."""
        sin, cos = self.context.sin(theta), self.context.cos(theta)
        rate = self.azimuth_rate(sin, cos)
        return rate, self.spin - rate * cos

    def libration(self, theta: Any, theta_dot: Any, fall: Any, digits: int) -> Libration:
        """The motion between the turning angles on both sides of the start.

        Raises `NumericError` where there are none because the coin falls flat.
        """
        context = self.context
        tangent, roots = context.tan(theta / 2), self._turning_tangents()
        # If the start is itself a turning point, θ̈ decides to which side the motion continues.
        nearest = min(roots, key=lambda x: abs(x - tangent))
        below = [x for x in roots if x < tangent and x != nearest]
        above = [x for x in roots if x > tangent and x != nearest]
        if abs(nearest - tangent) > context.sqrt(context.eps) * tangent:
            (below if nearest < tangent else above).append(nearest)
        else:
            (below if fall > 0 else above).append(nearest)
        if not above or not below or (self.minus == 0 and max(below) == 0):
            raise NumericError(
                "a coin that falls flat on the table",
                expected="a start with both momenta, about the vertical and the axis, so that the "
                "coin rises again",
                advice="simulate it up to the impact",
            )
        low, high = (2 * context.atan(x) for x in (max(below), min(above)))
        cosine = (low + high - 2 * theta) / (high - low)
        start = context.acos(max(-1, min(1, cosine)))
        start = -start if theta_dot < 0 else start
        return Libration(context, (low, high), self.square, self.angle_rates, start, digits)

    def _turning_tangents(self) -> list[Any]:
        """tan θ/2 where θ̇ = 0, and 0 where the coin can fall flat to θ = 0."""
        # With x = tan θ/2, φ̇ sin θ = (a + b x²)/2x, and the numerator of θ̇² is
        # 4 E x² (1 + x²) - (a + b x²)² (1 + x²) - 16 γ x³, here from x⁶ down.
        context, a, b = self.context, self.minus, self.plus
        sextic = [
            -(b**2),
            context.zero,
            4 * self.energy - 2 * a * b - b**2,
            -16 * self.weight,
            4 * self.energy - 2 * a * b - a**2,
            context.zero,
            -(a**2),
        ]
        sextic = sextic[:-2] if a == 0 else sextic
        first = next(i for i, coefficient in enumerate(sextic) if coefficient)
        found = context.polyroots(sextic[first:], maxsteps=500, extraprec=context.prec)
        small = context.sqrt(context.eps)  # roots close to one another lose half the digits
        real = [context.re(x) for x in found if abs(context.im(x)) < small * abs(x)]
        return [x for x in real if x > 0] + ([context.zero] if a == 0 else [])


@dataclass(frozen=True)
class CoinNutation(ExactSolution):
    """The coin nodding between two angles while it turns.

    Attributes:
        libration: of θ in (0, π), carrying φ and ψ.
        integrals: constants of the motion.
        whole: turns of θ at the start, rad.
        start: φ and ψ at t = 0.
        names: of angles and rates.
    """

    libration: Libration
    integrals: CoinIntegrals
    whole: Any
    start: tuple[Any, Any]
    names: Names

    kind = "nutation"

    @property
    def period(self) -> Any:
        """Of the nutation, s."""
        return self.libration.period

    @property
    def figures(self) -> dict[str, Any]:
        """Turning angles (rad), and the turn of φ in one nutation (rad)."""
        low, high = self.libration.ends
        turn = self.libration.drifts[0] * self.period
        return {
            "theta_1": low,
            "theta_2": high,
            "precession_per_nutation": turn,
            "mean_precession": self.libration.drifts[0],
        }

    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        names = self.names
        angle, rate, (turned, spun) = self.libration.at(reals, times)
        sine, cosine = reals.sin(angle), reals.cos(angle)
        minus, plus = reals.number(self.integrals.minus), reals.number(self.integrals.plus)
        found = {
            names.theta: reals.number(self.whole) + angle,
            names.theta_rate: rate,
            names.phi: reals.number(self.start[0]) + turned,
            names.phi_rate: (minus * (1 + cosine) + plus * (1 - cosine)) / (2 * sine * sine),
        }
        spins = {names.psi: reals.number(self.start[1]) + spun} if names.psi else {}
        return found | spins


def recognise(equations: Equations) -> SpinningCoin | None:
    """The equations as those of a disk on a smooth table, in Euler's angles."""
    for axle in axles(equations):
        theta, rate, turning = map(Expr.generator, (axle.theta, axle.theta_rate, axle.phi_rate))
        s, c = sin(theta), cos(theta)
        swing = equations.accelerations[axle.theta_rate.derivative()]
        squared = swing.diff(axle.phi_rate).diff(axle.phi_rate)
        if not squared:
            continue
        inertia = 2 * s * c / squared
        lift = (inertia - 1) / c**2
        pull = s * c * (lift * rate**2 + turning**2) - axle.ratio * axle.n * turning * s
        weight = (pull - inertia * swing) / c
        if is_constant(lift) and is_constant(weight):
            return SpinningCoin(axle, lift, weight)
    return None

"""The heavy symmetric top with one point fixed, and without gravity the free symmetric body."""

from __future__ import annotations

from dataclasses import dataclass

from polhode.algebra import Expr, Symbol, cos, sin
from polhode.analyse.closed._axle import Axle, axles
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._nutation import Integrals, Nutation, Release, nutation
from polhode.analyse.closed._solution import Solvable, is_constant
from polhode.base import NumericError
from polhode.derive import Equations


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
                f"a sleeping top: {theta} at the vertical at the start, where "
                f"{self.axle.names.phi} is not defined",
                expected="an axle that leans",
                advice=(
                    "it sleeps as it is, a steady motion without a period; "
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
        release = Release(
            theta=data.number(theta),
            theta_dot=data.number(theta_dot),
            phi=data.number(phi),
            psi=data.number(Expr.generator(axle.psi)) if axle.psi else data.context.zero,
            spin=data.number(axle.n),
            names=axle.names,
        )
        return nutation(data, Integrals(alpha, beta, energy, 2 * self.weight), release)


def recognise(equations: Equations) -> HeavyTop | None:
    """The equations as those of a symmetric top in Euler's angles, under gravity or none."""
    for axle in axles(equations):
        theta, turning = Expr.generator(axle.theta), Expr.generator(axle.phi_rate)
        pull = equations.accelerations[axle.theta_rate.derivative()] / sin(theta)
        weight = pull - turning**2 * cos(theta) + axle.ratio * axle.n * turning
        if is_constant(weight):
            return HeavyTop(axle, weight)
    return None

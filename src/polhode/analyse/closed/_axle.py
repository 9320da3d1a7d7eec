"""Roles of coordinates and speeds in the motion of a symmetric body's axle."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import permutations

from polhode.algebra import ZERO, Expr, Symbol, cos, sin
from polhode.analyse.closed._solution import is_constant, rates
from polhode.derive import Equations


@dataclass(frozen=True)
class Axle:
    """Euler's angles, with φ̈ = θ̇ (κ n - 2 φ̇ cos θ)/sin θ: no torque about the vertical.

    Attributes:
        theta: angle of the axle from the vertical.
        phi: azimuth.
        theta_rate: θ̇, a speed of the equations.
        phi_rate: φ̇, another.
        spin: n, the constant angular velocity along the axle; None for a pendulum without spin.
        psi: spin angle, of rate n - φ̇ cos θ; None where it is not among the coordinates.
        ratio: κ, the moment of inertia about the axle divided by the transverse one.
    """

    theta: Symbol
    phi: Symbol
    theta_rate: Symbol
    phi_rate: Symbol
    spin: Symbol | None
    psi: Symbol | None
    ratio: Expr

    @property
    def n(self) -> Expr:
        """The spin; zero where there is none."""
        return Expr.generator(self.spin) if self.spin else ZERO

    @property
    def state(self) -> tuple[Symbol, ...]:
        """θ, θ̇ and φ̇, a closed system of equations."""
        return self.theta, self.theta_rate, self.phi_rate

    @property
    def names(self) -> Names:
        """Published names."""
        return Names(
            theta=self.theta.published,
            phi=self.phi.published,
            theta_rate=self.theta_rate.published,
            phi_rate=self.phi_rate.published,
            psi=self.psi.published if self.psi else "",
        )


@dataclass(frozen=True)
class Names:
    """Published names of the angles and rates; that of ψ is empty where there is none."""

    theta: str
    phi: str
    theta_rate: str
    phi_rate: str
    psi: str


def axles(equations: Equations) -> Iterator[Axle]:
    """Every way of reading the equations as those of an axle."""
    angles, coordinates = rates(equations), equations.coordinates
    for theta_rate, phi_rate in permutations(angles, 2):
        others = [s for s in equations.speeds if s not in (theta_rate, phi_rate)]
        for spin in (*others, None):
            ratio = _ratio(equations, angles[theta_rate], theta_rate, phi_rate, spin)
            if ratio is not None:
                theta, phi = angles[theta_rate], angles[phi_rate]
                psi = None
                if spin is not None:
                    turning = Expr.generator(phi_rate) * cos(Expr.generator(theta))
                    psi_rate = Expr.generator(spin) - turning
                    kinematics = equations.kinematics
                    matching = (q for q in coordinates if kinematics[q.derivative()] == psi_rate)
                    psi = next(matching, None)
                yield Axle(theta, phi, theta_rate, phi_rate, spin, psi, ratio)


def _ratio(
    equations: Equations, theta: Symbol, theta_rate: Symbol, phi_rate: Symbol, spin: Symbol | None
) -> Expr | None:
    """κ, if φ̈ is that of an axle without torque about the vertical; otherwise None."""
    accelerations = equations.accelerations
    angle, turning = Expr.generator(theta), Expr.generator(phi_rate)
    pull = accelerations[phi_rate.derivative()] * sin(angle) / Expr.generator(theta_rate)
    carried = pull + 2 * turning * cos(angle)
    if spin is None:
        return None if carried else ZERO
    ratio = carried / Expr.generator(spin)
    spins_on = not accelerations[spin.derivative()]
    return ratio if ratio and is_constant(ratio) and spins_on else None

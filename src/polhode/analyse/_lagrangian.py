"""The Lagrangian in coordinates and their rates, the momenta, and Lagrange's equations."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import Expr, Symbol, SymbolKind, linear_parts, solve
from polhode.base import DeclarationError, Shown
from polhode.derive import Equations, equations_only


@dataclass(frozen=True)
class Lagrangian(Shown):
    """The Lagrangian of a system whose coordinates are independent.

    Attributes:
        equations: of the system.
        kinetic: kinetic energy, J, in coordinates and their rates.
        potential: potential energy, J.
    """

    equations: Equations
    kinetic: Expr
    potential: Expr

    @property
    def value(self) -> Expr:
        """T - V, J."""
        return self.kinetic - self.potential

    @cached_property
    def momenta(self) -> dict[Symbol, Expr]:
        """The momentum conjugate to each coordinate, ∂L/∂q̇."""
        return {q: self.kinetic.diff(q.derivative()) for q in self.equations.coordinates}

    @property
    def cyclic(self) -> tuple[Symbol, ...]:
        """The coordinates that the Lagrangian does not contain."""
        return tuple(q for q in self.equations.coordinates if not self.value.diff(q))

    @property
    def conserved(self) -> tuple[Symbol, ...]:
        """Cyclic coordinates without a generalised force: their momenta are constant."""
        return tuple(q for q in self.cyclic if not self.generalised_force(q))

    def rate_of_momentum_less_slope(self, coordinate: Symbol) -> Expr:
        """d/dt ∂L/∂q̇ - ∂L/∂q, in coordinates, rates and accelerations."""
        return self.momenta[coordinate].dt() - self.value.diff(coordinate)

    def generalised_force(self, coordinate: Symbol) -> Expr:
        """What d/dt ∂L/∂q̇ - ∂L/∂q amounts to along the motion: zero for conservative systems."""
        return self.equations.on_shell(
            in_speeds(self, self.rate_of_momentum_less_slope(coordinate))
        )

    def __str__(self) -> str:
        lines = [f"T = {self.kinetic.pretty()}", f"V = {self.potential.pretty()}"]
        lines += [
            f"P_{q.published} = {value.pretty()}{', constant' if q in self.conserved else ''}"
            for q, value in self.momenta.items()
        ]
        return "\n".join(lines)


def in_speeds(lagrangian: Lagrangian, expression: Expr) -> Expr:
    """An expression of rates and their derivatives in terms of the independent speeds."""
    kinetics = lagrangian.equations.kinetics
    table: dict[Symbol, Expr] = {}
    for rate, value in kinetics.kinematics.items():
        table[rate] = value
        table[rate.derivative()] = value.chain(kinetics.rate)
    return expression.subs(table)


def lagrangian(equations: Equations) -> Lagrangian:
    """The Lagrangian, the momenta and Lagrange's equations.

    Raises:
        DeclarationError: where a constraint relates velocities, as rolling does, or coordinates
            depend on one another: Lagrange's equations in this form do not apply.
    """
    equations_only(equations, "the Lagrangian")
    coordinates, speeds = equations.coordinates, equations.speeds
    rates = {q.derivative(): equations.kinematics[q.derivative()] for q in coordinates}
    if len(speeds) != len(coordinates):
        raise _not_independent(equations)
    pairs = [(rate, *linear_parts(value, speeds)) for rate, value in rates.items()]
    right = [Expr.generator(rate) - rest for rate, _, rest in pairs]
    try:
        values = solve([row for _, row, _ in pairs], right)
    except ZeroDivisionError as error:  # as of a ball that can spin, and cannot leave the floor
        raise _not_independent(equations) from error
    table = {
        speed: value
        for speed, value in zip(speeds, values, strict=True)
        if speed.kind is SymbolKind.SPEED
    }
    return Lagrangian(
        equations,
        equations.kinetic_energy.subs(table),
        equations.potential_energy.subs(table),
    )


def _not_independent(equations: Equations) -> DeclarationError:
    counts = f"{len(equations.coordinates)} coordinates and {len(equations.speeds)} independent"
    return DeclarationError(
        f"Lagrange's equations for {equations.system.name!r}, with {counts} speeds",
        expected="independent coordinates, and no constraint on velocities such as rolling",
        advice="use Newton's law and the torque equation, which derive gives",
    )

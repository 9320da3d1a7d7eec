"""Lagrange's equations, exactly, from the Lagrangian that polhode finds and from nothing else."""

from __future__ import annotations

from polhode.algebra import ZERO, Expr, Symbol, eliminate
from polhode.derive import Equations, derive
from polhode.derive._balance import ReactionColumn
from polhode.model import Smooth, System


def lagrange(equations: Equations) -> tuple[Expr, ...]:
    """Lagrange's equations of a holonomic system, one for every independent speed.

    d/dt ∂L/∂q̇ - ∂L/∂q for every coordinate, summed with the rate of it that a unit of the speed
    makes: virtual work in the motions that the speed alone makes.
    """
    on_rates = equations.lagrangian.subs(_speeds_in_rates(equations))
    coordinates = {s: Expr.generator(s) for s in equations.coordinates}
    forces = {s: on_rates.diff(q.dt()).dt() - on_rates.diff(q) for s, q in coordinates.items()}
    settled = {s: _on_speeds(force, equations) for s, force in forces.items()}
    return tuple(
        sum(
            (settled[s] * equations.kinematics[s.derivative()].diff(u) for s in coordinates),
            ZERO,
        )
        for u in equations.speeds
    )


def rolling_lagrange(rolling: Equations) -> tuple[Expr, ...]:
    """Lagrange's equations of one rolling body, its friction being the multipliers: all vanish.

    The Lagrangian is that of the same body on a smooth support, whose speeds are free. For each
    of its speeds the friction counts with the velocity of the contact in a unit of that speed.
    """
    (contact,) = rolling.system.elements
    smooth = derive(System(Smooth(contact.body, on=contact.on), *rolling.system.loads))
    rates = {s.derivative(): e.chain(rolling.kinetics.rate) for s, e in rolling.dependent.items()}
    forces, lines = rolling.components, rolling.lines
    friction = [
        sum((forces[line.name] * _reach(smooth, line, u) for line in lines), ZERO)
        for u in smooth.speeds
    ]
    return tuple(
        rolling.on_shell(row.subs(rates)) - rolling.on_shell(force)
        for row, force in zip(lagrange(smooth), friction, strict=True)
    )


def _reach(smooth: Equations, line: ReactionColumn, speed: Symbol) -> Expr:
    """Velocity of the contact along a reaction, in a unit of a speed."""
    return smooth.kinetics.slip(line.restraint).dot(line.direction).diff(speed)


def _on_speeds(expression: Expr, equations: Equations) -> Expr:
    """With rates of coordinates, and rates of those, put in terms of speeds and accelerations."""
    rates = {s: e for s, e in equations.kinematics.items() if s not in equations.speeds}
    second = {s.derivative(): e.chain(equations.kinetics.rate) for s, e in rates.items()}
    return expression.subs({**rates, **second})


def _speeds_in_rates(equations: Equations) -> dict[Symbol, Expr]:
    """The independent speeds as the rates of coordinates make them."""
    still = dict.fromkeys(equations.speeds, 0)
    rows = {r: [e.diff(u) for u in equations.speeds] for r, e in equations.kinematics.items()}
    carried = {r: e.subs(still) for r, e in equations.kinematics.items()}
    moving = [r for r, row in rows.items() if any(row)]
    right = [Expr.generator(r) - carried[r] for r in moving]
    solved = eliminate([rows[r] for r in moving], right).solved
    return {u: solved[i][1] for i, u in enumerate(equations.speeds)}

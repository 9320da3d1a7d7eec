"""Second formulations of mechanics, to compare derived equations with.

The derivation balances forces and projects them. Here the same motion is asked of scalars alone:
the Lagrangian, or Gibbs' energy of acceleration.
"""

from __future__ import annotations

from polhode.algebra import ZERO, Expr, Symbol, Vector, solve
from polhode.derive import Equations
from polhode.model import Body


def is_conservative(equations: Equations) -> bool:
    """Whether every load has a potential, and friction does no work on virtual motions."""
    motion = equations.kinetics
    bodies, places = equations.system.bodies, motion.places
    friction = any(element.friction(places) for element in motion.elements)
    return not friction and all(
        load.potential(bodies, places) is not None for load in equations.system.loads
    )


def is_holonomic(equations: Equations) -> bool:
    """Whether the coordinates that move are as many as the independent speeds."""
    moving = _moving(equations)
    return len(moving) == len(equations.speeds) and not equations.closures


def lagrange(equations: Equations) -> tuple[Expr, ...]:
    """d/dt ∂L/∂q̇ - ∂L/∂q along the derived motion, for every coordinate that moves.

    L is the kinetic less the potential energy as a function of coordinates and their rates.
    """
    rates = {q.derivative(): rate for q, rate in _moving(equations).items()}
    lagrangian = equations.lagrangian.subs(_speeds_in_rates(equations, rates))
    return tuple(
        _along_motion(equations, lagrangian.diff(rate).dt() - lagrangian.diff(rate.base()))
        for rate in rates
    )


def appell(equations: Equations) -> tuple[Expr, ...]:
    """∂S/∂u̇ - Q less the derived rows, for every independent speed u.

    S = Σ ½m a² + ½α·Iα + α·(ω × Iω), and Q u is the power of the loads in a unit of u alone
    (Gibbs 1879, Appell 1899).
    """
    motion = equations.kinetics
    gibbs = sum((_gibbs(equations, body) for body in equations.system.bodies), ZERO)
    falling = equations.potential_energy.chain(motion.rate)
    return tuple(
        gibbs.diff(speed.derivative()) + falling.diff(speed) - row
        for speed, row in zip(equations.speeds, equations.rows, strict=True)
    )


def _gibbs(equations: Equations, body: Body) -> Expr:
    motion = equations.kinetics
    velocity, angular = motion.velocities[body]
    linear, turning = motion.derivative(velocity), motion.derivative(angular)
    spin = _inertia_times(body, angular)
    return (
        body.mass * linear.dot(linear) / 2
        + turning.dot(_inertia_times(body, turning)) / 2
        + turning.dot(angular.cross(spin))
    )


def _inertia_times(body: Body, vector: Vector) -> Vector:
    return body.axes.vector(*body.inertia.times(vector.express(body.axes).components))


def _moving(equations: Equations) -> dict[Symbol, Expr]:
    """Rates of the coordinates that the independent speeds move."""
    return {
        q: rate
        for q in equations.coordinates
        for rate in [equations.kinematics[q.derivative()]]
        if any(rate.diff(speed) for speed in equations.speeds)
    }


def _speeds_in_rates(equations: Equations, rates: dict[Symbol, Expr]) -> dict[Symbol, Expr]:
    speeds = equations.speeds
    matrix = [[rate.diff(speed) for speed in speeds] for rate in rates.values()]
    still = dict.fromkeys(speeds, 0)
    right = [Expr.generator(symbol) - rate.subs(still) for symbol, rate in rates.items()]
    return dict(zip(speeds, solve(matrix, right), strict=True))


def _along_motion(equations: Equations, expression: Expr) -> Expr:
    kinematics = equations.kinematics
    seconds = {rate.derivative(): equations.rate(e) for rate, e in kinematics.items()}
    return equations.on_shell(expression.subs(seconds).subs(kinematics))

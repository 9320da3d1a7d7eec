"""The checks of a system: exact ones by second formulations, and balances along its motion."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from polhode.algebra import ZERO, Expr, Symbol, Vector, solve
from polhode.derive import Equations
from polhode.model import Body, Frame
from polhode.simulate import Trajectory
from polhode.tour._formulas import power_of_ten

ALLOWED = 1e-10
"""Largest relative defect of a computed motion that still passes.

Runs are good to 1e-13 or so; a wrong term in an equation is larger by many orders.
"""

# Gauss–Legendre quadrature with 12 nodes is exact to degree 23 within each interval.
_INTERVALS = 400  # of the motion, for the quadrature of its rates
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)


@dataclass(frozen=True)
class Check:
    """One check of one system.

    Attributes:
        name: short.
        how: the two sides of the comparison.
        passed: whether it holds.
        found: the difference in words or as a number.
    """

    name: str
    how: str
    passed: bool
    found: str


def decided(name: str, how: str, residuals: Iterable[Expr]) -> Check:
    """A check that expressions vanish identically, decided exactly."""
    left = [residual for residual in residuals if not residual.is_zero]
    return Check(name, how, not left, left[0].pretty() if left else "exactly zero")


def measured(name: str, how: str, defect: float) -> Check:
    """A check that a relative defect of a computed motion is of the size of rounding."""
    return Check(name, how, defect <= ALLOWED, power_of_ten(defect))


def exact_checks(equations: Equations) -> Iterator[Check]:
    """Checks that are decided exactly."""
    yield decided(
        "Power balance",
        "dE/dt along the motion equals the power of supports, motors and drives",
        [equations.rate(equations.energy) - equations.on_shell(equations.power)],
    )
    yield decided(
        "Constraints",
        "every held or touching point moves with its support",
        equations.slips.values(),
    )
    if is_conservative(equations) and is_holonomic(equations):
        yield decided(
            "Lagrange's equations",
            "formed independently from T − V, they hold along the derived motion",
            lagrange(equations),
        )
    elif is_conservative(equations):
        yield decided(
            "Gibbs–Appell equations",
            "formed independently from the energy of acceleration, they equal the derived ones",
            appell(equations),
        )


def numeric_checks(
    run: Trajectory, equations: Equations, travel: MomentumBalance
) -> Iterator[Check]:
    """Checks of the computed motion, each a defect relative to the size of what is compared."""
    yield measured(
        "Energy of the run",
        "energy against its initial value plus the work done",
        run.drift.energy,
    )
    yield measured(
        "Constraints of the run",
        "displacement against the integral of the constrained velocity",
        travel.relative,
    )
    yield measured(
        "Momentum of the run",
        "momentum gained against the impulse of loads and derived reactions",
        momentum_balance(run, equations).relative,
    )
    yield measured(
        "Angular momentum of the run",
        "gain about the centre of mass against the integral of the torques",
        angular_momentum_balance(run, equations).relative,
    )
    if run.drift.invariants:
        yield measured(
            "Conserved quantities of the run",
            "each integral against its value at the start",
            max(run.drift.invariants.values()),
        )


# --- second formulations ---
#
# The derivation balances forces and projects them. Here the same motion is derived from scalars
# alone: the Lagrangian, or Gibbs' energy of acceleration.


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
    speeds, kinematics = equations.speeds, equations.kinematics
    rates = {q.derivative(): rate for q, rate in _moving(equations).items()}
    # L is known in terms of the speeds u. The kinematics q̇ = A(q) u + b is solved for u, so that L
    # becomes a function of q and q̇.
    matrix = [[rate.diff(speed) for speed in speeds] for rate in rates.values()]
    still = dict.fromkeys(speeds, 0)
    right = [Expr.generator(symbol) - rate.subs(still) for symbol, rate in rates.items()]
    lagrangian = equations.lagrangian.subs(dict(zip(speeds, solve(matrix, right), strict=True)))
    # q̈ along the derived motion, which replaces the second derivatives in d/dt ∂L/∂q̇
    seconds = {rate.derivative(): equations.rate(e) for rate, e in kinematics.items()}
    rows = (lagrangian.diff(rate).dt() - lagrangian.diff(rate.base()) for rate in rates)
    return tuple(equations.on_shell(row.subs(seconds).subs(kinematics)) for row in rows)


def _moving(equations: Equations) -> dict[Symbol, Expr]:
    """Rates of the coordinates that the independent speeds move."""
    return {
        q: rate
        for q in equations.coordinates
        for rate in [equations.kinematics[q.derivative()]]
        if any(rate.diff(speed) for speed in equations.speeds)
    }


def appell(equations: Equations) -> tuple[Expr, ...]:
    """∂S/∂u̇ - Q minus the derived rows, for every independent speed u.

    S = Σ ½m a² + ½α·Iα + α·(ω × Iω), without the terms free of u̇, and Q is the generalised force
    of the loads on u: Q = -∂V̇/∂u (Gibbs 1879, Appell 1899).
    """
    motion, gibbs = equations.kinetics, ZERO
    for body in equations.system.bodies:
        velocity, angular = motion.velocities[body]
        linear, turning = motion.derivative(velocity), motion.derivative(angular)
        gibbs = gibbs + (
            body.mass * linear.dot(linear) / 2
            + turning.dot(_inertia_times(body, turning)) / 2
            + turning.dot(angular.cross(_inertia_times(body, angular)))
        )
    potential_rate = equations.potential_energy.chain(motion.rate)  # linear in the speeds
    return tuple(
        gibbs.diff(speed.derivative()) + potential_rate.diff(speed) - row
        for speed, row in zip(equations.speeds, equations.rows, strict=True)
    )


def _inertia_times(body: Body, vector: Vector) -> Vector:
    return body.axes.vector(*body.inertia.times(vector.express(body.axes).components))


# --- momentum gained against impulse received ---
#
# The integral forms of Newton's and Euler's laws compare the derived reactions, the exact
# kinematics and the numerical integration with one another: quadrature keeps the accuracy of the
# run, where numerical differentiation would lose half of its digits.


@dataclass(frozen=True)
class MomentumBalance:
    """Largest difference between a gain and the integral of its rate, and the size of both."""

    defect: float
    size: float

    @property
    def relative(self) -> float:
        """The difference relative to the size; the difference itself where all is zero."""
        return self.defect / self.size if self.size else self.defect


def momentum_balance(run: Trajectory, equations: Equations) -> MomentumBalance:
    """Momentum of every body against the impulse of loads and reactions, kg m/s."""
    return _worst(
        _account(run, body.axes.root, velocity * body.mass, _force_and_torque(equations, body)[0])
        for body, (velocity, _) in equations.kinetics.velocities.items()
    )


def angular_momentum_balance(run: Trajectory, equations: Equations) -> MomentumBalance:
    """Angular momentum about every centre of mass against that of the torques, kg m²/s."""
    return _worst(
        _account(
            run,
            body.axes.root,
            _inertia_times(body, angular),
            _force_and_torque(equations, body)[1],
        )
        for body, (_, angular) in equations.kinetics.velocities.items()
    )


def displacement_balance(run: Trajectory, equations: Equations) -> MomentumBalance:
    """Displacement of every centre of mass against the integral of its constrained velocity, m."""
    motion = equations.kinetics
    return _worst(
        _account(run, body.axes.root, place, motion.velocities[body][0])
        for body, place in motion.places.items()
    )


def _worst(accounts: Iterable[MomentumBalance]) -> MomentumBalance:
    return max(accounts, key=lambda account: account.relative)


def _account(run: Trajectory, root: Frame, gained: Vector, rate: Vector) -> MomentumBalance:
    """A gain and the integral of its rate, in components along the root frame.

    That frame turns if it is the Earth: (dG/dt)_root = dG/dt - Ω × G.
    """
    turning = root.angular_velocity
    quantity = gained.express(root)
    flow = (rate.express(root) - turning.cross(quantity)).components
    ends = np.linspace(0.0, run.duration, _INTERVALS + 1)
    half = ends[1] / 2
    nodes = ends[:-1, None] + half * (1 + _NODES)
    gain = np.array([run.evaluate(c, ends) for c in quantity.components])
    flux = half * np.array([run.evaluate(c, nodes) for c in flow])
    supply = np.concatenate([np.zeros((3, 1)), np.cumsum(flux @ _WEIGHTS, axis=1)], axis=1)
    defect = np.max(np.abs(gain - gain[:, :1] - supply))
    size = np.max(np.abs(gain)) + np.sum(np.abs(flux) @ _WEIGHTS)
    return MomentumBalance(float(defect), float(size))


def _force_and_torque(equations: Equations, body: Body) -> tuple[Vector, Vector]:
    """Resultant of all loads and reactions on a body, the torque about its centre of mass."""
    system = equations.system
    force = torque = body.axes.zero
    for load in system.loads:
        for action in equations.actions(load):
            if action.body == body:
                force = force + action.force
                torque = torque + (action.couple + action.arm.cross(action.force))
    for line in equations.lines:
        unit = line.on(body)
        if unit is not None:
            size = equations.least[line.name]
            force = force + unit.force * size
            torque = torque + unit.couple * size
    return force, torque

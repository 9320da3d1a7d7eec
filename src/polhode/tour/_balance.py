"""Momentum gained against impulse received, along a computed motion.

The integral forms of Newton's and Euler's laws: they hold the derived reactions, the exact
kinematics and the numerical integration against one another, by quadrature and not by
differentiation.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Vector
from polhode.derive import Equations
from polhode.model import Body, Frame
from polhode.simulate import Trajectory

Array = NDArray[np.float64]

_INTERVALS = 400
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)


@dataclass(frozen=True)
class MomentumBalance:
    """Largest difference between a gain and the integral of its rate, and the size of both."""

    defect: float
    size: float

    @property
    def relative(self) -> float:
        """The difference relative to the size; the difference itself where all is zero."""
        return self.defect / self.size if self.size else self.defect


def momentum(run: Trajectory, equations: Equations) -> MomentumBalance:
    """Momentum of every body against the impulse of loads and reactions, kg m/s."""
    return _worst(
        _account(run, body.axes.root, velocity * body.mass, _force(equations, body))
        for body, (velocity, _) in equations.kinetics.velocities.items()
    )


def spin(run: Trajectory, equations: Equations) -> MomentumBalance:
    """Angular momentum about every centre of mass against that of the torques, kg m²/s."""
    return _worst(
        _account(run, body.axes.root, _angular_momentum(body, angular), _torque(equations, body))
        for body, (_, angular) in equations.kinetics.velocities.items()
    )


def travel(run: Trajectory, equations: Equations) -> MomentumBalance:
    """Place of every centre of mass against the integral of the velocity that the constraints
    leave it, m.
    """
    motion = equations.kinetics
    return _worst(
        _account(run, body.axes.root, place, motion.velocities[body][0])
        for body, place in motion.places.items()
    )


def _worst(accounts: Iterable[MomentumBalance]) -> MomentumBalance:
    return max(accounts, key=lambda account: account.relative)


def _account(run: Trajectory, root: Frame, gained: Vector, rate: Vector) -> MomentumBalance:
    """Both along the root frame, which turns if it is the Earth."""
    carried = root.angular_velocity
    held = gained.express(root)
    flow = (rate.express(root) - carried.cross(held)).components
    ends = np.linspace(0.0, run.duration, _INTERVALS + 1)
    half = ends[1] / 2
    nodes = ends[:-1, None] + half * (1 + _NODES)
    gain = np.array([run.evaluate(c, ends) for c in held.components])
    flux = half * np.array([run.evaluate(c, nodes) for c in flow])
    supply = np.concatenate([np.zeros((3, 1)), np.cumsum(flux @ _WEIGHTS, axis=1)], axis=1)
    defect = np.max(np.abs(gain - gain[:, :1] - supply))
    size = np.max(np.abs(gain)) + np.sum(np.abs(flux) @ _WEIGHTS)
    return MomentumBalance(float(defect), float(size))


def _angular_momentum(body: Body, angular: Vector) -> Vector:
    return body.axes.vector(*body.inertia.times(angular.express(body.axes).components))


def _force(equations: Equations, body: Body) -> Vector:
    total = body.axes.zero
    for force, _ in _wrenches(equations, body):
        total = total + force
    return total


def _torque(equations: Equations, body: Body) -> Vector:
    total = body.axes.zero
    for _, torque in _wrenches(equations, body):
        total = total + torque
    return total


def _wrenches(equations: Equations, body: Body) -> Iterator[tuple[Vector, Vector]]:
    """Force and torque about the centre of mass of every load and reaction on a body."""
    motion = equations.kinetics
    system = equations.system
    for load in system.loads:
        for action in load.actions(system.bodies, motion.places, motion.velocities):
            if action.body == body:
                yield action.force, action.couple + action.arm.cross(action.force)
    for line in equations.lines:
        unit = line.on(body)
        if unit is not None:
            size = equations.least[line.name]
            yield unit.force * size, unit.couple * size

"""Trial motions by numbers: velocities and accelerations of all bodies for given speeds."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from polhode.algebra import (
    PI,
    Compiled,
    Expr,
    Op,
    Symbol,
    Vector,
    compile_program,
    variables,
)
from polhode.base import NumericError
from polhode.judge.balance._declared import Placement
from polhode.judge.balance._jets import JETS, Array, Jet
from polhode.model import Body, Frame, Restraint

#: Three jets: the components of a vector along the root frame.
Jets = Any


@dataclass(frozen=True, eq=False)
class BodyMotion:
    """The inertial velocities of one body, by components along the root frame.

    Attributes:
        velocity: of the centre of mass, m/s.
        angular: angular velocity, rad/s.
    """

    velocity: Jets
    angular: Jets


class Trial:
    """Several motions through one configuration, evaluated together.

    Args:
        known: the declaration.
        state: parameters, coordinates and prescribed functions with their rates.
        speeds: value of every declared speed, an array over the motions.
        rates: their time derivatives likewise; zero where not given.
    """

    def __init__(
        self,
        known: Placement,
        state: Mapping[Symbol, float],
        speeds: Mapping[Symbol, Array],
        rates: Mapping[Symbol, Array],
    ) -> None:
        self._known = known
        self.size = len(next(iter(speeds.values()), np.zeros(1)))
        self._zeros = np.zeros(self.size)
        table: dict[Symbol, Jet] = {s: Jet.of(v) for s, v in state.items()}
        for symbol in known.functions:
            table |= _prescribed(symbol, state)
        for symbol, speed in speeds.items():
            table[symbol] = Jet(speed, rates.get(symbol, self._zeros), _UNKNOWN)
        self._table = table
        for q in known.coordinates:
            self._table[q] = Jet(self._zeros + state[q], self._zeros, self._zeros)
        # The declared rates q̇ = f(q, u) give q̈ only once the q̇ of all coordinates are known, so a
        # first pass sets q̇ and a second one q̈.
        for _ in range(2):
            replaced = zip(known.replaced, self.scalars(known.replaced.values()), strict=True)
            self._table |= replaced
            moving = {
                q: self._table[q.derivative()] for q in known.coordinates if q not in known.rates
            }
            moving |= zip(known.rates, self.scalars(known.rates.values()), strict=True)
            for q, rate in moving.items():
                first, second = self._wide(rate.value), self._wide(rate.rate)
                self._table[q] = Jet(self._zeros + state[q], first, second)
                self._table[q.derivative()] = Jet(first, second, _UNKNOWN)

    def _wide(self, array: Array) -> Array:
        """A value as an array over all motions, also where it is the same in each."""
        return self._zeros + array

    # -- reading --------------------------------------------------------------------------------

    @property
    def coordinates(self) -> tuple[Symbol, ...]:
        """All coordinates."""
        return self._known.coordinates

    @property
    def symbols(self) -> Collection[Symbol]:
        """All symbols that have a value."""
        return self._table.keys()

    @property
    def restraints(self) -> tuple[Restraint, ...]:
        """The velocities that supports prescribe."""
        return self._known.restraints

    def number(self, symbol: Symbol) -> Jet:
        """One symbol."""
        return self._table[symbol]

    def scalars(self, expressions: Iterable[Expr]) -> list[Jet]:
        """Several expressions."""
        arguments, function = _compiled(tuple(expressions))
        return [Jet.of(x) for x in function(*(self._table[s] for s in arguments))]

    def scalar(self, expression: Expr) -> Jet:
        """One expression."""
        return self.scalars([expression])[0]

    def vector(self, vector: Vector) -> Jets:
        """Components along the root frame."""
        return np.array(self.scalars(_along(vector, self._root)), dtype=object)

    def now(self, vector: Vector) -> Array:
        """The same by value, in the first of the motions; it must be finite."""
        found = np.array([float(self._wide(c.value)[0]) for c in self.vector(vector)])
        if not np.isfinite(found).all():
            raise NumericError(
                "a place or a force has no finite value here", expected="a regular state"
            )
        return found

    @property
    def _root(self) -> Frame:
        return self._known.system.root

    # -- moving ---------------------------------------------------------------------------------

    @cached_property
    def _frame_rotation(self) -> Jets:
        """Angular velocity of the root frame, which may turn, such as a turntable."""
        return self.vector(self._root.angular_velocity)

    @cached_property
    def bodies(self) -> dict[Body, BodyMotion]:
        """How every body moves."""
        found = {}
        for body in self._known.system.bodies:
            velocity = self.inertial_rate(self.place(body))
            found[body] = BodyMotion(velocity, self.vector(body.angular_velocity))
        return found

    def acceleration(self, body: Body) -> Jets:
        """Of its centre of mass, in inertial space, m/s²."""
        return self.inertial_rate(self.bodies[body].velocity)

    def spin_rate(self, body: Body) -> Jets:
        """Rate of its angular momentum about the centre of mass, in inertial space, N m."""
        return self.inertial_rate(self.angular_momentum(body))

    def place(self, body: Body) -> Jets:
        """Of its centre of mass, from the origin of the root frame, m."""
        return self.vector(self._known.places[body])

    def inertial_rate(self, vector: Jets) -> Jets:
        """Rate of a vector in inertial space: that of its components, plus Ω × the vector."""
        return np.array([c.dt for c in vector], dtype=object) + cross(self._frame_rotation, vector)

    def angular_momentum(self, body: Body) -> Jets:
        """About its centre of mass, kg m²/s."""
        return self.mapped_by_inertia(body, self.bodies[body].angular)

    def mapped_by_inertia(self, body: Body, vector: Jets) -> Jets:
        """The inertia tensor of a body about its centre of mass, applied to a vector."""
        found = np.array(self.scalars(_axes_and_moments(body, self._root)), dtype=object)
        axes, moments = found.reshape(2, 3, 3)
        # Project on the body's axes, apply the matrix there, and return to the root frame.
        along = [dot(axis, vector) for axis in axes]
        return sum(axis * dot(row, along) for axis, row in zip(axes, moments, strict=True))

    def slip(self, restraint: Restraint, direction: Vector) -> Jet:
        """Relative velocity at a restraint along a direction: zero along the restraint's own."""
        relative = self._point(restraint.body, restraint.arm) - self.vector(restraint.velocity)
        if restraint.other is not None:
            relative = relative - self._point(restraint.other, restraint.other_arm)
        found = dot(relative, self.vector(direction))
        for share in restraint.more:
            found = found + dot(self._point(share.body, share.arm), self.vector(share.direction))
        return found

    def prescribed(self, restraint: Restraint) -> Jet:
        """The velocity that a restraint prescribes, along its direction."""
        return dot(self.vector(restraint.velocity), self.vector(restraint.direction))

    def _point(self, body: Body, arm: Vector | None) -> Jets:
        moving = self.bodies[body]
        if arm is None:
            return moving.angular
        return moving.velocity + cross(moving.angular, self.vector(arm))

    def pull(self, restraint: Restraint) -> Jets:
        """The force that one unit of a reaction puts on a body, with the friction it causes."""
        pull = self.vector(restraint.direction)
        for friction in self._known.frictions.get(restraint.name, ()):
            if friction.is_couple:
                continue
            # Sliding friction is -μ v/|v| for each unit of normal force, v being the slip velocity.
            along = [self.vector(r.direction) for r in friction.sliding]
            speeds = [self.slip(r, r.direction) for r in friction.sliding]
            slip = sum((axis * speed for axis, speed in zip(along, speeds, strict=True)), start=0.0)
            size = JETS.functions[Op.SQRT](sum((speed * speed for speed in speeds), start=0.0))
            pull = pull + slip * (self.scalar(friction.coefficient) * -1.0 / size)
        return pull

    @property
    def places(self) -> Mapping[Body, Vector]:
        """Positions of all bodies, as expressions."""
        return self._known.places

    def slips(self) -> tuple[Array, Array]:
        """Relative velocities that restraints exclude, and their rates: (restraints, motions)."""
        found = [self.slip(r, r.direction) for r in self._known.restraints]
        shape = (len(found), self.size)
        values = np.array([self._wide(s.value) for s in found]).reshape(shape)
        return values, np.array([self._wide(s.rate) for s in found]).reshape(shape)

    def values(self, jets: Jets) -> Array:
        """Values of several jets: (jets, motions)."""
        return np.array([self._wide(jet.value) for jet in jets])


#: The second rate of a speed, which nothing determines; nan shows wherever it is used by mistake.
_UNKNOWN = np.array(np.nan)


@lru_cache(maxsize=4096)
def _along(vector: Vector, root: Frame) -> tuple[Expr, ...]:
    return vector.express(root).components


@lru_cache(maxsize=64)
def _axes_and_moments(body: Body, root: Frame) -> tuple[Expr, ...]:
    """Components of a body's axes, one after another, then the rows of its inertia matrix."""
    axes = [_along(body.axes[label], root) for label in body.axes.labels]
    return tuple(entry for row in (*axes, *body.inertia.rows) for entry in row)


@lru_cache(maxsize=4096)
def _compiled(expressions: tuple[Expr, ...]) -> tuple[tuple[Symbol, ...], Compiled]:
    arguments = tuple(sorted(variables(expressions) - {PI}, key=lambda s: s.published))
    return arguments, compile_program(expressions, arguments).function(JETS)


def _prescribed(function: Symbol, state: Mapping[Symbol, float]) -> dict[Symbol, Jet]:
    orders = [function]
    for _ in range(3):
        orders.append(orders[-1].derivative())
    at, first, second, third = (np.array(state.get(s, 0.0)) for s in orders)
    return {
        orders[0]: Jet(at, first, second),
        orders[1]: Jet(first, second, third),
        orders[2]: Jet(second, third, _UNKNOWN),
    }


def dot(a: Any, b: Any) -> Jet:
    """The scalar product of two vectors."""
    return Jet.of(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


def cross(a: Jets, b: Jets) -> Jets:
    """The vector product of two vectors."""
    return np.array(
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ],
        dtype=object,
    )

"""Loads that store energy in coordinates, torsion springs and dampers, and magnetic couples."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from polhode.algebra import (
    ONE,
    ZERO,
    Expr,
    ExprLike,
    Symbol,
    SymbolKind,
    Vector,
    as_symbol,
    kept_length,
)
from polhode.base import DeclarationError
from polhode.model._body import Body, BodyPoint, bodies_of
from polhode.model._conjugate import shares_of_power
from polhode.model._declared import of_type, quantity, without_coordinates, without_rates
from polhode.model._element import Places, Share
from polhode.model._loads import (
    Action,
    Load,
    Push,
    Velocities,
    bodies_at,
    pair,
    pushes,
    require_points,
    vector_between,
)


@dataclass(frozen=True, init=False)
class Potential(Load):
    """A potential energy that is given as a function of the coordinates.

    For the angle of a body it is a couple -∂V/∂q on the body, and the opposite couple on the body
    from which the angle is measured; for the position of a centre of mass a force.

    Args:
        energy: V, J.
        on: the bodies whose coordinates occur in it.

    Raises:
        DeclarationError: for speeds in V, or a V without coordinates.
    """

    energy: Expr
    on: tuple[Body, ...]
    name: str

    def __init__(
        self, energy: ExprLike, *, on: Body | Iterable[Body], name: str = "potential"
    ) -> None:
        stored = quantity(energy, f"energy of {name!r}")
        without_rates([stored], f"energy of {name!r}")
        if not _coordinates(stored):
            raise DeclarationError(
                f"energy of {name!r}: {stored}", expected="an expression of coordinates"
            )
        self._set(energy=stored, on=bodies_of(on, f"{name!r}"), name=name)

    @property
    def bodies(self) -> tuple[Body, ...]:
        return self.on

    def potential(self, bodies: tuple[Body, ...], places: Places) -> Expr:
        return self.energy

    def actions(
        self, bodies: tuple[Body, ...], places: Places, velocities: Velocities
    ) -> tuple[Action, ...]:
        return _conservative(self.energy, places, self.name)


@dataclass(frozen=True, init=False)
class TorsionSpring(Load):
    """A couple proportional to an angle: a torsion spring or wire.

    Args:
        angle: between the bodies that it joins, or of a body in the ground, rad.
        stiffness: N m/rad.
        rest: the angle without a couple, rad.
        on: the bodies whose coordinates occur in the angle.
    """

    angle: Expr
    stiffness: Expr
    rest: Expr
    on: tuple[Body, ...]
    name: str

    def __init__(
        self,
        angle: ExprLike,
        *,
        stiffness: ExprLike,
        on: Body | Iterable[Body],
        rest: ExprLike = 0,
        name: str = "torsion spring",
    ) -> None:
        turned = _angle(angle, name)
        constants = {
            "stiffness": quantity(stiffness, f"stiffness of {name!r}"),
            "rest": quantity(rest, f"rest angle of {name!r}"),
        }
        without_coordinates(constants.values(), f"{name!r}", "give V itself as a Potential")
        self._set(angle=turned, **constants, on=bodies_of(on, f"{name!r}"), name=name)

    @property
    def bodies(self) -> tuple[Body, ...]:
        return self.on

    def potential(self, bodies: tuple[Body, ...], places: Places) -> Expr:
        return self.stiffness * (self.angle - self.rest) ** 2 / 2

    def actions(
        self, bodies: tuple[Body, ...], places: Places, velocities: Velocities
    ) -> tuple[Action, ...]:
        return _conservative(self.potential(bodies, places), places, self.name)


@dataclass(frozen=True, init=False)
class TorsionDamper(Load):
    """A couple proportional to the rate of an angle, against it.

    Args:
        angle: between the bodies that it joins, or of a body in the ground, rad.
        damping: N m s/rad.
        on: the bodies whose coordinates occur in the angle.
    """

    angle: Expr
    damping: Expr
    on: tuple[Body, ...]
    name: str

    def __init__(
        self,
        angle: ExprLike,
        *,
        damping: ExprLike,
        on: Body | Iterable[Body],
        name: str = "torsion damper",
    ) -> None:
        self._set(
            angle=_angle(angle, name),
            damping=quantity(damping, f"damping of {name!r}"),
            on=bodies_of(on, f"{name!r}"),
            name=name,
        )

    @property
    def bodies(self) -> tuple[Body, ...]:
        return self.on

    def actions(
        self, bodies: tuple[Body, ...], places: Places, velocities: Velocities
    ) -> tuple[Action, ...]:
        # The couples conjugate to the angle have its rate, and the excess, as their power.
        unit, excess = shares_of_power(self.angle.dt(), places, self.name)
        rate = sum((_power(share, velocities) for share in unit), -excess)
        return tuple(_action(share, -self.damping * rate) for share in unit)


@dataclass(frozen=True, init=False)
class CentralForce(Load):
    """Two points that attract or repel each other along the line between them.

    Args:
        start: a point of a body.
        end: a point of another body, or a place from the origin, m.
        energy: V as an expression of the distance, J; -k/r for an inverse-square attraction.
        distance: the symbol that stands for the distance in it.

    Raises:
        DeclarationError: for an energy that does not depend on the distance, and for a point that
            is not fixed in its body.
    """

    start: BodyPoint
    end: BodyPoint | Vector
    energy: Expr
    distance: Expr
    name: str

    def __init__(
        self,
        start: BodyPoint,
        end: BodyPoint | Vector,
        *,
        energy: ExprLike,
        distance: Expr,
        name: str = "central force",
    ) -> None:
        require_points(start, end, name)
        for point in (start, end):
            if isinstance(point, BodyPoint):
                point.require_fixed(f"end of {name!r}")
        stored = quantity(energy, f"energy of {name!r}")
        if as_symbol(distance) not in stored.symbols():
            raise DeclarationError(
                f"energy of {name!r}: {stored}", expected=f"an expression of {distance}"
            )
        without_coordinates([stored], f"energy of {name!r}", "use a Potential")
        self._set(start=start, end=end, energy=stored, distance=distance, name=name)

    @property
    def bodies(self) -> tuple[Body, ...]:
        return bodies_at(self.start, self.end)

    def potential(self, bodies: tuple[Body, ...], places: Places) -> Expr:
        distance = kept_length(vector_between(self.start, self.end, places).components)
        return self.energy.subs({as_symbol(self.distance): distance})

    def actions(
        self, bodies: tuple[Body, ...], places: Places, velocities: Velocities
    ) -> tuple[Action, ...]:
        between = vector_between(self.start, self.end, places)
        distance = kept_length(between.components)
        symbol = as_symbol(self.distance)
        pull = self.energy.diff(symbol).subs({symbol: distance}) / distance
        return pair(self.start, self.end, between * -pull)

    def on_places(self, places: Places, velocities: Velocities) -> tuple[Push, ...]:
        return pushes(self.end, self.actions((), places, velocities))


@dataclass(frozen=True)
class MagneticMoment(Load):
    """The couple m × B of a uniform magnetic field on a magnet.

    Args:
        body: the magnet.
        moment: m, fixed in the body, A m².
        field: B, in the ground, T; it may depend on time.

    Raises:
        DeclarationError: for a moment that is not fixed in the body.
    """

    body: Body
    moment: Vector
    field: Vector
    name: str = "magnetic field"

    def __post_init__(self) -> None:
        of_type(self.body, Body, f"body of {self.name!r}", "give the magnet")
        for what, vector in (("moment", self.moment), ("field", self.field)):
            of_type(
                vector, Vector, f"{what} of {self.name!r}", "give it along a frame: lab['x'] * B"
            )
        if not self.body.keeps(self.moment):
            raise DeclarationError(
                f"moment of {self.name!r}, ({', '.join(map(str, self.moment.components))})",
                expected=f"a vector that is fixed in body {self.body.name!r}",
                advice="take it along the axis of spin, or along axes that turn with the body",
            )
        without_coordinates(
            self.field.express(self.body.axes.root).components,
            f"field of {self.name!r}",
            "give its energy as a Potential",
        )

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,)

    def potential(self, bodies: tuple[Body, ...], places: Places) -> Expr:
        return -self.moment.dot(self.field)

    def actions(
        self, bodies: tuple[Body, ...], places: Places, velocities: Velocities
    ) -> tuple[Action, ...]:
        return (Action.pure(self.body, self.moment.cross(self.field)),)


def _angle(angle: ExprLike, name: str) -> Expr:
    turned = quantity(angle, f"angle of {name!r}")
    without_rates([turned], f"angle of {name!r}")
    if not _coordinates(turned):
        raise DeclarationError(
            f"angle of {name!r}: {turned}",
            expected="an expression of coordinates",
            advice="give the angle of a frame, or the difference of two",
        )
    return turned


def _coordinates(expression: Expr) -> list[Symbol]:
    return [s for s in expression.symbols() if s.kind is SymbolKind.COORDINATE]


def _conservative(energy: Expr, places: Places, name: str) -> tuple[Action, ...]:
    """The forces and couples with the power -Σ ∂V/∂q q̇."""
    power = ZERO
    for symbol in _coordinates(energy):
        power = power - energy.diff(symbol) * Expr.generator(symbol.derivative())
    shares, _ = shares_of_power(power, places, name)
    return tuple(_action(share, ONE) for share in shares)


def _action(share: Share, value: Expr) -> Action:
    pull = share.direction * value
    if share.arm is None:
        return Action.pure(share.body, pull)
    return Action.at(share.body.point(share.arm), pull)


def _power(share: Share, velocities: Velocities) -> Expr:
    """Of one unit of a force or couple on the motion."""
    velocity, angular = velocities[share.body]
    if share.arm is None:
        return share.direction.dot(angular)
    return share.direction.dot(velocity + angular.cross(share.arm))

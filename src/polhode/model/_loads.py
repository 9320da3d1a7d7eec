"""Loads: applied forces and couples."""

from __future__ import annotations

from abc import ABC
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from polhode.algebra import (
    ZERO,
    Expr,
    ExprLike,
    Symbol,
    SymbolKind,
    Vector,
    kept_length,
    kept_sum,
    kept_sums,
    lengths_written_out,
    linear_parts,
    variables,
)
from polhode.model._body import Body, BodyPoint, TwoPointLink
from polhode.model._declared import (
    Declared,
    Size,
    not_negative,
    of_type,
    quantity,
    unit_vector,
    without_coordinates,
    without_rates,
)
from polhode.model._element import Places
from polhode.model._frame import Frame

#: Velocity of the centre of mass and angular velocity of every body.
Velocities = Mapping[Body, tuple[Vector, Vector]]


@dataclass(frozen=True)
class Action:
    """A force (N) at a point of a body and a couple (N m) on it."""

    body: Body
    force: Vector
    arm: Vector
    couple: Vector

    @classmethod
    def at(cls, point: BodyPoint, force: Vector) -> Action:
        """A force at a point."""
        return cls(point.body, force, point.offset, point.body.axes.zero)

    @classmethod
    def pure(cls, body: Body, couple: Vector) -> Action:
        """A couple."""
        return cls(body, body.axes.zero, body.axes.zero, couple)

    @property
    def reactions(self) -> frozenset[Symbol]:
        """The reactions on which it depends."""
        written = (*self.force.components, *self.arm.components, *self.couple.components)
        return frozenset(s for s in variables(written) if s.kind is SymbolKind.REACTION)

    def per_unit(self, reactions: Sequence[Symbol]) -> tuple[tuple[Action, ...], Action]:
        """What it is for each unit of these reactions, and the rest.

        Raises `NumericError` where it is not linear in them.
        """
        forces, force = _linear(self.force, reactions)
        couples, couple = _linear(self.couple, reactions)
        units = tuple(
            Action(self.body, one, self.arm, other)
            for one, other in zip(forces, couples, strict=True)
        )
        return units, Action(self.body, force, self.arm, couple)

    def scaled(self, factor: Expr) -> Action:
        """A multiple of it."""
        return Action(self.body, self.force * factor, self.arm, self.couple * factor)

    def mapped(self, change: Callable[[Expr], Expr]) -> Action:
        """The same with every component of the force and the couple changed."""
        return Action(self.body, self.force.mapped(change), self.arm, self.couple.mapped(change))

    def subs(self, values: Mapping[Symbol, Expr]) -> Action:
        """The same with values put in for symbols of the force and the couple."""
        return self.mapped(lambda component: component.subs(values))

    def power(self, velocities: Velocities) -> Expr:
        """Rate of work, W."""
        velocity, angular = velocities[self.body]
        point = velocity + angular.cross(self.arm)
        return self.force.dot(point) + self.couple.dot(angular)


def _linear(vector: Vector, reactions: Sequence[Symbol]) -> tuple[list[Vector], Vector]:
    """The coefficients of reactions in a vector, and the rest."""
    parts = [linear_parts(component, reactions) for component in vector.components]
    units = zip(*(coefficients for coefficients, _ in parts), strict=True)
    rest = Vector(tuple(rest for _, rest in parts), vector.triad)
    return [Vector(tuple(unit), vector.triad) for unit in units], rest


@dataclass(frozen=True)
class Push:
    """A force (N) on a place, and the velocity (m/s) of that place."""

    force: Vector
    velocity: Vector


class Load(Declared, ABC):
    """A load: forces and couples on bodies; conservative if it has a potential.

    To define another load, derive a frozen dataclass from this class. Its fields, one of which is
    `name`, are bodies, points of bodies, vectors, expressions and text; it must define `bodies` and
    `actions`, and may define `potential`. It can then be derived, simulated, drawn and saved like
    those of polhode.
    """

    name: str

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The bodies named in its fields."""
        return ()

    def actions(
        self, bodies: tuple[Body, ...], places: Places, velocities: Velocities
    ) -> tuple[Action, ...]:
        """The forces (N) and couples (N m) on bodies.

        Args:
            bodies: all bodies of the system.
            places: position of the centre of mass of every body, from the origin, m.
            velocities: velocity of the centre of mass (m/s) and angular velocity (rad/s) of
                every body, in inertial space.
        """
        return ()

    def potential(self, bodies: tuple[Body, ...], places: Places) -> Expr | None:
        """Potential energy, J; None for a load that has none."""
        return None

    def on_places(self, places: Places, velocities: Velocities) -> tuple[Push, ...]:
        """The forces on places that are not points of bodies, such as the fixed end of a spring."""
        return ()

    @property
    def link(self) -> TwoPointLink | None:
        """Its drawing between two points; None for a load drawn as arrows."""
        return None


@dataclass(frozen=True, init=False)
class Gravity(Load):
    """Uniform gravity.

    Args:
        g: its acceleration, m/s².
        up: unit vector opposite to it; the third direction of the root frame by default.
    """

    g: Expr
    up: Vector | None
    name: str

    def __init__(self, g: ExprLike, *, up: Vector | None = None, name: str = "gravity") -> None:
        strength = quantity(g, f"g of {name!r}")
        without_coordinates([strength], f"g of {name!r}", _NO_POTENTIAL)
        if up is not None:
            what = f"the direction up of {name!r}"
            unit_vector(up, what)
            at_rest = up.express(up.triad.root) if isinstance(up.triad, Frame) else up
            without_coordinates(at_rest.components, what, _NO_POTENTIAL)
        self._set(g=strength, up=up, name=name)

    def _up(self, body: Body) -> Vector:
        root = body.axes.root
        return self.up if self.up is not None else root[root.labels[2]]

    def actions(
        self, bodies: tuple[Body, ...], places: Places, velocities: Velocities
    ) -> tuple[Action, ...]:
        return tuple(
            Action.at(body.point(body.axes.zero), self._up(body) * (-body.mass * self.g))
            for body in bodies
        )

    def potential(self, bodies: tuple[Body, ...], places: Places) -> Expr:
        heights = (body.mass * self.g * places[body].dot(self._up(body)) for body in bodies)
        return sum(heights, ZERO)


@dataclass(frozen=True)
class Force(Load):
    """A given force (N) at a point of a body."""

    at: BodyPoint
    force: Vector
    name: str = "force"

    def __post_init__(self) -> None:
        of_type(self.at, BodyPoint, f"point of {self.name!r}", _POINT)
        of_type(self.force, Vector, f"{self.name!r}", "give it along a frame: lab['x'] * F")

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.at.body,)

    def actions(
        self, bodies: tuple[Body, ...], places: Places, velocities: Velocities
    ) -> tuple[Action, ...]:
        return (Action.at(self.at, self.force),)


@dataclass(frozen=True)
class Torque(Load):
    """A given couple (N m) on a body, and its opposite on `reaction_on`, if any."""

    body: Body
    torque: Vector
    reaction_on: Body | None = None
    name: str = "torque"

    def __post_init__(self) -> None:
        of_type(self.body, Body, f"body of {self.name!r}", "give the body it turns")
        of_type(self.torque, Vector, f"{self.name!r}", "give it along a frame: lab['z'] * tau")

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,) if self.reaction_on is None else (self.body, self.reaction_on)

    def actions(
        self, bodies: tuple[Body, ...], places: Places, velocities: Velocities
    ) -> tuple[Action, ...]:
        own = Action.pure(self.body, self.torque)
        if self.reaction_on is None:
            return (own,)
        return (own, Action.pure(self.reaction_on, -self.torque))


@dataclass(frozen=True, init=False)
class Spring(Load):
    """A straight spring between two points.

    Args:
        start: a point of a body.
        end: a point of another body, or a place from the origin (m) that may move.
        stiffness: N/m.
        length: unstretched, m; zero for an ideal spring.
    """

    start: BodyPoint
    end: BodyPoint | Vector
    stiffness: Expr
    length: Expr
    name: str

    def __init__(
        self,
        start: BodyPoint,
        end: BodyPoint | Vector,
        *,
        stiffness: ExprLike,
        length: ExprLike = 0,
        name: str = "spring",
    ) -> None:
        laws = {
            "stiffness": quantity(stiffness, f"stiffness of {name!r}"),
            "length": not_negative(length, f"length of {name!r}"),
        }
        for field, law in laws.items():
            without_coordinates([law], f"{field} of {name!r}", _NO_POTENTIAL)
        self._set(start=start, end=end, **laws, name=name)
        require_points(start, end, name)
        for point in (start, end):
            if isinstance(point, BodyPoint):
                point.require_fixed(f"end of {name!r}")

    @property
    def bodies(self) -> tuple[Body, ...]:
        return bodies_at(self.start, self.end)

    @property
    def sizes(self) -> Iterator[Size]:
        yield Size(f"length of {self.name!r}", self.length, may_vanish=True)

    @property
    def link(self) -> TwoPointLink:
        return TwoPointLink("spring", self.start, self.end)

    def on_places(self, places: Places, velocities: Velocities) -> tuple[Push, ...]:
        return pushes(self.end, self.actions((), places, velocities))

    def actions(
        self, bodies: tuple[Body, ...], places: Places, velocities: Velocities
    ) -> tuple[Action, ...]:
        between = vector_between(self.start, self.end, places)
        rate = self.stiffness  # tension divided by distance, N/m
        if self.length:
            distance = kept_length(between.components)
            rate = rate * kept_sum(distance - self.length) / distance
        return pair(self.start, self.end, between * -rate)

    def potential(self, bodies: tuple[Body, ...], places: Places) -> Expr:
        between = vector_between(self.start, self.end, places)
        squared = lengths_written_out(between.dot(between))
        if self.length:
            squared = kept_sum(kept_length(between.components) - self.length) ** 2
        return self.stiffness * squared / 2


@dataclass(frozen=True, init=False)
class Damper(Load):
    """Resistance proportional to the relative velocity of two points.

    Args:
        start: a point of a body.
        end: a point of another body, or a place from the origin (m) that may move.
        damping: N s/m.
    """

    start: BodyPoint
    end: BodyPoint | Vector
    damping: Expr
    name: str

    def __init__(
        self,
        start: BodyPoint,
        end: BodyPoint | Vector,
        *,
        damping: ExprLike,
        name: str = "damper",
    ) -> None:
        require_points(start, end, name)
        resistance = quantity(damping, f"damping of {name!r}")
        self._set(start=start, end=end, damping=resistance, name=name)

    @property
    def bodies(self) -> tuple[Body, ...]:
        return bodies_at(self.start, self.end)

    def actions(
        self, bodies: tuple[Body, ...], places: Places, velocities: Velocities
    ) -> tuple[Action, ...]:
        relative = _velocity(self.start, velocities) - _velocity(self.end, velocities)
        return pair(self.start, self.end, relative * -self.damping)

    @property
    def link(self) -> TwoPointLink:
        return TwoPointLink("damper", self.start, self.end)

    def on_places(self, places: Places, velocities: Velocities) -> tuple[Push, ...]:
        return pushes(self.end, self.actions((), places, velocities))


_NO_POTENTIAL = "declare the force itself as Force or Torque, which may depend on anything"
_POINT = "body.point() is its centre of mass, body.point(offset) any other point"


def require_points(start: object, end: object, name: str) -> None:
    """Refuse ends that are neither points of bodies nor, for the second one, places."""
    of_type(start, BodyPoint, f"start of {name!r}", f"{_POINT}; only the end may be a place")
    if isinstance(end, Vector):
        without_rates(end.components, f"end of {name!r}")
    else:
        of_type(end, BodyPoint, f"end of {name!r}", f"{_POINT}; or a place from the origin")


def bodies_at(*ends: BodyPoint | Vector) -> tuple[Body, ...]:
    """The bodies of the ends that are points of bodies."""
    return tuple(end.body for end in ends if isinstance(end, BodyPoint))


def _place_of(point: BodyPoint | Vector, places: Places) -> Vector:
    """An end from the origin, m."""
    return places[point.body] + point.offset if isinstance(point, BodyPoint) else point


def vector_between(start: BodyPoint, end: BodyPoint | Vector, places: Places) -> Vector:
    """From the end to the start, m, with its components as they stand."""
    return kept_sums(_place_of(start, places) - _place_of(end, places), start.body.axes.root)


def _velocity(point: BodyPoint | Vector, velocities: Velocities) -> Vector:
    if isinstance(point, Vector):
        return point.dt()
    velocity, angular = velocities[point.body]
    return velocity + angular.cross(point.offset)


def pair(start: BodyPoint, end: BodyPoint | Vector, force: Vector) -> tuple[Action, ...]:
    """A force on the first end, and its opposite on the second one if that is on a body."""
    first = Action.at(start, force)
    return (first, Action.at(end, -force)) if isinstance(end, BodyPoint) else (first,)


def pushes(end: BodyPoint | Vector, actions: tuple[Action, ...]) -> tuple[Push, ...]:
    """The opposite of the first force, where the other end is a place."""
    return () if isinstance(end, BodyPoint) else (Push(-actions[0].force, end.dt()),)

"""Flat supports, at rest or moving in their own plane."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, ExprLike, Vector, coordinate, speed
from polhode.base import DeclarationError
from polhode.model._body import Body
from polhode.model._declared import of_type, quantity, without_coordinates
from polhode.model._frame import Frame
from polhode.model._support import Support


@dataclass(frozen=True, init=False)
class Plane(Support):
    """A plane at rest in a frame, or the flat side of a body.

    The coordinates of a body on it are those of its centre of mass along the axes of the plane,
    from the origin, or from the centre of mass of the body whose side it is.

    Args:
        axes: the frame, or the body.
        normal: label of the direction that points away from the support.
        tilt: angle (rad) by which the plane is turned about the first direction after the normal,
            so that the second points up the slope.
        at: a point of the plane from there, m; it is the origin of the coordinates. By default the
            origin of the frame, or the body's centre of mass.
        of: the body, if `axes` is a frame.
    """

    axes: Frame
    normal: str
    at: Vector | None
    of: Body | None

    def __init__(
        self,
        axes: Frame | Body,
        *,
        normal: str = "z",
        tilt: ExprLike = 0,
        at: Vector | None = None,
        of: Body | None = None,
    ) -> None:
        carrier = axes if isinstance(axes, Body) else of
        frame = axes.axes if isinstance(axes, Body) else axes
        first, _ = frame.others(normal)
        tilted = frame.rotated(tilt, first, name="slope") if Expr.of(tilt) else frame
        self._set(axes=tilted, normal=normal, at=at, of=carrier)
        if at is not None:
            of_type(at, Vector, "place of a Plane", "give it as lab['z'] * h")
            advice = "give it a frame that turns, take a Sheet, or the body whose side it is"
            without_coordinates(at.components, "the place of a Plane", advice)
        if carrier is not None:
            self._require_fixed(carrier, self.base)

    @property
    def carrier(self) -> Body | None:
        return self.of

    @property
    def base(self) -> Vector:
        return self.axes.zero if self.at is None else self.at

    def is_symmetric_about(self, label: str | None) -> bool:
        if label is None or self.of is None or self.axes != self.of.axes:
            return False
        return self.axes.position(label) == self.axes.position(self.normal)

    @property
    def brief(self) -> str:
        """Its kind and the frame that it is at rest or moves in."""
        return f"{type(self).__name__} in {self.axes}, {self.normal} up"

    @property
    def origin(self) -> Vector:
        """Place of the support's own origin in its frame, m."""
        return self.axes.zero

    @property
    def directions(self) -> tuple[Vector, Vector, Vector]:
        first, second = self.tangents
        return self.axes[first], self.axes[second], self.up

    @property
    def labels(self) -> tuple[str, ...]:
        return (*self.tangents, self.normal)

    # The coordinates of a body are those of its centre of mass, with its velocity as speeds.

    def _coordinate(self, label: str, tag: str) -> Expr:
        return coordinate((label if label in "xyz" else f"x_{label}") + tag)

    def introduced(self, tag: str) -> tuple[Expr, ...]:
        return tuple(self.rates(tag))

    def rates(self, tag: str) -> Mapping[Expr, Expr]:
        return {self._coordinate(label, tag): speed(f"v_{label}{tag}") for label in self.tangents}

    def height(self, tag: str) -> Expr:
        return self._coordinate(self.normal, tag)

    def rise(self, tag: str) -> Expr:
        return speed(f"v_{self.normal}{tag}")

    def placed(self, tag: str, arm: Vector, height: Expr | None = None) -> Vector:
        place = self.up * (-arm.dot(self.up) if height is None else height)
        for label in self.tangents:
            place = place + self.axes[label] * self._coordinate(label, tag)
        return place

    def height_at(self, place: Vector, arm: Vector) -> Expr:
        return place.dot(self.up)

    @property
    def angular_velocity(self) -> Vector:
        if self.of is not None:
            return self.of.angular_velocity
        return self.axes.angular_velocity + self.up * self.turning

    def velocity(self, point: Vector) -> Vector:
        spin = self.up * self.turning
        carried = self.axes.angular_velocity.cross(point - self.base) + self.base.dt()
        return carried + self.drift + spin.cross(point - self.base - self.origin)


@dataclass(frozen=True, init=False)
class Turntable(Plane):
    """A plane that turns about its normal through the origin.

    Args:
        axes: the frame it turns in.
        Omega: angular velocity about the normal, rad/s; may be a function of time.
    """

    Omega: Expr

    def __init__(
        self, axes: Frame, Omega: ExprLike, *, normal: str = "z", tilt: ExprLike = 0
    ) -> None:
        super().__init__(axes, normal=normal, tilt=tilt)
        object.__setattr__(self, "Omega", quantity(Omega, "Omega of the turntable"))

    @property
    def turning(self) -> Expr:
        return self.Omega


@dataclass(frozen=True, init=False)
class Sheet(Plane):
    """A plane that moves within itself, such as a sheet of paper that is pulled and turned.

    Args:
        axes: the frame it moves in.
        motion: position (X, Y) of the sheet's own origin along the two directions in the plane, m,
            as functions of time.
        angle: angle by which the sheet has turned about its origin, rad.
        edge: distance of the sheet's edge from its own origin along the first direction, m; beyond
            it is a table at rest.
    """

    motion: tuple[Expr, Expr]
    angle: Expr
    edge: Expr | None

    def __init__(
        self,
        axes: Frame,
        *,
        motion: tuple[ExprLike, ExprLike] = (0, 0),
        angle: ExprLike = 0,
        edge: ExprLike | None = None,
        normal: str = "z",
        tilt: ExprLike = 0,
    ) -> None:
        super().__init__(axes, normal=normal, tilt=tilt)
        ends = None if edge is None else quantity(edge, "edge of the sheet")
        object.__setattr__(self, "edge", ends)
        moved = tuple(quantity(place, "motion of the sheet") for place in motion)
        if len(moved) != 2:
            raise DeclarationError(
                f"motion of the sheet: {motion!r}", expected="its position along two directions"
            )
        object.__setattr__(self, "motion", moved)
        object.__setattr__(self, "angle", quantity(angle, "angle of the sheet"))

    def _in_plane(self, first: Expr, second: Expr) -> Vector:
        along, across = (self.axes[label] for label in self.tangents)
        return along * first + across * second

    @property
    def origin(self) -> Vector:
        return self._in_plane(*self.motion)

    def ending(self, edge: ExprLike) -> Sheet:
        """The same sheet, cut off at an edge (m)."""
        return self._changed(edge=quantity(edge, "edge of the sheet"))

    @property
    def beyond(self) -> Plane | None:
        return None if self.edge is None else Plane(self.axes, normal=self.normal)

    def reserve(self, point: Vector) -> Expr:
        along = self.axes[self.tangents[0]]
        return ZERO if self.edge is None else self.edge - (point - self.origin).dot(along)

    @property
    def drift(self) -> Vector:
        return self._in_plane(self.motion[0].dt(), self.motion[1].dt())

    @property
    def turning(self) -> Expr:
        return self.angle.dt()

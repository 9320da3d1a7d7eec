"""What a support is: a surface that bodies touch, as seen by a contact.

A body touches a support at one point, with the normals there in line. A support says where the
centre of a body is that touches it, or is above it, in terms of coordinates of its own; and along
which triad the reaction is resolved.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import ClassVar, Self

from polhode.algebra import ZERO, Expr, Vector
from polhode.base import DeclarationError
from polhode.model._body import Body
from polhode.model._declared import Declared
from polhode.model._element import Limit
from polhode.model._frame import Frame
from polhode.model._spin import About

#: A body as strongly curved as the hollow it is in, which touches at a second point beyond.
MISFIT = "no longer fits"
#: A body off a hollow that is as near to other points of it: at the centre of a bowl.
NO_FOOT = "has no nearest point"
#: A point of a surface at which its coordinates are singular.
AT_POLE = "reaches a pole"
#: The point of a cone, which has no normal.
AT_APEX = "reaches the apex"
#: A point of a graph that is hardly one: its tangent plane is vertical.
STEEP = "reaches a vertical tangent"


class Support(Declared, ABC):
    """A surface that bodies touch.

    Attributes:
        axes: the triad at the point of contact.
        normal: label of its direction that points away from the support.
    """

    axes: Frame
    normal: str

    #: Fields that documents leave out where they are None, as those from before there were any.
    omitted: ClassVar[tuple[str, ...]] = ("of", "at")

    def under(self, tag: str) -> Self:
        """The same support, with the coordinates of a body with this tag."""
        return self

    @property
    def up(self) -> Vector:
        """Unit normal at the point of contact, away from the support."""
        return self.axes[self.normal]

    @property
    def tangents(self) -> tuple[str, str]:
        """Labels of the two directions along the surface."""
        return self.axes.others(self.normal)

    @property
    def carrier(self) -> Body | None:
        """The body that it is a surface of; None if it is at rest or moves as prescribed."""
        return None

    @property
    def base(self) -> Vector:
        """Its reference point, from the origin or the centre of mass of its carrier, m."""
        return self.axes.zero

    @property
    def foot(self) -> Vector:
        """From there to the point of the surface that is touched; of a plane, to any of it, m."""
        return self.axes.zero

    @property
    def needs_own_coordinates(self) -> bool:
        """Whether where it is touched is known only from coordinates of its own."""
        return False

    # -- the coordinates of a body on it ---------------------------------------------------------

    @abstractmethod
    def introduced(self, tag: str) -> tuple[Expr, ...]:
        """The coordinates along the surface of a body that touches it."""

    def rates(self, tag: str) -> Mapping[Expr, Expr]:
        """Those of them whose rates are speeds of another name, with these speeds."""
        return {}

    @abstractmethod
    def height(self, tag: str) -> Expr:
        """The coordinate that a body has in addition where it does not touch, m."""

    @abstractmethod
    def rise(self, tag: str) -> Expr:
        """The speed that is its rate, m/s."""

    @abstractmethod
    def placed(self, tag: str, arm: Vector, height: Expr | None = None) -> Vector:
        """The centre of mass of a body, from the reference point, m.

        Args:
            tag: of the body.
            arm: from the centre of mass to the point that touches or is nearest, m.
            height: value of the height; that in contact by default.
        """

    @abstractmethod
    def height_at(self, place: Vector, arm: Vector) -> Expr:
        """The height of a body whose centre of mass is at this place from that point, m."""

    def gap(self, place: Vector, arm: Vector) -> Expr:
        """Distance of the point at the end of the arm from the surface, along the normal, m.

        Args:
            place: of the body's centre of mass, from the reference point, m.
            arm: from there, m.
        """
        return (place + arm - self.foot).dot(self.up)

    def limits(self, arm: Vector) -> tuple[Limit, ...]:
        """What is positive as long as a body touches at one point that the coordinates describe.

        Args:
            arm: of the body, from its centre of mass to that point, m.
        """
        return ()

    # -- its motion ------------------------------------------------------------------------------

    def is_symmetric_about(self, label: str | None) -> bool:
        """Whether turning it about a direction of its frame, or about any, leaves it as it is."""
        return False

    def _require_fixed(self, body: Body, at: Vector) -> None:
        """Refuse a surface that is not at rest in the body that carries it.

        Raises:
            DeclarationError: naming both.
        """
        spins = body.spin.axis if isinstance(body.spin, About) else None
        still = body.fixed_axes == body.axes
        if not still and not (at.is_zero and self.is_symmetric_about(spins)):
            raise DeclarationError(
                f"a {type(self).__name__} of body {body.name!r}, which spins relative to its axes",
                expected="a surface that is symmetric about the axis of spin",
                advice="turn the axes with the body by one more angle",
            )
        body.point(at).require_fixed(f"the place of a {type(self).__name__}")

    @property
    @abstractmethod
    def angular_velocity(self) -> Vector:
        """Of the surface in inertial space, rad/s."""

    @abstractmethod
    def velocity(self, point: Vector) -> Vector:
        """Velocity in inertial space of the surface at a point given from the origin, m/s."""

    @property
    @abstractmethod
    def origin(self) -> Vector:
        """Place of its own origin, from the reference point, m."""

    @property
    @abstractmethod
    def directions(self) -> tuple[Vector, Vector, Vector]:
        """Unit vectors that turn with it, but for its turning about the normal."""

    @property
    @abstractmethod
    def labels(self) -> tuple[str, ...]:
        """The labels of these."""

    @property
    def drift(self) -> Vector:
        """Velocity of the support's origin relative to its frame, m/s."""
        return self.axes.zero

    @property
    def turning(self) -> Expr:
        """Angular velocity of the surface about its normal, relative to its frame, rad/s."""
        return ZERO

    # -- where it ends ---------------------------------------------------------------------------

    @property
    def beyond(self) -> Support | None:
        """The support beyond its edge, if it has an edge."""
        return None

    def reserve(self, point: Vector) -> Expr:
        """Distance of a point, given from the origin, on this side of the edge, m."""
        return ZERO

"""Surfaces of bodies, with the position of their point of contact with a plane."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, ExprLike, Vector, named, principal_root
from polhode.base import DeclarationError
from polhode.model._declared import (
    Declared,
    Size,
    constant,
    not_negative,
    positive,
    quantity,
    three,
)
from polhode.model._frame import Frame

#: Terms of a squared length above which it is kept as a named part: its root enters every velocity.
_LONG = 10
_LONG_NORMAL = 4  # of a component of the normal, above which it is kept so too


@dataclass(frozen=True)
class Profile:
    """The shape of a body of revolution: its outline, rotated about one of the body's axes.

    Attributes:
        axis: label of the axis.
        outline: height along the axis, from the centre of mass, and radius of points from the top
            down along the outside, m; closed if the last point is the first.
    """

    axis: str
    outline: tuple[tuple[Expr, Expr], ...]


class Surface(Declared, ABC):
    """A convex surface fixed to a body's axes, or symmetric about the axis it spins on."""

    @property
    def is_face(self) -> bool:
        """Whether it lies on a support with a flat face, which prevents tilting."""
        return False

    @property
    def encloses_centre(self) -> bool:
        """Whether the centre of mass is above the support in whatever attitude it touches.

        Otherwise a motion ends where the centre of mass comes down to the support.
        """
        return False

    @property
    def touches(self) -> bool:
        """Whether it says by itself which point touches a support; otherwise contacts name it."""
        return True

    @abstractmethod
    def lowest(self, axes: Frame, normal: Vector) -> Vector:
        """From the centre of mass to the point that touches a plane with this unit normal, m."""

    def rolling_axes(
        self, axes: Frame, normal: Vector, tangents: tuple[Vector, Vector]
    ) -> tuple[Vector, ...]:
        """Vectors k of which ω·k is how fast the point of contact travels over the surface, m.

        Of a body that turns with ω against a plane with this unit normal, along one direction of
        the plane or two; none where the same point always touches.

        Args:
            axes: of the body.
            normal: of the plane.
            tangents: unit vectors along the plane, with the normal a right-handed triad.
        """
        return ()

    @property
    def profile(self) -> Profile | None:
        """The shape to be drawn; None for the uniform body with the same inertia."""
        return None

    @abstractmethod
    def is_symmetric(self, axes: Frame, axis: int) -> bool:
        """Whether it is symmetric about this axis."""

    def assumed_positive(self, axes: Frame, normal: Vector) -> tuple[Expr, ...]:
        """Expressions whose sign is assumed to be positive."""
        return ()


@dataclass(frozen=True)
class Round(Surface):
    """A sphere about the centre of mass, or about a point of one of the axes: a tippe top.

    `offset` is the height of its centre along the axis, from the centre of mass.
    """

    radius: Expr
    axis: str = "3"
    offset: Expr = ZERO

    def __post_init__(self) -> None:
        object.__setattr__(self, "radius", constant(positive(self.radius, "radius"), "radius"))
        object.__setattr__(self, "offset", _offset(self.offset, "a sphere"))

    @property
    def sizes(self) -> Iterator[Size]:
        yield Size("radius of a sphere", self.radius)

    def lowest(self, axes: Frame, normal: Vector) -> Vector:
        if not self.offset:
            return normal * -self.radius
        return axes[self.axis] * self.offset - normal.express(axes) * self.radius

    def rolling_axes(
        self, axes: Frame, normal: Vector, tangents: tuple[Vector, Vector]
    ) -> tuple[Vector, ...]:
        # arm = -R n, and n changes by -ω × n in the body: along t by R (n × t)·ω
        first, second = tangents
        return second * self.radius, first * -self.radius

    def is_symmetric(self, axes: Frame, axis: int) -> bool:
        return not self.offset or axes.position(self.axis) == axis

    @property
    def encloses_centre(self) -> bool:
        return not self.offset


@dataclass(frozen=True)
class MaterialPoint(Surface):
    """One point of a body, by its vector from the centre of mass (m); by default that itself."""

    at: Vector | None = None

    @property
    def encloses_centre(self) -> bool:
        return self.at is None

    def lowest(self, axes: Frame, normal: Vector) -> Vector:
        return normal * 0 if self.at is None else self.at

    def is_symmetric(self, axes: Frame, axis: int) -> bool:
        return True


@dataclass(frozen=True)
class Rim(Surface):
    """A circle about one of the axes: the edge of a disk, a coin or a hoop.

    `offset` is the height of its centre along the axis, from the centre of mass.
    """

    radius: Expr
    axis: str
    offset: Expr = ZERO

    def __post_init__(self) -> None:
        object.__setattr__(self, "radius", constant(positive(self.radius, "radius"), "radius"))
        object.__setattr__(self, "offset", _offset(self.offset, "a rim"))

    @property
    def sizes(self) -> Iterator[Size]:
        yield Size("radius of a rim", self.radius)

    def is_symmetric(self, axes: Frame, axis: int) -> bool:
        return axes.position(self.axis) == axis

    def _steepest(self, axes: Frame, normal: Vector) -> Vector:
        # the normal's projection on the plane of the circle, of length sin θ for a tilted disk
        along = axes[self.axis]
        upright = _along(axes, normal)
        return upright - along * upright.dot(along)

    def lowest(self, axes: Frame, normal: Vector) -> Vector:
        steepest = self._steepest(axes, normal)
        squared = steepest.dot(steepest)
        if not squared:
            raise _lies_flat(f"a rim about axis {self.axis}")
        length = principal_root(_brief(squared))
        return axes[self.axis] * self.offset - steepest * (self.radius / length)

    def assumed_positive(self, axes: Frame, normal: Vector) -> tuple[Expr, ...]:
        steepest = self._steepest(axes, normal)
        return (principal_root(steepest.dot(steepest)),)

    def rolling_axes(
        self, axes: Frame, normal: Vector, tangents: tuple[Vector, Vector]
    ) -> tuple[Vector, ...]:
        # The point travels along the circle alone, R/sin θ for each unit of the angle about the
        # horizontal vector across its tangent, by which the plane turns past it.
        steepest = self._steepest(axes, normal)
        squared = _brief(steepest.dot(steepest))
        return ((axes[self.axis] - normal * axes[self.axis].dot(normal)) * (self.radius / squared),)

    @property
    def encloses_centre(self) -> bool:
        return not self.offset


@dataclass(frozen=True)
class LowerEdge(Rim):
    """The edge of the lower face of an upright cylinder, at a negative `offset`.

    It is the lowest part of the cylinder while that leans by less than a right angle. A cylinder
    that always lies on its side touches along a line, and does not turn about the normal; the
    resultant of the forces along the line is applied at its middle.
    """

    @property
    def sizes(self) -> Iterator[Size]:
        yield from super().sizes
        yield Size("depth of a lower edge below the centre of mass", -self.offset, may_vanish=True)

    def lowest(self, axes: Frame, normal: Vector) -> Vector:
        along = axes[self.axis]
        if along.dot(normal):
            return super().lowest(axes, normal)
        if any(s.kind.varies for c in along.express(normal.triad).components for s in c.symbols()):
            raise DeclarationError(
                f"a cylinder about axis {self.axis} that lies on its side and turns about the "
                "normal, though it touches along a line",
                expected="axes that do not turn about the normal",
                advice="or declare one circle: a Body with its moments of inertia and rim=radius",
            )
        return normal.express(axes) * -self.radius

    def assumed_positive(self, axes: Frame, normal: Vector) -> tuple[Expr, ...]:
        leaning = axes[self.axis].dot(normal)
        known = super().assumed_positive(axes, normal)
        return (*known, leaning) if leaning else known

    @property
    def encloses_centre(self) -> bool:
        return True


@dataclass(frozen=True)
class BaseEdge(Rim):
    """The edge of the base of a cone whose apex is up the axis, at a negative `offset`.

    It is the lowest part of the cone as long as the apex is above the support. A cone that always
    lies on its side touches along a line from this edge to the apex: what is applied here is the
    force at the edge, and a joint at the apex has the rest.

    Attributes:
        height: of the apex above the base, m.
    """

    height: Expr = ZERO

    @property
    def profile(self) -> Profile:
        apex, base = self.offset + self.height, self.offset
        return Profile(self.axis, ((apex, ZERO), (base, self.radius), (base, ZERO)))

    @property
    def encloses_centre(self) -> bool:
        return True

    def assumed_positive(self, axes: Frame, normal: Vector) -> tuple[Expr, ...]:
        (steep,) = super().assumed_positive(axes, normal)
        above = axes[self.axis].dot(normal) * self.height + steep * self.radius
        return (steep, above) if above else (steep,)


@dataclass(frozen=True)
class Ellipsoidal(Surface):
    """An ellipsoid with these half-axes along the body's axes, such as the base of a rattleback.

    `offset` has the components of its centre along these axes, from the centre of mass.
    """

    half_axes: tuple[Expr, Expr, Expr]
    offset: tuple[Expr, Expr, Expr] = (ZERO, ZERO, ZERO)

    def __post_init__(self) -> None:
        what = "half-axis of an ellipsoid"
        halves = tuple(
            constant(not_negative(half, what), what)
            for half in three(self.half_axes, "half-axes of an ellipsoid")
        )
        centre = three(self.offset, "offset of an ellipsoid")
        object.__setattr__(self, "half_axes", halves)
        object.__setattr__(self, "offset", tuple(_offset(c, "an ellipsoid") for c in centre))

    @property
    def sizes(self) -> Iterator[Size]:
        return (Size("half-axis of an ellipsoid", h, may_vanish=True) for h in self.half_axes)

    def is_symmetric(self, axes: Frame, axis: int) -> bool:
        first, second = (axis + 1) % 3, (axis + 2) % 3
        centred = not self.offset[first] and not self.offset[second]
        return centred and self.half_axes[first] == self.half_axes[second]

    @property
    def encloses_centre(self) -> bool:
        return not any(self.offset)

    def lowest(self, axes: Frame, normal: Vector) -> Vector:
        # on Σ x²/h² = 1 the normal is along x/h²: the lowest point is -h² n/√(Σ h² n²)
        stretched, support = self._stretched(_along(axes, normal))
        if not support:
            raise _lies_flat("an ellipsoid without thickness")
        height = principal_root(_brief(support))
        reached = zip(self.offset, stretched, strict=True)
        return Vector(tuple(centre - s / height for centre, s in reached), axes)

    def rolling_axes(
        self, axes: Frame, normal: Vector, tangents: tuple[Vector, Vector]
    ) -> tuple[Vector, ...]:
        # arm = c - h² n/H with H² = Σ h² n²: where n changes by δ = n × ω, it changes by D δ with
        # the symmetric D = -h²/H + (h² n)(h² n)ᵀ/H³, so that k = (D t) × n
        upright = _along(axes, normal)
        stretched, squared = self._stretched(upright)
        squares, support = [h * h for h in self.half_axes], _brief(squared)
        height, found = principal_root(support), list[Vector]()
        for tangent in tangents:
            along = tangent.express(axes).components
            mixed = sum((s * t for s, t in zip(stretched, along, strict=True)), ZERO)
            changed = (
                (mixed / support * n - s * t) / height
                for s, n, t in zip(squares, stretched, along, strict=True)
            )
            first, second, third = changed
            found.append(Vector((first, second, third), axes).cross(upright))
        return tuple(found)

    def _stretched(self, upright: Vector) -> tuple[list[Expr], Expr]:
        """h² n along the axes, and Σ h² n², of a normal n along the same."""
        normal = upright.components
        stretched = [h * h * n for h, n in zip(self.half_axes, normal, strict=True)]
        return stretched, sum((s * n for s, n in zip(stretched, normal, strict=True)), ZERO)


@dataclass(frozen=True)
class Block(Surface):
    """A box about the centre of mass, with sides along the axes: contacts name its corners."""

    sides: tuple[Expr, Expr, Expr]

    def __post_init__(self) -> None:
        what = "side of a box"
        sides = three(self.sides, "sides of a box")
        object.__setattr__(self, "sides", tuple(constant(positive(s, what), what) for s in sides))

    @property
    def sizes(self) -> Iterator[Size]:
        for side in self.sides:
            yield Size("side of a box", side)

    @property
    def touches(self) -> bool:
        return False

    def lowest(self, axes: Frame, normal: Vector) -> Vector:
        raise DeclarationError(
            "the lowest point of a box, which changes from corner to corner",
            expected="contacts that name the corners",
            advice="give each contact its corner: at=axes.vector(a/2, b/2, -c/2)",
        )

    def is_symmetric(self, axes: Frame, axis: int) -> bool:
        first, second = (side for i, side in enumerate(self.sides) if i != axis)
        return first == second


@dataclass(frozen=True)
class Face(Surface):
    """A flat face that stays on the support: the body slides but neither tilts nor turns.

    `height` is the distance of the centre of mass above the face.
    """

    height: Expr

    def __post_init__(self) -> None:
        what = "height above the face"
        object.__setattr__(self, "height", constant(not_negative(self.height, what), what))

    @property
    def sizes(self) -> Iterator[Size]:
        yield Size("height above the face", self.height, may_vanish=True)

    @property
    def is_face(self) -> bool:
        return True

    @property
    def encloses_centre(self) -> bool:
        return True

    def lowest(self, axes: Frame, normal: Vector) -> Vector:
        return normal * -self.height

    def is_symmetric(self, axes: Frame, axis: int) -> bool:
        return False


def _lies_flat(what: str) -> DeclarationError:
    return DeclarationError(
        f"{what} that always lies flat on its support",
        expected="one lowest point",
        advice="let it tilt by a coordinate; a body that slides on a flat face has "
        "surface=ph.Face(height)",
    )


def _offset(value: ExprLike, of: str) -> Expr:
    what = f"offset of {of}"
    return constant(quantity(value, what), what)


def _along(axes: Frame, normal: Vector) -> Vector:
    """A normal along a body's axes, its components under names where they are long.

    They are where both the body and the normal turn by several angles, as on a curved support.
    """
    upright = normal.express(axes)
    long = any(sum(1 for _ in c.terms()) > _LONG_NORMAL for c in upright.components)
    return upright.mapped(named) if long else upright


def _brief(squared: Expr) -> Expr:
    """A squared length, under a name where it is long."""
    return named(squared) if sum(1 for _ in squared.terms()) > _LONG else squared

"""Curved supports: what all of them have in common.

A convex body touches a smooth surface S(u, v) where its own normal is opposite to n(u, v). With
`arm`, the vector from its centre of mass to the point that touches a plane with this normal, its
centre is at

    S(u, v) + gap n(u, v) - arm(n),

whatever its attitude: u and v, which say where the surface is touched, or is nearest, are
coordinates of the body, and so is the gap where it does not touch.

Along the surface the two are in contact at one point as long as the body is more strongly curved
than the hollow that it is in. (Two convex surfaces: do Carmo, Differential
Geometry of Curves and Surfaces, § 3.3; contact coordinates: Montana, Int. J. Robot. Res. 7 (3), 17,
1988.)
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Self

from polhode.algebra import (
    ONE,
    ZERO,
    Expr,
    ExprLike,
    Matrix,
    Symbol,
    SymbolKind,
    Vector,
    as_symbol,
    coordinate,
    is_positive,
    pi,
)
from polhode.base import DeclarationError
from polhode.model._body import Body
from polhode.model._declared import of_type, without_coordinates
from polhode.model._element import Limit
from polhode.model._frame import Frame
from polhode.model._support import MISFIT, Support


@dataclass(frozen=True, init=False)
class CurvedSupport(Support, ABC):
    """A smooth curved surface that is at rest in a frame.

    A body on it has the coordinates u and v, which say where it touches, and off it `gap`, the
    distance to the nearest point of the surface; names of other bodies have their tags. The
    reaction is resolved along the triad `axes` with the labels u, v, n: the directions in which the
    point of contact moves with u and with v, and the normal.

    Attributes:
        frame: in which it is at rest; it may turn as prescribed.
        of: the body that it is a surface of, whose axes the frame is; None for the ground.
        at: place of its centre, axis or apex, from the origin, m, where it may be a function of
            time, or from the body's centre of mass; None for there.
        tag: of the body whose coordinates u and v are.
        inside: whether bodies are inside.
        axis: label of a direction of the frame through it, or "-" and the label.
    """

    frame: Frame
    of: Body | None
    at: Vector | None
    tag: str
    inside: bool
    axis: str

    def _place(self, frame: Frame | Body, at: Vector | None, tag: str, of: Body | None) -> None:
        """Set the fields that all curved supports have."""
        what = f"a {type(self).__name__}"
        carrier = frame if isinstance(frame, Body) else of
        own = frame.axes if isinstance(frame, Body) else frame
        of_type(own, Frame, f"frame of {what}", "give the laboratory's, as in Sphere(lab, ...)")
        if at is not None:
            of_type(at, Vector, f"place of {what}", "give it as lab['z'] * h")
        self._set(frame=own, of=carrier, at=at, tag=tag)
        if carrier is None:
            advice = "it is at rest, or moves as prescribed; or give the body it is a surface of"
            without_coordinates(own.turning, f"the turning of {what}", advice)
            place = self.base.express(own.root).components
            without_coordinates(place, f"the place of {what}", advice)

    @property
    def brief(self) -> str:
        """Its kind, and the frame that it is at rest in or the body it is part of."""
        where = f"in {self.frame}" if self.of is None else f"of {self.of.name}"
        return f"{type(self).__name__} {where}"

    @property
    def carrier(self) -> Body | None:
        return self.of

    @property
    def base(self) -> Vector:
        return self.frame.root.zero if self.at is None else self.at

    def under(self, tag: str) -> Self:
        return self if tag == self.tag else self._changed(tag=tag)

    # -- its shape -------------------------------------------------------------------------------

    @property
    def _outwards(self) -> int:
        """1 where the normal points away from the axis or the centre, -1 inside."""
        return -1 if self.inside else 1

    @property
    def _along(self) -> Vector:
        """Unit vector along the axis."""
        return direction(self.frame, self.axis, f"axis of a {type(self).__name__}")

    @property
    def is_convex(self) -> bool:
        """Whether every convex body touches it at one point."""
        return not self.inside

    @property
    def normal(self) -> str:  # type: ignore[override]
        return "n"

    @cached_property
    @abstractmethod
    def axes(self) -> Frame:  # type: ignore[override]
        """The triad u, v, n at the point that is touched."""

    @cached_property
    @abstractmethod
    def foot(self) -> Vector:
        """The point that is touched, from the centre, axis or apex of the surface, m."""

    @property
    def uv(self) -> tuple[Expr, Expr]:
        """The two coordinates along the surface."""
        return coordinate(f"u{self.tag}"), coordinate(f"v{self.tag}")

    def renamed(self, expression: Expr) -> Expr:
        """An expression of coordinates called u and v, of those of the body that touches."""
        own = (as_symbol(coordinate(name)) for name in "uv")
        return expression.subs(dict(zip(own, self.uv, strict=True)))

    @property
    def tangents(self) -> tuple[str, str]:
        return ("u", "v")

    def limits(self, arm: Vector) -> tuple[Limit, ...]:
        if self.is_convex:
            return ()
        # the trace only tells apart a body that fits and one that is larger in both directions
        return tuple(Limit(MISFIT, m) for m in self._margins(arm) if not is_positive(m))

    def _margins(self, arm: Vector) -> tuple[Expr, Expr]:
        """Positive where a body touches at one point: determinant and trace of 1 + B W.

        W maps a displacement along this surface to the change of its normal, and B, for the body,
        a change of the normal to a displacement of the point that touches.
        """
        q = [as_symbol(c) for c in self.uv]
        first = Matrix(tuple(self._moved(self.foot, s) for s in q))  # on the support
        second = Matrix(tuple(self._moved(self.foot - arm.express(self.axes), s) for s in q))
        size = _determinant(first)
        stretch = second @ _adjugate(first)  # size * (1 + B W), along the tangents
        return _determinant(second) / size, (stretch[0, 0] + stretch[1, 1]) / size

    def _moved(self, vector: Vector, symbol: Symbol) -> tuple[Expr, Expr]:
        """Components along the surface of a vector's change with a coordinate, attitudes held."""
        rate = vector.express(self.frame).diff(symbol)
        along = rate.express(self.axes)
        return along.dot(self.axes["u"]), along.dot(self.axes["v"])

    # -- a body on it ----------------------------------------------------------------------------

    @property
    def needs_own_coordinates(self) -> bool:
        return True

    def introduced(self, tag: str) -> tuple[Expr, ...]:
        return self.uv

    def height(self, tag: str) -> Expr:
        return coordinate(f"gap{tag}")

    def rise(self, tag: str) -> Expr:
        return coordinate(f"gap{tag}").dt()

    def placed(self, tag: str, arm: Vector, height: Expr | None = None) -> Vector:
        return self.foot + self.up * (ZERO if height is None else height) - arm

    def height_at(self, place: Vector, arm: Vector) -> Expr:
        return self.gap(place, arm)

    # -- its motion ------------------------------------------------------------------------------

    @property
    def angular_velocity(self) -> Vector:
        return self.frame.angular_velocity if self.of is None else self.of.angular_velocity

    def velocity(self, point: Vector) -> Vector:
        return self.base.dt() + self.angular_velocity.cross(point - self.base)

    @property
    def origin(self) -> Vector:
        return self.frame.zero

    @property
    def directions(self) -> tuple[Vector, Vector, Vector]:
        return self.frame.directions

    @property
    def labels(self) -> tuple[str, ...]:
        return self.frame.labels

    @property
    def drift(self) -> Vector:
        return self.base.dt(self.frame.root)


@dataclass(frozen=True, init=False)
class SurfaceOfRevolution(CurvedSupport, ABC):
    """A curved support about an axis, with u the angle about it.

    Attributes:
        zero: label of the direction from its axis with u = 0; u grows from there towards the
            positive direction of the frame that is left.
    """

    zero: str

    def _about(self, *, inside: bool, axis: str, zero: str) -> None:
        """Set axis and angle, and refuse a surface that is not at rest in the body it is of.

        Args:
            zero: the direction that follows the axis if none is given.
        """
        begin = zero or self.frame.others(axis.removeprefix("-"))[0]
        self._set(inside=bool(inside), axis=axis, zero=begin)
        self._directions()
        if self.of is not None:
            self._require_fixed(self.of, self.base)

    def is_symmetric_about(self, label: str | None) -> bool:
        own = self.axis.removeprefix("-")
        return label is not None and self.frame.position(label) == self.frame.position(own)

    def _directions(self) -> tuple[Vector, Vector]:
        """From the axis to where u = 0, and where u grows to at first.

        Raises:
            DeclarationError: for a direction along the axis.
        """
        what = f"a {type(self).__name__}"
        along, start = self._along, direction(self.frame, self.zero, f"zero of {what}")
        if start.dot(along):
            raise DeclarationError(
                f"u = 0 of {what} along its axis", expected="a direction across the axis"
            )
        (other,) = (d for d in self.frame.directions if not d.dot(along) and not d.dot(start))
        return start, other

    def _around(self) -> Frame:
        """The triad of a cylinder about the axis, where u is."""
        start, other = self._directions()
        at_zero = triad(self.frame, other, self._along, start * self._outwards)
        return turned(at_zero, self.uv[0] * self._outwards, "n", at_zero["u"])


def _determinant(matrix: Matrix) -> Expr:
    return matrix[0, 0] * matrix[1, 1] - matrix[0, 1] * matrix[1, 0]


def _adjugate(matrix: Matrix) -> Matrix:
    (a, b), (c, d) = matrix.rows
    return Matrix(((d, -b), (-c, a)))


# -- surfaces given by expressions -----------------------------------------------------------------


def along_surface(given: ExprLike, names: str, what: str) -> Expr:
    """A length as an expression of coordinates along a surface and of constants.

    Args:
        names: of the coordinates, a letter each.

    Raises:
        DeclarationError: for one of anything else.
    """
    length = Expr.of(given)
    own = {as_symbol(coordinate(name)) for name in names}
    if others := {s for s in length.symbols() if s.kind is not SymbolKind.PARAMETER} - own:
        found = ", ".join(sorted(s.published for s in others))
        raise DeclarationError(
            f"{what} as a function of {found}",
            expected=f"an expression of the coordinates {' and '.join(names)}, and of parameters",
            advice=f"make them by polhode.coordinates({' '.join(names)!r}); a surface moves with "
            "its frame, or with its place `at`",
        )
    return length


# -- triads ----------------------------------------------------------------------------------------


def direction(frame: Frame, label: str, what: str) -> Vector:
    """A direction of a frame by its label, or its opposite by "-" and the label.

    Raises:
        DeclarationError: for a label that the frame does not have.
    """
    if not isinstance(label, str):
        raise DeclarationError(
            f"{what}: {label!r}", expected="a label such as 'z', or '-z' for the opposite direction"
        )
    along = frame[label.removeprefix("-")]
    return -along if label.startswith("-") else along


def triad(frame: Frame, u: Vector, v: Vector, n: Vector) -> Frame:
    """The frame with three directions, in the order u, v, n, or v, u, n if that is right-handed.

    Args:
        frame: which it is at rest in, and whose directions or opposites the three are.
    """
    ordered = (u, v, n) if u.cross(v).dot(n) == ONE else (v, u, n)
    labels = ("u", "v", "n") if ordered[0] is u else ("v", "u", "n")
    for turned in _quarter_turns(frame, labels):
        if all(turned[x].dot(d) == ONE for x, d in zip(labels, ordered, strict=True)):
            return turned
    raise AssertionError(f"{ordered} are no directions of {frame}")


def _quarter_turns(frame: Frame, labels: tuple[str, ...]) -> Iterator[Frame]:
    """All frames whose directions are those of a frame, or their opposites."""
    angles = (pi / 2, pi, -pi / 2)
    yield frame.rotated(ZERO, "1", labels, name="contact")
    for first, one in product("123", angles):
        yield frame.rotated(one, first, labels, name="contact")
    for (first, one), (second, two) in product(product("123", angles), repeat=2):
        if first != second:
            yield frame.rotated(one, first).rotated(two, second, labels, name="contact")


def turned(frame: Frame, angle: Expr, start: str, end: Vector) -> Frame:
    """A frame turned so that one of its directions moves towards another."""
    aside = frame[start].cross(end)
    (label,) = (x for x in frame.labels if frame[x].dot(aside))
    sense = frame[label].dot(aside)
    # a frame that only renames the directions of another is left out
    base = frame.parent if frame.angle.is_zero and frame.parent else frame
    return base.rotated(angle * sense, frame[label].components, frame.labels, frame.name)

"""A surface given by its height over a plane, or over the distance from an axis."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from polhode.algebra import (
    Expr,
    ExprLike,
    SquareRoot,
    Vector,
    as_symbol,
    atan,
    cos,
)
from polhode.model._body import Body
from polhode.model._curved import (
    CurvedSupport,
    SurfaceOfRevolution,
    along_surface,
    direction,
    triad,
    turned,
)
from polhode.model._element import Limit
from polhode.model._frame import Frame
from polhode.model._support import AT_POLE, STEEP

# Cosine of the slope at which a surface counts as vertical: 87°. Beyond, coordinates along it lose
# half of their digits.
_STEEPEST = Expr.of(Fraction(1, 20))


def _steepness(surface: CurvedSupport) -> Iterator[Limit]:
    """Where a height such as √(R² − u²) ends, with an infinite slope."""
    level = surface.up.dot(surface._along) * -surface._outwards
    if any(isinstance(generator, SquareRoot) for generator in level.numerator.generators):
        yield Limit(STEEP, level - _STEEPEST)


@dataclass(frozen=True, init=False)
class Graph(CurvedSupport):
    """A surface z = f(x, y): a bowl, a saddle, a track with hills.

    x and y are distances along two directions of a frame, z is that along the third. On it they
    are the coordinates u and v of the point that is touched. The direction u of its triad is that
    in which the point moves with u alone; v is across it.

    Args:
        frame: in which it is at rest, or the body whose surface it is.
        z: f, m: an expression of the coordinates called u and v, and of parameters.
        inside: whether bodies are above it, as in a bowl; below it otherwise.
        axis: label of the direction of z; the frame's third one by default. u and v are along the
            two that follow it.
        at: the point u = v = z = 0, from the origin or the body's centre of mass, m.
    """

    z: Expr

    def __init__(
        self,
        frame: Frame | Body,
        z: ExprLike,
        *,
        inside: bool = True,
        axis: str = "",
        at: Vector | None = None,
        tag: str = "",
        of: Body | None = None,
    ) -> None:
        self._place(frame, at, tag, of)
        label = axis or self.frame.labels[2]
        direction(self.frame, label, "axis of a Graph")
        self._set(z=along_surface(z, "uv", "a Graph"), inside=bool(inside), axis=label)
        if self.of is not None:
            self._require_fixed(self.of, self.base)

    @property
    def is_convex(self) -> bool:
        return False

    @property
    def _across(self) -> tuple[Vector, Vector]:
        """The directions of x and y."""
        first, second = self.frame.others(self.axis.removeprefix("-"))
        return self.frame[first], self.frame[second]

    @cached_property
    def elevation(self) -> Expr:
        """z at the point that is touched, m."""
        return self.renamed(self.z)

    @cached_property
    def axes(self) -> Frame:  # type: ignore[override]
        x, y = self._across
        level = triad(self.frame, x, y, self._along * -self._outwards)
        along_u, along_v = (self.elevation.diff(as_symbol(q)) for q in self.uv)
        up = level["n"] * -self._outwards
        slope = atan(along_u)
        sloped = turned(level, slope, "u", up)
        up = sloped["n"] * -self._outwards
        return turned(sloped, atan(along_v * cos(slope)), "v", up)

    @cached_property
    def foot(self) -> Vector:
        (u, v), (x, y) = self.uv, self._across
        return x * u + y * v + self._along * self.elevation

    def limits(self, arm: Vector) -> tuple[Limit, ...]:
        return (*_steepness(self), *super().limits(arm))


@dataclass(frozen=True, init=False)
class Revolution(SurfaceOfRevolution):
    """A surface z = f(r) about an axis: a funnel, a bowl, a trumpet.

    u is the angle about the axis, rad, and v the distance r from it, m; the axis itself, r = 0, is
    no point of the surface (a `Graph` has its lowest point).

    Args:
        frame: in which it is at rest, or the body whose surface it is.
        z: f, m: an expression of the coordinate called v, and of parameters.
        inside: whether bodies are above it, as in a bowl; below it otherwise.
        axis: label of the direction of z; the frame's third one by default.
        zero: label of the direction from its axis with u = 0; the next one by default. u grows
            towards the remaining direction.
        at: the point r = z = 0, from the origin or the body's centre of mass, m.
    """

    z: Expr

    def __init__(
        self,
        frame: Frame | Body,
        z: ExprLike,
        *,
        inside: bool = True,
        axis: str = "",
        zero: str = "",
        at: Vector | None = None,
        tag: str = "",
        of: Body | None = None,
    ) -> None:
        self._place(frame, at, tag, of)
        label = axis or self.frame.labels[2]
        self._set(z=along_surface(z, "v", "a Revolution"))
        self._about(inside=inside, axis=label, zero=zero)

    @property
    def is_convex(self) -> bool:
        return False

    @cached_property
    def elevation(self) -> Expr:
        """z at the point that is touched, m."""
        return self.renamed(self.z)

    @cached_property
    def _level(self) -> Frame:
        """The triad of a plane across the axis, turned by u about it."""
        start, other = self._directions()
        level = triad(self.frame, other, start, self._along * -self._outwards)
        return turned(level, self.uv[0], "v", level["u"])

    @cached_property
    def axes(self) -> Frame:  # type: ignore[override]
        slope = self.elevation.diff(as_symbol(self.uv[1]))
        return turned(self._level, atan(slope), "v", self._level["n"] * -self._outwards)

    @cached_property
    def foot(self) -> Vector:
        return self._level["v"] * self.uv[1] + self._along * self.elevation

    def limits(self, arm: Vector) -> tuple[Limit, ...]:
        return (Limit(AT_POLE, self.uv[1]), *_steepness(self), *super().limits(arm))

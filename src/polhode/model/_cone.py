"""The cone as a support: a funnel, or a hill with a point."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import Expr, ExprLike, Vector
from polhode.model._body import Body
from polhode.model._curved import SurfaceOfRevolution, turned
from polhode.model._declared import Size, constant, positive
from polhode.model._element import Limit
from polhode.model._frame import Frame
from polhode.model._support import AT_APEX


@dataclass(frozen=True, init=False)
class Cone(SurfaceOfRevolution):
    """A circular cone with its apex at a point, touched from outside or, a funnel, from inside.

    u is the angle about the axis, rad, and v the distance from the apex along the surface, m. The
    apex itself is no point of the surface.

    Args:
        frame: in which it is at rest, or the body whose surface it is.
        half_angle: between its axis and its surface, rad, less than π/2.
        inside: whether bodies are inside.
        axis: label of the direction from the apex into the cone, or "-" and the label. By default
            it opens upwards for bodies inside, and downwards for bodies outside.
        zero: label of the direction from its axis with u = 0; the next one by default. u grows
            towards the remaining direction.
        at: the apex, from the origin or the body's centre of mass, m.
    """

    half_angle: Expr

    def __init__(
        self,
        frame: Frame | Body,
        *,
        half_angle: ExprLike,
        inside: bool = False,
        axis: str = "",
        zero: str = "",
        at: Vector | None = None,
        tag: str = "",
        of: Body | None = None,
    ) -> None:
        self._place(frame, at, tag, of)
        frame = self.frame
        what = "half-angle of a Cone"
        label = axis or ("" if inside else "-") + frame.labels[2]
        angle = constant(positive(half_angle, what), what)
        self._set(half_angle=angle)
        self._about(inside=inside, axis=label, zero=zero)

    @property
    def sizes(self) -> Iterator[Size]:
        yield Size("half-angle of a Cone", self.half_angle)

    @cached_property
    def axes(self) -> Frame:  # type: ignore[override]
        around = self._around()  # the surface along the axis, which is then turned away from it
        return turned(around, -self.half_angle * self._outwards, "n", around["v"])

    @cached_property
    def foot(self) -> Vector:
        return self.axes["v"] * self.uv[1]

    def limits(self, arm: Vector) -> tuple[Limit, ...]:
        return (Limit(AT_APEX, self.uv[1]), *super().limits(arm))

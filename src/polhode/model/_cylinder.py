"""The cylinder as a support: a log to roll on, a trough, or a vertical drum."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import Expr, ExprLike, Vector
from polhode.model._body import Body
from polhode.model._curved import SurfaceOfRevolution
from polhode.model._declared import Size, constant, positive
from polhode.model._frame import Frame


@dataclass(frozen=True, init=False)
class Cylinder(SurfaceOfRevolution):
    """A circular cylinder of any length, touched from outside or from inside.

    u is the angle about the axis, rad, and v the distance along it, m. Unless `zero` says
    otherwise, u = 0 at the top of a cylinder that lies, or inside at its bottom; of an upright one
    in the first direction of the frame. It grows towards the third direction of the frame, besides
    those of `axis` and `zero`.

    Args:
        frame: in which it is at rest, or the body whose surface it is.
        radius: m.
        inside: whether bodies are inside.
        axis: label of the direction along its axis; by default the second, so that it lies.
        zero: label of the direction from its axis with u = 0, or "-" and the label.
        at: a point of its axis, from the origin or the body's centre of mass, m.
    """

    radius: Expr

    def __init__(
        self,
        frame: Frame | Body,
        *,
        radius: ExprLike,
        inside: bool = False,
        axis: str = "",
        zero: str = "",
        at: Vector | None = None,
        tag: str = "",
        of: Body | None = None,
    ) -> None:
        self._place(frame, at, tag, of)
        frame = self.frame
        what = "radius of a Cylinder"
        label = axis or frame.labels[1]
        upright = frame.position(label.removeprefix("-")) == 2
        lying = ("-" if inside else "") + frame.labels[2]
        begin = zero or (frame.labels[0] if upright else lying)
        size = constant(positive(radius, what), what)
        self._set(radius=size)
        self._about(inside=inside, axis=label, zero=begin)

    @property
    def sizes(self) -> Iterator[Size]:
        yield Size("radius of a Cylinder", self.radius)

    @cached_property
    def axes(self) -> Frame:  # type: ignore[override]
        return self._around()

    @cached_property
    def foot(self) -> Vector:
        return self.up * (self.radius * self._outwards) + self.axes["v"] * self.uv[1]

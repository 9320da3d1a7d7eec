"""The cylinder as a support: a log to roll on, a trough, or a vertical drum."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import Expr, ExprLike, Vector
from polhode.model._body import Body
from polhode.model._curved import CurvedSupport, direction, towards, triad, turned
from polhode.model._declared import Size, constant, positive
from polhode.model._element import Limit
from polhode.model._frame import Frame


@dataclass(frozen=True, init=False)
class Cylinder(CurvedSupport):
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
    inside: bool
    axis: str
    zero: str

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
        self._set(radius=size, inside=bool(inside), axis=label, zero=begin)
        self._directions()
        if self.of is not None:
            self._require_fixed(self.of, self.base)

    def _directions(self) -> tuple[Vector, Vector, Vector]:
        along = direction(self.frame, self.axis, "axis of a Cylinder")
        return (along, *towards(self.frame, along, self.zero, "", "a Cylinder"))

    def is_symmetric_about(self, label: str | None) -> bool:
        own = self.axis.removeprefix("-")
        return label is not None and self.frame.position(label) == self.frame.position(own)

    @property
    def sizes(self) -> Iterator[Size]:
        yield Size("radius of a Cylinder", self.radius)

    @cached_property
    def axes(self) -> Frame:  # type: ignore[override]
        along, start, other = self._directions()
        outwards = -1 if self.inside else 1
        at_zero = triad(self.frame, other, along, start * outwards)
        return turned(at_zero, self.uv[0] * outwards, "n", at_zero["u"])

    @cached_property
    def foot(self) -> Vector:
        outwards = -1 if self.inside else 1
        return self.up * (self.radius * outwards) + self.axes["v"] * self.uv[1]

    def limits(self, arm: Vector) -> tuple[Limit, ...]:
        return super().limits(arm) if self.inside else ()

"""The sphere as a support: a ball to roll on, or a bowl to roll in."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import Expr, ExprLike, Vector, cos
from polhode.model._body import Body
from polhode.model._curved import CurvedSupport, triad, turned
from polhode.model._declared import Size, constant, positive
from polhode.model._element import Limit
from polhode.model._frame import Frame
from polhode.model._support import AT_POLE


@dataclass(frozen=True, init=False)
class Sphere(CurvedSupport):
    """A sphere, touched from outside, or from inside: a bowl.

    u and v are longitude and latitude, rad, from the top, or inside from the bottom: at first u
    grows along the first of the two directions after `axis`, v along the second. At v = ±π/2 they
    are singular.

    Args:
        frame: in which it is at rest, or the body whose surface it is.
        radius: m.
        inside: whether bodies are inside.
        axis: label of the direction from its centre to its top.
        at: its centre, from the origin or the body's centre of mass, m.
    """

    radius: Expr

    def __init__(
        self,
        frame: Frame | Body,
        *,
        radius: ExprLike,
        inside: bool = False,
        axis: str = "",
        at: Vector | None = None,
        tag: str = "",
        of: Body | None = None,
    ) -> None:
        self._place(frame, at, tag, of)
        frame = self.frame
        what = "radius of a Sphere"
        label = axis or frame.labels[2]
        size = constant(positive(radius, what), what)
        self._set(radius=size, inside=bool(inside), axis=label)
        self._along  # noqa: B018 - refuses an unknown label
        if self.of is not None:
            self._require_fixed(self.of, self.base)

    def is_symmetric_about(self, label: str | None) -> bool:
        return True

    @property
    def sizes(self) -> Iterator[Size]:
        yield Size("radius of a Sphere", self.radius)

    @cached_property
    def axes(self) -> Frame:  # type: ignore[override]
        first, second = (self.frame[x] for x in self.frame.others(self.axis.removeprefix("-")))
        if self.axis.startswith("-"):
            first, second = second, first
        (u, v), start = self.uv, triad(self.frame, first, second, self._along)
        around = turned(start, u * self._outwards, "n", start["u"])
        return turned(around, v * self._outwards, "n", around["v"])

    @cached_property
    def foot(self) -> Vector:
        return self.up * (self.radius * self._outwards)

    def limits(self, arm: Vector) -> tuple[Limit, ...]:
        return (Limit(AT_POLE, cos(self.uv[1])), *super().limits(arm))

"""The torus as a support: a ring to roll on, or a tube to roll in."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import Expr, ExprLike, Vector, is_positive
from polhode.base import DeclarationError
from polhode.model._body import Body
from polhode.model._curved import CurvedSupport, direction, towards, triad, turned
from polhode.model._declared import Size, constant, positive
from polhode.model._frame import Frame


@dataclass(frozen=True, init=False)
class Torus(CurvedSupport):
    """A ring with a circular tube, touched from outside or, a bent tube, from inside.

    u is the angle about the axis of the ring, and v that about the middle of its tube, rad; v = 0
    farthest from the axis, and v = π/2 along it.

    Args:
        frame: in which it is at rest, or the body whose surface it is.
        radius: of the circle in the middle of the tube, m.
        tube: radius of the tube, m, less than that.
        inside: whether bodies are inside the tube.
        axis: label of the direction along the axis of the ring.
        zero: label of the direction from its axis with u = 0; the next one by default. u grows
            towards the remaining direction.
        at: its centre, from the origin or the body's centre of mass, m.
    """

    radius: Expr
    tube: Expr
    inside: bool
    axis: str
    zero: str

    def __init__(
        self,
        frame: Frame | Body,
        *,
        radius: ExprLike,
        tube: ExprLike,
        inside: bool = False,
        axis: str = "",
        zero: str = "",
        at: Vector | None = None,
        tag: str = "",
        of: Body | None = None,
    ) -> None:
        self._place(frame, at, tag, of)
        frame = self.frame
        label = axis or frame.labels[2]
        direction(frame, label, "axis of a Torus")
        begin = zero or frame.others(label.removeprefix("-"))[0]
        sizes = {"radius": radius, "tube": tube}
        large, small = (
            constant(positive(value, f"{name} of a Torus"), f"{name} of a Torus")
            for name, value in sizes.items()
        )
        if is_positive(small - large):
            raise DeclarationError(
                f"a Torus with radius {large} and tube {small}",
                expected="a tube that is thinner than the ring is wide",
            )
        self._set(radius=large, tube=small, inside=bool(inside), axis=label, zero=begin)
        self._directions()
        if self.of is not None:
            self._require_fixed(self.of, self.base)

    def _directions(self) -> tuple[Vector, Vector, Vector]:
        along = direction(self.frame, self.axis, "axis of a Torus")
        return (along, *towards(self.frame, along, self.zero, "", "a Torus"))

    def is_symmetric_about(self, label: str | None) -> bool:
        own = self.axis.removeprefix("-")
        return label is not None and self.frame.position(label) == self.frame.position(own)

    @property
    def sizes(self) -> Iterator[Size]:
        yield Size("radius of a Torus", self.radius)
        yield Size("tube of a Torus", self.tube)

    @cached_property
    def _outwards(self) -> Frame:
        """The triad from the axis of the ring to the middle of its tube."""
        along, start, other = self._directions()
        sense = -1 if self.inside else 1
        at_zero = triad(self.frame, other, along, start * sense)
        return turned(at_zero, self.uv[0] * sense, "n", at_zero["u"])

    @cached_property
    def axes(self) -> Frame:  # type: ignore[override]
        sense = -1 if self.inside else 1
        return turned(self._outwards, self.uv[1] * sense, "n", self._outwards["v"])

    @cached_property
    def foot(self) -> Vector:
        sense = -1 if self.inside else 1
        middle = self._outwards["n"] * (self.radius * sense)
        return self.up * (self.tube * sense) + middle

"""The torus as a support: a ring to roll on, or a tube to roll in."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import Expr, ExprLike, Vector, is_positive
from polhode.base import DeclarationError
from polhode.model._body import Body
from polhode.model._curved import SurfaceOfRevolution, turned
from polhode.model._declared import Size, constant, positive
from polhode.model._frame import Frame


@dataclass(frozen=True, init=False)
class Torus(SurfaceOfRevolution):
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
        self._set(radius=large, tube=small)
        self._about(inside=inside, axis=label, zero=zero)

    @property
    def sizes(self) -> Iterator[Size]:
        yield Size("radius of a Torus", self.radius)
        yield Size("tube of a Torus", self.tube)

    @cached_property
    def _to_the_middle(self) -> Frame:
        """The triad from the axis of the ring to the middle of its tube."""
        return self._around()

    @property
    def is_convex(self) -> bool:
        return False

    @cached_property
    def axes(self) -> Frame:  # type: ignore[override]
        around = self._to_the_middle
        return turned(around, self.uv[1] * self._outwards, "n", around["v"])

    @cached_property
    def foot(self) -> Vector:
        middle = self._to_the_middle["n"] * (self.radius * self._outwards)
        return self.up * (self.tube * self._outwards) + middle

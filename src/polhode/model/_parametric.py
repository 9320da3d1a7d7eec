"""A surface given point by point, by expressions of two coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import ExprLike, Row, Vector, as_symbol, polar_angle, sqrt
from polhode.base import DeclarationError
from polhode.model._body import Body
from polhode.model._curved import CurvedSupport, along_surface
from polhode.model._frame import Frame


@dataclass(frozen=True, init=False)
class Parametric(CurvedSupport):
    """A smooth surface S(u, v): an ellipsoid, a helicoid, a hyperboloid, a canal.

    The direction u of its triad is that of ∂S/∂u, which must not be along the third direction of
    the frame; the normal is that of ∂S/∂u × ∂S/∂v, and bodies are on its side.

    Args:
        frame: in which it is at rest, or the body whose surface it is.
        place: components of S along the frame, m: expressions of the coordinates called u and v,
            and of parameters.
        inside: whether bodies are on the other side.
        at: the origin of S, from the origin or the body's centre of mass, m.
    """

    place: Row

    def __init__(
        self,
        frame: Frame | Body,
        place: Sequence[ExprLike],
        *,
        inside: bool = False,
        at: Vector | None = None,
        tag: str = "",
        of: Body | None = None,
    ) -> None:
        self._place(frame, at, tag, of)
        if isinstance(place, str) or len(place) != 3:
            raise DeclarationError(
                f"a Parametric surface with the place {place!r}",
                expected="three components, such as (u, v, u*v)",
            )
        own = tuple(along_surface(c, "uv", "a Parametric surface") for c in place)
        self._set(place=own, inside=bool(inside), axis=self.frame.labels[2])
        if self.of is not None:
            self._require_fixed(self.of, self.base)
        self._refuse_degenerate()

    def _refuse_degenerate(self) -> None:
        """Refuse points that fill no surface, or whose triad has no first direction.

        Raises:
            DeclarationError: for those.
        """
        along_u, along_v = (self.foot.diff(as_symbol(q)) for q in self.uv)
        if not any(along_u.cross(along_v).components):
            raise DeclarationError(
                f"a Parametric surface of the points ({', '.join(map(str, self.place))})",
                expected="points that move in two directions with u and v",
            )
        if not any(along_u.components[:2]):
            third = self.frame.labels[2]
            raise DeclarationError(
                f"a Parametric surface whose points move along {third} with u",
                expected=f"a direction of ∂S/∂u that is not along {third}",
                advice="exchange u and v, and inside, which changes with the order of the two",
            )

    @property
    def is_convex(self) -> bool:
        return False

    @cached_property
    def foot(self) -> Vector:
        return self.frame.vector(*(self.renamed(component) for component in self.place))

    @cached_property
    def axes(self) -> Frame:  # type: ignore[override]
        along_u, along_v = (self.foot.diff(as_symbol(q)) for q in self.uv)
        x, y, z = along_u.components
        # the first direction is turned about the third, and lifted, towards ∂S/∂u; the second then
        # turns about it until it is in the tangent plane
        level = self.frame.rotated(polar_angle(x, y), self.frame.labels[2], "u h w")
        lifted = level.rotated(-polar_angle(sqrt(x**2 + y**2), z), "h")
        _, h, w = along_v.express(lifted).components
        side = self._outwards
        return lifted.rotated(polar_angle(h * side, w * side), "u", "u v n", name="contact")

"""Rigid bodies: mass, inertia, axes, and the surface they touch with."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from polhode.algebra import Expr, ExprLike, Matrix, Vector
from polhode.base import DeclarationError
from polhode.model._frame import Frame
from polhode.model._spin import About, Spin, WithAxes
from polhode.model._surface import Rim, Surface

InertiaLike = Sequence[ExprLike] | Sequence[Sequence[ExprLike]]


@dataclass(frozen=True)
class Body:
    """A rigid body.

    Args:
        name: what to call it.
        mass: kg.
        inertia: about the centre of mass along `axes`, kg m²: three principal moments, or the
            full symmetric 3 × 3 matrix.
        axes: the frame that inertia and surface are given along. They may follow the body
            without spinning with it if it is symmetric about the axis it spins on.
        spin: how the body turns relative to its axes; with them by default.
        spin_about: short for `spin=About(axis)`.
        rim: short for a thin circular edge of this radius about the spin axis, m.
        surface: what it touches supports with.
        tag: appended to the names of its coordinates and speeds; tells bodies apart.
    """

    name: str
    mass: Expr
    inertia: Matrix
    axes: Frame
    spin: Spin
    surface: Surface | None
    tag: str

    def __init__(
        self,
        name: str,
        *,
        mass: ExprLike,
        inertia: InertiaLike | Matrix = (0, 0, 0),
        axes: Frame,
        spin: Spin | None = None,
        spin_about: str = "",
        rim: ExprLike | None = None,
        surface: Surface | None = None,
        tag: str = "",
    ) -> None:
        chosen = spin or (About(spin_about) if spin_about else WithAxes())
        if rim is not None:
            surface = Rim(Expr.of(rim), spin_about or _symmetry_axis(chosen, name))
        values: dict[str, Any] = {
            "name": name,
            "mass": Expr.of(mass),
            "inertia": _inertia(name, inertia),
            "axes": axes,
            "spin": chosen,
            "surface": surface,
            "tag": f"_{tag}" if tag else "",
        }
        for field, value in values.items():
            object.__setattr__(self, field, value)
        check_mass(name, self.mass.rational)
        check_inertia(name, [self.inertia[i, i].rational for i in range(3)])

    def __hash__(self) -> int:
        return hash((self.name, self.axes, self.tag))

    @cached_property
    def angular_velocity(self) -> Vector:
        """Angular velocity in inertial space, rad/s."""
        return self.spin.angular_velocity(self.axes, self.tag)

    @property
    def speeds(self) -> tuple[Expr, ...]:
        """Its rotational speeds that are not rates of coordinates."""
        return self.spin.speeds(self.axes, self.tag)

    @property
    def rates(self) -> dict[Expr, Expr]:
        """Rates of its angles in terms of those speeds."""
        return self.spin.rates(self.axes, self.tag)

    @property
    def fixed_axes(self) -> Frame | None:
        """Axes fixed in the body, if its attitude is kept account of."""
        return self.spin.fixed_axes(self.axes, self.tag)

    @property
    def is_isotropic(self) -> bool:
        """Whether all three principal moments are equal, as for a ball."""
        first = self.inertia[0, 0]
        return bool(first) and self.inertia == Matrix.diagonal([first] * 3)

    def point(self, offset: Vector) -> BodyPoint:
        """A point fixed in the body's axes, by its vector from the centre of mass (m)."""
        return BodyPoint(self, offset)


@dataclass(frozen=True)
class BodyPoint:
    """A point of a body, by its vector from the centre of mass (m)."""

    body: Body
    offset: Vector


def _symmetry_axis(spin: Spin, name: str) -> str:
    axis = getattr(spin, "axis", "")
    if not axis:
        raise DeclarationError(
            f"a rim on body {name!r}, which has no spin axis",
            expected="spin_about together with rim",
            advice="say spin_about='3', or give surface=Rim(radius, axis)",
        )
    return str(axis)


def _inertia(name: str, given: InertiaLike | Matrix) -> Matrix:
    if isinstance(given, Matrix):
        return given
    rows = [entry for entry in given if isinstance(entry, Sequence)]
    if len(given) == 3 and not rows:
        return Matrix.diagonal(list(given))
    if len(given) == 3 and [len(row) for row in rows] == [3, 3, 3]:
        matrix = Matrix.of(rows)
        if matrix == matrix.T:
            return matrix
    raise DeclarationError(
        f"inertia {given!r} of body {name!r}",
        expected="three principal moments or a symmetric 3 by 3 matrix, in kg m^2",
    )


def check_mass(name: str, mass: float | Fraction | None) -> None:
    """Refuse a mass that is known and not positive."""
    if mass is not None and mass <= 0:
        raise DeclarationError(
            f"mass {mass} of body {name!r}", expected="a positive mass in kg", advice=""
        )


def check_inertia(name: str, moments: Sequence[float | Fraction | None]) -> None:
    """Refuse principal moments no distribution of mass can have."""
    known = [float(m) for m in moments if m is not None]
    if any(m < 0 for m in known):
        raise DeclarationError(
            f"moments of inertia {known} of body {name!r}", expected="none of them negative"
        )
    if len(known) == 3 and 2 * max(known) > sum(known) * (1 + 1e-12):
        raise DeclarationError(
            f"moments of inertia {known} of body {name!r}",
            expected="each at most the sum of the other two (the triangle inequality)",
            advice="check the moments: no body can have these",
        )

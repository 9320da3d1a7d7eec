"""Rigid bodies: mass, inertia, axes, and the surface that touches supports."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from typing import Any

from polhode.algebra import ONE, ZERO, Expr, ExprLike, Matrix, Row, Vector, dot, variables
from polhode.base import DeclarationError
from polhode.model._declared import (
    Declared,
    constant,
    is_negative,
    is_varying,
    of_type,
    quantity,
)
from polhode.model._frame import Frame
from polhode.model._spin import About, Spin, WithAxes
from polhode.model._surface import Rim, Surface

InertiaLike = Sequence[ExprLike] | Sequence[Sequence[ExprLike]]

#: Relative violation allowed of an inequality that is an equality for thin bodies: rounded moments
#: of a disk break it in their last digits.
ROUNDING = 1e-12


_LINE = 100  # characters of a body's description, beyond which its moments have lines of their own


@dataclass(frozen=True)
class Body(Declared):
    """A rigid body.

    Args:
        name: of the body.
        mass: kg; zero for a massless link, which has no moments of inertia either.
        inertia: about the centre of mass along `axes`, kg m²: three principal moments, or the
            full symmetric 3 × 3 matrix.
        axes: the frame along which inertia and surface are given. They need not spin with a body
            that is symmetric about its axis of spin.
        spin: how the body turns relative to its axes; with them by default.
        spin_about: short for `spin=About(axis)`.
        rim: short for a thin circular edge of this radius about the spin axis, m.
        surface: that touches supports.
        tag: appended to the names of its coordinates and speeds, to distinguish bodies.

    Raises:
        DeclarationError: for a mass or inertia that no body can have, for a body that spins
            relative to its axes about an axis of no symmetry, and for one whose axes turn with the
            angle of its spin.
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
        of_type(axes, Frame, f"axes of body {name!r}", "give the frame of its inertia")
        chosen = spin or (About(spin_about) if spin_about else WithAxes())
        of_type(chosen, Spin, f"spin of body {name!r}", "for spin about axis 3: spin_about='3'")
        if rim is not None:
            radius = quantity(rim, f"rim of body {name!r}")
            surface = Rim(radius, spin_about or _symmetry_axis(chosen, name))
        moments = check_inertia(name, inertia)
        self._set(
            name=name,
            mass=_mass(name, mass, moments),
            inertia=moments,
            axes=axes,
            spin=chosen,
            surface=surface,
            tag=f"_{tag}" if tag else "",
        )
        for axis in chosen.loose(axes):
            self._refuse_asymmetric(axis)
        if chosen.loose(axes):
            self._refuse_second_spin()

    def _refuse_second_spin(self) -> None:
        """Refuse a spin angle that is already an angle of the axes."""
        turning = variables(frame.angle for frame in self.axes.lineage)
        if twice := [str(q) for q in self.rates if q.symbols() & turning]:
            raise DeclarationError(
                f"body {self.name!r}, whose spin angle {', '.join(twice)} already turns its axes",
                expected="a separate angle for the spin relative to the axes",
                advice="use spin=WithAxes() if the axes are fixed in the body; otherwise name "
                "another angle, as in spin=About('3', 'chi')",
            )

    def _refuse_asymmetric(self, axis: str) -> None:
        position = self.axes.position(axis)
        round_ = self.surface is None or self.surface.is_symmetric(self.axes, position)
        if not (round_ and is_symmetric(self.inertia, position)):
            what = "inertia" if round_ else "surface"
            raise DeclarationError(
                f"body {self.name!r}, which spins about {axis} relative to its axes",
                expected=f"its {what} to be symmetric about that axis",
                advice="turn the axes with the body by one more angle, or use spin=Components()",
            )

    def __hash__(self) -> int:
        return hash((self.name, self.axes, self.tag))

    def __repr__(self) -> str:
        return f"Body {self.name!r}: mass {self.mass}, inertia {self._moments} along {self.axes}"

    def __str__(self) -> str:
        moments = self._moments
        if isinstance(moments, Matrix) or len(repr(self)) <= _LINE:
            return repr(self)
        rows = (f"  {moment}" for moment in moments)
        opening = f"Body {self.name!r}: mass {self.mass}, moments of inertia along {self.axes}"
        return "\n".join((opening, *rows))

    @property
    def brief(self) -> str:
        """Its name."""
        return self.name

    @property
    def parts(self) -> Iterator[tuple[str, object]]:
        """Its fields for printing, with principal moments if the axes are principal."""
        yield "mass", self.mass
        yield "inertia", self._moments
        yield "axes", self.axes
        yield "spin", self.spin
        if self.surface is not None:
            yield "surface", self.surface

    @property
    def _moments(self) -> Matrix | tuple[Expr, ...]:
        principal = tuple(self.inertia[i, i] for i in range(3))
        return principal if self.inertia == Matrix.diagonal(principal) else self.inertia

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
        """Axes fixed in the body, if its attitude is described by coordinates."""
        return self.spin.fixed_axes(self.axes, self.tag)

    @property
    def is_massless(self) -> bool:
        """Whether it has neither mass nor inertia: a link that only passes on forces."""
        return self.mass.is_zero

    @property
    def is_isotropic(self) -> bool:
        """Whether all three principal moments are equal, as for a ball."""
        first = self.inertia[0, 0]
        return bool(first) and self.inertia == Matrix.diagonal([first] * 3)

    def keeps(self, vector: Vector) -> bool:
        """Whether a vector is fixed in the body.

        In a body that spins relative to its axes, only vectors along the axis of spin are.
        """
        axes = self.fixed_axes
        parts = vector.components if axes is None else vector.express(axes).components
        moving = any(is_varying(s) for part in parts for s in part.symbols())
        return not moving and (axes is not None or not any(parts))

    def require_direction(self, vector: Vector, what: str) -> None:
        """Refuse a direction that turns relative to the body."""
        if not self.keeps(vector):
            raise DeclarationError(
                f"{what}, ({', '.join(map(str, vector.components))})",
                expected=f"a direction that is fixed in body {self.name!r}",
                advice="take it along axes that turn with the body, or along its axis of spin",
            )

    def point(self, offset: Vector | None = None) -> BodyPoint:
        """The point at this vector from the centre of mass (m); by default the centre of mass."""
        if offset is not None:
            of_type(offset, Vector, f"a point of body {self.name!r}", "give it as axes['z'] * l")
        return BodyPoint(self, self.axes.zero if offset is None else offset)


@dataclass(frozen=True)
class BodyPoint(Declared):
    """A point of a body, by its vector from the centre of mass (m)."""

    body: Body
    offset: Vector

    @property
    def brief(self) -> str:
        """The body and the place."""
        return f"point {self.offset} of {self.body.name}"

    def require_fixed(self, what: str) -> None:
        """Refuse a point that moves through the body.

        On a body that spins relative to its axes, every point off the axis of spin does.
        """
        if self.body.keeps(self.offset):
            return
        moving = {s.published for s in variables(self.offset.components) if is_varying(s)}
        if moving:
            advice = (
                "for a point that slides in the body, let a massless body slide there: trolley = "
                "Body(..., mass=0), Slider(trolley, axis='z', to=body.point()), where the distance "
                "is prescribed Constraint(s - L, on=trolley), and take trolley.point()"
            )
        elif self.body.fixed_axes is None:
            advice = "turn the axes with the body by one more angle, or take a point on its axis"
        else:
            advice = "give it along the axes of the body, such as axes['z'] * l"
        raise DeclarationError(
            f"{what}, ({', '.join(map(str, self.offset.components))}) "
            f"from the centre of body {self.body.name!r}",
            expected="a point that is fixed in the body"
            + (f", not one that moves in it with {', '.join(sorted(moving))}" if moving else ""),
            advice=advice,
        )


def bodies_of(on: Body | Iterable[Body], what: str) -> tuple[Body, ...]:
    """One body or several, as given in an argument `on`."""
    found = tuple(on) if isinstance(on, Iterable) else (on,)
    if not found:
        raise DeclarationError(f"{what} on no body", expected="the bodies on which it acts")
    for body in found:
        of_type(body, Body, f"on= of {what}", "give the body, or several: on=(first, second)")
    return found


@dataclass(frozen=True)
class TwoPointLink:
    """Something drawn between two points: a "spring", a "damper" or a "rope".

    An end is a point of a body, or a place from the origin, m.
    """

    kind: str
    start: BodyPoint | Vector
    end: BodyPoint | Vector


def _symmetry_axis(spin: Spin, name: str) -> str:
    axis = getattr(spin, "axis", "")
    if not axis:
        raise DeclarationError(
            f"a rim on body {name!r}, which has no spin axis",
            expected="spin_about together with rim",
            advice="give spin_about='3', or surface=Rim(radius, axis)",
        )
    return str(axis)


# -- mass and inertia that a body can have ---------------------------------------------------------


def check_mass(name: str, mass: ExprLike) -> Expr:
    """The mass (kg) of a body; it must be positive and constant."""
    what = f"mass of body {name!r}"
    value = constant(quantity(mass, what), what)
    if value.is_zero or is_negative(value):
        raise DeclarationError(
            f"{what}: {value}",
            expected="a positive mass in kg",
            advice="a massless body is declared with mass=0 and without moments of inertia",
        )
    return value


def _mass(name: str, mass: ExprLike, inertia: Matrix) -> Expr:
    """The mass of a body, which may be zero if it has no moments of inertia."""
    value = quantity(mass, f"mass of body {name!r}")
    weightless = value.is_zero and not any(entry for row in inertia.rows for entry in row)
    return value if weightless else check_mass(name, value)


def check_inertia(name: str, given: InertiaLike | Matrix) -> Matrix:
    """The inertia of a body about its centre of mass, kg m².

    The second moments ∫ xᵢxⱼ dm = tr(I)/2 δᵢⱼ - Iᵢⱼ form a positive semidefinite matrix, so no
    principal minor of it is negative. For principal moments this is the triangle inequality.

    Args:
        name: of the body.
        given: three principal moments, or the full symmetric 3 × 3 matrix.

    Raises:
        DeclarationError: for anything else, and for what no distribution of mass can have.
    """
    inertia = _matrix(name, given)
    for row in inertia.rows:
        for entry in row:
            constant(entry, f"inertia of body {name!r}")
    trace = _trace(inertia)
    if any(_falls_short(inertia[i, i], trace) for i in range(3)):
        raise DeclarationError(_moments_of(name, inertia), expected="none of them negative")
    if any(
        _falls_short(minor, trace**size) for size, minor in _minors(second_moments(inertia).rows)
    ):
        raise DeclarationError(
            _moments_of(name, inertia),
            expected="each at most the sum of the other two (the triangle inequality)",
            advice="check the moments: no body can have these",
        )
    return inertia


def is_symmetric(inertia: Matrix, axis: int) -> bool:
    """Whether the inertia is symmetric about this axis."""
    first, second = ((axis + 1) % 3, (axis + 2) % 3)
    mixed = (inertia[first, second], inertia[axis, first], inertia[axis, second])
    return not any(mixed) and inertia[first, first] == inertia[second, second]


def _matrix(name: str, given: InertiaLike | Matrix) -> Matrix:
    if isinstance(given, Matrix):
        given = given.rows
    rows: list[Any] = list(given) if isinstance(given, Iterable) else []
    what = f"inertia of body {name!r}"
    nested = [list(row) for row in rows if isinstance(row, Iterable)]
    if len(rows) == 3 and not nested:
        return Matrix.diagonal([quantity(moment, what) for moment in rows])
    if len(rows) == 3 and [len(row) for row in nested] == [3, 3, 3]:
        matrix = Matrix.of([[quantity(entry, what) for entry in row] for row in nested])
        if matrix == matrix.T:
            return matrix
    raise DeclarationError(
        f"{what}: {given!r}",
        expected="three principal moments or a symmetric 3 by 3 matrix, in kg m^2",
    )


def _trace(matrix: Matrix) -> Expr:
    return sum((matrix[i, i] for i in range(3)), ZERO)


def second_moments(inertia: Matrix) -> Matrix:
    """J = ∫ r r dm = ½ tr(I) 1 - I, kg m²."""
    half = _trace(inertia) / 2
    return Matrix.of(
        [[(half if i == j else ZERO) - inertia[i, j] for j in range(3)] for i in range(3)]
    )


def parallel_axis(mass: Expr, place: Row) -> Matrix:
    """m (r² 1 - r r), kg m²: what the inertia of a body is more about a point at r.

    The parallel-axis theorem; it is also the inertia of a particle.
    """
    squared = dot(place, place)
    return Matrix.of(
        [
            [mass * ((squared if i == j else ZERO) - place[i] * place[j]) for j in range(3)]
            for i in range(3)
        ]
    )


def _minors(rows: Sequence[Sequence[Expr]]) -> Iterator[tuple[int, Expr]]:
    """Principal minors by size."""
    for size in (1, 2, 3):
        for chosen in combinations(range(3), size):
            yield size, _determinant([[rows[i][j] for j in chosen] for i in chosen])


def _determinant(rows: Sequence[Sequence[Expr]]) -> Expr:
    if not rows:
        return ONE
    first, others = rows[0], rows[1:]
    cofactors = (
        _determinant([[*row[:j], *row[j + 1 :]] for row in others]) for j in range(len(rows))
    )
    signed = (entry * (-1) ** j for j, entry in enumerate(first))
    return sum((a * b for a, b in zip(signed, cofactors, strict=True)), ZERO)


def _falls_short(value: Expr, scale: Expr) -> bool:
    """Whether it is below zero, by more than rounding if both are numbers."""
    known, size = value.rational, scale.rational
    if known is None or size is None:
        return is_negative(value)
    return known < -Fraction(ROUNDING) * abs(size)


def _moments_of(name: str, inertia: Matrix) -> str:
    diagonal = [inertia[i, i] for i in range(3)]
    principal = inertia == Matrix.diagonal(diagonal)
    moments = diagonal if principal else [list(row) for row in inertia.rows]
    return f"moments of inertia {moments} of body {name!r}"

"""What bodies look like: from the surface that touches a support, or otherwise from the inertia."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import singledispatch

import numpy as np

from polhode.algebra import Expr
from polhode.model import Block, Body, Ellipsoidal, Face, Rim, Round, Surface
from polhode.view._quantities import Array
from polhode.view._scene import BodyShape, Triple

_THIN = 0.06  # thickness drawn for an infinitely thin body, against its radius
_SLENDER = 0.045  # radius of a rod against its length
_HOLLOW = 0.75  # I/(m a²) above which a round body is a hoop rather than a disk
_FLAT = 0.02  # relative side below which a body counts as a lamina
_LONG = 2.5  # length against width of a lamina that is drawn with a handle
_SAME = 1e-6  # relative difference of moments of inertia that count as equal
_POINT = BodyShape("ball", (0.0,))


@dataclass(frozen=True)
class ShapeSource:
    """What a shape follows from: a live page computes it anew for other numbers.

    Attributes:
        rule: round, ellipsoidal, box, face, rim, outline or inertia.
        numbers: expressions of parameters that the rule needs.
        position: of the axis among those of the body, for rules that have one.
    """

    rule: str
    numbers: tuple[Expr, ...]
    position: int = 2

    def shape(self, values: Sequence[float]) -> BodyShape:
        """The shape for values of the numbers."""
        return _RULES[self.rule](values, self.position)


def source_of(surface: Surface | None, body: Body) -> ShapeSource:
    """What the shape of a body with a surface follows from: its profile, if it has one."""
    profile = surface.profile if surface is not None else None
    if profile is None:
        return _source_of(surface, body)
    outline = tuple(length for point in profile.outline for length in point)
    return ShapeSource("outline", outline, body.axes.position(profile.axis))


@singledispatch
def _source_of(surface: Surface | None, body: Body) -> ShapeSource:
    return ShapeSource("inertia", (body.mass, *body.inertia.entries))


@_source_of.register
def _(surface: Round, body: Body) -> ShapeSource:
    position = body.axes.position(surface.axis) if surface.offset else 2
    return ShapeSource("round", (surface.radius, surface.offset), position)


@_source_of.register
def _(surface: Ellipsoidal, body: Body) -> ShapeSource:
    return ShapeSource("ellipsoidal", (*surface.half_axes, *surface.offset))


@_source_of.register
def _(surface: Block, body: Body) -> ShapeSource:
    return ShapeSource("box", surface.sides, 0)


@_source_of.register
def _(surface: Face, body: Body) -> ShapeSource:
    return ShapeSource("face", (surface.height,))


@_source_of.register
def _(surface: Rim, body: Body) -> ShapeSource:
    position = body.axes.position(surface.axis)
    numbers = (surface.radius, surface.offset, body.mass, body.inertia[position, position])
    return ShapeSource("rim", numbers, position)


# -- rules; a live page has the same in shape_rules.ts -------------------------------------------


def _outline(values: Sequence[float], position: int) -> BodyShape:
    return BodyShape("revolution", tuple(values), *_directions(position))


def _round(values: Sequence[float], position: int) -> BodyShape:
    radius, offset = values
    axis, across = _directions(position)
    x, y, z = (offset * part for part in axis)
    return BodyShape("ball", (radius,), axis, across, (x, y, z))


def _ellipsoidal(values: Sequence[float], position: int) -> BodyShape:
    first, second, third, *centre = values
    return BodyShape("ellipsoid", (first, second, third), centre=_triple(centre))


def _box(values: Sequence[float], position: int) -> BodyShape:
    return BodyShape("box", _triple(values), *_directions(position))


def _face(values: Sequence[float], position: int) -> BodyShape:
    (height,) = values
    return BodyShape("box", (3 * height, 2.4 * height, 2 * height))


def _rim(values: Sequence[float], position: int) -> BodyShape:
    radius, offset, mass, about = values
    kind = "hoop" if about > _HOLLOW * mass * radius**2 else "disk"
    thick = 2 * abs(offset) or _THIN * radius
    return BodyShape(kind, (radius, thick), *_directions(position))


def _equivalent(values: Sequence[float], position: int) -> BodyShape:
    """A uniform body of the same mass and inertia; a point if these were not given."""
    mass, *entries = values
    moments, turned = np.linalg.eigh(np.reshape(entries, (3, 3)))
    if mass <= 0 or moments[-1] <= 0:
        return _POINT
    first, middle, last = moments
    # The moment that differs most from the others goes last: that of the symmetry axis, if any.
    order = [1, 2, 0] if last - middle < middle - first else [0, 1, 2]
    moments, turned = moments[order], turned[:, order]
    directions = _triple(turned[:, 2]), _triple(turned[:, 0])
    if moments[2] <= _SAME * moments[0]:
        length = float(np.sqrt(12 * moments[0] / mass))
        return BodyShape("rod", (length, _SLENDER * length), *directions)
    if abs(moments[0] - moments[1]) <= _SAME * moments[0]:
        return _wheel(mass, moments, directions)
    return _slab(mass, moments, turned)


def _wheel(mass: float, moments: Array, directions: tuple[Triple, Triple]) -> BodyShape:
    """A cylinder, or a wheel with spokes where it has no thickness."""
    across, about = moments[0], moments[2]
    # A uniform cylinder has m r²/2 about its axis and m (3 r² + h²)/12 across it.
    radius = float(np.sqrt(2 * about / mass))
    squared = 12 * across / mass - 3 * radius**2
    if squared > (_FLAT * radius) ** 2:
        return BodyShape("disk", (radius, float(np.sqrt(squared))), *directions)
    rim = float(np.sqrt(about / mass))
    return BodyShape("wheel", (rim, 2 * _THIN * rim), *directions)


def _slab(mass: float, moments: Array, turned: Array) -> BodyShape:
    """A box, or a racquet where it is a long lamina."""
    total = float(np.sum(moments))
    # A uniform box with sides a, b, c has I_a = m (b² + c²)/12 and so on cyclically, so that
    # a² = 6 (I_a + I_b + I_c - 2 I_a)/m.
    squares = np.clip(6 * (total - 2 * moments) / mass, 0, None)
    order = np.argsort(-squares)
    long, wide, thick = (float(side) for side in np.sqrt(squares[order]))
    axis, across = _triple(turned[:, order[0]]), _triple(turned[:, order[1]])
    lamina = thick < _FLAT * long
    if lamina and long > _LONG * wide:
        return BodyShape("racquet", (long, wide, _THIN * wide), axis, across)
    return BodyShape("box", (long, wide, max(thick, _FLAT * long)), axis, across)


_RULES: Mapping[str, Callable[[Sequence[float], int], BodyShape]] = {
    "outline": _outline,
    "round": _round,
    "ellipsoidal": _ellipsoidal,
    "box": _box,
    "face": _face,
    "rim": _rim,
    "inertia": _equivalent,
}


def _directions(position: int) -> tuple[Triple, Triple]:
    """Along an axis, and across it."""
    unit = np.eye(3)
    return _triple(unit[position]), _triple(unit[(position + 1) % 3])


def _triple(values: Sequence[float] | Array) -> Triple:
    x, y, z = (float(value) for value in values)
    return x, y, z

"""Lines in space, of which a figure consists, and the geometry of their points."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import cos, hypot, pi, sin

from polhode.algebra import Expr, Symbol
from polhode.solution._figure import Flat, LineName
from polhode.solution._figure_numbers import Point
from polhode.solution._lines import letter_of

_ARC = 24  # points of an arc
RING = 60
"""Points of a circle."""


@dataclass(frozen=True)
class Shape:
    """A line through points.

    Attributes:
        points: in space.
        style: one of PENS.
        is_arrow: whether it ends in a head.
        is_closed: whether it is an area.
        name: what stands at it.
        at: the point that is named; the last one by default.
        away: the point from which the name stands away; the first one by default.
        beside: whether the name stands at the side of the line.
        aside: pixels by which the line is moved across itself.
        radius: of a dot around its only point, pixels.
    """

    points: tuple[Point, ...]
    style: str
    is_arrow: bool = False
    is_closed: bool = False
    name: LineName | None = None
    at: Point | None = None
    away: Point | None = None
    beside: bool = False
    aside: float = 0.0
    radius: float = 0.0


def name_of(expression: Expr) -> LineName:
    """Of a scalar."""
    return LineName(expression.latex(), expression.pretty().replace(" ", ""))


def axis_name(label: str) -> LineName:
    """Of an axis, by its label."""
    plain = label if label.isdigit() else Expr.generator(Symbol(label)).pretty()
    return LineName(letter_of(label), plain)


def plus(first: Point, second: Point, factor: float = 1.0) -> Point:
    """A point moved along a vector."""
    x, y, z = (a + factor * b for a, b in zip(first, second, strict=True))
    return x, y, z


def scaled(vector: Point, factor: float) -> Point:
    """A vector times a number."""
    x, y, z = vector
    return factor * x, factor * y, factor * z


def unit_vector(vector: Point) -> Point:
    """The direction of a vector; zero for zero."""
    return scaled(vector, 1.0 / (hypot(*vector) or 1.0))


def circle(centre: Point, plane: Sequence[Point], radius: float) -> tuple[Point, ...]:
    """Points around a centre, in the plane of two unit vectors."""
    first, second = plane
    return tuple(
        plus(plus(centre, first, radius * cos(t)), second, radius * sin(t))
        for t in (2 * pi * k / RING for k in range(RING))
    )


def coincide(first: Iterable[float], second: Iterable[float]) -> bool:
    """Whether two points or directions are the same but for rounding."""
    return all(abs(a - b) < 1e-9 for a, b in zip(first, second, strict=True))


def twice_area(first: Flat, second: Flat) -> float:
    """Between two lines: zero where they cover one another."""
    return abs(first[0] * second[1] - first[1] * second[0])


def arc_between(centre: Point, before: Point, after: Point, radius: float) -> tuple[Point, ...]:
    """Between two directions, on the great circle through them."""
    points = []
    for k in range(_ARC + 1):
        share = k / _ARC
        x, y, z = ((1 - share) * a + share * b for a, b in zip(before, after, strict=True))
        points.append(plus(centre, unit_vector((x, y, z)), radius))
    return tuple(points)

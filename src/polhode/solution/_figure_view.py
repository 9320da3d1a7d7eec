"""How a figure is seen: a parallel projection of one generic attitude of the system."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, hypot, radians, sin

from polhode.algebra import PI, Expr, Symbol, Vector
from polhode.derive import Equations
from polhode.model import Body, Contact
from polhode.solution._figure import Flat
from polhode.solution._figure_forces import FigureForces, forces_of
from polhode.solution._figure_numbers import FigureState, Point, frames_of, root_of, up_of

_FIRST = (40.0, 25.0, 60.0, 75.0)  # degrees, for the first rotation
_AZIMUTHS = (32.0, 48.0, 20.0)  # degrees, of the eye
_ELEVATION = 18.0


@dataclass(frozen=True)
class Projection:
    """A parallel projection: two unit vectors in space, to the right and upwards."""

    right: Point
    up: Point

    def flat(self, point: Point) -> Flat:
        """Where a point appears."""
        return _dot(point, self.right), _dot(point, self.up)

    @property
    def towards(self) -> Point:
        """Unit vector towards the eye."""
        return _cross(self.right, self.up)


def _dot(first: Point, second: Point) -> float:
    return sum(a * b for a, b in zip(first, second, strict=True))


_STRAIGHT = {
    0: Projection((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    1: Projection((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    2: Projection((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
}
_UPWARD: Point = (0.0, 0.0, 1.0)


def _straight(axis: int, up: Point) -> Projection:
    """Along an axis of the laboratory, with what is upwards at the top."""
    usual = _STRAIGHT[axis]
    if abs(up[axis]) > 0.5 or _dot(up, usual.up) > 1 - 1e-9:
        return usual
    return Projection(_cross(up, usual.towards), up)


def _oblique(azimuth: float, up: Point = _UPWARD) -> Projection:
    """From somewhat above; the azimuth counts from the axis that follows the upright one."""
    turn, raised = radians(azimuth), radians(_ELEVATION)
    least = min(range(3), key=lambda i: (round(abs(up[i]), 9), i))
    aside: Point = (float(least == 0), float(least == 1), float(least == 2))
    first = _unit(_cross(_cross(up, aside), up))
    second = _cross(up, first)
    right = _combined((-sin(turn), cos(turn)), (first, second))
    ahead = _combined((-cos(turn) * sin(raised), -sin(turn) * sin(raised)), (first, second))
    return Projection(right, _combined((1.0, cos(raised)), (ahead, up)))


def _combined(factors: tuple[float, float], vectors: tuple[Point, Point]) -> Point:
    (a, b), (first, second) = factors, vectors
    x, y, z = (a * p + b * q for p, q in zip(first, second, strict=True))
    return x, y, z


def _cross(first: Point, second: Point) -> Point:
    (a, b, c), (d, e, f) = first, second
    return b * f - c * e, c * d - a * f, a * e - b * d


def _unit(vector: Point) -> Point:
    size = hypot(*vector)
    x, y, z = (c / size for c in vector)
    return x, y, z


@dataclass(frozen=True)
class FigureView:
    """A system at one attitude, seen from one direction.

    Attributes:
        state: its attitude.
        projection: how it is seen.
        forces: at one instant in that attitude; None where they could not be computed.
    """

    state: FigureState
    projection: Projection
    forces: FigureForces | None

    @property
    def equations(self) -> Equations:
        """Of the system."""
        return self.state.equations

    @property
    def values(self) -> dict[Symbol, float]:
        """Angles at generic values, lengths near one, closed loops closed."""
        return self.state.values

    def number(self, expression: Expr) -> float:
        """The value of an expression."""
        return self.state.number(expression)

    def point(self, vector: Vector) -> Point:
        """Components along the laboratory's axes."""
        return self.state.point(vector)

    def centre(self, body: Body) -> Point:
        """Of mass."""
        return self.state.centre(body)

    def flat(self, point: Point) -> Flat:
        """Where a point appears, in units of length to the right and upwards."""
        return self.projection.flat(point)

    @property
    def is_straight(self) -> bool:
        """Whether one looks along an axis of the laboratory."""
        return max(map(abs, self.projection.towards)) > 1 - 1e-9


def views_of(equations: Equations) -> Iterator[FigureView]:
    """The views among which the clearest is taken; a motion in a plane is seen straight on."""
    states = [FigureState(equations, first) for first in _FIRST]
    up = up_of(equations)
    upward = states[0].point(up) if up is not None else _UPWARD
    flat = _plane_of(states[0])
    seen = [_oblique(a, upward) for a in _AZIMUTHS]
    if flat is not None:
        seen = [_straight(flat, upward)]
    for state in states:
        forces = forces_of(state)
        for projection in seen:
            yield FigureView(state, projection, forces)


def _plane_of(view: FigureState) -> int | None:
    """The axis of the laboratory across which everything moves, if there is one."""
    equations = view.equations
    turned = [frame for frame, _ in frames_of(equations) if frame.angle.symbols() - {PI}]
    root = root_of(equations)
    varies = any(s.kind.varies for frame in turned for s in frame.angle.symbols())
    if not varies or any(root.turned):
        return None
    axes = [view.point(Vector(frame.axis, frame)) for frame in turned]
    up = up_of(equations)
    for i in range(3):
        others = [view.centre(body)[i] for body in equations.system.bodies]
        normals = [
            view.point(e.on.up)[i] for e in equations.system.elements if isinstance(e, Contact)
        ]
        if up is not None:
            normals.append(view.point(up)[i])
        lines_up = all(abs(abs(axis[i]) - 1) < 1e-9 for axis in axes)
        if lines_up and max(map(abs, [*others, *normals])) < 1e-9:
            return i
    return None


def length(first: Flat, second: Flat) -> float:
    """Between two points as they appear."""
    return hypot(first[0] - second[0], first[1] - second[1])

"""Closed surfaces as coloured faces, each visible from outside only."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from polhode.view._quantities import Array

#: Colour of all faces of a grid, or of each by its row and column.
Paint = str | Callable[[int, int], str]

_TURNS, _PARTS = 11, 16  # of a coil, and of a turn of it
_WIRE = 0.16  # thickness of its wire against its radius
_WOUND = 0.86  # share of its length that is wound


@dataclass(frozen=True)
class Mesh:
    """Faces of four corners, counter-clockwise as seen from outside.

    Attributes:
        faces: corners, m, shape (faces, 4, 3).
        colours: of the faces.
    """

    faces: Array
    colours: tuple[str, ...]

    def placed(self, turn: Array, place: Array) -> Mesh:
        """Turned by a rotation matrix, then moved."""
        return Mesh(self.faces @ turn.T + place, self.colours)

    def stretched(self, *factors: float) -> Mesh:
        """Made longer along the axes."""
        return Mesh(self.faces * np.array(factors), self.colours)

    @property
    def normals(self) -> Array:
        """Unit vectors out of the faces, shape (faces, 3)."""
        diagonals = self.faces[:, 2] - self.faces[:, 0], self.faces[:, 3] - self.faces[:, 1]
        normal = np.cross(*diagonals)
        size = np.linalg.norm(normal, axis=1, keepdims=True)
        unit: Array = normal / np.where(size > 0, size, 1.0)
        return unit


def together(meshes: Sequence[Mesh]) -> Mesh:
    """Several meshes as one."""
    faces = np.concatenate([mesh.faces for mesh in meshes])
    return Mesh(faces, tuple(colour for mesh in meshes for colour in mesh.colours))


def sphere(paint: Paint, rows: int = 20, columns: int = 32) -> Mesh:
    """The unit sphere; rows from the pole of the third axis."""
    down, round_ = _grid(np.linspace(0, np.pi, rows + 1), np.linspace(0, 2 * np.pi, columns + 1))
    points = [np.sin(down) * np.cos(round_), np.sin(down) * np.sin(round_), np.cos(down)]
    return _of_grid(points, paint)


def tube(radius: float, low: float, high: float, paint: Paint, columns: int = 48) -> Mesh:
    """The side of a cylinder about the third axis, from one height to another."""
    round_, height = _grid(np.linspace(0, 2 * np.pi, columns + 1), np.array([low, high]))
    return _of_grid([radius * np.cos(round_), radius * np.sin(round_), height], paint)


def cap(radius: float, height: float, paint: Paint, rings: Sequence[float] = (0.0, 1.0)) -> Mesh:
    """A level disk in rings, shares of the radius; seen from above where its height is positive."""
    across, round_ = _grid(radius * np.array(rings), np.linspace(0, 2 * np.pi, 49))
    points = [across * np.cos(round_), across * np.sin(round_), 0 * across + height]
    mesh = _of_grid(points, paint)
    return mesh if height >= 0 else Mesh(mesh.faces[:, ::-1], mesh.colours)


def ring(radius: float, thick: float, paint: Paint, columns: int = 48) -> Mesh:
    """A torus about the third axis, its outer radius given."""
    round_, about = _grid(np.linspace(0, 2 * np.pi, columns + 1), np.linspace(0, 2 * np.pi, 11))
    out = radius - thick + thick * np.cos(about)
    return _of_grid([out * np.cos(round_), out * np.sin(round_), thick * np.sin(about)], paint)


def revolution(outline: Array, paint: Paint, columns: int = 48) -> Mesh:
    """An outline of heights and radii, from the top downwards, turned about the third axis."""
    height, round_ = _grid(outline[:, 0], np.linspace(0, 2 * np.pi, columns + 1))
    radius = np.broadcast_to(outline[:, 1:], height.shape)
    return _of_grid([radius * np.cos(round_), radius * np.sin(round_), height], paint)


def box(sides: Sequence[float], colours: Sequence[str]) -> Mesh:
    """A box along the axes; colours of the faces at +1, −1, +2, −2, +3, −3."""
    faces = []
    for i in range(3):
        for sign in (1.0, -1.0):
            corners = np.empty((4, 3))
            j, k = (i + 1) % 3, (i + 2) % 3
            corners[:, i] = sign
            corners[:, j] = np.array([-1, 1, 1, -1])
            corners[:, k] = np.array([-1, -1, 1, 1])
            faces.append(corners if sign > 0 else corners[::-1])
    return Mesh(np.array(faces) * np.array(sides) / 2, tuple(colours))


def rod_between(foot: Array, tip: Array, radius: float, colour: str) -> Mesh:
    """A thin rod from one point to another."""
    along = np.asarray(tip) - np.asarray(foot)
    length = float(np.linalg.norm(along))
    mesh = tube(radius, 0.0, length, colour, 10)
    return mesh.placed(turned_to(along / length), np.asarray(foot))


def coil(foot: Array, tip: Array, radius: float, colour: str) -> Mesh:
    """A wire wound about the line from one point to another.

    In its first and last half turn the radius goes to zero, so that the ends are on the line.
    """
    along = np.asarray(tip) - np.asarray(foot)
    length = float(np.linalg.norm(along))
    count = _TURNS * _PARTS
    i, round_ = _grid(np.arange(count + 1.0), np.linspace(0, 2 * np.pi, 7))
    angle, pitch = 2 * np.pi * i / _PARTS, _WOUND * length / (2 * np.pi * _TURNS)
    out = radius * np.minimum(1, np.minimum(i, count - i) / (_PARTS / 2))
    height = np.clip((1 - _WOUND) / 2 * length + pitch * angle, 0, length)
    height = np.where(i == 0, 0.0, np.where(i == count, length, height))
    # The tube's cross-section is spanned by the normal n and the binormal b of the helix.
    slope = float(np.hypot(radius, pitch)) or 1.0
    n, b = _WIRE * radius * np.cos(round_), _WIRE * radius * np.sin(round_)
    cosine, sine = np.cos(angle), np.sin(angle)
    x = out * cosine + n * cosine + b * sine * pitch / slope
    y = out * sine + n * sine - b * cosine * pitch / slope
    mesh = _of_grid([x, y, height + b * radius / slope], colour)
    return mesh.placed(turned_to(along / length) if length else np.eye(3), np.asarray(foot))


def turned_to(direction: Array) -> Array:
    """A rotation matrix that takes the third axis to a unit vector."""
    guess = np.eye(3)[int(np.argmin(np.abs(direction)))]  # least parallel to it
    first = np.cross(guess, direction)
    first = first / np.linalg.norm(first)
    return np.stack([first, np.cross(direction, first), direction], axis=1)


def _grid(rows: Array, columns: Array) -> tuple[Array, Array]:
    first, second = np.meshgrid(rows, columns, indexing="ij")
    return first, second


def _of_grid(points: Sequence[Array], paint: Paint) -> Mesh:
    p = np.stack(points, axis=-1)
    corners = np.stack([p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]], axis=2)
    rows, columns = corners.shape[:2]
    places = product(range(rows), range(columns))
    colours = tuple(paint if isinstance(paint, str) else paint(i, j) for i, j in places)
    return Mesh(corners.reshape(-1, 4, 3), colours)

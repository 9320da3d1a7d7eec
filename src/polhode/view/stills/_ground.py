"""Supports: planes, turntables, sheets and a faint floor as outlines, curved ones as meshes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from polhode.base import colour, colours
from polhode.view._quantities import Array
from polhode.view._scene import Scene, Support
from polhode.view.stills._camera import place_at, turn_at
from polhode.view.stills._mesh import Mesh, turned_to

# flat, where pages have light and shadow
GROUND, LINES = (colours("stills")[name] for name in ("floor", "grid"))
PAPER, STRONG, ACCENT = colour("paper"), colour("grid-strong"), colours("materials")["accent"]
_ROUND = np.linspace(0, 2 * np.pi, 97)
_MOST = 24  # lines to either side of the middle


@dataclass(frozen=True)
class Ground:
    """A flat surface at an instant.

    Attributes:
        outline: corners, m, shape (n, 3).
        colour: of the surface.
        lines: pieces of lines on it, each of shape (n, 3), m.
        marks: filled outlines on it, m.
        place: a point of it, m.
        normal: unit vector out of it.
    """

    outline: Array
    colour: str
    lines: tuple[Array, ...]
    marks: tuple[Array, ...]
    place: Array
    normal: Array


def grounds_of(scene: Scene, frame: float, radius: float, middle: Array) -> list[Ground]:
    """All surfaces of a scene at a frame; a boundless one reaches `radius` about `middle`."""
    sheets = [support for support in scene.supports if support.kind == "sheet"]
    # A sheet lies on a plane that does not move.
    found = [_boundless(sheet, 0.0, radius, middle) for sheet in sheets[:1]]
    for support in scene.supports:
        turn, place = turn_at(support.pose, frame), place_at(support.pose, frame)
        if support.kind == "turntable":
            found.append(_turntable(turn, place, support.reach[0]))
        elif support.kind == "sheet":
            found.append(_sheet(turn, place, support))
        elif support.kind != "curved":
            found.append(_boundless(support, frame, radius, middle))
    if scene.floor is not None:
        up = np.array(scene.up)
        under = middle + up * (scene.floor - middle @ up)
        found.append(_plane(turned_to(up), under, radius, under))
    return found


def shells(scene: Scene, frame: float) -> Iterator[Mesh]:
    """The curved supports of a scene at a frame, seen from the side of the bodies only."""
    for support in scene.supports:
        if support.kind == "curved":
            p = support.points
            corners = (p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:])
            faces = np.stack(corners, axis=2).reshape(-1, 4, 3)
            shell = Mesh(faces, (GROUND,) * len(faces))
            yield shell.placed(turn_at(support.pose, frame), place_at(support.pose, frame))


def _boundless(support: Support, frame: float, radius: float, middle: Array) -> Ground:
    turn, place = turn_at(support.pose, frame), place_at(support.pose, frame)
    below = middle - turn[:, 2] * float((middle - place) @ turn[:, 2])
    return _plane(turn, place, radius, below)


def _plane(turn: Array, place: Array, radius: float, middle: Array) -> Ground:
    centre = (middle - place) @ turn
    outline = centre[:2, None] + radius * np.array([np.cos(_ROUND), np.sin(_ROUND)])
    step = spacing(radius / 6)
    lines = []
    for i in (0, 1):
        first, last = np.ceil((centre[i] - radius) / step), np.floor((centre[i] + radius) / step)
        for k in np.arange(first, last + 1):
            half = np.sqrt(max(radius**2 - (k * step - centre[i]) ** 2, 0.0))
            line = np.full((2, 2), k * step)
            line[1 - i] = centre[1 - i] + half * np.array([-1, 1])
            lines.append(line)
    return _lifted(outline, GROUND, lines, [], turn, place)


def _turntable(turn: Array, place: Array, radius: float) -> Ground:
    circle = np.array([np.cos(_ROUND), np.sin(_ROUND)])
    spokes = [
        radius * np.array([[0, np.cos(angle)], [0, np.sin(angle)]])
        for angle in np.arange(12) * np.pi / 6
    ]
    rings = [radius * share * circle for share in (0.25, 0.5, 0.75, 1.0)]
    arc = np.linspace(-0.06, 0.06, 9)
    edge = np.array([np.cos(arc), np.sin(arc)])
    mark = radius * np.concatenate([edge, 0.9 * edge[:, ::-1]], axis=1)
    return _lifted(radius * circle, PAPER, [*spokes, *rings], [mark], turn, place)


def _sheet(turn: Array, place: Array, support: Support) -> Ground:
    (x, y), (a, b) = support.middle, support.reach
    corners = np.array([[x - a, x + a, x + a, x - a, x - a], [y - b, y - b, y + b, y + b, y - b]])
    step = spacing(max(a, b) / 8)
    lines = [corners]
    for k in np.arange(np.ceil((x - a) / step), np.floor((x + a) / step) + 1):
        lines.append(np.array([[k * step, k * step], [y - b, y + b]]))
    for k in np.arange(np.ceil((y - b) / step), np.floor((y + b) / step) + 1):
        lines.append(np.array([[x - a, x + a], [k * step, k * step]]))
    return _lifted(corners, PAPER, lines, [], turn, place)


def _lifted(
    outline: Array, colour: str, lines: list[Array], marks: list[Array], turn: Array, place: Array
) -> Ground:
    """Out of the plane into space."""

    def lift(flat: Array) -> Array:
        found: Array = place + flat.T @ turn[:, :2].T
        return found

    lifted = tuple(lift(line) for line in lines)
    return Ground(lift(outline), colour, lifted, tuple(map(lift, marks)), place, turn[:, 2])


def spacing(size: float) -> float:
    """1, 2 or 5 times a power of ten near a length."""
    power = 10.0 ** np.floor(np.log10(size))
    return float(next((s * power for s in (5, 2, 1) if s * power <= size), power))

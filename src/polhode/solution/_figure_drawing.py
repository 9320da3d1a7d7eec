"""A labelled figure of a system, drawn from its declaration.

The picture is a parallel projection at one generic attitude: supports, bodies, the axes of the
laboratory and of the body, angles as arcs, lengths, the vector to the point where a force acts, and
the forces. A motion in a plane is seen straight on.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations
from math import cos, hypot, pi, sin

from polhode.solution._figure import Figure, Flat, Stroke
from polhode.solution._figure_letters import Tag, placed
from polhode.solution._figure_lines import Shape
from polhode.solution._figure_shapes import corner_axes, shapes_of
from polhode.solution._figure_view import FigureView, views_of
from polhode.solution._setting import Setting

_WIDE, _LARGEST, _SCALE = 560.0, 420.0, 96.0  # pixels
_MARGIN = 34.0
_CAPTION = "Axes, angles and forces {when}; lengths are not to scale."


def figure_of(setting: Setting, *, has_arm: bool = False) -> Figure:
    """The clearest figure of a system, with or without **a**, the arm of its only force."""
    views = views_of(setting.equations)
    drawn = [(view, tuple(shapes_of(view, setting, has_arm))) for view in views]
    view, shapes = max(drawn, key=lambda pair: _clearness(*pair))
    paper = _Paper(view, shapes)
    axes = tuple(corner_axes(view))
    strokes = [*paper.strokes(shapes, (0.0, 0.0)), *paper.strokes(axes, paper.corner)]
    tags = [*paper.tags(shapes, (0.0, 0.0)), *paper.tags(axes, paper.corner)]
    title = f"{setting.equations.system.name}: axes, angles and forces"
    letters = placed(tags, strokes, paper.size)
    caption = _CAPTION.format(when=_when(view))
    return Figure(title, caption, paper.size, tuple(strokes), letters)


def _when(view: FigureView) -> str:
    """The instant of which the forces are, which then are to one scale."""
    if view.forces is None or not any(map(any, view.forces.reactions.values())):
        return "at some instant"
    starts = view.forces.starts
    return "where the motion starts from rest" if starts else "at an instant of a motion"


def _clearness(view: FigureView, shapes: Iterable[Shape]) -> float:
    """How far apart what is named appears, at the least and on the whole."""
    points = {view.flat(s.at or s.points[-1]) for s in shapes if s.name is not None}
    gaps = [hypot(a[0] - b[0], a[1] - b[1]) for a, b in combinations(points, 2)]
    return min(gaps, default=0.0) + 0.2 * sum(min(gap, 0.6) for gap in gaps) / (len(gaps) or 1)


class _Paper:
    """Where points of space appear in pixels: the axes of the laboratory on the left."""

    def __init__(self, view: FigureView, shapes: Sequence[Shape]) -> None:
        self.view = view
        flat = [view.flat(p) for s in shapes for p in s.points]
        left, right = min(x for x, _ in flat), max(x for x, _ in flat)
        low, high = min(y for _, y in flat), max(y for _, y in flat)
        self.axes = [view.flat(p) for s in corner_axes(view) for p in s.points]
        beside = max(x for x, _ in self.axes) - min(x for x, _ in self.axes) + 0.35
        tallest = max(y for _, y in self.axes) - min(y for _, y in self.axes)
        high = max(high, low + 1.2 * tallest)
        wide, tall = right - left + beside, high - low
        self.scale = min((_WIDE - 2 * _MARGIN) / wide, (_LARGEST - 2 * _MARGIN) / tall, _SCALE)
        self.size = (_WIDE, round(tall * self.scale + 2 * _MARGIN))
        self.left = left - beside - ((_WIDE - 2 * _MARGIN) / self.scale - wide) / 2
        self.high = high
        self.corner = (
            left - 0.35 - max(x for x, _ in self.axes),
            low + 0.1 * tall - min(y for _, y in self.axes),
        )

    def pixel(self, point: Flat, shift: Flat) -> Flat:
        """Where a projected point appears."""
        x = _MARGIN + (point[0] + shift[0] - self.left) * self.scale
        y = _MARGIN + (self.high - point[1] - shift[1]) * self.scale
        return round(x, 1), round(y, 1)

    def strokes(self, shapes: Iterable[Shape], shift: Flat) -> list[Stroke]:
        """Lines."""
        found = []
        for shape in shapes:
            points = [self.pixel(self.view.flat(p), shift) for p in shape.points]
            if shape.radius:
                points = [_on_circle(points[0], shape.radius, k) for k in range(16)]
            if shape.aside:
                points = _aside(points, shape.aside)
            if points:
                style = shape.style
                found.append(Stroke(tuple(points), style, shape.is_arrow, shape.is_closed))
        return found

    def tags(self, shapes: Iterable[Shape], shift: Flat) -> list[Tag]:
        """Names that need a place."""
        return [self._tag(shape, shift) for shape in shapes if shape.name is not None]

    def _tag(self, shape: Shape, shift: Flat) -> Tag:
        assert shape.name is not None
        at = self.pixel(self.view.flat(shape.at or shape.points[-1]), shift)
        start = self.pixel(self.view.flat(shape.away or shape.points[0]), shift)
        away = (at[0] - start[0], at[1] - start[1])
        if shape.beside:
            away = (away[1], -away[0])
            # lengths at the right of a line, everything else at the left of it
            left = away[0] <= 0
            away = away if left != (shape.style == "length") else (-away[0], -away[1])
        if shape.away is not None and len(shape.points) == 1:  # a direction, not a point
            flat = self.view.flat(shape.away)
            away = (flat[0], -flat[1])
        return Tag(shape.name, shape.style, at, away)


def _on_circle(centre: Flat, radius: float, k: int) -> Flat:
    angle = 2 * pi * k / 16
    x, y = centre[0] + radius * cos(angle), centre[1] + radius * sin(angle)
    return round(x, 1), round(y, 1)


def _aside(points: Sequence[Flat], pixels: float) -> list[Flat]:
    (a, b), (c, d) = points[0], points[-1]
    size = hypot(c - a, d - b) or 1.0
    across = (pixels * (b - d) / size, pixels * (c - a) / size)
    return [(round(x + across[0], 1), round(y + across[1], 1)) for x, y in points]

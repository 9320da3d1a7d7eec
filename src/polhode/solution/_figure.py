"""A labelled figure of a system, drawn from its declaration as SVG.

The picture is a parallel projection at one generic attitude: the support, the body, the axes of the
laboratory and of the body, the angles as arcs, the vector to the point where a force acts, and the
forces.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from html import escape
from itertools import combinations, product
from math import cos, hypot, pi, radians, sin

from polhode.algebra import PI, Expr, Symbol, SymbolKind, Vector, compile_program
from polhode.algebra import cos as exact_cos
from polhode.model import Contact, Element, Frame, Rim, Round, Smooth
from polhode.solution._setting import Setting

Point = tuple[float, float, float]
Flat = tuple[float, float]

_WIDE, _TALL, _UNIT = 560, 400, 92.0  # pixels
_AZIMUTH, _ELEVATION = radians(32), radians(18)
_FIRST = (40.0, 25.0, 60.0, 80.0, 100.0, 120.0)  # degrees, for the first rotation
_ANGLES = (58.0, 35.0, 25.0, 20.0)  # for the others
_LETTERS = {"theta": 58.0, "alpha": 24.0}
_ARC_POINTS = 24


@dataclass(frozen=True)
class _View:
    """Numbers for every symbol, and the projection."""

    setting: Setting

    angle: float

    @cached_property
    def values(self) -> dict[Symbol, float]:
        """Angles at generic values, lengths one, everything that moves at rest."""
        degrees = (self.angle, *_ANGLES)
        found = dict(zip(_angles_of(self.setting), map(radians, degrees), strict=False))
        for symbol in found:
            if symbol.name in _LETTERS:
                found[symbol] = radians(_LETTERS[symbol.name])
        return found

    @property
    def clearness(self) -> float:
        """How far apart the ends of the body's axes and the origin appear, at the least."""
        axes = self.setting.axes
        ends = [(0.0, 0.0), *(self.flat(self.point(axes[label])) for label in axes.labels)]
        return min(hypot(a[0] - b[0], a[1] - b[1]) for a, b in combinations(ends, 2))

    def number(self, expression: Expr) -> float:
        """The value of an expression."""
        known = (s for s in expression.symbols() if s != PI)
        symbols = sorted(known, key=lambda s: s.published)
        values = [self.values.get(s, self._default(s)) for s in symbols]
        function = compile_program([expression], tuple(symbols)).function()
        return float(function(*values)[0])

    def _default(self, symbol: Symbol) -> float:
        return 1.0 if symbol.kind is SymbolKind.PARAMETER else 0.0

    def point(self, vector: Vector) -> Point:
        """Components along the laboratory's axes, the vertical last."""
        x, y, z = (self.number(c) for c in vector.express(self.setting.axes.root).components)
        return x, y, z

    @staticmethod
    def flat(point: Point) -> Flat:
        """Where a point appears, in units of length to the right and upwards."""
        x, y, z = point
        right = -x * sin(_AZIMUTH) + y * cos(_AZIMUTH)
        depth = x * cos(_AZIMUTH) + y * sin(_AZIMUTH)
        return right, z * cos(_ELEVATION) - depth * sin(_ELEVATION)


def _angles_of(setting: Setting) -> tuple[Symbol, ...]:
    turned = (f for f in reversed(setting.axes.lineage) if f.parent is not None)
    every = [s for frame in turned for s in sorted(frame.angle.symbols(), key=str) if s != PI]
    return tuple(dict.fromkeys(every))


@dataclass(frozen=True)
class _Shape:
    """A line through points, with an arrow head or a letter at its end.

    Attributes:
        points: in space.
        style: class of the element.
        letter: at the end, set apart from it.
        is_arrow: whether it ends in a head.
        is_closed: whether it is an area.
    """

    points: tuple[Point, ...]
    style: str
    letter: str = ""
    is_arrow: bool = False
    is_closed: bool = False


def figure_of(setting: Setting) -> str:
    """The figure as an SVG element; empty for several bodies."""
    if not setting.is_single:
        return ""
    view = max((_View(setting, first) for first in _FIRST), key=lambda v: v.clearness)
    shapes = [*_support(view), *_body(view), *_axes(view), *_angles(view), *_forces(view)]
    flat = [(shape, [view.flat(p) for p in shape.points]) for shape in shapes]
    every = [p for _, points in flat for p in points]
    left, right = min(x for x, _ in every), max(x for x, _ in every)
    low, high = min(y for _, y in every), max(y for _, y in every)
    scale = min((_WIDE - 80) / (right - left), (_TALL - 70) / (high - low), 1.6 * _UNIT)
    middle = ((left + right) / 2, (low + high) / 2)

    def place(p: Flat) -> Flat:
        return (
            round(_WIDE / 2 + (p[0] - middle[0]) * scale, 1),
            round(_TALL / 2 - (p[1] - middle[1]) * scale, 1),
        )

    placed = [(shape, [place(p) for p in points]) for shape, points in flat]
    drawn = [_line(shape, points) for shape, points in placed]
    drawn += [_letter(shape, points) for shape, points in placed if shape.letter]
    title = f"<title>{escape(setting.equations.system.name)}: axes, angles and forces</title>"
    frame = f'viewBox="0 0 {_WIDE} {_TALL}" width="{_WIDE}"'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="polhode-system" {frame} '
        f'height="{_TALL}" role="img"><style>{_STYLE}</style>{title}{_MARKER}{"".join(drawn)}</svg>'
    )


_RULES = {
    "path": "fill:none;stroke:currentColor;stroke-width:1.3",
    # The stroke, in the colour of the page, keeps letters apart from the lines that they meet.
    "text": "font:italic 17px serif;fill:currentColor;stroke:Canvas;stroke-width:3;"
    "stroke-linejoin:round;paint-order:stroke;text-anchor:middle;dominant-baseline:middle",
    "path.support": "fill:#8882;stroke:#8886",
    "path.body": "fill:#6a8fc455;stroke-width:1.6",
    "path.fixed": "stroke:#888",
    "path.dashed": "stroke:#888;stroke-dasharray:4 3",
    "path.angle": "stroke:#a52",
    "path.force": "stroke:#b3261e;stroke-width:2",
    "path.arm": "stroke:#1b7f3b;stroke-width:1.6",
    "text.force": "fill:#b3261e;font-weight:bold",
    "text.angle": "fill:#a52",
    "text.arm": "fill:#1b7f3b;font-weight:bold",
    "text.fixed": "fill:#888",
    "text.axis": "font-style:normal;font-weight:bold",
}
# Every rule is confined to this figure: a style within a page or notebook applies to all of it.
_STYLE = "".join(f".polhode-system {select}{{{rule}}}" for select, rule in _RULES.items())
_MARKER = (
    '<defs><marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" '
    'orient="auto"><path d="M0 0.8L8 4L0 7.2Z" style="fill:context-stroke;stroke:none"/></marker>'
    "</defs>"
)


def _line(shape: _Shape, points: list[Flat]) -> str:
    if shape.style.endswith("letter"):
        return ""
    path = "M" + "L".join(f"{x:g} {y:g}" for x, y in points) + ("Z" if shape.is_closed else "")
    head = ' marker-end="url(#head)"' if shape.is_arrow else ""
    return f'<path class="{shape.style}" d="{path}"{head}/>'


def _letter(shape: _Shape, points: list[Flat]) -> str:
    x, y = _beside(shape, points)
    return f'<text class="{shape.style}" x="{x:g}" y="{y:g}">{escape(shape.letter)}</text>'


def _beside(shape: _Shape, points: list[Flat]) -> Flat:
    """Where a letter stands: beyond the end of a line, outside the middle of an arc."""
    if len(points) > 2:  # an arc around its first point
        centre, middle = points[0], points[len(points) // 2]
        dx, dy = middle[0] - centre[0], middle[1] - centre[1]
    else:
        middle = points[-1]
        dx, dy = middle[0] - points[0][0], middle[1] - points[0][1]
    if shape.style == "arm letter":  # beside the arrow
        dx, dy = -dy, dx
    size = hypot(dx, dy) or 1.0
    return round(middle[0] + 13 * dx / size, 1), round(middle[1] + 13 * dy / size, 1)


# -- geometry --------------------------------------------------------------------------------------


def _sum(first: Point, second: Point, factor: float = 1.0) -> Point:
    x, y, z = (a + factor * b for a, b in zip(first, second, strict=True))
    return x, y, z


def _centre(view: _View) -> Point:
    return view.point(view.setting.equations.kinetics.places[view.setting.body])


def _ring(centre: Point, plane: Sequence[Point], radius: float) -> tuple[Point, ...]:
    first, second = plane
    return tuple(
        _sum(_sum(centre, first, radius * cos(t)), second, radius * sin(t))
        for t in (2 * pi * k / 48 for k in range(48))
    )


def _support(view: _View) -> Iterator[_Shape]:
    for contact in view.setting.contacts:
        first, second = (view.point(contact.on.axes[label]) for label in contact.on.tangents)
        touching = _sum(_centre(view), view.point(contact.arm))
        corners = ((1.7, 1.7), (1.7, -1.7), (-1.7, -1.7), (-1.7, 1.7))
        points = tuple(_sum(_sum(touching, first, p), second, q) for p, q in corners)
        yield _Shape(points, "support", is_closed=True)


def _body(view: _View) -> Iterator[_Shape]:
    setting, centre = view.setting, _centre(view)
    surface = setting.body.surface
    match surface:
        case Rim(radius=radius, axis=axis):
            others = [view.point(setting.axes[label]) for label in setting.axes.others(axis)]
            yield _Shape(_ring(centre, others, view.number(radius)), "body", is_closed=True)
        case Round(radius=radius):
            right = (-sin(_AZIMUTH), cos(_AZIMUTH), 0.0)
            up = (
                -sin(_ELEVATION) * cos(_AZIMUTH),
                -sin(_ELEVATION) * sin(_AZIMUTH),
                cos(_ELEVATION),
            )
            yield _Shape(_ring(centre, (right, up), view.number(radius)), "body", is_closed=True)
        case _:
            yield from _rotor(view, centre)


def _rotor(view: _View, centre: Point) -> Iterator[_Shape]:
    """A body without a surface: a ring about its axis of symmetry, and the rod to its support."""
    setting = view.setting
    moments = [setting.body.inertia[i, i] for i in range(3)]
    odd = next((i for i in range(3) if moments.count(moments[i]) == 1), 2)
    if any(moments):
        axes = setting.axes
        others = [view.point(axes[label]) for label in axes.others(axes.labels[odd])]
        yield _Shape(_ring(centre, others, 0.5), "body", is_closed=True)
    for element in setting.forced:
        place = _sum(centre, view.point(setting.arm(element)))
        yield _Shape((place, centre), "body")


def _axes(view: _View) -> Iterator[_Shape]:
    setting = view.setting
    root, centre = setting.axes.root, _centre(view)
    corner = _sum(centre, (0.3, -2.1, -0.6)) if setting.contacts else (0.0, 0.0, 0.0)
    same = setting.axes == root
    for label in root.labels:
        style = "axis" if same else "fixed"
        start = centre if same else corner
        yield _arrow(start, view.point(root[label]), 1.25 if same else 0.8, style, label)
    if not same and setting.along == setting.axes:
        for label in setting.axes.labels:
            yield _arrow(centre, view.point(setting.axes[label]), 1.45, "axis", label)


def _arrow(start: Point, along: Point, length: float, style: str, label: str) -> _Shape:
    letter = Expr.generator(Symbol(label)).pretty() if not label.isdigit() else label
    return _Shape((start, _sum(start, along, length)), style, letter, is_arrow=True)


def _angles(view: _View) -> Iterator[_Shape]:
    """An arc for every angle, between two directions whose scalar product is its cosine."""
    centre = _centre(view)
    varying = set(_angles_of(view.setting))
    steps = [f for f in reversed(view.setting.axes.lineage) if f.angle.symbols() & varying]
    for i, frame in enumerate(steps):
        for angle in sorted(frame.angle.symbols() & varying, key=str):
            pair = _between(view, frame, Expr.generator(angle))
            if pair is None:
                continue
            before, after = pair
            arc = _arc(centre, before, after, 0.62 + 0.2 * i)
            yield _Shape((centre, _sum(centre, before, 1.1)), "dashed")
            yield _Shape(arc, "angle")
            letter = Expr.generator(angle).pretty()
            yield _Shape((centre, arc[len(arc) // 2]), "angle letter", letter)


def _between(view: _View, frame: Frame, angle: Expr) -> tuple[Point, Point] | None:
    """A direction of the parent and one of the frame with this angle between them.

    Preferred are those that end as an axis of the body and begin at the vertical.
    """
    parent = frame.parent
    if parent is None:
        return None
    axes = view.setting.axes
    final = [view.point(axes[label]) for label in axes.labels]
    pairs = [
        (view.point(before), view.point(after))
        for before, after in product(parent.directions, frame.directions)
        if before.dot(after) == exact_cos(angle)
    ]

    def preference(pair: tuple[Point, Point]) -> tuple[bool, bool]:
        return any(_close(pair[1], axis) for axis in final), abs(pair[0][2]) > 0.99

    return max(pairs, key=preference, default=None)


def _close(first: Iterable[float], second: Iterable[float]) -> bool:
    return all(abs(a - b) < 1e-9 for a, b in zip(first, second, strict=True))


def _arc(centre: Point, before: Point, after: Point, radius: float) -> tuple[Point, ...]:
    """Between two directions, on the great circle through them."""
    points = []
    for k in range(_ARC_POINTS + 1):
        share = k / _ARC_POINTS
        x, y, z = ((1 - share) * a + share * b for a, b in zip(before, after, strict=True))
        size = hypot(x, y, z) or 1.0
        points.append(_sum(centre, (x / size, y / size, z / size), radius))
    return tuple(points)


def _forces(view: _View) -> Iterator[_Shape]:
    setting, centre = view.setting, _centre(view)
    if setting.gravity is not None and setting.up is not None:
        down = view.point(-setting.up)
        weight = (setting.mass * setting.gravity.g).pretty().replace(" ", "")
        arms = [view.flat(view.point(setting.arm(element))) for element in setting.forced]
        covered = any(_apart(arm, view.flat(down)) < 0.1 < hypot(*arm) for arm in arms)
        length = 0.4 if covered else 0.7
        yield _Shape((centre, _sum(centre, down, length)), "force", weight, is_arrow=True)
    for element in setting.forced:
        arm = view.point(setting.arm(element))
        place = _sum(centre, arm)
        if any(arm):
            yield _Shape((centre, place), "arm", "", is_arrow=True)
            middle = _sum(centre, arm, 0.7)
            yield _Shape((centre, middle), "arm letter", "a")
        push = _direction(view, element)
        letter = "F" if len(setting.forced) == 1 else f"F {element.name}"
        yield _Shape((place, _sum(place, push)), "force", letter, is_arrow=True)


def _direction(view: _View, element: Element) -> Point:
    """Along the normal without friction, and otherwise somewhat aside, as it is not known."""
    if not isinstance(element, Contact):
        return (0.2, -0.45, 0.8)
    up = view.point(element.on.up)
    if isinstance(element, Smooth):
        return _sum((0.0, 0.0, 0.0), up, 0.85)
    first, second = (view.point(element.on.axes[label]) for label in element.on.tangents)
    arm = view.flat(view.point(view.setting.arm(element)))
    raised = _sum((0.0, 0.0, 0.0), up, 0.8)
    tilted = [_sum(raised, aside, 0.4 * sign) for aside in (first, second) for sign in (1, -1)]
    return max(tilted, key=lambda push: _apart(view.flat(push), arm))


def _apart(first: Flat, second: Flat) -> float:
    """Twice the area between two lines: zero where they cover one another."""
    return abs(first[0] * second[1] - first[1] * second[0])

"""What a figure shows of bodies, of what they touch and of what holds them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import cos, hypot, sin

from polhode.algebra import Vector, as_symbol
from polhode.model import (
    Body,
    BodyPoint,
    Contact,
    CurvedSupport,
    Pivot,
    Rim,
    Round,
    Sheet,
    Turntable,
)
from polhode.solution._figure import Flat, LineName
from polhode.solution._figure_lines import RING, Shape, circle, name_of, plus, scaled
from polhode.solution._figure_numbers import Point
from polhode.solution._figure_view import FigureView

_ASKEW = 0.25  # rad, by which a sheet has been turned
_CURVED = 1.1  # of a curved surface, to either side of the contact
_STEPS = [k / 12 for k in range(-12, 13)]
_HALF_WIDTH = 0.13  # of a flywheel

# -- supports --------------------------------------------------------------------------------------


def supports(view: FigureView) -> Iterator[Shape]:
    """Walls, planes and turntables that bodies touch."""
    contacts = view.equations.system.contacts
    by_support: dict[object, list[Point]] = {}
    for contact in contacts:
        by_support.setdefault(contact.on, []).append(_touching(view, contact))
    for contact in {c.on: c for c in contacts}.values():
        if isinstance(contact.on, CurvedSupport):
            yield from _curved(view, contact.on)
            continue
        places = by_support[contact.on]
        middle = scaled(_total(places), 1.0 / len(places))
        first, second = (view.point(contact.on.axes[label]) for label in contact.on.tangents)
        if view.is_straight:
            line = _across(view, view.point(contact.on.up), middle, 1.7)
            yield Shape(line, "wall")
            continue
        reach = 1.6 + max(hypot(*plus(p, middle, -1.0)) for p in places)
        if isinstance(contact.on, Turntable):
            yield Shape(circle(middle, (first, second), reach), "support", is_closed=True)
            continue
        yield Shape(_square(middle, first, second, reach), "support", is_closed=True)
        if isinstance(contact.on, Sheet):
            yield _paper(middle, first, second, 0.75 * reach)


def _curved(view: FigureView, support: CurvedSupport) -> Iterator[Shape]:
    """The part of a curved surface about the point of contact: lines along u and v."""
    place = support.foot.express(support.frame)
    u, v = support.uv
    spans = [_CURVED / hypot(*view.point(place.diff(as_symbol(q)))) for q in (u, v)]

    moved = view.state.moved(place, (as_symbol(u), as_symbol(v)))

    def line(q: int, aside: float) -> tuple[Point, ...]:
        """Along one of the coordinates, with the other one changed."""
        along = [k * spans[q] for k in _STEPS]
        return tuple(moved(aside, step) if q else moved(step, aside) for step in along)

    across, along = line(0, 0.0), line(1, 0.0)
    if view.is_straight:
        yield Shape(max(across, along, key=lambda points: _width(view, points)), "wall")
        return
    edges = [
        line(0, -spans[1]),
        line(1, spans[0]),
        line(0, spans[1])[::-1],
        line(1, -spans[0])[::-1],
    ]
    yield Shape(tuple(point for edge in edges for point in edge), "support", is_closed=True)
    yield Shape(across, "dashed")
    yield Shape(along, "dashed")


def _width(view: FigureView, points: Sequence[Point]) -> float:
    """Distance between the ends of a line, as drawn."""
    (x, y), (u, v) = view.flat(points[0]), view.flat(points[-1])
    return hypot(u - x, v - y)


def _square(middle: Point, first: Point, second: Point, half: float) -> tuple[Point, ...]:
    corners = ((1, 1), (1, -1), (-1, -1), (-1, 1))
    return tuple(plus(plus(middle, first, p * half), second, q * half) for p, q in corners)


def _paper(middle: Point, first: Point, second: Point, half: float) -> Shape:
    """A sheet, turned on the table that it lies on."""
    turned = plus(scaled(first, cos(_ASKEW)), second, sin(_ASKEW))
    across = plus(scaled(second, cos(_ASKEW)), first, -sin(_ASKEW))
    return Shape(_square(middle, turned, across, half), "paper", is_closed=True)


def _total(points: Iterable[Point]) -> Point:
    found = (0.0, 0.0, 0.0)
    for point in points:
        found = plus(found, point)
    return found


def _across(view: FigureView, normal: Point, place: Point, half: float) -> tuple[Point, Point]:
    """A line in the picture's plane, perpendicular to a normal within it."""
    x, y = view.flat(normal)
    right, up = view.projection.right, view.projection.up
    line = plus(scaled(right, -y), up, x)
    return plus(place, line, half), plus(place, line, -half)


def _touching(view: FigureView, contact: Contact) -> Point:
    return plus(view.centre(contact.body), view.point(contact.arm))


def turntables(view: FigureView) -> Iterator[Shape]:
    """An arrow around the normal of what turns."""
    for element in view.equations.system.elements:
        if isinstance(element, Contact) and isinstance(element.on, Turntable):
            support = element.on
            first, second = (view.point(support.axes[label]) for label in support.tangents)
            middle = _touching(view, element)
            name = name_of(support.Omega)
            yield _turn_arrow(middle, (first, second), 1.35, name)


def _turn_arrow(centre: Point, plane: tuple[Point, Point], radius: float, name: LineName) -> Shape:
    """A part of a circle with a head, in front of the rest."""
    ring = circle(centre, plane, radius)
    lowest = RING // 12
    points = ring[lowest : lowest + RING // 5]
    middle = points[len(points) // 2]
    return Shape(points, "turn", True, name=name, at=middle, away=centre)


def held_points(view: FigureView) -> Iterator[Shape]:
    """A pin where a point of a body is held, a wall where it is guided, a joint in between."""
    for element in view.equations.system.elements:
        if not isinstance(element, Pivot):
            continue
        place = plus(view.centre(element.body), view.point(element.at))
        is_free = set(element.only) != set(element.along.labels)
        if is_free and view.is_straight and isinstance(element.to, Vector):
            for label in element.only:
                normal = view.point(element.along[label])
                if hypot(*view.flat(normal)) > 0.5:
                    yield Shape(_across(view, normal, place, 0.55), "wall")
        elif not is_free and any(view.point(element.at)):
            yield Shape((place,), "pin", is_closed=True, radius=3.5)


# -- bodies ----------------------------------------------------------------------------------------


def drawn_body(view: FigureView, body: Body) -> Iterator[Shape]:
    """The outline of a body, and its centre of mass."""
    centre = view.centre(body)
    match body.surface:
        case Rim(radius=radius, axis=axis, offset=offset):
            others = [view.point(body.axes[label]) for label in body.axes.others(axis)]
            middle = plus(centre, view.point(body.axes[axis]), view.number(offset))
            yield Shape(circle(middle, others, view.number(radius)), "body", is_closed=True)
        case Round(radius=radius, axis=axis, offset=offset):
            middle = plus(centre, view.point(body.axes[axis]), view.number(offset))
            plane = (view.projection.right, view.projection.up)
            yield Shape(circle(middle, plane, view.number(radius)), "body", is_closed=True)
            if offset:
                yield from _unsurfaced(view, body, centre)
        case _:
            yield from _unsurfaced(view, body, centre)
    if body.surface is not None and body.surface.touches:
        yield from _spokes(view, body, centre)
    if body.inertia.is_zero and body.mass:
        yield Shape((centre,), "dot", is_closed=True, radius=5.0)
    elif any(hypot(*arm) > 0.1 for arm in _ends(view, body)):
        yield Shape((centre,), "dot", is_closed=True, radius=2.2)


def _spokes(view: FigureView, body: Body, centre: Point) -> Iterator[Shape]:
    """Rods from the middle of a round body to the points at which it is held."""
    for element in view.equations.system.elements:
        if isinstance(element, Pivot) and element.body == body and not element.at.is_zero:
            yield Shape((plus(centre, view.point(element.at)), centre), "rod")


def _ends(view: FigureView, body: Body) -> list[Point]:
    """Where a body is held or touches, and where it holds others, from its centre of mass."""
    own = [view.point(r.arm) for r in view.equations.reactions.values() if r.body == body]
    centre = view.centre(body)
    for element in view.equations.system.elements:
        if isinstance(element, Pivot) and body in element.bodies and element.body != body:
            place = plus(view.centre(element.body), view.point(element.at))
            own.append(plus(place, centre, -1.0))
    return own


def _unsurfaced(view: FigureView, body: Body, centre: Point) -> Iterator[Shape]:
    """A rod, a rotor about its axis of symmetry, or a block, and rods to where it is held."""
    moments = [body.inertia[i, i] for i in range(3)]
    ends = [end for end in _ends(view, body) if hypot(*end) > 1e-6]
    for end in ends:
        yield Shape((plus(centre, end), centre), "rod")
    if not any(moments):
        return
    axes = [view.point(d) for d in body.axes.directions]
    odd = next((i for i in range(3) if moments.count(moments[i]) == 1), None)
    if odd is not None and not moments[odd]:
        half = max((hypot(*end) for end in ends), default=1.0)
        yield Shape((plus(centre, axes[odd], half), plus(centre, axes[odd], -half)), "rod")
    elif odd is not None and not view.is_straight and len(set(moments)) == 2:
        others = [axis for i, axis in enumerate(axes) if i != odd]
        yield from _flywheel(view, centre, axes[odd], others)
    else:
        yield from _block(view, centre, axes, ends)


def _flywheel(
    view: FigureView, centre: Point, axis: Point, others: Sequence[Point]
) -> Iterator[Shape]:
    """A short cylinder about an axis: its outline, and the face that is seen."""
    facing = sum(a * b for a, b in zip(axis, view.projection.towards, strict=True))
    near = _HALF_WIDTH if facing > 0 else -_HALF_WIDTH
    front, back = (circle(plus(centre, axis, side), others, 0.55) for side in (near, -near))
    yield Shape(_outline(view, (*front, *back)), "body", is_closed=True)
    yield Shape(front, "body", is_closed=True)


def _outline(view: FigureView, points: Sequence[Point]) -> tuple[Point, ...]:
    """Those of some points, not all on a line as they appear, that enclose all.

    Chains of left turns, from left to right below the others and back above them (Andrew 1979).
    """
    flat = {view.flat(point): point for point in points}
    places = sorted(flat)
    corners: list[Point] = []
    for side in (places, places[::-1]):
        chain: list[tuple[float, float]] = []
        for x, y in side:
            while len(chain) > 1 and not _turns_left(chain[-2], chain[-1], (x, y)):
                chain.pop()
            chain.append((x, y))
        corners += [flat[place] for place in chain[:-1]]
    return tuple(corners)


def _turns_left(a: Sequence[float], b: Sequence[float], c: Sequence[float]) -> bool:
    return (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])


def _block(
    view: FigureView, centre: Point, axes: Sequence[Point], ends: Sequence[Point]
) -> Iterator[Shape]:
    """The faces of a block that are seen, longest towards where it is held."""
    halves = [0.42, 0.62, 0.16]
    for end in ends[:1]:
        size = hypot(*end)
        along = [abs(sum(a * b for a, b in zip(axis, end, strict=True))) / size for axis in axes]
        longest = along.index(max(along))
        halves = [0.24, 0.24, 0.24]
        halves[longest] = max(0.5, min(1.15 * size, 1.3))
    towards = view.projection.towards
    for i, axis in enumerate(axes):
        facing = sum(a * b for a, b in zip(axis, towards, strict=True))
        if abs(facing) < 1e-6:
            continue
        sign = 1.0 if facing > 0 else -1.0
        middle = plus(centre, axis, sign * halves[i])
        j, k = (i + 1) % 3, (i + 2) % 3
        corners = ((1, 1), (1, -1), (-1, -1), (-1, 1))
        points = tuple(
            plus(plus(middle, axes[j], p * halves[j]), axes[k], q * halves[k]) for p, q in corners
        )
        yield Shape(points, "body", is_closed=True)


def drawn_links(view: FigureView) -> Iterator[Shape]:
    """Springs as zigzag lines, dampers and ropes as straight ones."""
    system = view.equations.system
    links = [link for element in system.elements for link in element.links]
    links += [load.link for load in system.loads if load.link is not None]
    for link in links:
        start, end = place_of(view, link.start), place_of(view, link.end)
        if link.kind != "spring":
            yield Shape((start, end), "axis")
            continue
        x, y = _plane_unit(view.flat(plus(end, start, -1.0)))
        across = plus(scaled(view.projection.right, -y), view.projection.up, x)
        along = [(0.0, 0.0), (0.2, 0.0)]
        along += [(0.2 + 0.6 * (k + 0.5) / 10, 0.08 * (-1) ** k) for k in range(10)]
        along += [(0.8, 0.0), (1.0, 0.0)]
        line = plus(end, start, -1.0)
        points = tuple(plus(plus(start, line, part), across, aside) for part, aside in along)
        yield Shape(points, "axis")


def place_of(view: FigureView, point: BodyPoint | Vector) -> Point:
    """Where a point of a body, or of the ground, is."""
    if isinstance(point, Vector):
        return view.point(point)
    return plus(view.centre(point.body), view.point(point.offset))


def _plane_unit(vector: Flat) -> Flat:
    size = hypot(*vector) or 1.0
    return vector[0] / size, vector[1] / size

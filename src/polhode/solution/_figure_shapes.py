"""What a figure shows, as lines in space: supports, bodies, axes, angles, forces, lengths."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from math import cos, hypot, pi, sin

from polhode.algebra import PI, Expr, Symbol, Vector
from polhode.algebra import cos as exact_cos
from polhode.model import (
    Body,
    BodyPoint,
    Constraint,
    Contact,
    Element,
    Frame,
    Gravity,
    Hold,
    KnifeEdge,
    Pivot,
    Rim,
    Round,
    Smooth,
    Turntable,
)
from polhode.solution._figure import Flat, LineName
from polhode.solution._figure_view import FigureView, Point, frames_of, root_of, up_of
from polhode.solution._lines import letter_of
from polhode.solution._setting import Setting

_ARC = 24  # points of an arc
_RING = 60  # points of a circle
_AXIS, _CORNER_AXIS, _FORCE, _WEIGHT = 1.45, 0.55, 0.95, 0.7


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


def shapes_of(view: FigureView, setting: Setting) -> Iterator[Shape]:
    """Everything but the axes of the laboratory, what is behind first."""
    yield from _supports(view)
    for body in view.equations.system.bodies:
        yield from _body(view, body)
    yield from _links(view)
    yield from _axes(view, setting)
    yield from _angles(view)
    yield from _lengths(view, setting)
    yield from _forces(view, setting)
    yield from _turntables(view)
    yield from _held(view)


def corner_axes(view: FigureView) -> Iterator[Shape]:
    """The axes of the laboratory, from an origin of their own."""
    root = root_of(view.equations)
    for label in root.labels:
        along = view.point(root[label])
        if hypot(*view.flat(along)) > 0.1:
            end = _scaled(along, _CORNER_AXIS)
            yield Shape(((0.0, 0.0, 0.0), end), "fixed", True, name=_axis_name(label))
        else:
            yield from _end_on(view, along, label)
    if any(root.turned):
        turned = view.point(Vector(root.turned, root))
        end = _scaled(turned, 1.5 * _CORNER_AXIS / (hypot(*turned) or 1.0))
        omega = LineName(r"\boldsymbol{\Omega}", "Ω")
        yield Shape(((0.0, 0.0, 0.0), end), "turn", True, name=omega)
        yield from _latitude(view, end)


def _latitude(view: FigureView, end: Point) -> Iterator[Shape]:
    """The angle from an axis of the laboratory to that of the Earth."""
    root = root_of(view.equations)
    for label, rate in zip(root.labels, root.turned, strict=True):
        for symbol in rate.symbols():
            angle, origin = Expr.generator(symbol), (0.0, 0.0, 0.0)
            if rate and (rate / exact_cos(angle)).symbols() < rate.symbols():
                arc = _arc(origin, view.point(root[label]), _unit(end), 0.7 * _CORNER_AXIS)
                middle = arc[len(arc) // 2]
                yield Shape(arc, "angle", name=name_of(angle), at=middle, away=origin)
                return


def _end_on(view: FigureView, along: Point, label: str) -> Iterator[Shape]:
    """An axis along which one looks: a dot where it comes towards the eye, otherwise a cross."""
    origin = (0.0, 0.0, 0.0)
    nearer = sum(a * b for a, b in zip(along, view.projection.towards, strict=True)) > 0
    right, up = view.projection.right, view.projection.up
    away = _sum(right, up)
    named = _axis_name(label)
    yield Shape((origin,), "fixed", is_closed=True, radius=5.0, name=named, away=away)
    if nearer:
        yield Shape((origin,), "fixed", is_closed=True, radius=1.2)
        return
    for second in (up, _scaled(up, -1.0)):
        line = _scaled(_sum(right, second), 0.032)
        yield Shape((_scaled(line, -1.0), line), "fixed")


def name_of(expression: Expr) -> LineName:
    """Of a scalar."""
    return LineName(expression.latex(), expression.pretty().replace(" ", ""))


def _axis_name(label: str) -> LineName:
    plain = label if label.isdigit() else Expr.generator(Symbol(label)).pretty()
    return LineName(letter_of(label), plain)


# -- geometry --------------------------------------------------------------------------------------


def _sum(first: Point, second: Point, factor: float = 1.0) -> Point:
    x, y, z = (a + factor * b for a, b in zip(first, second, strict=True))
    return x, y, z


def _scaled(vector: Point, factor: float) -> Point:
    x, y, z = vector
    return factor * x, factor * y, factor * z


def _unit(vector: Point) -> Point:
    return _scaled(vector, 1.0 / (hypot(*vector) or 1.0))


def _ring(centre: Point, plane: Sequence[Point], radius: float) -> tuple[Point, ...]:
    first, second = plane
    return tuple(
        _sum(_sum(centre, first, radius * cos(t)), second, radius * sin(t))
        for t in (2 * pi * k / _RING for k in range(_RING))
    )


def _close(first: Iterable[float], second: Iterable[float]) -> bool:
    return all(abs(a - b) < 1e-9 for a, b in zip(first, second, strict=True))


def _twice_area(first: Flat, second: Flat) -> float:
    """Between two lines: zero where they cover one another."""
    return abs(first[0] * second[1] - first[1] * second[0])


# -- supports --------------------------------------------------------------------------------------


def _supports(view: FigureView) -> Iterator[Shape]:
    contacts = [e for e in view.equations.system.elements if isinstance(e, Contact)]
    by_support: dict[object, list[Point]] = {}
    for contact in contacts:
        by_support.setdefault(contact.on, []).append(_touching(view, contact))
    for contact in {c.on: c for c in contacts}.values():
        places = by_support[contact.on]
        middle = _scaled(_total(places), 1.0 / len(places))
        first, second = (view.point(contact.on.axes[label]) for label in contact.on.tangents)
        if view.is_straight:
            line = _across(view, view.point(contact.on.up), middle, 1.7)
            yield Shape(line, "wall")
            continue
        reach = 1.6 + max(hypot(*_sum(p, middle, -1.0)) for p in places)
        if isinstance(contact.on, Turntable):
            yield Shape(_ring(middle, (first, second), reach), "support", is_closed=True)
            continue
        corners = ((1, 1), (1, -1), (-1, -1), (-1, 1))
        points = tuple(_sum(_sum(middle, first, p * reach), second, q * reach) for p, q in corners)
        yield Shape(points, "support", is_closed=True)


def _total(points: Iterable[Point]) -> Point:
    found = (0.0, 0.0, 0.0)
    for point in points:
        found = _sum(found, point)
    return found


def _across(view: FigureView, normal: Point, place: Point, half: float) -> tuple[Point, Point]:
    """A line in the picture's plane, perpendicular to a normal within it."""
    x, y = view.flat(normal)
    right, up = view.projection.right, view.projection.up
    line = _sum(_scaled(right, -y), up, x)
    return _sum(place, line, half), _sum(place, line, -half)


def _touching(view: FigureView, contact: Contact) -> Point:
    return _sum(view.centre(contact.body), view.point(contact.arm))


def _turntables(view: FigureView) -> Iterator[Shape]:
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
    ring = _ring(centre, plane, radius)
    lowest = _RING // 12
    points = ring[lowest : lowest + _RING // 5]
    middle = points[len(points) // 2]
    return Shape(points, "turn", True, name=name, at=middle, away=centre)


def _held(view: FigureView) -> Iterator[Shape]:
    """A pin where a point of a body is held, a wall where it is guided, a joint in between."""
    for element in view.equations.system.elements:
        if not isinstance(element, Pivot):
            continue
        place = _sum(view.centre(element.body), view.point(element.at))
        is_free = set(element.only) != set(element.along.labels)
        if is_free and view.is_straight and isinstance(element.to, Vector):
            for label in element.only:
                normal = view.point(element.along[label])
                if hypot(*view.flat(normal)) > 0.5:
                    yield Shape(_across(view, normal, place, 0.55), "wall")
        elif not is_free and any(view.point(element.at)):
            yield Shape((place,), "pin", is_closed=True, radius=3.5)


# -- bodies ----------------------------------------------------------------------------------------


def _body(view: FigureView, body: Body) -> Iterator[Shape]:
    centre = view.centre(body)
    match body.surface:
        case Rim(radius=radius, axis=axis, offset=offset):
            others = [view.point(body.axes[label]) for label in body.axes.others(axis)]
            middle = _sum(centre, view.point(body.axes[axis]), view.number(offset))
            yield Shape(_ring(middle, others, view.number(radius)), "body", is_closed=True)
        case Round(radius=radius, axis=axis, offset=offset):
            middle = _sum(centre, view.point(body.axes[axis]), view.number(offset))
            plane = (view.projection.right, view.projection.up)
            yield Shape(_ring(middle, plane, view.number(radius)), "body", is_closed=True)
            if offset:
                yield from _unsurfaced(view, body, centre)
        case _:
            yield from _unsurfaced(view, body, centre)
    if not _has_size(body) and body.mass:
        yield Shape((centre,), "dot", is_closed=True, radius=5.0)
    elif any(hypot(*arm) > 0.1 for arm in _ends(view, body)):
        yield Shape((centre,), "dot", is_closed=True, radius=2.2)


def _has_size(body: Body) -> bool:
    return any(any(row) for row in body.inertia.rows)


def _ends(view: FigureView, body: Body) -> list[Point]:
    """Where a body is held or touches, and where it holds others, from its centre of mass."""
    own = [view.point(r.arm) for r in view.equations.reactions.values() if r.body == body]
    centre = view.centre(body)
    for element in view.equations.system.elements:
        if isinstance(element, Pivot) and body in element.bodies and element.body != body:
            place = _sum(view.centre(element.body), view.point(element.at))
            own.append(_sum(place, centre, -1.0))
    return own


def _unsurfaced(view: FigureView, body: Body, centre: Point) -> Iterator[Shape]:
    """A rod, a rotor about its axis of symmetry, or a block, and rods to where it is held."""
    moments = [body.inertia[i, i] for i in range(3)]
    ends = [end for end in _ends(view, body) if hypot(*end) > 1e-6]
    for end in ends:
        yield Shape((_sum(centre, end), centre), "rod")
    if not any(moments):
        return
    axes = [view.point(d) for d in body.axes.directions]
    odd = next((i for i in range(3) if moments.count(moments[i]) == 1), None)
    if odd is not None and not moments[odd]:
        half = max((hypot(*end) for end in ends), default=1.0)
        yield Shape((_sum(centre, axes[odd], half), _sum(centre, axes[odd], -half)), "rod")
    elif odd is not None and not view.is_straight and len(set(moments)) == 2:
        others = [axis for i, axis in enumerate(axes) if i != odd]
        yield Shape(_ring(centre, others, 0.55), "body", is_closed=True)
    else:
        yield from _block(view, centre, axes, ends)


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
        middle = _sum(centre, axis, sign * halves[i])
        j, k = (i + 1) % 3, (i + 2) % 3
        corners = ((1, 1), (1, -1), (-1, -1), (-1, 1))
        points = tuple(
            _sum(_sum(middle, axes[j], p * halves[j]), axes[k], q * halves[k]) for p, q in corners
        )
        yield Shape(points, "body", is_closed=True)


def _links(view: FigureView) -> Iterator[Shape]:
    """Springs as zigzag lines, dampers and ropes as straight ones."""
    system = view.equations.system
    links = [link for element in system.elements for link in element.links]
    links += [load.link for load in system.loads if load.link is not None]
    for link in links:
        start, end = _place(view, link.start), _place(view, link.end)
        if link.kind != "spring":
            yield Shape((start, end), "axis")
            continue
        x, y = _plane_unit(view.flat(_sum(end, start, -1.0)))
        across = _sum(_scaled(view.projection.right, -y), view.projection.up, x)
        along = [(0.0, 0.0), (0.2, 0.0)]
        along += [(0.2 + 0.6 * (k + 0.5) / 10, 0.08 * (-1) ** k) for k in range(10)]
        along += [(0.8, 0.0), (1.0, 0.0)]
        line = _sum(end, start, -1.0)
        points = tuple(_sum(_sum(start, line, part), across, aside) for part, aside in along)
        yield Shape(points, "axis")


def _place(view: FigureView, point: BodyPoint | Vector) -> Point:
    if isinstance(point, Vector):
        return view.point(point)
    return _sum(view.centre(point.body), view.point(point.offset))


def _plane_unit(vector: Flat) -> Flat:
    size = hypot(*vector) or 1.0
    return vector[0] / size, vector[1] / size


# -- axes and angles -------------------------------------------------------------------------------


def _axes(view: FigureView, setting: Setting) -> Iterator[Shape]:
    """The axes of the bodies that have letters of their own."""
    root = root_of(view.equations)
    seen = set[tuple[str, ...]]()
    for body in view.equations.system.bodies:
        axes = body.axes
        if axes == root or axes.labels in seen or set(axes.labels) & set(root.labels):
            continue
        if setting.is_single and setting.along != axes:
            continue
        seen.add(axes.labels)
        centre = view.centre(body)
        for label in axes.labels:
            along = view.point(axes[label])
            if hypot(*view.flat(along)) > 0.1:
                line = (centre, _sum(centre, along, _AXIS))
                yield Shape(line, "axis", True, name=_axis_name(label))


def _angles(view: FigureView) -> Iterator[Shape]:
    """An arc for every angle, between two directions whose scalar product is its cosine."""
    root = root_of(view.equations)
    named = {label: view.point(root[label]) for label in root.labels}
    radii: dict[Point, int] = {}
    for frame, body in frames_of(view.equations):
        angle = _letter_of_angle(frame)
        pair = angle and between(view, frame, angle)
        if not angle or not pair:
            continue
        before, after = pair
        centre = view.centre(body)
        shown = [view.point(body.axes[label]) for label in body.axes.labels]
        radius = 0.6 + 0.22 * radii.get(centre, 0)
        radii[centre] = radii.get(centre, 0) + 1
        for direction in (before, after):
            if any(_close(direction, axis) for axis in shown) and direction is after:
                continue
            label = next((k for k, axis in named.items() if _close(axis, direction)), "")
            name = _axis_name(label) if label else None
            yield Shape((centre, _sum(centre, direction, radius + 0.5)), "dashed", name=name)
        arc = _arc(centre, before, after, radius)
        middle = arc[len(arc) // 2]
        yield Shape(arc, "angle", name=name_of(angle), at=middle, away=centre)


def _letter_of_angle(frame: Frame) -> Expr | None:
    """The letter of a rotation's angle, or the angle where it has several letters."""
    letters = [s for s in frame.angle.symbols() if s != PI]
    if not letters:
        return None
    return Expr.generator(letters[0]) if len(letters) == 1 else frame.angle


def between(view: FigureView, frame: Frame, angle: Expr) -> tuple[Point, Point] | None:
    """A direction of the parent and one of the frame with this angle between them.

    Preferred are those that end as an axis of a body and begin at the vertical, and that the
    picture shows well apart.
    """
    parent = frame.parent
    if parent is None:
        return None
    final = [view.point(d) for body in view.equations.system.bodies for d in body.axes.directions]
    up = up_of(view.equations)
    vertical = view.point(up) if up is not None else (0.0, 0.0, 1.0)
    pairs = [
        (view.point(before), view.point(after))
        for before, after in product(parent.directions, frame.directions)
        if before.dot(after) == exact_cos(angle)
    ]

    def preference(pair: tuple[Point, Point]) -> tuple[bool, bool, float]:
        before, after = pair
        apart = _twice_area(view.flat(before), view.flat(after))
        is_final = any(_close(after, axis) for axis in final)
        return is_final, _close(before, vertical), apart

    return max(pairs, key=preference, default=None)


def _arc(centre: Point, before: Point, after: Point, radius: float) -> tuple[Point, ...]:
    """Between two directions, on the great circle through them."""
    points = []
    for k in range(_ARC + 1):
        share = k / _ARC
        x, y, z = ((1 - share) * a + share * b for a, b in zip(before, after, strict=True))
        points.append(_sum(centre, _unit((x, y, z)), radius))
    return tuple(points)


# -- lengths and forces ----------------------------------------------------------------------------


def _lengths(view: FigureView, setting: Setting) -> Iterator[Shape]:
    """Radii, and distances from centres of mass to where bodies are held."""
    named = {LineName("a", "a")} if setting.is_single and len(setting.forced) == 1 else set()
    for body in view.equations.system.bodies:
        centre = view.centre(body)
        for element in view.equations.system.elements:
            if isinstance(element, Pivot) and element.body == body:
                name = _length_of(element.at)
                if name is not None and name not in named:
                    named.add(name)
                    line = (centre, _sum(centre, view.point(element.at)))
                    yield _dimension(line, name)
        if isinstance(body.surface, Rim | Round):
            name = name_of(body.surface.radius)
            if name in named:
                continue
            named.add(name)
            yield _radius(view, body, body.surface, centre, name)


def _length_of(vector: Vector) -> LineName | None:
    """The length of a vector along one of its axes, if it has a letter."""
    present = [c for c in vector.components if c]
    if len(present) != 1 or not present[0].symbols():
        return None
    value = -present[0] if present[0].latex().startswith("-") else present[0]
    return name_of(value) if len(value.latex()) < 12 else None


def _dimension(line: tuple[Point, Point], name: LineName) -> Shape:
    middle = _scaled(_sum(*line), 0.5)
    return Shape((), "length", name=name, at=middle, away=line[0], beside=True)


def _radius(
    view: FigureView, body: Body, surface: Rim | Round, centre: Point, name: LineName
) -> Shape:
    axis = view.point(body.axes[surface.axis])
    middle = _sum(centre, axis, view.number(surface.offset))
    if isinstance(surface, Rim):
        plane = [view.point(body.axes[label]) for label in body.axes.others(surface.axis)]
        ring = _ring(middle, plane, view.number(surface.radius))
    else:
        plane = [view.projection.right, view.projection.up]
        ring = _ring(middle, plane, view.number(surface.radius))
    aim = (0.94, -0.34)  # to the right, where little else is

    def along(point: Point) -> float:
        x, y = view.flat(_sum(point, middle, -1.0))
        return x * aim[0] + y * aim[1]

    end = max(ring, key=along)
    half = _scaled(_sum(middle, end), 0.5)
    return Shape((middle, end), "length", True, name=name, at=half, away=middle, beside=True)


def _forces(view: FigureView, setting: Setting) -> Iterator[Shape]:
    forced = [r for r in view.equations.reactions.values() if not r.force.is_zero]
    arms = {r.name: view.point(r.arm) for r in forced}
    yield from _weights(view, arms)
    elements = {e.name: e for e in view.equations.system.elements}
    for reaction in forced:
        if isinstance(elements[reaction.name], Constraint):  # a generalized force, at no point
            continue
        centre, arm = view.centre(reaction.body), arms[reaction.name]
        place = _sum(centre, arm)
        if setting.is_single and len(forced) == 1 and hypot(*arm) > 1e-6:
            upright = hypot(view.flat(arm)[0], 0.0) < 0.05
            half = _sum(centre, arm, 0.5)
            yield Shape(
                (centre, place),
                "arm",
                True,
                name=LineName(r"\mathbf{a}", "a"),
                at=half,
                away=centre,
                beside=True,
                aside=4.0 if upright else 0.0,
            )
        element = elements[reaction.name]
        push = direction(view, element, arm)
        if isinstance(element, Contact):
            yield Shape((place,), "dot", is_closed=True, radius=2.6)
        yield Shape((place, _sum(place, push)), "force", True, name=_force_name(setting, element))


def _force_name(setting: Setting, element: Element) -> LineName:
    if len(setting.forced) == 1:
        return LineName(r"\mathbf{F}", "F")
    letters = [getattr(e, "force", "F") for e in setting.forced]
    letter = getattr(element, "force", "F")
    if not setting.is_single and letters.count(letter) == 1:
        return LineName(rf"\mathbf{{{letter}}}", letter)
    low = element.name.replace(" ", r"\ ")
    return LineName(rf"\mathbf{{F}}_{{\mathrm{{{low}}}}}", "F", element.name)


def _weights(view: FigureView, arms: dict[str, Point]) -> Iterator[Shape]:
    up = up_of(view.equations)
    if up is None:
        return
    down = _scaled(view.point(up), -1.0)
    (g,) = (load.g for load in view.equations.system.loads if isinstance(load, Gravity))
    for body in view.equations.system.bodies:
        if not body.mass:
            continue
        covered = any(_twice_area(view.flat(a), view.flat(down)) < 0.1 for a in arms.values())
        lower = any(a[2] < -0.1 for a in arms.values())
        centre = view.centre(body)
        length = 0.5 if covered and lower else _WEIGHT
        line = (centre, _sum(centre, down, length))
        yield Shape(line, "force", True, name=name_of(body.mass * g), beside=covered)


def direction(view: FigureView, element: Element, arm: Point) -> Point:
    """Along what holds, towards the body; somewhat aside where the direction is not known."""
    if isinstance(element, KnifeEdge):
        return _scaled(view.point(element.body.axes[element.across]), _FORCE)
    if isinstance(element, Smooth):
        return _scaled(view.point(element.on.up), _FORCE)
    if isinstance(element, Contact):
        up = _scaled(view.point(element.on.up), 0.85)
        tangents = [view.point(element.on.axes[label]) for label in element.on.tangents]
        if view.is_straight:
            tangents = [t for t in tangents if hypot(*view.flat(t)) > 0.5]
        tilted = [_sum(up, aside, 0.45 * sign) for aside in tangents for sign in (1.0, -1.0)]
        return max(tilted, key=lambda push: _twice_area(view.flat(push), view.flat(arm)))
    if isinstance(element, Pivot | Hold) and set(element.only) != set(element.along.labels):
        return _guided(view, element, arm)
    right, up = view.projection.right, view.projection.up
    sides = [_sum(_scaled(up, 0.8), right, 0.5 * sign) for sign in (1.0, -1.0)]
    return max(sides, key=lambda push: _twice_area(view.flat(push), view.flat(arm)))


def _guided(view: FigureView, element: Pivot | Hold, arm: Point) -> Point:
    """Along the directions in which a point is held, upwards or inwards."""
    found = (0.0, 0.0, 0.0)
    for label in element.only:
        along = view.point(element.along[label])
        if hypot(*view.flat(along)) < 0.3:
            continue
        inward = -sum(a * b for a, b in zip(along, arm, strict=True))
        sign = 1.0 if abs(along[2]) > 0.5 or inward >= 0 else -1.0
        found = _sum(found, along, sign)
    return _scaled(_unit(found), _FORCE) if any(found) else (0.0, 0.0, _FORCE)

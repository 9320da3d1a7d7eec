"""What a figure shows, as lines in space: bodies and supports, axes, angles, lengths, forces."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from math import hypot

from polhode.algebra import PI, Expr, Symbol, Vector
from polhode.algebra import cos as exact_cos
from polhode.model import (
    Body,
    Constraint,
    Contact,
    Element,
    Frame,
    Gravity,
    Hold,
    KnifeEdge,
    Pivot,
    Rim,
    Rope,
    Round,
    Smooth,
)
from polhode.solution._figure import LineName
from polhode.solution._figure_bodies import (
    drawn_body,
    drawn_links,
    held_points,
    place_of,
    supports,
    turntables,
)
from polhode.solution._figure_lines import (
    Shape,
    arc_between,
    axis_name,
    circle,
    coincide,
    name_of,
    plus,
    scaled,
    twice_area,
    unit_vector,
)
from polhode.solution._figure_numbers import Point, frames_of, root_of, up_of
from polhode.solution._figure_view import FigureView
from polhode.solution._setting import Setting

_AXIS, _CORNER_AXIS, _FORCE, _WEIGHT = 1.45, 0.55, 0.95, 0.7
_SEEN = 0.01  # length of an arrow that can be seen


def shapes_of(view: FigureView, setting: Setting, has_arm: bool) -> Iterator[Shape]:
    """Everything but the axes of the laboratory, what is behind first.

    The vector to where the only force acts is shown where a text has a letter for it.
    """
    yield from supports(view)
    for body in view.equations.system.bodies:
        yield from drawn_body(view, body)
    yield from drawn_links(view)
    yield from _axes(view, setting)
    yield from _angles(view)
    yield from _lengths(view, has_arm)
    yield from _forces(view, setting, has_arm)
    yield from turntables(view)
    yield from held_points(view)


def corner_axes(view: FigureView) -> Iterator[Shape]:
    """The axes of the laboratory, from an origin of their own."""
    root = root_of(view.equations)
    for label in root.labels:
        along = view.point(root[label])
        if hypot(*view.flat(along)) > 0.1:
            end = scaled(along, _CORNER_AXIS)
            yield Shape(((0.0, 0.0, 0.0), end), "fixed", True, name=_corner_name(root, label))
        else:
            yield from _end_on(view, along, label)
    if any(root.turned):
        turned = view.point(Vector(root.turned, root))
        end = scaled(turned, 1.5 * _CORNER_AXIS / (hypot(*turned) or 1.0))
        omega = LineName(r"\boldsymbol{\Omega}", "Ω")
        yield Shape(((0.0, 0.0, 0.0), end), "turn", True, name=omega)
        yield from _latitude(view, end)


def _corner_name(root: Frame, label: str) -> LineName:
    """Of an axis of the laboratory, and on the Earth where it points."""
    name = axis_name(label)
    if not root.compass:
        return name
    where = root.compass[root.labels.index(label)]
    return LineName(rf"{name.latex}\ \mathrm{{({where})}}", f"{name.plain} ({where})")


def _latitude(view: FigureView, end: Point) -> Iterator[Shape]:
    """The angle from an axis of the laboratory to that of the Earth."""
    root = root_of(view.equations)
    for label, rate in zip(root.labels, root.turned, strict=True):
        for symbol in rate.symbols():
            angle, origin = Expr.generator(symbol), (0.0, 0.0, 0.0)
            if rate and (rate / exact_cos(angle)).symbols() < rate.symbols():
                arc = arc_between(
                    origin, view.point(root[label]), unit_vector(end), 0.7 * _CORNER_AXIS
                )
                middle = arc[len(arc) // 2]
                yield Shape(arc, "angle", name=name_of(angle), at=middle, away=origin)
                return


def _end_on(view: FigureView, along: Point, label: str) -> Iterator[Shape]:
    """An axis along which one looks: a dot where it comes towards the eye, otherwise a cross."""
    origin = (0.0, 0.0, 0.0)
    nearer = sum(a * b for a, b in zip(along, view.projection.towards, strict=True)) > 0
    right, up = view.projection.right, view.projection.up
    away = plus(right, up)
    named = axis_name(label)
    yield Shape((origin,), "fixed", is_closed=True, radius=5.0, name=named, away=away)
    if nearer:
        yield Shape((origin,), "fixed", is_closed=True, radius=1.2)
        return
    for second in (up, scaled(up, -1.0)):
        line = scaled(plus(right, second), 0.032)
        yield Shape((scaled(line, -1.0), line), "fixed")


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
                line = (centre, plus(centre, along, _AXIS))
                yield Shape(line, "axis", True, name=axis_name(label))


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
            if any(coincide(direction, axis) for axis in shown) and direction is after:
                continue
            label = next((k for k, axis in named.items() if coincide(axis, direction)), "")
            name = axis_name(label) if label else None
            yield Shape((centre, plus(centre, direction, radius + 0.5)), "dashed", name=name)
        arc = arc_between(centre, before, after, radius)
        middle = arc[len(arc) // 2]
        yield Shape(arc, "angle", name=name_of(angle), at=middle, away=centre)


def _letter_of_angle(frame: Frame) -> Expr | None:
    """The letter of a rotation's angle, or the angle where it has several letters.

    None for an angle without any, and for one that is a function of something else, as a slope is.
    """
    letters = [s for s in frame.angle.symbols() if s != PI]
    if not letters or not all(isinstance(g, Symbol) for g in frame.angle.generators):
        return None
    return Expr.generator(letters[0]) if len(letters) == 1 else frame.angle


def between(view: FigureView, frame: Frame, angle: Expr) -> tuple[Point, Point] | None:
    """A direction of the parent and one of the frame with this angle between them.

    Preferred are those that end as an axis of a body and begin at the vertical, or the north, and
    that the picture shows well apart.
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

    root = root_of(view.equations)
    marked = zip(root.compass, root.labels, strict=False)
    north = [view.point(root[label]) for name, label in marked if name == "north"]

    def preference(pair: tuple[Point, Point]) -> tuple[bool, bool, bool, float]:
        before, after = pair
        apart = twice_area(view.flat(before), view.flat(after))
        is_final = any(coincide(after, axis) for axis in final)
        is_north = any(coincide(before, direction) for direction in north)
        return is_final, coincide(before, vertical), is_north, apart

    return max(pairs, key=preference, default=None)


# -- lengths and forces ----------------------------------------------------------------------------


def _lengths(view: FigureView, has_arm: bool) -> Iterator[Shape]:
    """Radii, and distances from centres of mass to where bodies are held."""
    named = {LineName("a", "a")} if has_arm else set()  # the letter of the vector
    for body in view.equations.system.bodies:
        centre = view.centre(body)
        for element in view.equations.system.elements:
            if isinstance(element, Pivot | Hold | KnifeEdge) and element.body == body:
                name = _length_of(element.at)
                if name is not None and name not in named:
                    named.add(name)
                    line = (centre, plus(centre, view.point(element.at)))
                    yield _dimension(line, name)
        if isinstance(body.surface, Rim | Round):
            to_middle = body.axes[body.surface.axis] * body.surface.offset
            name = _length_of(to_middle)
            if name is not None and name not in named:
                named.add(name)
                yield _dimension((centre, plus(centre, view.point(to_middle))), name)
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
    middle = scaled(plus(*line), 0.5)
    return Shape((), "length", name=name, at=middle, away=line[0], beside=True)


def _radius(
    view: FigureView, body: Body, surface: Rim | Round, centre: Point, name: LineName
) -> Shape:
    axis = view.point(body.axes[surface.axis])
    middle = plus(centre, axis, view.number(surface.offset))
    if isinstance(surface, Rim):
        plane = [view.point(body.axes[label]) for label in body.axes.others(surface.axis)]
        ring = circle(middle, plane, view.number(surface.radius))
    else:
        plane = [view.projection.right, view.projection.up]
        ring = circle(middle, plane, view.number(surface.radius))
    aim = (0.94, -0.34)  # to the right, where little else is

    def along(point: Point) -> float:
        x, y = view.flat(plus(point, middle, -1.0))
        return x * aim[0] + y * aim[1]

    end = max(ring, key=along)
    half = scaled(plus(middle, end), 0.5)
    return Shape((middle, end), "length", True, name=name, at=half, away=middle, beside=True)


def _forces(view: FigureView, setting: Setting, has_arm: bool) -> Iterator[Shape]:
    forced = [r for r in view.equations.reactions.values() if not r.force.is_zero]
    arms = {r.name: view.point(r.arm) for r in forced}
    yield from _weights(view, arms)
    elements = {e.name: e for e in view.equations.system.elements}
    for reaction in forced:
        element = elements[reaction.name]
        if isinstance(element, Constraint):  # a generalized force, at no point
            continue
        push = _push(view, element, arms[reaction.name])
        if hypot(*push) < _SEEN:
            continue
        if isinstance(element, Rope):
            yield _tension(view, element, hypot(*push))
            continue
        centre, arm = view.centre(reaction.body), arms[reaction.name]
        place = plus(centre, arm)
        if has_arm and len(forced) == 1 and hypot(*arm) > 1e-6:
            yield _arm(view, centre, arm, push)
        if isinstance(element, Contact):
            yield Shape((place,), "dot", is_closed=True, radius=2.6)
        yield Shape((place, plus(place, push)), "force", True, name=_force_name(setting, element))


def _push(view: FigureView, element: Element, arm: Point) -> Point:
    """A force as an arrow: as it is at one instant, or else along what can hold."""
    if view.forces is None:
        return direction(view, element, arm)
    return scaled(view.forces.reactions[element.name], view.forces.unit)


def _arm(view: FigureView, centre: Point, arm: Point, push: Point) -> Shape:
    """The vector to where the force acts, beside the force where that would cover it."""
    covered = twice_area(view.flat(arm), view.flat(push)) < 0.05
    upright = abs(view.flat(arm)[0]) < 0.05
    return Shape(
        (centre, plus(centre, arm)),
        "arm",
        True,
        name=LineName(r"\mathbf{a}", "a"),
        at=plus(centre, arm, 0.5),
        away=centre,
        beside=True,
        aside=4.0 if covered or upright else 0.0,
    )


def _tension(view: FigureView, rope: Rope, size: float) -> Shape:
    """The pull of a rope at the body at its beginning."""
    (restraint,) = view.equations.kinetics.restraints[rope.name]
    link = rope.links[0]
    start, end = place_of(view, link.start), place_of(view, link.end)
    push = scaled(unit_vector(plus(end, start, -1.0)), size)
    name = name_of(Expr.generator(Symbol(restraint.name)))
    return Shape((start, plus(start, push)), "force", True, name=name)


def _force_name(setting: Setting, element: Element) -> LineName:
    letter, low = setting.force_name(element)
    low = low.strip("{}").removeprefix(r"\rm ")
    latex = rf"\mathbf{{{letter[0]}}}{letter[1:]}" + (rf"_{{\mathrm{{{low}}}}}" if low else "")
    return LineName(latex, letter, low)


def _weights(view: FigureView, arms: dict[str, Point]) -> Iterator[Shape]:
    up = up_of(view.equations)
    strengths = [load.g for load in view.equations.system.loads if isinstance(load, Gravity)]
    if up is None or not strengths:
        return
    down = scaled(view.point(up), -1.0)
    for body in view.equations.system.bodies:
        if not body.mass:
            continue
        weight = body.mass * strengths[0]
        covered = any(twice_area(view.flat(a), view.flat(down)) < 0.1 for a in arms.values())
        centre = view.centre(body)
        size = _WEIGHT if view.forces is None else view.number(weight) * view.forces.unit
        line = (centre, plus(centre, down, size))
        yield Shape(line, "force", True, name=name_of(weight), beside=covered)


def direction(view: FigureView, element: Element, arm: Point) -> Point:
    """Along what holds, towards the body; somewhat aside where the direction is not known."""
    if isinstance(element, Rope):
        return scaled(view.projection.up, 0.7 * _FORCE)
    if isinstance(element, Pivot) and element.body.inertia.is_zero and any(arm):  # a light rod
        return scaled(unit_vector(arm), _FORCE)
    if isinstance(element, KnifeEdge):
        return scaled(view.point(element.body.axes[element.across]), _FORCE)
    if isinstance(element, Smooth):
        return scaled(view.point(element.on.up), _FORCE)
    if isinstance(element, Contact):
        up = scaled(view.point(element.on.up), 0.85)
        tangents = [view.point(element.on.axes[label]) for label in element.on.tangents]
        if view.is_straight:
            tangents = [t for t in tangents if hypot(*view.flat(t)) > 0.5]
        tilted = [plus(up, aside, 0.45 * sign) for aside in tangents for sign in (1.0, -1.0)]
        return max(tilted, key=lambda push: twice_area(view.flat(push), view.flat(arm)))
    if isinstance(element, Pivot | Hold) and set(element.only) != set(element.along.labels):
        return _guided(view, element, arm)
    right, up = view.projection.right, view.projection.up
    sides = [plus(scaled(up, 0.8), right, 0.5 * sign) for sign in (1.0, -1.0)]
    return max(sides, key=lambda push: twice_area(view.flat(push), view.flat(arm)))


def _guided(view: FigureView, element: Pivot | Hold, arm: Point) -> Point:
    """Along the directions in which a point is held, upwards or inwards."""
    found = (0.0, 0.0, 0.0)
    for label in element.only:
        along = view.point(element.along[label])
        if hypot(*view.flat(along)) < 0.3:
            continue
        inward = -sum(a * b for a, b in zip(along, arm, strict=True))
        sign = 1.0 if abs(along[2]) > 0.5 or inward >= 0 else -1.0
        found = plus(found, along, sign)
    return scaled(unit_vector(found), _FORCE) if any(found) else (0.0, 0.0, _FORCE)

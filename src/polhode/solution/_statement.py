"""What is assumed, and the axes and angles: the opening of a worked solution."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from polhode.algebra import Expr, Length, Matrix, Symbol, Vector, cos, lengths_in, sin, variables
from polhode.model import (
    Body,
    BodyPoint,
    CentralForce,
    Constraint,
    Contact,
    Coulomb,
    CurvedSupport,
    Damper,
    DrillingFriction,
    Element,
    Ellipsoidal,
    Force,
    Frame,
    Gear,
    Gravity,
    Guide,
    Hinge,
    Hold,
    KnifeEdge,
    Load,
    MagneticMoment,
    Motor,
    Pivot,
    Plane,
    Potential,
    Rack,
    Rim,
    Rolling,
    RollingResistance,
    Rope,
    Round,
    Screw,
    Sheet,
    Slider,
    Smooth,
    Spring,
    Support,
    Torque,
    TorsionDamper,
    TorsionSpring,
    Turntable,
    Universal,
    Weld,
)
from polhode.solution._letters import lengths_among, letters_in
from polhode.solution._lines import (
    SolutionLine,
    inline,
    is_sum,
    letter_of,
    listed,
    negative_multiple,
    unit,
    vector_latex,
)
from polhode.solution._setting import WIDEST, Setting, dependent_coordinates
from polhode.solution._surfaces import surface_words


def assumptions(setting: Setting) -> Iterator[SolutionLine]:
    """The bodies, what holds them, and gravity."""
    for body in setting.equations.system.bodies:
        yield from _body(setting, body)
    for element in setting.equations.system.elements:
        yield SolutionLine(_held(setting, element))
    gravity = setting.gravity
    if gravity is not None:
        up = f", opposite to ${setting.up_latex}$" if setting.up_latex else ""
        yield SolutionLine(f"Gravity acts with acceleration {inline(gravity.g)}{up}.")
    for load in setting.equations.system.loads:
        if not isinstance(load, Gravity):
            yield SolutionLine(_acting(setting, load))
    if signs := setting.equations.assumed_positive:
        words = listed(f"{inline(sign)} > 0" for sign in signs).replace("$ > 0", " > 0$")
        yield SolutionLine(f"We take {words}; otherwise the body would touch elsewhere.")


def _acting(setting: Setting, load: Load) -> str:
    on = listed(f"the {body.name}" for body in load.bodies) if load.bodies else "the bodies"
    match load:
        case Spring():
            size = f"of stiffness {inline(load.stiffness)}"
            if load.length:
                size += f" and natural length {inline(load.length)}"
            ideal = "A spring" if load.length else "An ideal spring"
            return f"{ideal} {size} {_joins(setting, load.start, load.end)}."
        case Damper():
            what = f"A damper of constant {inline(load.damping)}"
            return (
                f"{what} {_joins(setting, load.start, load.end)}; its force is proportional to "
                "their relative velocity and opposite to it."
            )
        case Force() if vector := _written(setting, load.at.body, load.force):
            where = _point_of(setting, load.at.body, load.at.offset)
            return f"The force {vector} (“{load.name}”) acts at {where[0].lower()}{where[1:]}."
        case Torque() if vector := _written(setting, load.body, load.torque):
            opposite = (
                f", and its opposite on the {other.name}" if (other := load.reaction_on) else ""
            )
            return f"The couple {vector} (“{load.name}”) acts on the {load.body.name}{opposite}."
    return _turning(setting, load, on)


def _turning(setting: Setting, load: Load, on: str) -> str:
    """Loads on angles, and those that are given by a potential."""
    match load:
        case TorsionSpring():
            angle = load.angle - load.rest
            couple = negative_multiple(load.stiffness, angle) if is_sum(angle.latex()) else ""
            couple = couple or (-load.stiffness * angle).latex()
            return f"A torsion spring exerts the couple ${couple}$ on {on}."
        case TorsionDamper():
            couple = (-load.damping * load.angle.dt()).latex()
            return f"A torsion damper exerts the couple ${couple}$ on {on}."
        case CentralForce() if len(text := load.energy.latex()) <= WIDEST:
            energy = f"with the potential energy ${text}$ at the distance {inline(load.distance)}"
            return f"A force {energy} {_joins(setting, load.start, load.end)} (“{load.name}”)."
        case MagneticMoment() if moment := _written(setting, load.body, load.moment):
            field = f"${vector_latex(load.field, setting.axes.root)}$"
            return f"The {load.body.name} has the magnetic moment {moment} in the field {field}."
        case Potential() if len(text := load.energy.latex()) <= WIDEST:
            return f"Forces with the potential energy ${text}$ (“{load.name}”) act on {on}."
    return f"The {_kind(load)} “{load.name}” acts on {on}."


def _joins(setting: Setting, start: BodyPoint, end: BodyPoint | Vector) -> str:
    """Between which points something acts."""
    first = _point_of(setting, start.body, start.offset)
    if isinstance(end, BodyPoint):
        second = _point_of(setting, end.body, end.offset)
        other = f"{second[0].lower()}{second[1:]}"
    else:
        other = (
            "the origin" if end.is_zero else f"the place ${vector_latex(end, setting.axes.root)}$"
        )
    return f"joins {first[0].lower()}{first[1:]} to {other}"


def _written(setting: Setting, body: Body, vector: Vector) -> str:
    """A force or couple within words; empty where it is too long."""
    text = _seen(setting, body, vector)
    return text if len(text) <= WIDEST else ""


def _kind(thing: object) -> str:
    name = type(thing).__name__
    if isinstance(thing, Universal):
        name += "Joint"
    return "".join(f" {c.lower()}" if c.isupper() else c for c in name).strip()


def _body(setting: Setting, body: Body) -> Iterator[SolutionLine]:
    name, axes = body.name, body.axes
    moments = tuple(body.inertia[i, i] for i in range(3))
    mass = f"The {name} has mass {inline(body.mass)}"
    if body.is_massless:
        yield SolutionLine(f"The {name} has no mass.")
        return
    if not any(moments):
        yield SolutionLine(f"{mass}, and its size does not matter.")
        return
    if body.inertia != Matrix.diagonal(moments):
        yield SolutionLine(f"{mass}. {_inertia_tensor(body)}")
        return
    if body.is_isotropic:
        about = "every axis through its centre of mass"
        yield SolutionLine(f"{mass}; its moment of inertia about {about} is {inline(moments[0])}.")
        return
    equal = [i for i in range(3) if moments.count(moments[i]) > 1]
    odd = [i for i in range(3) if i not in equal]
    words = f"{mass}. Its axes ${_labels(axes)}$ through the centre of mass are principal axes"
    if equal:
        words += f", and ${letter_of(axes.labels[odd[0]])}$ is an axis of symmetry"
    named = [(axes.labels[i], moments[i]) for i in (*equal[:1], *odd)]
    letters = [m for _, m in named if m.symbol is not None]
    if letters or not setting.is_single or axes.labels == setting.axes.root.labels:
        each = [f"{inline(m)} about {_about(axes, moments, m)}" for _, m in named]
        yield SolutionLine(f"{words}. The moments of inertia are {listed(each)}.")
        return
    yield SolutionLine(f"{words}. The moments of inertia are")
    for label, moment in named:
        yield SolutionLine("", rf"I_{label} = {moment.latex()}", context="identity")


def _inertia_tensor(body: Body) -> str:
    """The components of an inertia tensor along axes that are not principal axes."""
    labels = [letter_of(label) for label in body.axes.labels]
    pairs = [(i, i) for i in range(3)] + [(0, 1), (0, 2), (1, 2)]
    shown = [
        f"$I_{{{labels[i]}{labels[j]}}} = {body.inertia[i, j].latex()}$"
        for i, j in pairs
        if i == j or body.inertia[i, j]
    ]
    rest = "; the others are zero" if len(shown) < len(pairs) else ""
    return (
        f"Its axes ${', '.join(labels)}$ are not principal axes: the inertia tensor has the "
        f"components {listed(shown)} along them{rest}."
    )


def _about(axes: Frame, moments: tuple[Expr, ...], moment: Expr) -> str:
    pairs = zip(axes.labels, moments, strict=True)
    return listed(f"${letter_of(label)}$" for label, value in pairs if value == moment)


def _held(setting: Setting, element: Element) -> str:
    name = f"The {element.bodies[0].name}"
    match element:
        case Contact():
            touches = f"{_touching(element)} {_support(setting, element.on)}"
            return f"{name}{_size(setting, element.body)} {touches}."
        case Guide():
            across = f"${vector_latex(element.normal, setting.axes.root)}$"
            return (
                f"The axis ${element.axis}$ of the {element.body.name} is kept perpendicular to "
                f"{across}, so that it can turn in a plane only."
            )
        case Motor():
            near = element.relative_to
            to = "" if near == element.body.axes else f" relative to “{near.name}”"
            keeps = "from turning" if not element.rate else f"turning at {inline(element.rate)}"
            return f"A motor keeps {name.lower()} {keeps} about its axis ${element.axis}${to}."
        case Hinge():
            to = "" if element.to is None else f" relative to the {element.to.name}"
            return f"{name} can turn{to} about its axis ${element.axis}$ only."
        case Hold():
            along = listed(f"${letter_of(label)}$" for label in element.only)
            return f"{_point_of(setting, element.body, element.at)} is kept at rest along {along}."
        case KnifeEdge():
            where = _point_of(setting, element.body, element.at)
            along = f"its axis ${letter_of(element.across)}$"
            return f"{where} is a sharp edge, which cannot move along {along}."
        case Pivot():
            return _pivoted(setting, element)
    return _coupled(setting, element)


def _size(setting: Setting, body: Body) -> str:
    """What touches a support: its radius or half-axes, and where it is."""
    match body.surface:
        case Rim(radius=radius, offset=offset) | Round(radius=radius, offset=offset):
            if not offset:
                return f" of radius {inline(radius)}"
            kind = "circle" if isinstance(body.surface, Rim) else "sphere"
            middle = body.axes[body.surface.axis] * offset
            what = f"a {kind} of radius {inline(radius)}"
        case Ellipsoidal(half_axes=halves, offset=offsets):
            axes = f"{listed(map(inline, halves))} along ${_labels(body.axes)}$"
            middle = Vector(offsets, body.axes)
            what = f"an ellipsoid with the half-axes {axes}"
            if middle.is_zero:
                return f", {what},"
        case _:
            return ""
    where = f"whose centre is at {_seen(setting, body, middle)} from its centre of mass"
    return f", which touches with {what}, {where},"


def _coupled(setting: Setting, element: Element) -> str:
    """How two bodies, or a body and the ground, are tied to one another."""
    bodies = [f"the {body.name}" for body in element.bodies]
    name, other = f"The {element.bodies[0].name}", [*bodies, "the ground"][1]
    match element:
        case Slider():
            to = f" of the {element.to.body.name}" if isinstance(element.to, BodyPoint) else ""
            axis = f"${letter_of(element.axis)}${to}"
            return f"{name} can slide along the axis {axis} only, without turning against it."
        case Rope():
            both = listed([*bodies, "the ground"][: max(2, len(bodies))])
            joins = f"joins {both}{_fixed_points(setting, element)}"
            return f"The rope “{element.name}” {joins}; it is taut and has no mass."
        case Gear():
            radii = listed(map(inline, (element.radius, element.other_radius)))
            return f"{name} and {other} are in mesh (“{element.name}”), with the radii {radii}."
        case Rack():
            rack = "a rack at rest" if element.to is None else f"a rack on {other}"
            line = vector_latex(element.along, setting.axes.root)
            at = _seen(setting, element.pinion, element.at)
            return (
                f"{name} rolls along ${line}$ on the line through its point at {at} from the "
                f"centre of mass, like a pinion on {rack} (“{element.name}”)."
            )
        case RollingResistance():
            return (
                f"{name} rolls against a resistance of {inline(element.mu)} times the normal "
                "force, which opposes the travel of the point of contact along its surface."
            )
        case DrillingFriction():
            return (
                f"A couple of {inline(element.mu)} times the normal force opposes the spinning of "
                f"{name[0].lower()}{name[1:]} about the normal."
            )
        case Screw():
            advance = f"by {inline(element.pitch)} in every turn"
            return f"{name} moves along its thread in {other} {advance}."
        case Constraint() if len(equation := element.equation.latex()) <= WIDEST:
            return f"The motion obeys the equation ${equation} = 0$ (“{element.name}”)."
    kind = _kind(element)
    named = f"the {kind} “{element.name}”"
    return f"{name} is held by {f'a {kind}' if element.name in kind.split() else named}."


def _fixed_points(setting: Setting, rope: Rope) -> str:
    """The points of the ground that a rope passes or ends at."""
    fixed = [p for p in rope.points if isinstance(p, Vector)]
    if not fixed:
        return ""
    places = listed(f"${vector_latex(p, setting.axes.root)}$" for p in fixed)
    return f", through the fixed point{'s' if len(fixed) > 1 else ''} {places}"


def _at_place(setting: Setting, pivot: Pivot, place: Vector) -> str:
    """Where a pivot holds its body: a place that moves, or one that its coordinates describe."""
    point = _point_of(setting, pivot.body, pivot.at)
    there = f"${vector_latex(place, setting.axes.root)}$"
    found = variables(place.express(setting.axes.root).components)
    own = [Expr.generator(q) for q in setting.equations.coordinates if q in found]
    if not own:
        return f"{point} is held at {there}, which moves as prescribed."
    number = "coordinates" if len(own) > 1 else "a coordinate"
    return f"{point} is at {there}, with {listed(map(inline, own))} as {number}."


def _pivoted(setting: Setting, pivot: Pivot) -> str:
    """How a pivot holds its body."""
    body = pivot.body
    if isinstance(pivot, Weld):
        other = f"the {pivot.to.body.name}" if isinstance(pivot.to, BodyPoint) else "the ground"
        return f"The {body.name} is rigidly joined to {other}."
    if setting.is_fixed(pivot):
        free = _is_alone(setting, pivot)
        if pivot.at.is_zero and free:
            return (
                f"The {body.name} can turn freely about its centre of mass, which is held at rest."
            )
        if pivot.at.is_zero:
            return f"The centre of mass of the {body.name} is held at rest."
        if body.inertia.is_zero:
            to = _seen(setting, body, pivot.at)
            return (
                f"The {body.name} stays at a constant distance from a fixed point, which is at "
                f"{to} from it."
            )
        place = f", at {_seen(setting, body, pivot.at)} from its centre of mass,"
        turns = ", and it can turn freely about it" if free else ""
        return f"One point of the {body.name}{place} is held at rest{turns}."
    whole = set(pivot.only) == set(pivot.along.labels)
    is_particle = body.inertia.is_zero and not pivot.at.is_zero
    if isinstance(pivot.to, BodyPoint) and whole and is_particle:
        other = _point_of(setting, pivot.to.body, pivot.to.offset)
        return (
            f"The {body.name} stays at a constant distance from {other[0].lower()}{other[1:]}, "
            f"which is at {_seen(setting, body, pivot.at)} from it."
        )
    if isinstance(pivot.to, BodyPoint) and whole:
        other = _point_of(setting, pivot.to.body, pivot.to.offset)
        return f"{_point_of(setting, body, pivot.at)} is joined to {other[0].lower()}{other[1:]}."
    if isinstance(pivot.to, Vector) and whole:
        return _at_place(setting, pivot, pivot.to)
    along = listed(f"${letter_of(label)}$" for label in pivot.only)
    if isinstance(pivot.to, Vector):
        there = f"is held at ${vector_latex(pivot.to, setting.axes.root)}$ along {along} only"
        held = f"cannot move along {along}" if pivot.to.is_zero else there
        return f"{_point_of(setting, body, pivot.at)} {held}."
    other = _point_of(setting, pivot.to.body, pivot.to.offset)
    there = f"relative to {other[0].lower()}{other[1:]}"
    return f"{_point_of(setting, body, pivot.at)} cannot move along {along} {there}."


def _is_alone(setting: Setting, element: Element) -> bool:
    """Whether nothing else holds the body."""
    body = element.bodies[0]
    return [e for e in setting.equations.system.elements if body in e.bodies] == [element]


def _point_of(setting: Setting, body: Body, at: Vector) -> str:
    """A point of a body at the start of a sentence."""
    if at.is_zero:
        return f"The centre of mass of the {body.name}"
    return f"The point of the {body.name} at {_seen(setting, body, at)} from its centre of mass"


def _seen(setting: Setting, body: Body, at: Vector) -> str:
    """A vector from the centre of mass of a body."""
    one = next(s for s in setting.each if s.body == body)
    return f"${one.shortest(at)[1]}$"


def _touching(contact: Contact) -> str:
    match contact:
        case Rolling():
            return "rolls without slipping on"
        case Smooth():
            return "slides without friction on"
        case Coulomb():
            return f"slides with friction, coefficient {inline(contact.mu)}, on"
    return "touches"


def _support(setting: Setting, support: Support) -> str:
    if isinstance(support, CurvedSupport):
        return surface_words(support)
    assert isinstance(support, Plane)
    level = setting.up is not None and (support.up - setting.up).is_zero
    place, slope = _attitude(setting, support), "" if level else _slope(setting, support)
    match support:
        case Turntable():
            turns = f"which turns at the rate {inline(support.Omega)}"
            return f"{place} turntable{slope}, {turns}"
        case Sheet():
            return f"{place} sheet{slope}, which is moved as prescribed{_moved(support)}"
    if support.carrier is not None:
        return f"{place} side of the {support.carrier.name}{slope}"
    return f"{place} plane{slope}"


def _attitude(setting: Setting, support: Plane) -> str:
    """The article of a plane with how it stands; the article alone where nothing is up."""
    if setting.up is None:
        return "a"
    if (support.up - setting.up).is_zero:
        return "a horizontal"
    return "an inclined" if support.up.dot(setting.up) else "a vertical"


def _slope(setting: Setting, support: Plane) -> str:
    """How a plane lies whose axes have the names of others and are not shown."""
    axes = support.axes
    if axes in setting.frames or axes.parent is None:
        return ""
    turned = f"those of the laboratory, turned by {inline(axes.angle)} about {_axis_words(axes)}"
    return f" (the axes of the slope are {turned})"


def _moved(sheet: Sheet) -> str:
    """The letters of its motion."""
    words = ""
    if all(part.symbol is not None for part in sheet.motion):
        first, second = map(inline, sheet.motion)
        words = f": {first} and {second} are the coordinates of its origin"
        if sheet.angle.symbol is not None:
            words += f", {inline(sheet.angle)} the angle by which it has turned"
    return words


# -- axes ------------------------------------------------------------------------------------------


def choice_of_axes(setting: Setting) -> Iterator[SolutionLine]:
    """How the axes arise, why these are chosen, and the unit vectors that are needed."""
    body, root = setting.body, setting.axes.root
    yield SolutionLine(f"{_laboratory(setting, root)}{_turned(setting, 'them')}")
    yield SolutionLine(_why(setting, body))
    yield from _directions(setting)


def axes_of_bodies(setting: Setting) -> Iterator[SolutionLine]:
    """How the axes of each of several bodies arise."""
    root = setting.axes.root
    yield SolutionLine(_laboratory(setting, root))
    for one in setting.each:
        if one.axes.parent is None:
            yield SolutionLine(f"They serve for the {one.body.name} too.")
            continue
        same = next((o for o in setting.each if o.axes == one.axes), one)
        if same.body != one.body:
            yield SolutionLine(f"The {one.body.name} has the axes of the {same.body.name}.")
            continue
        before = [o for o in setting.each[: setting.each.index(one)] if o.axes.parent is not None]
        near = max(
            (o for o in before if o.axes in one.axes.lineage),
            key=lambda other: len(other.axes.lineage),
            default=None,
        )
        first = "those of the laboratory" if near is None else f"those of the {near.body.name}"
        turned = _turned(one, first, None if near is None else near.axes).strip()
        yield SolutionLine(f"For the axes of the {one.body.name}: {turned[0].lower()}{turned[1:]}")


def places_in_words(setting: Setting, formulas: Iterable[str]) -> Iterator[SolutionLine]:
    """What the coordinates of places mean that occur in formulas, and which never change."""
    used = frozenset[str]().union(*map(letters_in, formulas))
    kinetics = setting.equations.kinetics
    known = set[Symbol]()
    for one in setting.each:
        found = _coordinates_along(setting, kinetics.places[one.body])
        named = [q for q in found if Expr.generator(q).latex() in used and q not in known]
        known |= set(named)
        if not named:
            continue
        is_root = all(label in setting.axes.root.labels for label in found.values())
        along = listed(f"${letter_of(found[q])}$" for q in named)
        many = len(named) > 1
        words = f"{listed(map(inline, named))} {'are' if many else 'is'} the "
        words += f"coordinate{'s' if many else ''} of the centre of mass of the {one.body.name}"
        plain = is_root and all(q.published == found[q] for q in named)
        yield SolutionLine(f"{words}{'' if plain else f' along {along}'}{_kept(setting, named)}.")


def lengths_in_words(setting: Setting, formulas: Iterable[str]) -> Iterator[SolutionLine]:
    """What the letters of lengths stand for that occur in formulas."""
    for part in lengths_among(formulas, setting.equations):
        words = "The speed is" if part.letter.of_velocity else _spanned(setting, part)
        left = Expr.generator(part).latex()
        yield SolutionLine(words, f"{left} = {part.meaning.latex()}", context="identity")


def _spanned(setting: Setting, distance: Length) -> str:
    """What a distance is, in words."""
    equations = setting.equations.in_lengths
    for load in equations.system.loads:
        forces = (c for action in equations.actions(load) for c in action.force.components)
        if distance in lengths_in(forces):
            return f"The distance between the ends of “{load.name}” is"
    return "The distance is"


def _coordinates_along(setting: Setting, place: Vector) -> dict[Symbol, str]:
    """Coordinates that are components of a place, each with the axis along which it is one."""
    coordinates = set(setting.equations.coordinates)
    for frame in (setting.axes.root, *setting.frames):
        pairs = zip(frame.labels, place.express(frame).components, strict=True)
        found = {c.symbol: k for k, c in pairs if c.symbol is not None and c.symbol in coordinates}
        if found:
            return found
    return {}


def _kept(setting: Setting, named: list[Symbol]) -> str:
    """The values that supports give to coordinates, once and for all."""
    fixed = dependent_coordinates(setting.equations)
    values = {q: fixed[q] for q in named if q in fixed and not fixed[q].varies}
    if not values:
        return ""
    texts = (f"${Expr.generator(q).latex()} = {value.latex()}$" for q, value in values.items())
    return f", where the supports keep {listed(texts)}"


def _laboratory(setting: Setting, root: Frame) -> str:
    words = f"The axes ${_labels(root)}$ are those of the laboratory"
    if any(root.turned):
        spin = vector_latex(Vector(root.turned, root), root)
        words += rf", which turns with the Earth at the angular velocity ${spin}$"
    return words + _vertical(setting, root) + "."


def _turned(setting: Setting, first: str, start: Frame | None = None) -> str:
    """The rotations that lead from the laboratory, or the start, to the axes of a body."""
    words = ""
    steps = [frame for frame in reversed(setting.axes.lineage) if frame.parent is not None]
    steps = steps[steps.index(start) + 1 :] if start is not None else steps
    for i, frame in enumerate(steps):
        turn = f" Turn {first}" if not i else ", then"
        turn = " Turn these" if words.endswith(".") else turn
        name = f"; this gives the axes ${_labels(frame)}$." if frame in setting.frames else ""
        words += f"{turn} by {inline(frame.angle)} about {_axis_words(frame)}{name}"
    return words if not words or words.endswith(".") else f"{words}."


def _labels(frame: Frame) -> str:
    return ", ".join(map(letter_of, frame.labels))


def _vertical(setting: Setting, root: Frame) -> str:
    if setting.up is None:
        return ""
    for label in root.labels:
        if (root[label] - setting.up).is_zero:
            return f", with ${letter_of(label)}$ vertically upwards"
    return ""


def _axis_words(frame: Frame) -> str:
    parent = frame.parent
    if parent is None:
        return ""
    for label in parent.labels:
        if parent[label].components == frame.axis:
            return f"their ${letter_of(label)}$-axis"
    return f"the direction $({', '.join(c.latex() for c in frame.axis)})$"


def _why(setting: Setting, body: Body) -> str:
    axes, labels = body.axes, f"${_labels(body.axes)}$"
    if setting.along != axes:
        return (
            f"The axes of the {body.name} have the same names as those of the laboratory, so that "
            "vectors are resolved along the latter."
        )
    if setting.turning.is_zero and body.is_isotropic:
        return (
            f"Since all moments of inertia of the {body.name} are equal, these axes, which are at "
            "rest, serve as well as any that turn with it."
        )
    if axes.parent is None:
        return f"The axes of the laboratory serve for the {body.name} too."
    if body.fixed_axes == axes and body.inertia.is_zero:
        return f"The axes {labels} turn with the {body.name}."
    if body.fixed_axes == axes:
        return (
            f"The axes {labels} are fixed in the {body.name}, so that its inertia is constant "
            "along them."
        )
    return (
        f"The axes {labels} follow the {body.name} but do not spin with it. Because of its "
        "symmetry its moments of inertia along them are constant all the same, and the angle of "
        "spin appears in no formula."
    )


def _directions(setting: Setting) -> Iterator[SolutionLine]:
    """The vertical along the axes, and what the angles and axes mean for it."""
    axes, up = setting.axes, setting.up
    if up is None or axes.parent is None or axes != setting.along:
        return
    remarks = list(filter(None, (_of_axis(axes[label], label, up) for label in axes.labels)))
    words = f"{listed(remarks)[:1].upper()}{listed(remarks)[1:]}." if remarks else ""
    written = vector_latex(up, axes)
    named = next((k for k in axes.root.labels if (axes.root[k] - up).is_zero), "")
    if named and named not in axes.labels:
        yield SolutionLine(words, f"{unit(named)} = {written}", "vertical", "identity")
    elif words:
        yield SolutionLine(words)


def _of_axis(direction: Vector, label: str, up: Vector) -> str:
    along = direction.dot(up)
    if not along:
        return f"axis ${letter_of(label)}$ is always horizontal"
    for angle in along.symbols():
        q = Expr.generator(angle)
        if along == cos(q):
            return f"axis ${letter_of(label)}$ makes the angle {inline(q)} with the vertical"
        if along == sin(q):
            return f"axis ${letter_of(label)}$ rises at {inline(q)} above the horizontal"
    return ""

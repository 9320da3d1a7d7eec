"""Bodies of the scene: their shapes and poses, joints and links, and the arrows at them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial, singledispatch

import numpy as np

from polhode.algebra import Expr, Symbol, Vector
from polhode.base import DeclarationError
from polhode.derive import Equations
from polhode.model import (
    Action,
    Body,
    BodyPoint,
    Ellipsoidal,
    Face,
    Gravity,
    Hinge,
    Hold,
    Load,
    Pivot,
    Plane,
    Rim,
    Round,
    Surface,
    System,
    TwoPointLink,
    Universal,
    Weld,
)
from polhode.simulate import Trajectory
from polhode.view._magnitudes import Magnitudes
from polhode.view._mathml import inline
from polhode.view._quantities import Array, equations_of, modes_of
from polhode.view._scene import NOWHERE, Arrow, BodyShape, Joint, Link, Pose, SceneBody, Triple
from polhode.view._scene_along import along, attitudes, collapsed, constants, rolled, vectors

_THIN = 0.06  # thickness drawn for an infinitely thin body, against its radius
_SLENDER = 0.045  # radius of a rod against its length
_HOLLOW = 0.75  # I/(m a²) above which a round body is a hoop rather than a disk
_FLAT = 0.02  # relative side below which a body counts as a lamina
_LONG = 2.5  # length against width of a lamina that is drawn with a handle
_SAME = 1e-6  # relative difference of moments of inertia that count as equal
_POINT = 0.07  # radius of a particle against the reach of the whole
_THICKNESS = {"spring": 0.035, "damper": 0.022, "rope": 0.006}  # radius against the greatest length
_UNSEEN = 1e-9  # an arrow shorter than this share of the longest of its kind is not drawn
_USUAL = 0.9  # share of the motion for which an arrow is shorter than its usual length
_UPRIGHT: Triple = (0.0, 0.0, 1.0)


def bodies_of(run: Trajectory, links: Sequence[Link], t: Array) -> tuple[SceneBody, ...]:
    """Every body with its pose at the given instants; `links` help to size particles."""
    # of a body with a flat side that another touches, that side is drawn
    system = run.system if isinstance(run.system, System) else equations_of(run).system
    sided = {contact.on.carrier for contact in system.contacts if isinstance(contact.on, Plane)}
    point_like = BodyShape("ball", (0.0,))
    bodies = [
        SceneBody(
            body.name,
            point_like if body in sided else _shape(body.surface, body, run),
            _pose(run, body, t),
            _arms(run, body),
        )
        for body in equations_of(run).system.bodies
    ]
    lengths = [body.reach for body in bodies]
    lengths += [float(np.max(np.linalg.norm(link.start - link.end, axis=1))) for link in links]
    # A particle gets a radius that can be seen.
    point = (_POINT * (max(lengths) or 1.0),)
    return tuple(
        b if any(b.shape.size) else replace(b, shape=replace(b.shape, size=point)) for b in bodies
    )


def _pose(run: Trajectory, body: Body, t: Array) -> Pose:
    place = vectors(run, lambda equations: equations.kinetics.places[body], t)
    fixed = body.fixed_axes
    if fixed is None:  # a ball without body axes: its attitude is integrated from ω
        turning = vectors(run, lambda equations: equations.kinetics.velocities[body][1], t)
        carried = vectors(run, lambda equations: equations.system.root.angular_velocity, t)
        turn = rolled(turning - carried, float(t[1] - t[0]))
        return Pose(collapsed(place), collapsed(turn), np.zeros(0), _UPRIGHT)
    turn = attitudes(run, lambda equations: body.axes, t)
    spin, axis = np.zeros(0), _UPRIGHT
    if fixed != body.axes:
        spin = along(run, lambda equations: [fixed.angle], 1, t)[:, 0]
        axis = _triple(constants(run, fixed.axis))
    return Pose(collapsed(place), collapsed(turn), spin, axis)


def _arms(run: Trajectory, body: Body) -> tuple[Triple, ...]:
    """From the centre of mass to where joints hold it."""
    held: list[Vector] = []
    for element in equations_of(run).system.elements:
        owner, at, to = (getattr(element, name, None) for name in ("body", "at", "to"))
        if isinstance(at, Vector) and owner == body:
            held.append(at)
        if isinstance(to, BodyPoint) and to.body == body:
            held.append(to.offset)
    arms = (_fixed(run, offset, body) for offset in held)
    return tuple(arm for arm in arms if arm is not None)


def _fixed(run: Trajectory, vector: Vector, body: Body) -> Triple | None:
    """Components along a body's axes; None if they vary."""
    components = vector.express(body.axes).components
    if any(component.varies for component in components):
        return None
    return _triple(constants(run, components))


def _triple(values: Sequence[float] | Array) -> Triple:
    x, y, z = (float(value) for value in values)
    return x, y, z


# --- shapes: from the surface that touches a support, or otherwise from the inertia ---


@singledispatch
def _shape(surface: Surface | None, body: Body, run: Trajectory) -> BodyShape:
    profile = surface.profile if surface is not None else None
    if profile is None:
        return _equivalent(body, run)
    lengths = constants(run, [length for point in profile.outline for length in point])
    return BodyShape("revolution", lengths, *_directions(body.axes.position(profile.axis)))


@_shape.register
def _(surface: Round, body: Body, run: Trajectory) -> BodyShape:
    radius, offset = constants(run, [surface.radius, surface.offset])
    if not offset:
        return BodyShape("ball", (radius,))
    axis, across = _directions(body.axes.position(surface.axis))
    x, y, z = (offset * part for part in axis)
    return BodyShape("ball", (radius,), axis, across, (x, y, z))


@_shape.register
def _(surface: Ellipsoidal, body: Body, run: Trajectory) -> BodyShape:
    first, second, third, *centre = constants(run, (*surface.half_axes, *surface.offset))
    return BodyShape("ellipsoid", (first, second, third), centre=_triple(centre))


@_shape.register
def _(surface: Face, body: Body, run: Trajectory) -> BodyShape:
    (height,) = constants(run, [surface.height])
    return BodyShape("box", (3 * height, 2.4 * height, 2 * height))


@_shape.register
def _(surface: Rim, body: Body, run: Trajectory) -> BodyShape:
    position = body.axes.position(surface.axis)
    moment = body.inertia[position, position]
    radius, offset, mass, about = constants(
        run, [surface.radius, surface.offset, body.mass, moment]
    )
    kind = "hoop" if about > _HOLLOW * mass * radius**2 else "disk"
    thick = 2 * abs(offset) or _THIN * radius
    return BodyShape(kind, (radius, thick), *_directions(position))


def _equivalent(body: Body, run: Trajectory) -> BodyShape:
    """A uniform body of the same mass and inertia; a point if these were not given."""
    entries = body.inertia.entries
    try:
        mass, *values = constants(run, [body.mass, *entries])
    except DeclarationError:  # the motion does not depend on them
        return BodyShape("ball", (0.0,))
    moments, turned = np.linalg.eigh(np.reshape(values, (3, 3)))
    if mass <= 0 or moments[-1] <= 0:
        return BodyShape("ball", (0.0,))
    first, middle, last = moments
    # The moment that differs most from the others goes last: that of the symmetry axis, if any.
    order = [1, 2, 0] if last - middle < middle - first else [0, 1, 2]
    moments, turned = moments[order], turned[:, order]
    directions = _triple(turned[:, 2]), _triple(turned[:, 0])
    if moments[2] <= _SAME * moments[0]:
        length = float(np.sqrt(12 * moments[0] / mass))
        return BodyShape("rod", (length, _SLENDER * length), *directions)
    if abs(moments[0] - moments[1]) <= _SAME * moments[0]:
        return _wheel(mass, moments, directions)
    return _slab(mass, moments, turned)


def _wheel(mass: float, moments: Array, directions: tuple[Triple, Triple]) -> BodyShape:
    """A cylinder, or a wheel with spokes where it has no thickness."""
    across, about = moments[0], moments[2]
    # A uniform cylinder has m r²/2 about its axis and m (3 r² + h²)/12 across it.
    radius = float(np.sqrt(2 * about / mass))
    squared = 12 * across / mass - 3 * radius**2
    if squared > (_FLAT * radius) ** 2:
        return BodyShape("disk", (radius, float(np.sqrt(squared))), *directions)
    rim = float(np.sqrt(about / mass))
    return BodyShape("wheel", (rim, 2 * _THIN * rim), *directions)


def _slab(mass: float, moments: Array, turned: Array) -> BodyShape:
    """A box, or a racquet where it is a long lamina."""
    total = float(np.sum(moments))
    # A uniform box with sides a, b, c has I_a = m (b² + c²)/12 and so on cyclically, so that
    # a² = 6 (I_a + I_b + I_c - 2 I_a)/m.
    squares = np.clip(6 * (total - 2 * moments) / mass, 0, None)
    order = np.argsort(-squares)
    long, wide, thick = (float(side) for side in np.sqrt(squares[order]))
    axis, across = _triple(turned[:, order[0]]), _triple(turned[:, order[1]])
    lamina = thick < _FLAT * long
    if lamina and long > _LONG * wide:
        return BodyShape("racquet", (long, wide, _THIN * wide), axis, across)
    return BodyShape("box", (long, wide, max(thick, _FLAT * long)), axis, across)


def _directions(position: int) -> tuple[Triple, Triple]:
    """Along an axis, and across it."""
    unit = np.eye(3)
    return _triple(unit[position]), _triple(unit[(position + 1) % 3])


# --- joints and links ---


def joints_of(run: Trajectory) -> tuple[Joint, ...]:
    """A joint for every point that is held; two crossed ones for a universal joint."""
    points = [e for e in equations_of(run).system.elements if isinstance(e, Pivot | Hold)]
    return tuple(joint for point in points for joint in _joints(run, point))


def _joints(run: Trajectory, point: Pivot | Hold) -> Iterator[Joint]:
    system = equations_of(run).system
    place = _fixed(run, point.at, point.body)
    if place is None:
        return
    body = list(system.bodies).index(point.body)
    if isinstance(point, Weld | Hold):
        yield Joint("weld", point.name, body, place, _UPRIGHT)
        return
    couples = [e for e in system.elements if isinstance(e, Hinge | Universal)]
    # hinges and universal joints between the same two bodies as the point
    turning = [e for e in couples if e.body == point.body and e.to == point.other]
    if not turning:
        yield Joint("pivot", point.name, body, place, _UPRIGHT)
    for couple in turning:
        yield from _turning(run, couple, point, body, place)


def _turning(
    run: Trajectory, couple: Hinge | Universal, point: Pivot, body: int, place: Triple
) -> Iterator[Joint]:
    if isinstance(couple, Hinge):
        axis = _fixed(run, couple.body.axes[couple.axis], couple.body)
        yield Joint("hinge", couple.name, body, place, axis or _UPRIGHT)
        return
    arm = _fixed(run, couple.arm, couple.body)
    yield Joint("universal", couple.name, body, place, arm or _UPRIGHT)
    if isinstance(point.to, BodyPoint):
        other = point.to
        arm, place_there = (_fixed(run, v, other.body) for v in (couple.other_arm, other.offset))
        if arm and place_there:
            number = list(run.equations.system.bodies).index(other.body)
            yield Joint("universal", couple.name, number, place_there, arm)


def links_of(run: Trajectory, t: Array) -> tuple[Link, ...]:
    """Springs, dampers and ropes with their ends at the given instants."""
    system = equations_of(run).system
    found = [(load.name, load.link) for load in system.loads if load.link is not None]
    found += [(element.name, link) for element in system.elements for link in element.links]
    return tuple(_link(run, name, link, t) for name, link in found)


def _link(run: Trajectory, name: str, link: TwoPointLink, t: Array) -> Link:
    start, end = (_path(run, point, t) for point in (link.start, link.end))
    longest = float(np.max(np.linalg.norm(start - end, axis=1)))
    return Link(link.kind, name, start, end, _THICKNESS[link.kind] * longest)


def _path(run: Trajectory, point: BodyPoint | Vector, t: Array) -> Array:
    def place(equations: Equations) -> Vector:
        if isinstance(point, Vector):
            return point
        return equations.kinetics.places[point.body] + point.offset

    return collapsed(vectors(run, place, t))


# --- arrows ---


def arrows_of(run: Trajectory, t: Array, sizes: Magnitudes) -> tuple[Arrow, ...]:
    """Forces of contacts and joints, loads, torques, angular velocities and momenta.

    Components that only rounding has left are zero.
    """
    system = equations_of(run).system
    bodies = list(system.bodies)
    attached: dict[str, Body] = {}
    for equations in modes_of(run):
        for name, reaction in equations.reactions.items():
            attached.setdefault(name, reaction.body)
    drawn = partial(_arrow, sizes)
    found = [
        drawn(
            "force", f"force at {name}", "", bodies.index(body), "N", *_reaction(run, name, body, t)
        )
        for name, body in attached.items()
    ]
    found += [
        drawn("load", f"{load.name} on {body.name}", _letter(load, body), i, "N", force)
        for load in system.loads
        for i, body in enumerate(bodies)
        for force in (_force(run, load, body, t),)
    ]
    for i, body in enumerate(bodies):
        found += [
            drawn(kind, f"{words} {body.name}", "", i, unit, values, foot)
            for kind, words, unit, values, foot in _rotation(run, body, t)
        ]
    kinds = dict.fromkeys(arrow.kind for arrow in found)
    largest = {kind: max(a.largest for a in found if a.kind == kind) for kind in kinds}
    return tuple(a for a in found if a.largest > _UNSEEN * largest[a.kind])


def _letter(load: Load, body: Body) -> str:
    """The weight as the model writes it; other loads have no letter in common."""
    return inline(body.mass * load.g) if isinstance(load, Gravity) else ""


def _reaction(run: Trajectory, name: str, body: Body, t: Array) -> tuple[Array, Array]:
    """A reaction, N, and where it acts, m."""

    def force(equations: Equations) -> Vector | None:
        reaction = equations.reactions.get(name)
        if reaction is None:
            return None
        # Components that Newton's laws leave undetermined get the least-squares choice.
        undetermined = map(Symbol, equations.undetermined)
        least = {Expr.generator(s): equations.least[s.name] for s in undetermined}
        return reaction.force.subs({**least})

    def foot(equations: Equations) -> Vector:
        reaction = equations.reactions.get(name)
        place = equations.kinetics.places[body]
        return place if reaction is None else place + reaction.arm

    return vectors(run, force, t), collapsed(vectors(run, foot, t))


def _force(run: Trajectory, load: Load, body: Body, t: Array) -> Array:
    """The force of a load on a body, N."""

    def force(equations: Equations) -> Vector:
        actions = _actions(equations, body, load.name)
        return sum((a.force for a in actions), start=equations.system.root.zero)

    return vectors(run, force, t)


def _rotation(
    run: Trajectory, body: Body, t: Array
) -> Iterator[tuple[str, str, str, Array, Array]]:
    """Torque, angular velocity and momentum: kind, words, unit, components, and where they begin.

    Torque and momentum are about the point that a pivot keeps at rest, if there is one.
    """
    pivot = _held_at_rest(run, body)
    about = "the pivot" if pivot else "the centre"

    def arm(equations: Equations) -> Vector:
        """From that point to the centre of mass."""
        return equations.system.root.zero if pivot is None else -pivot.at

    def torque(equations: Equations) -> Vector:
        """Of all loads and reactions."""
        total = equations.system.root.zero
        for line in equations.lines:
            wrench = line.on(body)
            if wrench is not None:
                couple = wrench.couple + arm(equations).cross(wrench.force)
                total = total + couple * equations.least[line.name]
        for action in _actions(equations, body):
            total = total + action.couple + (arm(equations) + action.arm).cross(action.force)
        return total

    def omega(equations: Equations) -> Vector:
        return equations.kinetics.velocities[body][1]

    def momentum(equations: Equations) -> Vector:
        velocity, turning = equations.kinetics.velocities[body]
        own = Vector(body.inertia.times(turning.express(body.axes).components), body.axes)
        return own + arm(equations).cross(velocity) * body.mass

    def foot(equations: Equations) -> Vector:
        return equations.kinetics.places[body] - arm(equations)

    begins = NOWHERE if pivot is None else collapsed(vectors(run, foot, t))
    yield "torque", f"torque about {about} of", "N m", vectors(run, torque, t), begins
    yield "omega", "angular velocity of", "rad/s", vectors(run, omega, t), NOWHERE
    yield (
        "momentum",
        f"angular momentum about {about} of",
        "kg m²/s",
        vectors(run, momentum, t),
        begins,
    )


def _held_at_rest(run: Trajectory, body: Body) -> Pivot | None:
    """The only pivot at rest, unless it holds the centre of mass."""
    elements = equations_of(run).system.elements
    held = [e for e in elements if isinstance(e, Pivot) and e.body == body and e.is_at_rest]
    return held[0] if len(held) == 1 and not held[0].at.is_zero else None


def _actions(equations: Equations, body: Body, only: str = "") -> list[Action]:
    """The actions of loads on a body; of a single load if it is named."""
    loads = [load for load in equations.system.loads if only in ("", load.name)]
    return [a for load in loads for a in equations.actions(load) if a.body == body]


def _arrow(
    sizes: Magnitudes,
    kind: str,
    name: str,
    symbol: str,
    body: int,
    unit: str,
    values: Array,
    foot: Array = NOWHERE,
) -> Arrow:
    finite = np.nan_to_num(values, posinf=0.0, neginf=0.0)
    shown = sizes.without_rounding(finite, unit)
    lengths = np.linalg.norm(shown, axis=1)
    usual, largest = float(np.quantile(lengths, _USUAL)), float(np.max(lengths))
    return Arrow(kind, name, symbol, body, unit, foot, collapsed(shown), usual, largest)

"""What is drawn of a system, as expressions in the equations of each of its contact modes.

`_scene_bodies` and `_scene_supports` evaluate them along a motion that has been followed; a live
page has a kernel that computes them for motions of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from polhode.algebra import Expr, Symbol, Vector
from polhode.derive import Equations
from polhode.model import (
    Action,
    Body,
    BodyPoint,
    Contact,
    DryFriction,
    Element,
    Gravity,
    Hinge,
    Hold,
    Load,
    Pivot,
    Plane,
    Smooth,
    Support,
    System,
    TwoPointLink,
    Universal,
    Weld,
)
from polhode.view._mathml import inline

#: A vector in the equations of one contact mode; None where it is not defined.
VectorInMode = Callable[[Equations], Vector | None]

_CENTRE = "centre"
_PIVOT = "pivot"


# -- bodies and links ------------------------------------------------------------------------------


def place_of(body: Body) -> VectorInMode:
    """Its centre of mass."""
    return lambda equations: equations.kinetics.places[body]


def turning_of(body: Body) -> VectorInMode:
    """Angular velocity against the root frame; of a ball without axes it gives the attitude."""

    def turning(equations: Equations) -> Vector:
        carried = equations.system.root.angular_velocity
        return equations.kinetics.velocities[body][1] - carried

    return turning


def labels_of(body: Body) -> tuple[str, ...]:
    """Names of its axes; none for a ball whose attitude no coordinates describe."""
    return () if body.fixed_axes is None else body.axes.labels


def links_in(system: System) -> Iterator[tuple[str, TwoPointLink]]:
    """Springs, dampers and ropes, each with its name."""
    yield from ((load.name, load.link) for load in system.loads if load.link is not None)
    for element in system.elements:
        yield from ((element.name, link) for link in element.links)


def end_of_link(point: BodyPoint | Vector) -> VectorInMode:
    """An end of a link: a point of a body, or one that is fixed."""

    def place(equations: Equations) -> Vector:
        if isinstance(point, Vector):
            return point
        return equations.kinetics.places[point.body] + point.offset

    return place


def sided_in(system: System) -> set[Body | None]:
    """Bodies with a flat side that another touches: that side is drawn in their place."""
    return {contact.on.carrier for contact in system.contacts if isinstance(contact.on, Plane)}


def arms_in(system: System, body: Body) -> Iterator[tuple[Expr, ...]]:
    """From the centre of mass of a body to where joints hold it, along its axes."""
    held: list[Vector] = []
    for element in system.elements:
        owner, at, to = (getattr(element, name, None) for name in ("body", "at", "to"))
        if isinstance(at, Vector) and owner == body:
            held.append(at)
        if isinstance(to, BodyPoint) and to.body == body:
            held.append(to.offset)
    arms = (_fixed(offset, body) for offset in held)
    yield from (arm for arm in arms if arm is not None)


def _fixed(vector: Vector, body: Body) -> tuple[Expr, ...] | None:
    """Components along the axes of a body; None if they vary."""
    components = tuple(vector.express(body.axes).components)
    return None if any(component.varies for component in components) else components


@dataclass(frozen=True)
class DrawnJoint:
    """What a body turns on; see `Joint` of the scene.

    Attributes:
        place: along the axes of the body, from its centre of mass.
        axis: along the same; None where the joint has none.
    """

    kind: str
    name: str
    body: Body
    place: tuple[Expr, ...]
    axis: tuple[Expr, ...] | None = None


def joints_in(system: System) -> Iterator[DrawnJoint]:
    """A joint for every point that is held; two crossed ones for a universal joint."""
    for point in system.elements:
        if isinstance(point, Pivot | Hold):
            yield from _joints(system, point)


def _joints(system: System, point: Pivot | Hold) -> Iterator[DrawnJoint]:
    place = _fixed(point.at, point.body)
    if place is None:
        return
    if isinstance(point, Weld | Hold):
        yield DrawnJoint("weld", point.name, point.body, place)
        return
    couples = [e for e in system.elements if isinstance(e, Hinge | Universal)]
    # hinges and universal joints between the same two bodies as the point
    turning = [e for e in couples if e.body == point.body and e.to == point.other]
    if not turning:
        yield DrawnJoint("pivot", point.name, point.body, place)
    for couple in turning:
        yield from _turning(couple, point, place)


def _turning(
    couple: Hinge | Universal, point: Pivot, place: tuple[Expr, ...]
) -> Iterator[DrawnJoint]:
    body = point.body
    if isinstance(couple, Hinge):
        axis = _fixed(couple.body.axes[couple.axis], couple.body)
        yield DrawnJoint("hinge", couple.name, body, place, axis)
        return
    yield DrawnJoint("universal", couple.name, body, place, _fixed(couple.arm, couple.body))
    if isinstance(point.to, BodyPoint):
        other = point.to
        arm, place_there = (_fixed(v, other.body) for v in (couple.other_arm, other.offset))
        if arm and place_there:
            yield DrawnJoint("universal", couple.name, other.body, place_there, arm)


# -- supports --------------------------------------------------------------------------------------


def contacts_in(system: System) -> Iterator[Contact]:
    """Contacts, open or closed, as they were declared."""
    for element in system.elements:
        contact = getattr(element, "contact", element)  # an open contact wraps the declared one
        if isinstance(contact, Contact):
            yield contact


def contact_point(contact: Contact, on: Support | None = None) -> VectorInMode:
    """Where a body touches; nowhere in flight.

    Args:
        on: if given, nowhere either where it touches another support, such as the table beyond the
            edge of a sheet.
    """

    def place(equations: Equations) -> Vector | None:
        element = equations.system.element(contact.name)
        if not isinstance(element, Contact) or on not in (None, element.on):
            return None
        return equations.kinetics.places[contact.body] + contact.arm

    return place


def base_of(contact: Contact) -> VectorInMode:
    """The origin of the support of a contact."""
    return lambda equations: contact.base(equations.kinetics.places) + contact.on.origin


def directions_of(contact: Contact) -> tuple[Expr, ...]:
    """Two directions along a support and its normal, as the columns of a matrix, row by row."""
    support = contact.on
    triad = [direction.express(support.axes.root) for direction in support.directions]
    return tuple(direction.components[i] for i in range(3) for direction in triad)


# -- arrows ----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class DrawnArrow:
    """A vector that is drawn as an arrow.

    Attributes:
        kind: force, load, torque, omega or momentum.
        name: what it is, in words.
        symbol: MathML, as m g; empty for the letter of its kind.
        body: it acts on.
        unit: of its components.
        along: the vector.
        foot: where it begins; None for the centre of mass of the body.
        normal: of a contact with friction, or one that rolls.
        friction: coefficient of static friction of such a contact; None where it has none.
    """

    kind: str
    name: str
    symbol: str
    body: Body
    unit: str
    along: VectorInMode
    foot: VectorInMode | None = None
    normal: VectorInMode | None = None
    friction: Expr | None = None


def arrows_in(system: System, modes: Sequence[Equations]) -> Iterator[DrawnArrow]:
    """Forces of contacts and joints, loads, torques, angular velocities and momenta."""
    attached: dict[str, Body] = {}
    for equations in modes:
        for name, reaction in equations.reactions.items():
            attached.setdefault(name, reaction.body)
    for name, body in attached.items():
        element = system.element(name)
        force, foot = _reaction(name, body, limited=isinstance(element, DryFriction))
        letter = inline(Expr.generator(Symbol(element.force))) if hasattr(element, "force") else ""
        about = f"force at {name}"
        normal, friction = _normal(element), _friction(element)
        yield DrawnArrow("force", about, letter, body, "N", force, foot, normal, friction)
    for load in system.loads:
        for body in system.bodies:
            force = _force(load, body)
            yield DrawnArrow(
                "load", f"{load.name} on {body.name}", _letter(load, body), body, "N", force
            )
    for body in system.bodies:
        yield from _rotation(system, body)


def _normal(element: Element) -> VectorInMode | None:
    """The normal of a contact whose force may have another part."""
    if not isinstance(element, Contact) or isinstance(element, Smooth):
        return None

    def normal(equations: Equations) -> Vector:
        present = equations.system.element(element.name)
        return present.on.up if isinstance(present, Contact) else element.on.up

    return normal


def _friction(element: Element) -> Expr | None:
    return element.mu_static if isinstance(element, DryFriction) else None


def _letter(load: Load, body: Body) -> str:
    """The weight as the model writes it; other loads have no letter in common."""
    return inline(body.mass * load.g) if isinstance(load, Gravity) else ""


def _reaction(name: str, body: Body, *, limited: bool) -> tuple[VectorInMode, VectorInMode]:
    """A reaction, and where it acts.

    Components that Newton's laws leave undetermined get the least-squares choice, unless friction
    limits them, which that choice knows nothing of.
    """

    def force(equations: Equations) -> Vector | None:
        reaction = equations.reactions.get(name)
        if reaction is None or (limited and equations.undetermined):
            return None
        undetermined = map(Symbol, equations.undetermined)
        least = {Expr.generator(s): equations.least[s.name] for s in undetermined}
        return reaction.force.subs({**least})

    def foot(equations: Equations) -> Vector:
        reaction = equations.reactions.get(name)
        place = equations.kinetics.places[body]
        return place if reaction is None else place + reaction.arm

    return force, foot


def _force(load: Load, body: Body) -> VectorInMode:
    """The force of a load on a body."""

    def force(equations: Equations) -> Vector:
        actions = _actions(equations, body, load.name)
        return sum((a.force for a in actions), start=equations.system.root.zero)

    return force


def _rotation(system: System, body: Body) -> Iterator[DrawnArrow]:
    """Torque, angular velocity and momentum.

    Torque and momentum are about the point that a pivot keeps at rest, if there is one.
    """
    pivot = _held_at_rest(system, body)
    about = _CENTRE if pivot is None else _PIVOT

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

    begins = None if pivot is None else foot
    of = f"about the {about} of {body.name}"
    yield DrawnArrow("torque", f"torque {of}", "", body, "N m", torque, begins)
    yield DrawnArrow("omega", f"angular velocity of {body.name}", "", body, "rad/s", omega)
    yield DrawnArrow("momentum", f"angular momentum {of}", "", body, "kg m²/s", momentum, begins)


def _held_at_rest(system: System, body: Body) -> Pivot | None:
    """The only pivot at rest, unless it holds the centre of mass."""
    held = [e for e in system.elements if isinstance(e, Pivot) and e.body == body and e.is_at_rest]
    return held[0] if len(held) == 1 and not held[0].at.is_zero else None


def _actions(equations: Equations, body: Body, only: str = "") -> list[Action]:
    """The actions of loads on a body; of a single load if it is named."""
    loads = [load for load in equations.system.loads if only in ("", load.name)]
    return [a for load in loads for a in equations.actions(load) if a.body == body]

"""The angles that are drawn: of every rotation that leads from the root frame to some axes.

An arc of an angle begins where the direction that it turns would be if the angle were zero. Which
direction that is follows from the rotations: the axis of a top for its inclination, the line of
nodes for its azimuth, the arm of a pendulum, the normal of a curved support.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass

from polhode.algebra import ONE, ZERO, Expr, Row, Symbol, Vector, cos, dot, rotation, sin
from polhode.derive import Equations
from polhode.model import Body, CurvedSupport, Frame, Pivot, System
from polhode.view._drawn import VectorInMode, base_of, contacts_in, place_of
from polhode.view._mathml import inline

_UNITS: tuple[Row, ...] = ((ONE, ZERO, ZERO), (ZERO, ONE, ZERO), (ZERO, ZERO, ONE))


@dataclass(frozen=True)
class DrawnRotation:
    """One of the rotations that lead from the root frame to some axes.

    Attributes:
        symbol: MathML of its angle; empty where no arc of it is drawn.
        angle: by which it turns, rad.
        axis: by components along the directions before it or after it, in which they are equal.
        begin: direction from which the arc begins, along the directions before it.
        offset: of the angle, where the arc begins, rad.
        coordinate: published name of the coordinate, or parameter, that the arc is; empty for
            other angles.
        sign: 1, or -1 where it turns the other way round.
    """

    symbol: str
    angle: Expr
    axis: Row
    begin: Row
    offset: Expr
    coordinate: str = ""
    sign: int = 1


@dataclass(frozen=True)
class DrawnAngles:
    """The angles of the rotations to some axes, drawn around a point.

    Attributes:
        name: of the body or contact whose axes they are.
        body: position of a body among the bodies, by whose size they are drawn.
        vertex: the point.
        rotations: from the first to the last.
    """

    name: str
    body: int
    vertex: VectorInMode
    rotations: tuple[DrawnRotation, ...]


def angles_in(system: System) -> Iterator[DrawnAngles]:
    """The angles of curved supports, then of bodies; each rotation is drawn once."""
    drawn: set[Frame] = set()
    for angles, axes in _chains(system, drawn):
        if any(rotation.symbol for rotation in angles.rotations):
            yield angles
        drawn.update(axes.lineage)


def _chains(system: System, drawn: Container[Frame]) -> Iterator[tuple[DrawnAngles, Frame]]:
    """The rotations to the axes of every curved support and body, and those axes.

    Args:
        system: the system.
        drawn: frames whose rotation is drawn already; it grows meanwhile.
    """
    bodies = list(system.bodies)
    for contact in contacts_in(system):
        on = contact.on
        if isinstance(on, CurvedSupport) and on.carrier is None:
            rotations = _rotations(on.axes, _from_centre(on), drawn)
            owner = bodies.index(contact.body)
            yield DrawnAngles(contact.name, owner, base_of(contact), rotations), on.axes
    for i, body in enumerate(bodies):
        axes = body.fixed_axes
        if axes is not None:
            vertex, arm = _vertex(system, body)
            yield DrawnAngles(body.name, i, vertex, _rotations(axes, arm, drawn)), axes


def _from_centre(on: CurvedSupport) -> Vector:
    """From the centre or axis of a support towards the point of contact."""
    return -on.up if on.inside else on.up


def _vertex(system: System, body: Body) -> tuple[VectorInMode, Vector | None]:
    """The point that holds a body, or else its centre of mass; and the arm to the latter."""
    held = [e.at for e in system.elements if isinstance(e, Pivot) and e.body == body]
    touching = [c.at for c in contacts_in(system) if c.body == body and c.at is not None]
    offset = next(iter([*held, *touching]), None)
    if offset is None or offset.is_zero or not body.keeps(offset):
        return place_of(body), None

    def vertex(equations: Equations) -> Vector:
        return equations.kinetics.places[body] + offset

    return vertex, -offset


def _rotations(
    axes: Frame, arm: Vector | None, drawn: Container[Frame]
) -> tuple[DrawnRotation, ...]:
    """The rotations from the root frame to some axes.

    Args:
        axes: to which they lead.
        arm: the direction that they are seen by; by default the axis of the last one.
        drawn: frames whose rotation is drawn already, with other axes.
    """
    found: list[DrawnRotation] = []
    # where that direction points as long as all later letters, or all later angles, are zero
    lettered = unturned = _marked(axes, arm)
    following: tuple[Row, ...] = ()
    for frame in axes.lineage[:-1]:  # without the root
        offset = _offset(frame.angle)
        at_zero = offset or ZERO
        letter, sign = _lettered(frame.angle - at_zero)
        is_drawn = frame not in drawn and offset is not None
        symbol = inline(letter) if is_drawn else ""
        coordinate = letter.symbol.published if is_drawn and letter.symbol else ""
        candidates = (*lettered, *unturned, *following, *_cyclic(frame.axis))
        begin = _rotated(_across(candidates, frame.axis), frame.axis, at_zero)
        found.append(
            DrawnRotation(symbol, frame.angle, frame.axis, begin, at_zero, coordinate, sign)
        )
        lettered = tuple(_rotated(mark, frame.axis, at_zero) for mark in lettered)
        following = (frame.axis,)
    return tuple(reversed(found))


def _marked(axes: Frame, arm: Vector | None) -> tuple[Row, ...]:
    """Directions that the rotations are seen by, along the axes they lead to."""
    if arm is None:
        return (axes.axis,)
    components = tuple(arm.express(axes).components)
    return () if any(c.varies for c in components) else (components,)


def _cyclic(axis: Row) -> tuple[Row, ...]:
    """Directions across an axis: first the one after it, from which a wheel's marks count."""
    position = next((i for i, part in enumerate(axis) if not part.is_zero), 0)
    return tuple(_UNITS[(position + k) % 3] for k in (1, 2))


def _offset(angle: Expr) -> Expr | None:
    """What an angle is where its letters are zero; None unless it is a polynomial in them."""
    letters = [g for g in angle.generators if str(g) != "pi"]
    if not letters or not all(isinstance(letter, Symbol) for letter in letters):
        return None
    return angle.subs({Expr.generator(letter): 0 for letter in letters})


def _lettered(angle: Expr) -> tuple[Expr, int]:
    """What an angle is called, and its sign: one letter, whichever way round it is counted."""
    letters = [Expr.generator(g) for g in angle.generators]
    if len(letters) == 1 and angle in (letters[0], -letters[0]):
        return letters[0], 1 if angle == letters[0] else -1
    return angle, 1


def _across(candidates: Sequence[Row], axis: Row) -> Row:
    """The part across an axis of the first direction that is not along it."""
    for direction in candidates:
        along = dot(direction, axis)
        parts = tuple(d - along * a for d, a in zip(direction, axis, strict=True))
        if any(not part.is_zero for part in parts):
            x, y, z = parts
            return x, y, z
    raise AssertionError("two directions across an axis are along it")


def _rotated(v: Row, axis: Row, angle: Expr) -> Row:
    """A vector rotated about a unit vector."""
    return rotation(axis, cos(angle), sin(angle)).times(v)

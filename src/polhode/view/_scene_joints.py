"""What bodies turn on, and the springs and dampers between them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeGuard

import numpy as np

from polhode.algebra import Vector
from polhode.derive import Equations
from polhode.model import (
    Body,
    BodyPoint,
    Damper,
    Element,
    Hinge,
    Hold,
    Load,
    Pivot,
    Spring,
    Universal,
    Weld,
)
from polhode.simulate import Trajectory
from polhode.view._quantities import Array
from polhode.view._scene import Joint, Link, Triple
from polhode.view._scene_along import collapsed, constants, vectors

_COIL = 0.035  # radius of a spring against its greatest length
_ROD = 0.022  # radius of a damper likewise
_UPRIGHT: Triple = (0.0, 0.0, 1.0)


def joints_of(run: Trajectory) -> tuple[Joint, ...]:
    """One for every point that is held; a cross of two for a universal joint."""
    elements = run.equations.system.elements
    points = [e for e in elements if isinstance(e, Pivot | Hold)]
    return tuple(joint for point in points for joint in _joints(run, point, elements))


def _joints(run: Trajectory, point: Pivot | Hold, elements: tuple[Element, ...]) -> Iterator[Joint]:
    place = _fixed(run, point.at, point.body)
    if place is None:
        return
    body = list(run.equations.system.bodies).index(point.body)
    if isinstance(point, Weld | Hold):
        yield Joint("weld", point.name, body, place, _UPRIGHT)
        return
    turning = [e for e in elements if isinstance(e, Hinge | Universal) and _with(e, point)]
    if not turning:
        yield Joint("pivot", point.name, body, place, _UPRIGHT)
    for couple in turning:
        yield from _turning(run, couple, point, body, place)


def _with(couple: Hinge | Universal, point: Pivot) -> bool:
    """Whether a couple and a point hold the same two bodies together."""
    return couple.body == point.body and couple.to == point.other


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


def _fixed(run: Trajectory, vector: Vector, body: Body) -> Triple | None:
    """Components along a body's axes, where they stay the same."""
    components = vector.express(body.axes).components
    if any(s.kind.varies for component in components for s in component.symbols()):
        return None
    x, y, z = constants(run, components)
    return x, y, z


def links_of(run: Trajectory, t: Array) -> tuple[Link, ...]:
    """Springs and dampers with their ends at the given instants."""
    loads = run.equations.system.loads
    return tuple(_link(run, load, t) for load in loads if _is_link(load))


def _is_link(load: Load) -> TypeGuard[Spring | Damper]:
    return isinstance(load, Spring | Damper)


def _link(run: Trajectory, load: Spring | Damper, t: Array) -> Link:
    start, end = (_along(run, point, t) for point in (load.start, load.end))
    longest = float(np.max(np.linalg.norm(start - end, axis=1)))
    kind, share = ("spring", _COIL) if isinstance(load, Spring) else ("damper", _ROD)
    return Link(kind, load.name, start, end, share * longest)


def _along(run: Trajectory, point: BodyPoint | Vector, t: Array) -> Array:
    def place(equations: Equations) -> Vector:
        if isinstance(point, Vector):
            return point
        return equations.kinetics.places[point.body] + point.offset

    return collapsed(vectors(run, place, t))

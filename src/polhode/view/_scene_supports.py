"""Supports of the scene, and the paths that are left on them and in space."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from scipy.integrate import cumulative_simpson

from polhode.algebra import Vector
from polhode.derive import Equations
from polhode.model import Contact, Plane
from polhode.simulate import Trajectory
from polhode.view._quantities import Array
from polhode.view._scene import Pose, SceneBody, Support, Trace
from polhode.view._scene_along import along, collapsed, quaternions, vectors
from polhode.view._shapes import reach_of

_ROOM = 2.6  # of a body's reach: margin of a support round the path of the contact
_BEYOND = 1.1  # of a body's reach: where the end of its axis leaves a trace
_MOVING = 1e-9


def supports_of(
    run: Trajectory, t: Array, reach: float
) -> tuple[tuple[Support, ...], tuple[Trace, ...]]:
    """Supports that bodies touch, each once, and the paths of the contacts."""
    supports: dict[Plane, Support] = {}
    traces: list[Trace] = []
    for contact in _contacts(run):
        plane = contact.on
        pose = _pose(run, plane, t)
        points = vectors(run, _touching(contact), t)
        on_it = _carried(points, pose)
        if plane not in supports:
            supports[plane] = _support(contact, pose, on_it, reach)
        traces.append(Trace("contact", f"path of {contact.name}", points))
        if len(pose.place) > 1 or len(pose.turn) > 1:
            number = list(supports).index(plane)
            traces.append(Trace("contact", f"trace on {contact.name}", on_it, number))
    return tuple(supports.values()), tuple(traces)


def other_traces(bodies: tuple[SceneBody, ...]) -> Iterator[Trace]:
    """Paths of centres of mass that move, and of the ends of axes about those that do not."""
    for body in bodies:
        pose, shape = body.pose, body.shape
        if len(pose.place) > 1:
            yield Trace("centre", f"centre of {body.name}", pose.place)
        elif len(pose.turn) > 1 and shape.kind != "ball":
            tip = np.array(shape.axis) * _BEYOND * reach_of(shape)
            yield Trace("axis", f"axis of {body.name}", pose.place + _turned(tip, pose.turn))


def _contacts(run: Trajectory) -> list[Contact]:
    """Contacts of the declaration, whatever phase they begin in."""
    elements = run.equations.system.elements
    found = (getattr(element, "contact", element) for element in elements)
    return [contact for contact in found if isinstance(contact, Contact)]


def _touching(contact: Contact) -> Callable[[Equations], Vector | None]:
    def place(equations: Equations) -> Vector | None:
        element = equations.system.element(contact.name)
        if not isinstance(element, Contact):
            return None
        return equations.kinetics.places[contact.body] + contact.arm

    return place


def _pose(run: Trajectory, plane: Plane, t: Array) -> Pose:
    """Of the surface, its third direction along the normal."""
    root = plane.axes.root
    triad = [plane.axes[label].express(root) for label in (*plane.tangents, plane.normal)]
    entries = [direction.components[i] for i in range(3) for direction in triad]
    turn = quaternions(along(run, lambda equations: entries, 9, t).reshape(-1, 3, 3))
    place = vectors(run, lambda equations: plane.origin, t)
    turning = along(run, lambda equations: [plane.turning], 1, t)[:, 0]
    angle: Array = cumulative_simpson(turning, x=t, initial=0.0)
    if np.ptp(angle) <= _MOVING:
        return Pose(collapsed(place), collapsed(turn), np.zeros(0), (0.0, 0.0, 1.0))
    return Pose(collapsed(place), turned_about_third(turn, angle), np.zeros(0), (0.0, 0.0, 1.0))


def turned_about_third(turn: Array, angle: Array) -> Array:
    """Attitudes turned further about their own third direction."""
    x, y, z, w = turn.T
    s, c = np.sin(angle / 2), np.cos(angle / 2)
    found: Array = np.stack([c * x + s * y, c * y - s * x, c * z + s * w, c * w - s * z], axis=1)
    return found


def _carried(points: Array, pose: Pose) -> Array:
    """Points as seen from a surface that moves, along its own directions."""
    back = pose.turn * np.array([-1.0, -1.0, -1.0, 1.0])
    return _turned(points - pose.place, back)


def _turned(vector: Array, turn: Array) -> Array:
    """Vectors turned by quaternions."""
    u, w = turn[:, :3], turn[:, 3:]
    cross = np.cross(u, vector)
    found: Array = vector + 2 * (w * cross + np.cross(u, cross))
    return found


def _support(contact: Contact, pose: Pose, path: Array, reach: float) -> Support:
    kind = type(contact.on).__name__.lower()
    flat = path[np.isfinite(path).all(axis=1), :2]
    low, high = (flat.min(0), flat.max(0)) if len(flat) else (np.zeros(2), np.zeros(2))
    middle, half = (low + high) / 2, (high - low) / 2 + _ROOM * reach
    if kind == "turntable":
        radius = float(np.max(np.linalg.norm(flat, axis=1), initial=0.0)) + reach
        middle, half = np.zeros(2), np.full(2, 1.08 * radius)
    return Support(
        contact.name,
        kind,
        pose,
        (float(middle[0]), float(middle[1])),
        (float(half[0]), float(half[1])),
    )

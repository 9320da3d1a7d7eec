"""Supports of a scene, flat and curved, and the paths of the contacts on them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from polhode.algebra import as_symbol
from polhode.model import (
    Cone,
    Contact,
    CurvedSupport,
    Cylinder,
    Face,
    Graph,
    Parametric,
    Revolution,
    Sheet,
    Sphere,
)
from polhode.model import Support as Surface
from polhode.simulate import Trajectory
from polhode.view import _rotations
from polhode.view._drawn import base_of, contact_point, contacts_in, directions_of
from polhode.view._quantities import Array, accumulated, equations_of
from polhode.view._scene import Pose, Support, Trace
from polhode.view._scene_along import along, collapsed, constants, quaternions, vectors

_ROOM = 2.6  # margin of a support around the path of the contact, in reaches of a body
_STILL = 1e-9  # rad: a support that turns by less is at rest
_FINE = (33, 65)  # points of a curved support across and around
_NOTHING: Array = np.zeros((0, 0, 3))
_LEVEL = 1e-9  # a smaller slope counts as level
_APART = 1e-4  # of two points from whose distance a stretch is found, in the coordinate's unit
_HALVINGS = 8  # of that margin, until a surface exists all over
_AXIS = 1e-3  # of the largest radius: how near to its axis a surface of revolution is drawn,
_DEEP = 3.0  # unless it is deeper than so many of these
_OPEN = 0.5 * np.pi  # rad: half of what is drawn of a bowl or trough, if the path is within


def supports_of(
    run: Trajectory, t: Array, reach: float
) -> tuple[tuple[Support, ...], tuple[Trace, ...]]:
    """Supports that bodies touch, each once, and the paths of the contacts."""
    supports: dict[Surface, Support] = {}
    traces: list[Trace] = []
    for contact in contacts_in(equations_of(run).system):
        plane = contact.on.under("")  # the same surface for every body
        pose = _support_pose(run, contact, t)
        points = vectors(run, contact_point(contact), t)
        seen_from = _rotations.inverse(pose.turn)
        touched = vectors(run, contact_point(contact, contact.on), t)
        on_it = _rotations.applied(seen_from, touched - pose.place)
        if plane not in supports:
            if plane.carrier is not None:
                drawn = _side
            else:
                drawn = _curved if isinstance(plane, CurvedSupport) else _flat
            supports[plane] = drawn(run, contact, pose, on_it, reach)
        traces.append(Trace("contact", f"path of {contact.name}", points))
        if len(pose.place) > 1 or len(pose.turn) > 1:
            number = list(supports).index(plane)
            traces.append(Trace("contact", f"trace on {contact.name}", on_it, number))
    return tuple(supports.values()), tuple(traces)


def _support_pose(run: Trajectory, contact: Contact, t: Array) -> Pose:
    """The pose of a support; the third direction of a flat one is along the normal."""
    entries = directions_of(contact)
    turn = quaternions(along(run, lambda equations: entries, 9, t).reshape(-1, 3, 3))
    place = vectors(run, base_of(contact), t)
    rate = along(run, lambda equations: [contact.on.turning], 1, t)[:, 0]
    angle = accumulated(rate, t)
    if np.ptp(angle) <= _STILL:
        turn = collapsed(turn)
    else:
        about_normal = _rotations.about(angle[:, None] * np.array([0.0, 0.0, 1.0]))
        turn = _rotations.product(turn, about_normal)
    return Pose(collapsed(place), turn, np.zeros(0), (0.0, 0.0, 1.0))


def _flat(run: Trajectory, contact: Contact, pose: Pose, path: Array, reach: float) -> Support:
    """A support that reaches beyond the path of a contact on it, but not beyond its edge."""
    plane = contact.on
    kind = type(plane).__name__.lower()
    flat = path[np.isfinite(path).all(axis=1), :2]
    low, high = (flat.min(0), flat.max(0)) if len(flat) else (np.zeros(2), np.zeros(2))
    low, high = low - _ROOM * reach, high + _ROOM * reach
    if kind == "turntable":
        radius = float(np.max(np.linalg.norm(flat, axis=1), initial=0.0)) + reach
        low, high = np.full(2, -1.08 * radius), np.full(2, 1.08 * radius)
    if isinstance(plane, Sheet) and plane.edge is not None:
        (high[0],) = constants(run, [plane.edge])
        low[0] = min(low[0], high[0] - _ROOM * reach)
    (x, y), (a, b) = (low + high) / 2, (high - low) / 2
    return Support(contact.name, kind, pose, (float(x), float(y)), (float(a), float(b)))


# -- curved ----------------------------------------------------------------------------------------


def _curved(run: Trajectory, contact: Contact, pose: Pose, path: Array, reach: float) -> Support:
    """A curved support as a grid of points, as far as a contact goes, or all around."""
    support = contact.on
    assert isinstance(support, CurvedSupport)
    u, v = patch_of(run, support, reach)
    points = _points(run, support, u, v)
    return Support(contact.name, "curved", pose, (0.0, 0.0), (0.0, 0.0), points)


def patch_of(run: Trajectory, support: CurvedSupport, reach: float) -> tuple[Array, Array]:
    """Values of u and v of a grid that covers what is to be drawn of a support."""
    rows, columns = _FINE
    around = np.linspace(-np.pi, np.pi, columns)
    t = np.linspace(0.0, run.duration, 2000)
    us, vs = (run.evaluate(as_symbol(q), t) for q in support.uv)
    if isinstance(support, Sphere):
        farthest = float(np.max(np.arccos(np.clip(np.cos(us) * np.cos(vs), -1, 1))))
        limit = min(max(_OPEN, 1.1 * farthest), np.pi) if support.inside else np.pi
        away, turned = np.meshgrid(np.linspace(1e-6, limit, rows), around, indexing="ij")
        sine = np.clip(np.sin(away) * np.sin(turned), -1, 1)
        return np.arctan2(np.sin(away) * np.cos(turned), np.cos(away)), np.arcsin(sine)
    if isinstance(support, Cylinder | Cone):
        low, high = float(np.min(vs)) - _ROOM * reach, float(np.max(vs)) + _ROOM * reach
        if isinstance(support, Cone):
            low = 0.0
        elif support.inside:
            width = max(_OPEN, 1.1 * float(np.max(np.abs(us))))
            around = around * min(width / np.pi, 1.0)
        u, v = np.meshgrid(around, np.linspace(low, high, rows), indexing="ij")
        return u, v
    if isinstance(support, Graph | Revolution):
        return _inside_a_graph(run, support, us, vs, reach)
    if isinstance(support, Parametric):
        return _about_a_path(run, support, us, vs, reach)
    u, v = np.meshgrid(around, np.linspace(-np.pi, np.pi, rows), indexing="ij")
    return u, v


def _about_a_path(
    run: Trajectory, support: Parametric, us: Array, vs: Array, reach: float
) -> tuple[Array, Array]:
    """As far around a path as some reaches of a body, along each coordinate."""
    rows, columns = _FINE
    middle = np.array([(np.min(values) + np.max(values)) / 2 for values in (us, vs)])
    ends = []
    for values, side, count in ((us, [1, 0], columns), (vs, [0, 1], rows)):
        u, v = middle[:, None] + np.outer(side, [0.0, _APART])
        (here, there), _ = _placed(run, support, u, v)
        room = _ROOM * reach / max(float(np.linalg.norm(there - here)) / _APART, _AXIS)
        ends.append(np.linspace(float(np.min(values)) - room, float(np.max(values)) + room, count))
    u, v = np.meshgrid(*ends, indexing="ij")
    return u, v


def _inside_a_graph(
    run: Trajectory, support: Graph | Revolution, us: Array, vs: Array, reach: float
) -> tuple[Array, Array]:
    """As far around a path as a graph goes, up to some reaches of a body.

    A surface of revolution is drawn all around, and down to its axis unless it is very deep there.
    """
    rows, columns = _FINE
    for room in _ROOM * reach * 0.5 ** np.arange(_HALVINGS):
        low, high = float(np.min(vs)) - room, float(np.max(vs)) + room
        wide = np.linspace(float(np.min(us)) - room, float(np.max(us)) + room, columns)
        lows = [low]
        if isinstance(support, Revolution):
            wide, lows = np.linspace(-np.pi, np.pi, columns), [_AXIS * high, max(low, _AXIS * high)]
        for least in lows:
            u, v = np.meshgrid(wide, np.linspace(least, high, rows), indexing="ij")
            with np.errstate(all="ignore"):
                points = _points(run, support, u, v)
            deep = np.max(np.ptp(points.reshape(-1, 3), axis=0)) > _DEEP * high
            if np.all(np.isfinite(points)) and (least == lows[-1] or not deep):
                return u, v
    return u, v


def _points(run: Trajectory, support: CurvedSupport, u: Array, v: Array) -> Array:
    """Points of a support along its frame, m, in rows so that it is seen from the side of bodies.

    Corners (i, j), (i + 1, j), (i + 1, j + 1) go round counter-clockwise.
    """
    points, normals = _placed(run, support, u, v)
    i, j = (size // 2 for size in u.shape)
    across, along_ = points[i + 1, j] - points[i, j], points[i, j + 1] - points[i, j]
    turned = float(np.dot(np.cross(across, along_), normals[i, j])) < 0
    return np.ascontiguousarray(points[:, ::-1] if turned else points)


def _placed(run: Trajectory, support: CurvedSupport, u: Array, v: Array) -> tuple[Array, Array]:
    """Points of a support along its frame, m, and its normals there."""
    segment = run.segments[0]
    frame, symbols = support.frame, tuple(as_symbol(q) for q in support.uv)
    place = support.foot.express(frame).components
    wanted = (*place, *support.up.express(frame).components)
    function = segment.dynamics.function(wanted, (*symbols, *segment.dynamics.parameters))
    found = function(u.ravel(), v.ravel(), *segment.parts[0].constants)
    values = [np.broadcast_to(value, u.size).reshape(u.shape) for value in found]
    return np.stack(values[:3], axis=-1), np.stack(values[3:], axis=-1)


def _side(run: Trajectory, contact: Contact, pose: Pose, path: Array, reach: float) -> Support:
    """A side of a body; of a convex one that is drawn itself, nothing."""
    support = contact.on
    if isinstance(support, CurvedSupport):
        drawn = _curved(run, contact, pose, path, reach)
        return drawn if support.inside else replace(drawn, points=_NOTHING)
    return Support(
        contact.name,
        "curved",
        pose,
        (0.0, 0.0),
        (0.0, 0.0),
        _block(run, contact, pose, path, reach),
    )


def _block(run: Trajectory, contact: Contact, pose: Pose, path: Array, reach: float) -> Array:
    """A side of a body with what is below it, as far as the path of a contact goes.

    The body reaches down to the face it stands on, or to the lowest edge of the side.
    """
    flat = path[np.isfinite(path).all(axis=1), :2]
    low, high = (flat.min(0), flat.max(0)) if len(flat) else (np.zeros(2), np.zeros(2))
    low, high = low - reach, high + reach
    down = -_rotations.applied(_rotations.inverse(pose.turn[0]), [0.0, 0.0, 1.0])
    surface = getattr(contact.on.carrier, "surface", None)
    depth = max(
        float(np.dot(down, (x, y, 0.0))) for x in (low[0], high[0]) for y in (low[1], high[1])
    )
    if isinstance(surface, Face):
        (depth,) = constants(run, [surface.height])
        if down[1] < -_LEVEL:  # the second direction points up the slope
            low[1] = max(low[1], (depth - max(down[0] * low[0], down[0] * high[0])) / down[1])
    ends = [np.array([[x, low[1], 0.0], [x, high[1], 0.0]]) for x in (low[0], high[0])]
    feet = [end + down * (depth - end @ down)[:, None] for end in ends]
    return np.stack([feet[0], *ends, feet[1]])

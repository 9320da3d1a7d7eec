"""Bodies of the scene: their shapes and poses, joints and links, and the arrows at them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import hypot

import numpy as np

from polhode.base import DeclarationError
from polhode.model import (
    Body,
    System,
    TwoPointLink,
)
from polhode.simulate import Trajectory
from polhode.view._drawn import (
    DrawnArrow,
    arms_in,
    arrows_in,
    end_of_link,
    joints_in,
    labels_of,
    links_in,
    place_of,
    sided_in,
    turning_of,
)
from polhode.view._drawn_angles import DrawnRotation, angles_in
from polhode.view._magnitudes import Magnitudes
from polhode.view._quantities import Array, equations_of, modes_of
from polhode.view._scene import (
    NOWHERE,
    Angles,
    Arrow,
    BodyShape,
    Joint,
    Link,
    Pose,
    Rotation,
    SceneBody,
    Triple,
)
from polhode.view._scene_along import along, attitudes, collapsed, constants, rolled, vectors
from polhode.view._shapes import source_of

_POINT = 0.07  # radius of a particle against the reach of the whole
THICKNESS = {"spring": 0.035, "damper": 0.022, "rope": 0.006}  # radius against the greatest length
_UNSEEN = 1e-9  # an arrow shorter than this share of the longest of its kind is not drawn
_USUAL = 0.9  # share of the motion for which an arrow is shorter than its usual length
_UPRIGHT: Triple = (0.0, 0.0, 1.0)


def bodies_of(run: Trajectory, links: Sequence[Link], t: Array) -> tuple[SceneBody, ...]:
    """Every body with its pose at the given instants; `links` help to size particles."""
    system = equations_of(run).system
    sided = sided_in(run.system if isinstance(run.system, System) else system)
    point_like = BodyShape("ball", (0.0,))
    bodies = [
        SceneBody(
            body.name,
            point_like if body in sided else _shape(run, body),
            _pose(run, body, t),
            tuple(_triple(constants(run, arm)) for arm in arms_in(system, body)),
            labels_of(body),
        )
        for body in system.bodies
    ]
    lengths = [body.reach for body in bodies]
    lengths += [float(np.max(np.linalg.norm(link.start - link.end, axis=1))) for link in links]
    # A particle gets a radius that can be seen.
    point = (_POINT * (max(lengths) or 1.0),)
    return tuple(
        b if any(b.shape.size) else replace(b, shape=replace(b.shape, size=point)) for b in bodies
    )


def _pose(run: Trajectory, body: Body, t: Array) -> Pose:
    place = vectors(run, place_of(body), t)
    fixed = body.fixed_axes
    if fixed is None:  # a ball without body axes: its attitude is integrated from ω
        turn = rolled(vectors(run, turning_of(body), t), float(t[1] - t[0]))
        return Pose(collapsed(place), collapsed(turn), np.zeros(0), _UPRIGHT)
    turn = attitudes(run, lambda equations: body.axes, t)
    spin, axis = np.zeros(0), _UPRIGHT
    if fixed != body.axes:
        spin = along(run, lambda equations: [fixed.angle], 1, t)[:, 0]
        axis = _triple(constants(run, fixed.axis))
    return Pose(collapsed(place), collapsed(turn), spin, axis)


def _triple(values: Sequence[float] | Array) -> Triple:
    x, y, z = (float(value) for value in values)
    return x, y, z


def _shape(run: Trajectory, body: Body) -> BodyShape:
    source = source_of(body.surface, body)
    try:
        return source.shape(constants(run, source.numbers))
    except DeclarationError:
        if source.rule != "inertia":
            raise
        return BodyShape("ball", (0.0,))  # the motion does not depend on mass and inertia


# --- joints and links ---


def joints_of(run: Trajectory) -> tuple[Joint, ...]:
    """A joint for every point that is held; two crossed ones for a universal joint."""
    system = equations_of(run).system
    bodies = list(system.bodies)
    return tuple(
        Joint(
            joint.kind,
            joint.name,
            bodies.index(joint.body),
            _triple(constants(run, joint.place)),
            _UPRIGHT if joint.axis is None else _triple(constants(run, joint.axis)),
        )
        for joint in joints_in(system)
    )


def links_of(run: Trajectory, t: Array) -> tuple[Link, ...]:
    """Springs, dampers and ropes with their ends at the given instants."""
    return tuple(_link(run, name, link, t) for name, link in links_in(equations_of(run).system))


def _link(run: Trajectory, name: str, link: TwoPointLink, t: Array) -> Link:
    start, end = (
        collapsed(vectors(run, end_of_link(point), t)) for point in (link.start, link.end)
    )
    longest = float(np.max(np.linalg.norm(start - end, axis=1)))
    return Link(link.kind, name, start, end, THICKNESS[link.kind] * longest)


# --- arrows ---


def arrows_of(run: Trajectory, t: Array, sizes: Magnitudes) -> tuple[Arrow, ...]:
    """Forces of contacts and joints, loads, torques, angular velocities and momenta.

    Components that only rounding has left are zero.
    """
    # as declared: contacts in their modes know nothing of the friction that limits their forces
    system = run.system if isinstance(run.system, System) else equations_of(run).system
    bodies = list(system.bodies)
    found = [
        _arrow(
            drawn,
            bodies.index(drawn.body),
            sizes,
            vectors(run, drawn.along, t),
            NOWHERE if drawn.foot is None else collapsed(vectors(run, drawn.foot, t)),
            NOWHERE if drawn.normal is None else collapsed(vectors(run, drawn.normal, t)),
            0.0 if drawn.friction is None else constants(run, [drawn.friction])[0],
        )
        for drawn in arrows_in(system, modes_of(run))
    ]
    kinds = dict.fromkeys(arrow.kind for arrow in found)
    largest = {kind: max(a.largest for a in found if a.kind == kind) for kind in kinds}
    return tuple(a for a in found if a.largest > _UNSEEN * largest[a.kind])


def _arrow(
    drawn: DrawnArrow,
    body: int,
    sizes: Magnitudes,
    values: Array,
    foot: Array,
    normal: Array,
    friction: float,
) -> Arrow:
    finite = np.nan_to_num(values, posinf=0.0, neginf=0.0)
    shown = sizes.without_rounding(finite, drawn.unit)
    lengths = np.linalg.norm(shown, axis=1)
    usual, largest = float(np.quantile(lengths, _USUAL)), float(np.max(lengths))
    kind, name, symbol, unit = drawn.kind, drawn.name, drawn.symbol, drawn.unit
    along = collapsed(shown)
    return Arrow(kind, name, symbol, body, unit, foot, along, usual, largest, normal, friction)


# --- angles ---


def angles_of(run: Trajectory, t: Array) -> tuple[Angles, ...]:
    """The angles of curved supports and of bodies, where an arc of one is drawn."""
    system = equations_of(run).system
    return tuple(
        Angles(
            drawn.name,
            drawn.body,
            collapsed(vectors(run, drawn.vertex, t)),
            tuple(_rotation(run, rotation, t) for rotation in drawn.rotations),
        )
        for drawn in angles_in(system)
    )


def _rotation(run: Trajectory, drawn: DrawnRotation, t: Array) -> Rotation:
    angle = collapsed(along(run, lambda equations: [drawn.angle], 1, t))[:, 0]
    axis, begin = (_triple(constants(run, row)) for row in (drawn.axis, drawn.begin))
    (offset,) = constants(run, [drawn.offset])
    symbol, coordinate, sign = drawn.symbol, drawn.coordinate, drawn.sign
    return Rotation(symbol, angle, axis, _unit(begin), offset, coordinate, sign)


def _unit(vector: Triple) -> Triple:
    size = hypot(*vector) or 1.0
    return _triple([part / size for part in vector])

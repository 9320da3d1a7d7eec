"""What bodies look like: by the surface they touch with, or else by their inertia."""

from __future__ import annotations

from functools import singledispatch
from math import hypot

import numpy as np

from polhode.model import Body, Ellipsoidal, Face, Rim, Round, Surface
from polhode.simulate import Trajectory
from polhode.view._quantities import Array
from polhode.view._scene import BodyShape, Triple
from polhode.view._scene_along import constants

_THIN = 0.06  # thickness of what has none, against its radius
_SLENDER = 0.045  # radius of a rod against its length
_HOLLOW = 0.75  # I/(m a²) above which a round body is a hoop rather than a disk
_FLAT = 0.02  # relative side below which a body counts as a lamina
_LONG = 2.5  # length against width of a lamina that is drawn with a handle
_SAME = 1e-6


def shape_of(body: Body, run: Trajectory) -> BodyShape:
    """The shape of a body, in numbers."""
    return _touching(body.surface, body, run)


def reach_of(shape: BodyShape) -> float:
    """Distance from the centre of mass to the farthest point, m."""
    halves = {"box": 0.87, "rod": 0.5, "racquet": 0.6}
    return max(shape.size) * halves.get(shape.kind, 1.0) + hypot(*shape.centre)


@singledispatch
def _touching(surface: Surface | None, body: Body, run: Trajectory) -> BodyShape:
    return _equivalent(body, run)


@_touching.register
def _(surface: Round, body: Body, run: Trajectory) -> BodyShape:
    radius, offset = constants(run, [surface.radius, surface.offset])
    if not offset:
        return BodyShape("ball", (radius,))
    axis, across = _directions(body.axes.position(surface.axis))
    x, y, z = (offset * part for part in axis)
    return BodyShape("ball", (radius,), axis, across, (x, y, z))


@_touching.register
def _(surface: Ellipsoidal, body: Body, run: Trajectory) -> BodyShape:
    return BodyShape("ellipsoid", constants(run, surface.half_axes))


@_touching.register
def _(surface: Face, body: Body, run: Trajectory) -> BodyShape:
    (height,) = constants(run, [surface.height])
    return BodyShape("box", (3 * height, 2.4 * height, 2 * height))


@_touching.register
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
    """A uniform body of the same mass and inertia."""
    entries = [entry for row in body.inertia.rows for entry in row]
    mass, *values = constants(run, [body.mass, *entries])
    moments, turned = np.linalg.eigh(np.reshape(values, (3, 3)))
    if mass <= 0 or moments[-1] <= 0:
        return BodyShape("ball", (0.0,))
    order = _symmetry(moments)
    moments, turned = moments[order], turned[:, order]
    directions = _unit(turned[:, 2]), _unit(turned[:, 0])
    if moments[2] <= _SAME * moments[0]:
        length = float(np.sqrt(12 * moments[0] / mass))
        return BodyShape("rod", (length, _SLENDER * length), *directions)
    if abs(moments[0] - moments[1]) <= _SAME * moments[0]:
        return _wheel(mass, moments, directions)
    return _slab(mass, moments, turned)


def _symmetry(moments: Array) -> list[int]:
    """The order that puts the moment unlike the others last."""
    first, middle, last = moments
    return [1, 2, 0] if last - middle < middle - first else [0, 1, 2]


def _wheel(mass: float, moments: Array, directions: tuple[Triple, Triple]) -> BodyShape:
    """A cylinder, or a wheel with spokes where it has no thickness."""
    across, about = moments[0], moments[2]
    radius = float(np.sqrt(2 * about / mass))
    squared = 12 * across / mass - 3 * radius**2
    if squared > (_FLAT * radius) ** 2:
        return BodyShape("disk", (radius, float(np.sqrt(squared))), *directions)
    rim = float(np.sqrt(about / mass))
    return BodyShape("wheel", (rim, 2 * _THIN * rim), *directions)


def _slab(mass: float, moments: Array, turned: Array) -> BodyShape:
    total = float(np.sum(moments))
    squares = np.clip(6 * (total - 2 * moments) / mass, 0, None)
    order = np.argsort(-squares)
    long, wide, thick = (float(side) for side in np.sqrt(squares[order]))
    axis, across = _unit(turned[:, order[0]]), _unit(turned[:, order[1]])
    lamina = thick < _FLAT * long
    if lamina and long > _LONG * wide:
        return BodyShape("racquet", (long, wide, _THIN * wide), axis, across)
    return BodyShape("box", (long, wide, max(thick, _FLAT * long)), axis, across)


def _directions(position: int) -> tuple[Triple, Triple]:
    """Along an axis, and across it."""
    unit = np.eye(3)
    return _unit(unit[position]), _unit(unit[(position + 1) % 3])


def _unit(vector: Array) -> Triple:
    x, y, z = (float(component) for component in vector)
    return x, y, z

"""The camera of a picture, as on the page: from a little above, in perspective."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from polhode.view import _rotations
from polhode.view._quantities import Array
from polhode.view._scene import Pose, Scene, Support

_FIELD = np.radians(16)  # half of the angle of view, up and down
_FOLLOWED = 3.45  # reaches of the body in view when it is followed
_FAR = 60  # reaches beyond which a body would be a dot, and the picture follows it
_AIR = 1.5  # margin about the middle of a body, in reaches of the body
_TIP = 0.15  # margin about a point of a path, in reaches of a body
_EDGE = 0.03  # margin about a point of a path, relative to the extent of the motion
_SAMPLES = 200
_NEAR = 6  # reaches about the path of the bodies up to which a sheet is in view


@dataclass(frozen=True)
class Camera:
    """A view in perspective; places on the page are shares of half its height.

    Attributes:
        eye: m.
        target: what is in the middle of the picture, m.
        upright: unit vector.
        clip: nearest distance that is drawn, m.
    """

    eye: Array
    target: Array
    upright: Array
    clip: float

    @property
    def axes(self) -> Array:
        """Unit vectors to the right, up and away, as rows."""
        away = self.target - self.eye
        away = away / np.linalg.norm(away)
        right = np.cross(away, self.upright)
        right = right / np.linalg.norm(right)
        return np.array([right, np.cross(right, away), away])

    def project(self, points: Array) -> Array:
        """Places on the page, shape (..., 2)."""
        seen = (points - self.eye) @ self.axes.T
        depth = np.maximum(seen[..., 2:], self.clip)
        flat: Array = seen[..., :2] / (depth * np.tan(_FIELD))
        return flat


def camera_of(scene: Scene, frame: float) -> Camera:
    """The initial view of the page: from the same side, as near as keeps everything in view."""
    reach = max(body.reach for body in scene.bodies)
    frames = np.linspace(0, scene.frames - 1, _SAMPLES)
    bodies = np.array([place_at(body.pose, f) for body in scene.bodies for f in frames])
    # points of joints and of link ends, and those of the traces
    fixed = [arrow.foot[0] for arrow in scene.arrows if len(arrow.foot) == 1]
    outlines = [_outline(support, bodies, reach) for support in scene.supports]
    paths = np.concatenate([np.reshape(fixed, (-1, 3)), _tied(scene), *_paths(scene), *outlines])
    box = np.array([f(np.concatenate([bodies, paths]), axis=0) for f in (np.nanmin, np.nanmax)])
    radius = float(np.linalg.norm(box[1] - box[0])) / 2 + reach
    follows = radius > _FAR * reach and not len(_tied(scene))
    target = place_at(scene.bodies[0].pose, frame) if follows else np.mean(box, axis=0)
    up = np.array(scene.up)
    guess = np.array([0.0, 1.0, 0.0]) if abs(up[2]) > 0.9 else np.array([0.0, 0.0, 1.0])
    side = np.cross(guess, up)
    side = side / np.linalg.norm(side)
    away = 0.82 * np.cross(up, side) - 0.36 * side - 0.44 * up
    view = Camera(target - away, target, up, 1.0)
    if follows:
        distance = _FOLLOWED * reach / np.tan(_FIELD)
    else:
        distance = max(
            _needed(view, bodies, _AIR * reach),
            _needed(view, paths, max(_TIP * reach, _EDGE * radius)),
        )
    eye = target - distance * view.axes[2]
    return Camera(eye, target, up, 0.05 * distance)


def _needed(view: Camera, points: Array, radius: float) -> float:
    """Distance along its direction from which a view contains all balls about some points, m.

    At distance D a ball at depth z is in view if |x| + r ≤ (D + z) tan(field).
    """
    right, above, away = ((points - view.target) @ view.axes.T).T
    across = np.maximum(np.abs(right), np.abs(above)) + radius
    return float(np.nanmax(across / np.tan(_FIELD) - away, initial=0.0))


def place_at(pose: Pose, frame: float) -> Array:
    """Where something is at a frame, which may lie between two, m."""
    return between(pose.place, frame)


def turn_at(pose: Pose, frame: float) -> Array:
    """The attitude of something at a frame, with its spin, as a rotation matrix."""
    turn = between(pose.turn, frame)
    if len(pose.spin):
        spin = between(pose.spin[:, None], frame)[0]
        (about_axis,) = _rotations.about(spin * np.array([pose.axis]))
        turn = _rotations.product(turn, about_axis)
    return _rotations.matrix(turn)


def between(rows: Array, frame: float) -> Array:
    """A row, or linear interpolation between two."""
    if len(rows) == 1:
        first: Array = rows[0]
        return first
    low = min(int(frame), len(rows) - 2)
    share = frame - low
    found: Array = rows[low] * (1 - share) + rows[low + 1] * share
    return found


def _paths(scene: Scene) -> Iterator[Array]:
    """Points of the traces in the laboratory; one on a moving support may go anywhere with it."""
    for trace in scene.traces:
        if trace.support < 0:
            yield trace.points[:: max(1, len(trace.points) // _SAMPLES)]


def _outline(support: Support, bodies: Array, reach: float) -> Array:
    """Points of the outline of a support at the start, of a sheet only near the bodies, m."""
    turn, place = turn_at(support.pose, 0.0), place_at(support.pose, 0.0)
    if support.kind == "curved":
        points = np.reshape(support.points, (-1, 3)) @ turn.T + place
        low, high = (f(bodies, axis=0) for f in (np.min, np.max))
        room = _NEAR * reach
        close: Array = points[np.all((points > low - room) & (points < high + room), axis=1)]
        return close
    if support.kind == "turntable":
        angles = np.linspace(0, 2 * np.pi, 25)
        flat = support.reach[0] * np.array([np.cos(angles), np.sin(angles)]).T
    elif support.kind == "sheet":
        passed = ((bodies - place) @ turn)[:, :2]
        low, high = np.min(passed, axis=0) - _NEAR * reach, np.max(passed, axis=0) + _NEAR * reach
        middle, half = np.array(support.middle), np.array(support.reach)
        x, y = np.clip(middle + half * np.array([[-1.0], [1.0]]), low, high).T
        flat = np.array([(a, b) for a in x for b in y])
    else:
        flat = np.zeros((0, 2))
    found: Array = place + flat @ turn[:, :2].T
    return found


def _tied(scene: Scene) -> Array:
    """Fixed points that springs and dampers are attached to, shape (points, 3)."""
    ends = [end for link in scene.links for end in (link.start, link.end)]
    return np.reshape([end[0] for end in ends if len(end) == 1], (-1, 3))

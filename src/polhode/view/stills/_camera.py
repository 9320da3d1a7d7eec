"""Where a picture is seen from, as on the page: from a little above, in perspective."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from polhode.view._quantities import Array
from polhode.view._scene import Pose, Scene, SceneBody
from polhode.view._shapes import reach_of

_FIELD = np.radians(16)  # half of the angle of view, up and down
_FOLLOWED = 3.0  # reaches of the body in view when it is followed
_FAR = 7.5  # reaches beyond which the picture follows the body
_SAMPLES = 200


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
    """The view that the page opens with."""
    middle, radius = _extent(scene)
    reach = max(_reach(body) for body in scene.bodies)
    follows = radius > _FAR * reach and not len(_tied(scene))
    target = place_at(scene.bodies[0].pose, frame) if follows else middle
    seen = _FOLLOWED * reach if follows else max(radius, 1.9 * reach)
    up = np.array(scene.up)
    guess = np.array([0.0, 1.0, 0.0]) if abs(up[2]) > 0.9 else np.array([0.0, 0.0, 1.0])
    side = np.cross(guess, up)
    side = side / np.linalg.norm(side)
    ahead = np.cross(up, side)
    distance = 1.15 * seen / np.tan(_FIELD)
    eye = target + distance * (-0.82 * ahead + 0.36 * side + 0.44 * up)
    return Camera(eye, target, up, 0.05 * distance)


def place_at(pose: Pose, frame: float) -> Array:
    """Where something is at a frame, which may lie between two, m."""
    return between(pose.place, frame)


def turn_at(pose: Pose, frame: float) -> Array:
    """How it is turned, with its spin, as a rotation matrix."""
    turn = rotation(between(pose.turn, frame))
    if not len(pose.spin):
        return turn
    half = float(between(pose.spin[:, None], frame)[0]) / 2
    spin = np.append(np.sin(half) * np.array(pose.axis), np.cos(half))
    return turn @ rotation(spin)


def between(rows: Array, frame: float) -> Array:
    """A row, or what lies between two."""
    if len(rows) == 1:
        first: Array = rows[0]
        return first
    low = min(int(frame), len(rows) - 2)
    share = frame - low
    found: Array = rows[low] * (1 - share) + rows[low + 1] * share
    return found


def rotation(quaternion: Array) -> Array:
    """A quaternion (x, y, z, w) of any size but zero as a rotation matrix."""
    x, y, z, w = quaternion / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def _extent(scene: Scene) -> tuple[Array, float]:
    """Middle and radius of everything the bodies pass through."""
    frames = np.linspace(0, scene.frames - 1, _SAMPLES)
    points = np.array([place_at(b.pose, f) for b in scene.bodies for f in frames])
    fixed = [arrow.foot[0] for arrow in scene.arrows if len(arrow.foot) == 1]
    points = np.concatenate([points, np.reshape(fixed, (-1, 3)), _tied(scene)])
    low, high = np.nanmin(points, axis=0), np.nanmax(points, axis=0)
    reach = max(_reach(body) for body in scene.bodies)
    return (low + high) / 2, float(np.linalg.norm(high - low)) / 2 + reach


def _tied(scene: Scene) -> Array:
    """Places in space that springs and dampers are tied to, shape (places, 3)."""
    ends = [end for link in scene.links for end in (link.start, link.end)]
    return np.reshape([end[0] for end in ends if len(end) == 1], (-1, 3))


def _reach(body: SceneBody) -> float:
    return max([reach_of(body.shape), *(float(np.linalg.norm(arm)) for arm in body.arms)])

"""The instant at which a picture tells most of a body."""

from __future__ import annotations

import numpy as np

from polhode.view._scene import Scene
from polhode.view.stills._bodies import body_mesh
from polhode.view.stills._camera import camera_of, place_at, turn_at

_SHARES = np.linspace(0.25, 0.6, 36)  # of the motion: some of it done, and some to come
_ENOUGH = 0.85  # of the largest outline seen: the first instant with so much of it will do


def telling_time(scene: Scene) -> float:
    """When most of the bodies is seen, and not their edges, s."""
    seen = np.array([_outline(scene, share * (scene.frames - 1)) for share in _SHARES])
    first = int(np.argmax(seen >= _ENOUGH * np.max(seen)))
    return float(_SHARES[first]) * scene.duration


def _outline(scene: Scene, frame: float) -> float:
    """Area of all faces that are seen, in the picture."""
    camera = camera_of(scene, frame)
    area = 0.0
    for body in scene.bodies:
        mesh = body_mesh(body).placed(turn_at(body.pose, frame), place_at(body.pose, frame))
        corners = camera.project(mesh.faces)
        across, along = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
        turned = across[:, 0] * along[:, 1] - across[:, 1] * along[:, 0]
        area += float(np.sum(turned[turned > 0])) / 2
    return area

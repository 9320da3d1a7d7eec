"""A picture is taken when a body shows its face."""

import numpy as np
import pytest

from polhode.view import clearest_time, scene
from polhode.view.stills._camera import camera_of, turn_at


@pytest.mark.parametrize("name", ["spinning-coin", "rolling-disk", "tennis-racquet"])
def test_a_flat_body_is_not_seen_edge_on(run_of, name):
    shown = scene(run_of(name))
    time = clearest_time(shown)
    assert 0.2 * shown.duration < time < 0.7 * shown.duration
    frame = time / shown.duration * (shown.frames - 1)
    (body,), camera = shown.bodies, camera_of(shown, frame)
    flat = (
        np.cross(body.shape.axis, body.shape.across)
        if name == "tennis-racquet"
        else body.shape.axis
    )
    assert abs(turn_at(body.pose, frame) @ np.array(flat) @ camera.axes[2]) > 0.5


def test_a_ball_is_seen_at_any_time(run_of):
    shown = scene(run_of("ball-on-paper"))
    assert clearest_time(shown) == pytest.approx(0.25 * shown.duration)

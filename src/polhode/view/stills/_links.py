"""Springs, dampers and joints of a scene as meshes."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from polhode.view._quantities import Array
from polhode.view._scene import Joint, Link, Scene
from polhode.view._shapes import reach_of
from polhode.view.stills._camera import between, place_at, turn_at
from polhode.view.stills._mesh import (
    Mesh,
    box,
    cap,
    coil,
    rod_between,
    sphere,
    together,
    tube,
    turned_to,
)

_METAL, _DARK, _DEEP, _LIGHT = "#9aa3ad", "#5b636d", "#1d4a6d", "#f3e9d2"
_POT = 0.5  # of a damper's length at the middle of the motion
_CLEAR = 0.11  # size of a joint against the reach of its body
_ROD_END = 1.9  # against the radius of a rod: beyond the knob at its end


def links(scene: Scene, frame: float) -> list[Mesh]:
    """Springs and dampers, and the knobs at ends that are tied to a place."""
    drawn = [_BUILDERS[link.kind](link, frame) for link in scene.links]
    tied = [
        _knob(1.5 * link.thick, _DARK).placed(np.eye(3), end[0])
        for link in scene.links
        for end in (link.start, link.end)
        if len(end) == 1
    ]
    return [*drawn, *tied]


def _spring(link: Link, frame: float) -> Mesh:
    return coil(between(link.start, frame), between(link.end, frame), link.thick, _METAL)


def _damper(link: Link, frame: float) -> Mesh:
    start, end = between(link.start, frame), between(link.end, frame)
    middle = max(len(link.start), len(link.end)) / 2
    usual = float(np.linalg.norm(between(link.end, middle) - between(link.start, middle)))
    length = float(np.linalg.norm(end - start))
    if not length:
        return _knob(link.thick, _DEEP).placed(np.eye(3), start)
    foot = start + (end - start) * min(_POT * usual / length, 0.8)
    pot = rod_between(start, foot, link.thick, _DEEP)
    return together([pot, rod_between(foot, end, 0.35 * link.thick, _LIGHT)])


_BUILDERS: dict[str, Callable[[Link, float], Mesh]] = {"spring": _spring, "damper": _damper}


def joints(scene: Scene, frame: float) -> Iterator[Mesh]:
    """What bodies turn on, where that is not their middle."""
    for joint in scene.joints:
        if any(joint.place):
            pose = scene.bodies[joint.body].pose
            yield _joint(scene, joint).placed(turn_at(pose, frame), place_at(pose, frame))


def _joint(scene: Scene, joint: Joint) -> Mesh:
    shape = scene.bodies[joint.body].shape
    arm = float(np.linalg.norm(joint.place))
    clear = _ROD_END * shape.size[1] if shape.kind == "rod" else _CLEAR * max(reach_of(shape), arm)
    axis, place = np.array(joint.axis), np.array(joint.place)
    return _JOINTS[joint.kind](clear, axis).placed(np.eye(3), place)


def _knob(radius: float, colour: str) -> Mesh:
    return sphere(lambda i, j: colour, 10, 16).stretched(*[radius] * 3)


def _pin(radius: float, half: float, axis: Array) -> Mesh:
    """A short cylinder with an eye at either end."""
    parts = []
    for share, length, colour in ((1.0, 0.95 * half, _DARK), (0.6, 1.4 * half, _METAL)):
        side = tube(share * radius, -length, length, lambda i, j, c=colour: c, 24)  # type: ignore[misc]
        ends = [
            cap(share * radius, end, lambda i, j, c=colour: c)  # type: ignore[misc]
            for end in (length, -length)
        ]
        parts += [side, *ends]
    return together(parts).placed(turned_to(axis), np.zeros(3))


_JOINTS: dict[str, Callable[[float, Array], Mesh]] = {
    "pivot": lambda clear, axis: _knob(clear, _METAL),
    "hinge": lambda clear, axis: _pin(1.6 * clear, clear, axis),
    "universal": lambda clear, axis: _pin(0.9 * clear, 1.5 * clear, axis),
    "weld": lambda clear, axis: box([2 * clear] * 3, [_DARK] * 6),
}

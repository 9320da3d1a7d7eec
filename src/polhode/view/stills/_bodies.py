"""Bodies, joints and links of a scene as meshes; marks on the bodies show their spin."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from itertools import pairwise

import numpy as np

from polhode.base import colours
from polhode.view._quantities import Array
from polhode.view._scene import BodyShape, Link, Scene, SceneBody, Triple
from polhode.view.stills._camera import between, place_at, turn_at
from polhode.view.stills._mesh import (
    Mesh,
    box,
    cap,
    coil,
    revolution,
    ring,
    rod_between,
    sphere,
    together,
    tube,
    turned_to,
)

LIGHT, BLUE, DEEP, ACCENT, METAL, DARK = (
    colours("materials")[name] for name in ("light", "blue", "deep", "accent", "metal", "dark")
)
_SECTORS = 12
_REMEMBERED = 32  # bodies: those of a movie are drawn again and again
_PIECES = 8  # of a spoke
_POT = 0.5  # of a damper's length at the middle of the motion
_CLEAR = 0.11  # size of a joint against the reach of its body
_ROD_END = 1.9  # against the radius of a rod: beyond the knob at its end
_AXLE = 0.055  # thickness of the rod to where a body is held, against its reach


def bodies(scene: Scene, frame: float) -> list[Mesh]:
    """The bodies where they are at a frame."""
    return [
        body_mesh(body).placed(turn_at(body.pose, frame), place_at(body.pose, frame))
        for body in scene.bodies
    ]


def body_mesh(body: SceneBody) -> Mesh:
    """A body along its own axes, with the rods to the points at which it is held."""
    return _mesh(body.shape, body.arms)


@lru_cache(_REMEMBERED)
def _mesh(shape: BodyShape, held: tuple[Triple, ...]) -> Mesh:
    mesh = _SHAPES.get(shape.kind, _ball)(*shape.size)
    if shape.kind != "ellipsoid":
        axis, across = np.array(shape.axis), np.array(shape.across)
        turn = np.stack([across, np.cross(axis, across), axis], axis=1)
        mesh = mesh.placed(turn, np.array(shape.centre))
    thick = _AXLE * max([shape.reach, *(float(np.linalg.norm(arm)) for arm in held)])
    arms = [np.array(arm) for arm in held if any(arm)]
    rods = [rod_between(np.zeros(3), arm, thick / 2, METAL) for arm in arms]
    return together([mesh, *rods])


def _sector(column: int, columns: int, dark: str = BLUE, light: str = LIGHT) -> str:
    number = column * _SECTORS // columns
    return ACCENT if number == 0 else (dark if number % 2 else light)


def _panel(i: int, j: int) -> str:
    """A ball in panels, with a marked cap."""
    if i < 2:
        return ACCENT
    if i >= 18:
        return DEEP
    return BLUE if (i // 5 + j // 4) % 2 else LIGHT


def _ball(radius: float = 1.0) -> Mesh:
    return _ellipsoid(radius, radius, radius)


def _ellipsoid(*half_axes: float) -> Mesh:
    return sphere(_panel).stretched(*half_axes)


def _disk(radius: float, height: float) -> Mesh:
    def face(i: int, j: int) -> str:
        if i == 0:
            return LIGHT
        return DEEP if i == 2 else _sector(j, 48)

    rings = (0.0, 0.18, 0.93, 1.0)
    side = tube(radius, -height / 2, height / 2, lambda i, j: _sector(i, 48, DEEP, METAL))
    return together([side, *(cap(radius, h / 2, face, rings) for h in (height, -height))])


def _hoop(radius: float, height: float) -> Mesh:
    return ring(radius, _rim(radius, height), lambda i, j: _sector(i, 48))


def _rim(radius: float, height: float) -> float:
    """Radius of the tube that a hoop is."""
    return max(height / 2, 0.045 * radius)


def _wheel(radius: float, height: float) -> Mesh:
    hub, inside = 0.12 * radius, radius - 2 * _rim(radius, height)
    deep = 0.1 * radius
    ends = [cap(hub, side * deep, DEEP) for side in (-1, 1)]
    spokes = []
    for i in range(6):
        along = np.array([np.cos(np.pi * i / 3), np.sin(np.pi * i / 3), 0.0])
        # In short pieces: each is nearer or farther than what it crosses.
        points = [distance * along for distance in np.linspace(hub, inside, _PIECES + 1)]
        colour = METAL if i else ACCENT
        pieces = [rod_between(a, b, 0.028 * radius, colour) for a, b in pairwise(points)]
        spokes.append(together(pieces))
    return together([_hoop(radius, height), *spokes, tube(hub, -deep, deep, DEEP), *ends])


def _rod(length: float, radius: float) -> Mesh:
    bar = tube(radius, -length / 2, length / 2, BLUE, 20)
    ends = [
        _knob(1.7 * radius, colour).placed(np.eye(3), np.array([0.0, 0.0, side * length / 2]))
        for side, colour in ((1, ACCENT), (-1, LIGHT))
    ]
    return together([bar, *ends])


def _racquet(length: float, width: float, thick: float) -> Mesh:
    head = 0.27 * length
    middle = np.array([0.0, 0.0, 0.5 * length - head])
    across = np.array([[1.0, 0, 0], [0, 0, 1.0], [0, -1.0, 0]]).T  # its plane along 1 and 3
    frame = ring(1.0, 0.07, DEEP).stretched(width / 2, head, width / 2)
    strings = [
        cap(0.9, side * 0.02, colour).stretched(width / 2, head, width / 2)
        for side, colour in ((1, ACCENT), (-1, LIGHT))
    ]
    flat = together([frame, *strings]).placed(across, middle)
    handle = tube(1.3 * thick, -length / 2, float(middle[2]) - head, BLUE, 16)
    return together([flat, handle])


_COLUMNS = 48  # around a body of revolution
_SHAPES: dict[str, Callable[..., Mesh]] = {
    "ball": _ball,
    "ellipsoid": _ellipsoid,
    "disk": _disk,
    "hoop": _hoop,
    "wheel": _wheel,
    "rod": _rod,
    "box": lambda long, wide, thick: box(
        (wide, thick, long), (BLUE, BLUE, LIGHT, DEEP, ACCENT, METAL)
    ),
    "racquet": _racquet,
    "revolution": lambda *lengths: revolution(
        np.reshape(lengths, (-1, 2)), lambda _, column: _sector(column, _COLUMNS)
    ),
}


# --- joints, springs, dampers and ropes ---


def links(scene: Scene, frame: float) -> list[Mesh]:
    """Springs, dampers and ropes, and the knobs at ends that are tied to a place."""
    drawn = [_LINKS[link.kind](link, frame) for link in scene.links]
    tied = [
        _knob(1.5 * link.thick, DARK).placed(np.eye(3), end[0])
        for link in scene.links
        for end in (link.start, link.end)
        if len(end) == 1
    ]
    return [*drawn, *tied]


def _damper(link: Link, frame: float) -> Mesh:
    start, end = between(link.start, frame), between(link.end, frame)
    middle = max(len(link.start), len(link.end)) / 2
    usual = float(np.linalg.norm(between(link.end, middle) - between(link.start, middle)))
    length = float(np.linalg.norm(end - start))
    if not length:
        return _knob(link.thick, DEEP).placed(np.eye(3), start)
    foot = start + (end - start) * min(_POT * usual / length, 0.8)
    pot = rod_between(start, foot, link.thick, DEEP)
    return together([pot, rod_between(foot, end, 0.35 * link.thick, LIGHT)])


_LINKS: dict[str, Callable[[Link, float], Mesh]] = {
    "spring": lambda link, frame: coil(
        between(link.start, frame), between(link.end, frame), link.thick, METAL
    ),
    "damper": _damper,
    "rope": lambda link, frame: rod_between(
        between(link.start, frame), between(link.end, frame), link.thick, DARK
    ),
}


def joints(scene: Scene, frame: float) -> Iterator[Mesh]:
    """Joints that are not at the centre of mass of a body."""
    for joint in scene.joints:
        if any(joint.place):
            pose = scene.bodies[joint.body].pose
            shape, arm = scene.bodies[joint.body].shape, float(np.linalg.norm(joint.place))
            clear = _CLEAR * max(shape.reach, arm)
            if shape.kind == "rod":
                clear = _ROD_END * shape.size[1]
            mesh = _JOINTS[joint.kind](clear, np.array(joint.axis))
            mesh = mesh.placed(np.eye(3), np.array(joint.place))
            yield mesh.placed(turn_at(pose, frame), place_at(pose, frame))


def _knob(radius: float, colour: str) -> Mesh:
    return sphere(colour, 10, 16).stretched(*[radius] * 3)


def _pin(radius: float, half: float, axis: Array) -> Mesh:
    """A short cylinder with an eye at either end."""
    parts = []
    for share, length, colour in ((1.0, 0.95 * half, DARK), (0.6, 1.4 * half, METAL)):
        side = tube(share * radius, -length, length, colour, 24)
        ends = [cap(share * radius, end, colour) for end in (length, -length)]
        parts += [side, *ends]
    return together(parts).placed(turned_to(axis), np.zeros(3))


_JOINTS: dict[str, Callable[[float, Array], Mesh]] = {
    "pivot": lambda clear, axis: _knob(clear, METAL),
    "hinge": lambda clear, axis: _pin(1.6 * clear, clear, axis),
    "universal": lambda clear, axis: _pin(0.9 * clear, 1.5 * clear, axis),
    "weld": lambda clear, axis: box([2 * clear] * 3, [DARK] * 6),
}

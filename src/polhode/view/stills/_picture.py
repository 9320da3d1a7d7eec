"""A scene at an instant, drawn with matplotlib: faces from far to near, no WebGL needed."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING

import numpy as np

from polhode.base import colour, colours
from polhode.view._quantities import Array
from polhode.view._scene import Arrow, Scene, Trace
from polhode.view.figures import house_style
from polhode.view.stills._bodies import DARK, bodies, joints, links
from polhode.view.stills._camera import Camera, between, camera_of, place_at, turn_at
from polhode.view.stills._ground import ACCENT, LINES, STRONG, Ground, grounds_of, shells
from polhode.view.stills._mesh import Mesh, rod_between, together

if TYPE_CHECKING:
    from matplotlib.axes import Axes


SKY, _SHADOW = (colours("stills")[name] for name in ("sky", "shadow"))
_LIGHT = np.array([0.35, -0.45, 0.82])  # along right, away from the eye, and up
_AMBIENT = 0.5
_TRACES = {kind: colour(f"path-{kind}") for kind in ("contact", "centre", "axis")}
ARROWS = {kind: colour(kind) for kind in ("force", "load", "torque", "omega", "momentum")}
_LONG = 2.0  # usual length of the longest arrow of a kind, in reaches of the picture
_LEVEL = 1e-3  # a body hangs if it is this far below its point, relative to its rise and fall
_BOUNDLESS = 2.6  # radius of a plane against that of the picture
_SHARES = np.linspace(0.25, 0.6, 36)  # of the motion: instants with a trace already drawn
_ENOUGH = 0.85  # the first instant with this share of the largest visible area is taken


@house_style()
def picture(scene: Scene, frame: float, ax: Axes, arrows: Collection[str] = ()) -> None:
    """Draw a scene at a frame, which may lie between two.

    Args:
        scene: what to draw.
        frame: from 0 to `scene.frames` − 1.
        ax: filled with the picture.
        arrows: kinds of arrows to draw: force, load, torque, omega, momentum.
    """
    camera = camera_of(scene, frame)
    width = float(np.linalg.norm(camera.eye - camera.target)) * 0.3
    grounds = grounds_of(scene, frame, _BOUNDLESS * width, camera.target)
    parts = (bodies(scene, frame), joints(scene, frame), links(scene, frame), _posts(scene))
    mesh = together([part for kind in parts for part in kind])
    light = _light(camera, np.array(scene.up))
    for i, ground in enumerate(grounds):
        _draw_ground(ax, camera, ground, 0.1 * i)
        if i == len(grounds) - 1:
            _draw_shadow(ax, camera, mesh, ground, light)
    curved = list(shells(scene, frame))
    for trace in scene.traces:
        _draw_trace(ax, camera, scene, trace, frame, on_top=bool(curved))
    _draw_mesh(ax, camera, together([*curved, mesh]), light)
    for arrow in scene.arrows:
        if arrow.kind in arrows:
            _draw_arrow(ax, camera, scene, arrow, frame, 0.55 * width)
    box = ax.get_window_extent()
    ratio = box.width / box.height
    ax.set_xlim(-ratio, ratio)
    ax.set_ylim(-1, 1)
    ax.set_axis_off()


def _posts(scene: Scene) -> Iterator[Mesh]:
    """Posts under points fixed in space, unless the body hangs from its point."""
    if scene.floor is None:
        return
    up = np.array(scene.up)
    for arrow in scene.arrows:
        if arrow.kind != "force" or len(arrow.foot) != 1:
            continue
        foot, place = arrow.foot[0], scene.bodies[arrow.body].pose.place
        hangs = np.mean((place - foot) @ up) < -_LEVEL * np.ptp(place @ up)
        height = float(foot @ up) - scene.floor
        if height > 0 and not hangs:
            yield rod_between(foot - up * height, foot, 0.03 * height, DARK)


def _light(camera: Camera, up: Array) -> Array:
    right, _, away = camera.axes
    level = away - up * float(away @ up)
    light = -_LIGHT[0] * right + _LIGHT[1] * level / np.linalg.norm(level) + _LIGHT[2] * up
    found: Array = light / np.linalg.norm(light)
    return found


def _draw_ground(ax: Axes, camera: Camera, ground: Ground, order: float) -> None:
    from matplotlib.collections import LineCollection

    ax.fill(
        *camera.project(ground.outline).T,
        facecolor=ground.colour,
        edgecolor=STRONG,
        linewidth=0.5,
        zorder=order,
    )
    lines = [camera.project(line) for line in ground.lines]
    ax.add_collection(LineCollection(lines, colors=LINES, linewidths=0.5, zorder=order + 0.02))
    for mark in ground.marks:
        ax.fill(*camera.project(mark).T, facecolor=ACCENT, zorder=order + 0.03)


def _draw_shadow(ax: Axes, camera: Camera, mesh: Mesh, ground: Ground, light: Array) -> None:
    from matplotlib.collections import PolyCollection

    # Each corner is moved along the light onto the plane of the ground.
    heights = (mesh.faces - ground.place) @ ground.normal
    slope = float(light @ ground.normal)
    faces = camera.project(mesh.faces - heights[..., None] * light / slope)
    ax.add_collection(
        PolyCollection(
            list(faces), facecolors=_SHADOW, edgecolors=_SHADOW, linewidths=0.4, zorder=0.5
        )
    )


def _draw_mesh(ax: Axes, camera: Camera, mesh: Mesh, light: Array) -> None:
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import to_rgb

    middles, normals = np.mean(mesh.faces, axis=1), mesh.normals
    sight = middles - camera.eye
    # Painter's algorithm: faces turned away are left out, the rest drawn from far to near.
    seen = np.flatnonzero(np.sum(normals * sight, axis=1) < 0)
    order = seen[np.argsort(-np.linalg.norm(sight[seen], axis=1))]
    known = {colour: to_rgb(colour) for colour in set(mesh.colours)}
    colours = np.array([known[mesh.colours[i]] for i in order])
    shade = _AMBIENT + (1 - _AMBIENT) * np.clip(normals[order] @ light, 0, 1)
    painted = np.clip(colours * shade[:, None], 0, 1)
    faces = camera.project(mesh.faces[order])
    ax.add_collection(
        PolyCollection(
            list(faces), facecolors=painted, edgecolors=painted, linewidths=0.35, zorder=2
        )
    )


def _draw_trace(
    ax: Axes, camera: Camera, scene: Scene, trace: Trace, frame: float, *, on_top: bool
) -> None:
    points = trace.points[: int(frame) + 1]
    if trace.support >= 0:
        pose = scene.supports[trace.support].pose
        points = points @ turn_at(pose, frame).T + place_at(pose, frame)
    colour, width = _TRACES.get(trace.kind, STRONG), 1.4 if trace.kind == "contact" else 1.0
    ax.plot(
        *camera.project(points).T,
        color=colour,
        linewidth=width,
        zorder=3 if on_top or trace.kind == "axis" else 1,
        alpha=0.7 if trace.support >= 0 else 0.9,
    )


def _draw_arrow(
    ax: Axes, camera: Camera, scene: Scene, arrow: Arrow, frame: float, length: float
) -> None:
    usual = max(other.usual for other in scene.arrows if other.kind == arrow.kind)
    along = between(arrow.along, frame) * (length / usual if usual else 0.0)
    foot = between(arrow.foot, frame) if len(arrow.foot) else None
    start = place_at(scene.bodies[arrow.body].pose, frame) if foot is None else foot
    if not np.all(np.isfinite(start)) or not np.any(along):
        return
    tail, tip = camera.project(np.array([start, start + along]))
    style = {"arrowstyle": "-|>,head_width=0.22,head_length=0.45", "linewidth": 1.6}
    style |= {"color": ARROWS[arrow.kind], "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", tip, tail, arrowprops=style, zorder=4)


def clearest_time(scene: Scene) -> float:
    """A time at which the bodies are seen from their broad side rather than edge on, s."""
    seen = np.array([_outline(scene, share * (scene.frames - 1)) for share in _SHARES])
    first = int(np.argmax(seen >= _ENOUGH * np.max(seen)))
    return float(_SHARES[first]) * scene.duration


def _outline(scene: Scene, frame: float) -> float:
    """Area in the picture of all visible faces."""
    camera = camera_of(scene, frame)
    area = 0.0
    for mesh in bodies(scene, frame):
        corners = camera.project(mesh.faces)
        across, along = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
        turned = across[:, 0] * along[:, 1] - across[:, 1] * along[:, 0]
        area += float(np.sum(turned[turned > 0])) / 2
    return area

"""Making a scene of a motion."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from math import ceil, isfinite

import numpy as np
from scipy.integrate import cumulative_simpson

from polhode.algebra import Vector
from polhode.base import NumericError
from polhode.derive import Equations
from polhode.model import Body, Contact, Plane
from polhode.simulate import Trajectory
from polhode.view._judgement import Judgement
from polhode.view._quantities import (
    Array,
    Groups,
    equations_of,
    everything,
    grouped,
    refuse_an_instant,
)
from polhode.view._scene import (
    Link,
    MotionSummary,
    Pose,
    Scene,
    SceneBody,
    Support,
    Trace,
    Triple,
)
from polhode.view._scene_along import along, collapsed, constants, quaternions, vectors
from polhode.view._scene_bodies import arrows_of, bodies_of, joints_of, links_of
from polhode.view._scene_text import (
    evidence_of,
    happenings_of,
    motion_of,
    origin_of_scene,
    panels_of,
    parameters_of,
    reactions_of,
    start_of,
)

_TURN = 0.12  # largest angle between two frames, rad
_LEAST, _MOST = 2000, 3600  # frames, for one body
_FEWEST = 600  # for however many
_COARSE = 601  # instants at which the turning is looked at
_BELOW = 1.15  # of the reach of everything: depth of the floor where nothing is stood on


def scene(
    run: Trajectory,
    *,
    title: str = "",
    about: str = "",
    plots: Groups = (),
    meanings: Mapping[str, str] | None = None,
    judgements: Iterable[Judgement] = (),
) -> Scene:
    """All there is to see of a motion.

    Args:
        run: the motion.
        title: heading; the system's name by default.
        about: the problem in a few sentences.
        plots: names of quantities to plot, or groups of names; by default coordinates, speeds
            and reactions.
        meanings: what parameters are, by name.
        judgements: verdicts on claims about the system.

    Raises:
        DeclarationError: for the name of a quantity that the run does not have.
        NumericError: for a motion beyond all numbers, or that does not last.
    """
    read = account(run, plots=plots, meanings=meanings)
    seen = scenery(run, title=title, about=about)
    return replace(seen, judgements=tuple(judgements), **vars(read))


def account(
    run: Trajectory,
    *,
    plots: Groups = (),
    meanings: Mapping[str, str] | None = None,
) -> MotionSummary:
    """What there is to read of a motion: the arguments and errors are those of `scene`."""
    refuse_an_instant(run)
    return MotionSummary(
        panels=panels_of(run, grouped(plots) or everything(run)),
        motion=motion_of(run),
        reactions=reactions_of(run),
        parameters=parameters_of(run, meanings or {}),
        start=start_of(run),
        evidence=evidence_of(run),
        happenings=happenings_of(run),
        doubt=run.doubt,
    )


def scenery(run: Trajectory, *, title: str = "", about: str = "") -> Scene:
    """What there is to look at: a scene without an account, which takes its time.

    Raises:
        NumericError: for a motion beyond all numbers, or that does not last.
    """
    refuse_an_instant(run)
    equations = equations_of(run)
    t = np.linspace(0.0, run.duration, _frames(run))
    links = links_of(run, t)
    bodies = bodies_of(run, links, t)
    reach = max(body.reach for body in bodies)
    supports, traces = supports_of(run, t, reach)
    up = _up(run)
    return Scene(
        title=title or equations.system.name,
        about=about,
        duration=run.duration,
        frames=len(t),
        up=up,
        floor=_floor(bodies, links, supports, up),
        directions=equations.system.root.labels,
        bodies=bodies,
        joints=joints_of(run),
        links=links,
        supports=supports,
        arrows=arrows_of(run, t),
        traces=(*traces, *other_traces(bodies)),
        origin=origin_of_scene(run),
    )


def poses(run: Trajectory, frames: int) -> tuple[Pose, ...]:
    """Where the bodies are at equally spaced instants: little else is made while one waits."""
    t = np.linspace(0.0, run.duration, frames)
    return tuple(body.pose for body in bodies_of(run, (), t))


def _frames(run: Trajectory) -> int:
    """So many that nothing but a spin turns far between two of them."""
    bodies = run.equations.system.bodies
    coarse = np.linspace(0.0, run.duration, _COARSE)
    fastest = max(_fastest(run, body, coarse) for body in bodies)
    if not isfinite(fastest):
        raise NumericError(
            f"{equations_of(run).system.name} turns faster than numbers can be squared",
            expected="a motion that can be drawn",
            advice="end it earlier, or check the sizes of the parameters and of the start",
        )
    wanted = ceil(run.duration * fastest / _TURN)
    most = max(_MOST // len(bodies), _FEWEST)
    return 1 + min(max(wanted, _LEAST), most)


def _fastest(run: Trajectory, body: Body, t: Array) -> float:
    """Greatest angular velocity of what poses are given of, rad/s: the axes, or a ball itself."""
    turning = vectors(run, lambda equations: _turning(equations, body), t)
    return float(np.max(np.linalg.norm(turning, axis=1)))


def _turning(equations: Equations, body: Body) -> Vector:
    if body.fixed_axes is None:
        return equations.kinetics.velocities[body][1]
    return body.axes.angular_velocity


def _up(run: Trajectory) -> Triple:
    """Against gravity; else off a support or out of the plane of a guide."""
    root = run.equations.system.root
    vector = next(iter(_upright(run)), root[root.labels[2]])
    x, y, z = constants(run, vector.express(root).components)
    return x, y, z


def _upright(run: Trajectory) -> list[Vector]:
    system = run.equations.system
    root = system.root
    loads = [load for load in system.loads if hasattr(load, "up")]
    lifted = [load.up if load.up is not None else root[root.labels[2]] for load in loads]
    supports = [element.on.up for element in system.elements if hasattr(element, "on")]
    guides = [element.normal for element in system.elements if hasattr(element, "normal")]
    return [*lifted, *supports, *guides]


def _floor(
    bodies: Sequence[SceneBody], links: Sequence[Link], supports: Sequence[Support], up: Triple
) -> float | None:
    """A height below everything, where nothing is stood on."""
    if supports:
        return None
    feet = [end for link in links for end in (link.start, link.end)]
    lowest = [float(np.min(foot @ np.array(up))) for foot in feet]
    return min([*lowest, *(_depth(body, np.array(up)) for body in bodies)])


def _depth(body: SceneBody, up: Array) -> float:
    return float(np.min(body.pose.place @ up)) - _BELOW * body.reach


# Supports of the scene, and the paths that are left on them and in space.

_ROOM = 2.6  # of a body's reach: margin of a support round the path of the contact
_BEYOND = 1.1  # of a body's reach: where the end of its axis leaves a trace
_MOVING = 1e-9


def supports_of(
    run: Trajectory, t: Array, reach: float
) -> tuple[tuple[Support, ...], tuple[Trace, ...]]:
    """Supports that bodies touch, each once, and the paths of the contacts."""
    supports: dict[Plane, Support] = {}
    traces: list[Trace] = []
    for contact in _contacts(run):
        plane = contact.on
        pose = _pose(run, plane, t)
        points = vectors(run, _touching(contact), t)
        on_it = _carried(points, pose)
        if plane not in supports:
            supports[plane] = _support(contact, pose, on_it, reach)
        traces.append(Trace("contact", f"path of {contact.name}", points))
        if len(pose.place) > 1 or len(pose.turn) > 1:
            number = list(supports).index(plane)
            traces.append(Trace("contact", f"trace on {contact.name}", on_it, number))
    return tuple(supports.values()), tuple(traces)


def other_traces(bodies: tuple[SceneBody, ...]) -> Iterator[Trace]:
    """Paths of centres of mass that move, and of the ends of axes about those that do not."""
    for body in bodies:
        pose, shape = body.pose, body.shape
        if len(pose.place) > 1:
            yield Trace("centre", f"centre of {body.name}", pose.place)
        elif len(pose.turn) > 1 and shape.kind != "ball":
            tip = np.array(shape.axis) * _BEYOND * shape.reach
            yield Trace("axis", f"axis of {body.name}", pose.place + _turned(tip, pose.turn))


def _contacts(run: Trajectory) -> list[Contact]:
    """Contacts of the declaration, whatever phase they begin in."""
    elements = run.equations.system.elements
    found = (getattr(element, "contact", element) for element in elements)
    return [contact for contact in found if isinstance(contact, Contact)]


def _touching(contact: Contact) -> Callable[[Equations], Vector | None]:
    def place(equations: Equations) -> Vector | None:
        element = equations.system.element(contact.name)
        if not isinstance(element, Contact):
            return None
        return equations.kinetics.places[contact.body] + contact.arm

    return place


def _pose(run: Trajectory, plane: Plane, t: Array) -> Pose:
    """Of the surface, its third direction along the normal."""
    root = plane.axes.root
    triad = [plane.axes[label].express(root) for label in (*plane.tangents, plane.normal)]
    entries = [direction.components[i] for i in range(3) for direction in triad]
    turn = quaternions(along(run, lambda equations: entries, 9, t).reshape(-1, 3, 3))
    place = vectors(run, lambda equations: plane.origin, t)
    turning = along(run, lambda equations: [plane.turning], 1, t)[:, 0]
    angle: Array = cumulative_simpson(turning, x=t, initial=0.0)
    if np.ptp(angle) <= _MOVING:
        return Pose(collapsed(place), collapsed(turn), np.zeros(0), (0.0, 0.0, 1.0))
    return Pose(collapsed(place), turned_about_third(turn, angle), np.zeros(0), (0.0, 0.0, 1.0))


def turned_about_third(turn: Array, angle: Array) -> Array:
    """Attitudes turned further about their own third direction."""
    x, y, z, w = turn.T
    s, c = np.sin(angle / 2), np.cos(angle / 2)
    found: Array = np.stack([c * x + s * y, c * y - s * x, c * z + s * w, c * w - s * z], axis=1)
    return found


def _carried(points: Array, pose: Pose) -> Array:
    """Points as seen from a surface that moves, along its own directions."""
    back = pose.turn * np.array([-1.0, -1.0, -1.0, 1.0])
    return _turned(points - pose.place, back)


def _turned(vector: Array, turn: Array) -> Array:
    """Vectors turned by quaternions."""
    u, w = turn[:, :3], turn[:, 3:]
    cross = np.cross(u, vector)
    found: Array = vector + 2 * (w * cross + np.cross(u, cross))
    return found


def _support(contact: Contact, pose: Pose, path: Array, reach: float) -> Support:
    kind = type(contact.on).__name__.lower()
    flat = path[np.isfinite(path).all(axis=1), :2]
    low, high = (flat.min(0), flat.max(0)) if len(flat) else (np.zeros(2), np.zeros(2))
    middle, half = (low + high) / 2, (high - low) / 2 + _ROOM * reach
    if kind == "turntable":
        radius = float(np.max(np.linalg.norm(flat, axis=1), initial=0.0)) + reach
        middle, half = np.zeros(2), np.full(2, 1.08 * radius)
    return Support(
        contact.name,
        kind,
        pose,
        (float(middle[0]), float(middle[1])),
        (float(half[0]), float(half[1])),
    )

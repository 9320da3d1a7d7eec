"""Making a scene of a motion."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from math import ceil, isfinite

import numpy as np

from polhode.algebra import Vector
from polhode.base import NumericError
from polhode.derive import Equations
from polhode.model import Body
from polhode.simulate import Trajectory
from polhode.view._judgement import Judgement
from polhode.view._quantities import Array, Groups, equations_of, grouped, refuse_an_instant
from polhode.view._scene import (
    Link,
    MotionSummary,
    Pose,
    Scene,
    SceneBody,
    Support,
    Triple,
)
from polhode.view._scene_along import constants, vectors
from polhode.view._scene_bodies import arrows_of, bodies_of
from polhode.view._scene_joints import joints_of, links_of
from polhode.view._scene_supports import other_traces, supports_of
from polhode.view._scene_text import (
    everything,
    evidence_of,
    happenings_of,
    motion_of,
    origin_of_scene,
    panels_of,
    parameters_of,
    reactions_of,
    start_of,
)
from polhode.view._shapes import reach_of

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
    reach = max(_reach(body) for body in bodies)
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


def _reach(body: SceneBody) -> float:
    return max([reach_of(body.shape), *(float(np.linalg.norm(arm)) for arm in body.arms)])


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
    return float(np.min(body.pose.place @ up)) - _BELOW * _reach(body)

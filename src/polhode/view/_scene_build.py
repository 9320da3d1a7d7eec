"""Building the scene of a motion: bodies, supports, traces, and the text beside them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from math import ceil, isfinite

import numpy as np

from polhode.algebra import Expr, Vector
from polhode.base import NumericError
from polhode.derive import Equations
from polhode.model import Body, Contact, Frame, System
from polhode.simulate import Trajectory
from polhode.view import _rotations
from polhode.view._judgement import Judgement
from polhode.view._magnitudes import magnitudes_of
from polhode.view._quantities import (
    Array,
    Groups,
    equations_of,
    everything,
    grouped,
    made_with,
    require_duration,
)
from polhode.view._scene import Link, MotionSummary, Pose, Scene, SceneBody, Support, Trace, Triple
from polhode.view._scene_along import constants, vectors
from polhode.view._scene_bodies import angles_of, arrows_of, bodies_of, joints_of, links_of
from polhode.view._scene_portraits import portraits_of
from polhode.view._scene_supports import supports_of
from polhode.view._scene_text import (
    POINTS,
    equations_shown,
    evidence_of,
    happenings_of,
    modes_of,
    panels_of,
    parameters_of,
    start_of,
)

# The page interpolates linearly between frames: over 0.12 rad a chord departs from its circle by
# angle²/8, 0.2 % of the radius. The number of frames bounds the size of the page.
_TURN = 0.12  # largest angle between two frames, rad
_LEAST, _MOST = 2000, 3200  # frames, for one body
_BLURRED = 2200  # frames for one body that turns too fast even for the most
_FEWEST = 600  # frames at least, for any number of bodies
_COARSE = 601  # instants at which the angular velocity is sampled
_BEYOND = 1.1  # distance of the end of an axis that leaves a trace, in reaches of its body
_BELOW = 1.15  # depth of the floor where no support is, in reaches of the body above


def scene(
    run: Trajectory,
    *,
    title: str = "",
    about: str = "",
    plots: Groups = (),
    meanings: Mapping[str, str] | None = None,
    judgements: Iterable[Judgement] = (),
    frames: int | None = None,
) -> Scene:
    """The complete scene of a motion.

    Args:
        run: the motion.
        title: heading; the system's name by default.
        about: the problem in a few sentences.
        plots: names of quantities to plot, or groups of names; by default coordinates, speeds
            and reactions.
        meanings: what parameters are, by name.
        judgements: verdicts on claims about the system.
        frames: number of instants of the picture and the plots; by default as many as a smooth
            picture needs.

    Raises:
        DeclarationError: for the name of a quantity that the run does not have.
        NumericError: for a motion beyond all numbers, or that does not last.
    """
    read = account(run, plots=plots, meanings=meanings, points=frames or POINTS)
    seen = scenery(run, title=title, about=about, frames=frames)
    return replace(seen, judgements=tuple(judgements), **vars(read))


def account(
    run: Trajectory,
    *,
    plots: Groups = (),
    meanings: Mapping[str, str] | None = None,
    points: int = POINTS,
) -> MotionSummary:
    """The text, numbers and plots of a motion; arguments and errors as for `scene`.

    Args:
        points: of every plotted curve.
    """
    require_duration(run)
    sizes, equations = magnitudes_of(run), equations_shown(run)
    return MotionSummary(
        panels=panels_of(run, grouped(plots) or everything(run), sizes, points),
        portraits=portraits_of(run, points),
        motion=equations.motion,
        reactions=equations.reactions,
        parameters=parameters_of(run, meanings or {}),
        start=start_of(run, sizes),
        evidence=evidence_of(run),
        happenings=happenings_of(run),
        modes=modes_of(run),
        doubt=run.doubt,
    )


def scenery(
    run: Trajectory, *, title: str = "", about: str = "", frames: int | None = None
) -> Scene:
    """The picture alone: a scene without formulas, numbers and plots, which take longer.

    Raises:
        NumericError: for a motion beyond all numbers, or that does not last.
    """
    require_duration(run)
    equations = equations_of(run)
    t = np.linspace(0.0, run.duration, frames or frames_of(run))
    links = links_of(run, t)
    bodies = bodies_of(run, links, t)
    reach = max(body.reach for body in bodies)
    supports, traces = supports_of(run, t, reach)
    x, y, z = constants(run, up_of(equations.system))
    up = (x, y, z)
    return Scene(
        title=title or equations.system.name,
        about=about,
        duration=run.duration,
        frames=len(t),
        up=up,
        floor=_floor(bodies, links, supports, up),
        directions=_directions(equations.system.root),
        bodies=bodies,
        joints=joints_of(run),
        links=links,
        supports=supports,
        arrows=arrows_of(run, t, magnitudes_of(run)),
        angles=angles_of(run, t),
        traces=(*traces, *other_traces(bodies)),
        origin=made_with(run),
    )


def poses(run: Trajectory, frames: int) -> tuple[Pose, ...]:
    """Only the poses of the bodies at equally spaced instants, for a quick update."""
    t = np.linspace(0.0, run.duration, frames)
    return tuple(body.pose for body in bodies_of(run, (), t))


def frames_of(run: Trajectory) -> int:
    """Number of frames so that no body turns far between two of them, its spin apart."""
    system = equations_of(run).system
    coarse = np.linspace(0.0, run.duration, _COARSE)
    fastest = max(_fastest_turn(run, body, coarse) for body in system.bodies)
    if not isfinite(fastest):
        raise NumericError(
            f"the angular velocity of {system.name} is too large to be squared",
            expected="a motion that can be drawn",
            advice="shorten it, or check the sizes of the parameters and start values",
        )
    wanted = ceil(run.duration * fastest / _TURN)
    enough = max(wanted, _LEAST) if wanted <= _MOST else _BLURRED
    return 1 + min(enough, max(_MOST // len(system.bodies), _FEWEST))


def _fastest_turn(run: Trajectory, body: Body, t: Array) -> float:
    """Greatest angular velocity of a body's axes, or of a ball without axes, rad/s."""

    def turning(equations: Equations) -> Vector:
        if body.fixed_axes is None:
            return equations.kinetics.velocities[body][1]
        return body.axes.angular_velocity

    return float(np.max(np.linalg.norm(vectors(run, turning, t), axis=1)))


def up_of(system: System) -> tuple[Expr, ...]:
    """The upward direction: against gravity, normal to a support, or else upwards on the Earth."""
    root = system.root
    loads = [load for load in system.loads if hasattr(load, "up")]
    lifted = [load.up if load.up is not None else root[root.labels[2]] for load in loads]
    supports = [element.on.up for element in system.elements if isinstance(element, Contact)]
    guides = [element.normal for element in system.elements if hasattr(element, "normal")]
    skyward = [root.skyward] if root.skyward else []
    upright = next(iter([*lifted, *supports, *skyward, *guides]), root[root.labels[2]])
    return tuple(upright.express(root).components)


def _directions(root: Frame) -> tuple[str, ...]:
    """Names of the directions of the root frame, on the Earth with where they point."""
    if not root.compass:
        return root.labels
    short = {"north": "N", "east": "E", "south": "S", "west": "W"}
    pairs = zip(root.labels, root.compass, strict=True)
    return tuple(f"{label} {short.get(to, to)}" for label, to in pairs)


def _floor(
    bodies: Sequence[SceneBody], links: Sequence[Link], supports: Sequence[Support], up: Triple
) -> float | None:
    """A height below all bodies and links; None if there is a support."""
    if supports:
        return None
    ends = [end for link in links for end in (link.start, link.end)]
    lowest = [float(np.min(end @ np.array(up))) for end in ends]
    for body in bodies:
        lowest.append(float(np.min(body.pose.place @ np.array(up))) - _BELOW * body.reach)
    return min(lowest)


# --- paths of bodies in space ---


def other_traces(bodies: tuple[SceneBody, ...]) -> Iterator[Trace]:
    """Paths of centres of mass that move, and of the ends of axes about those that do not."""
    for body in bodies:
        pose, shape = body.pose, body.shape
        if len(pose.place) > 1:
            yield Trace("centre", f"centre of {body.name}", pose.place)
        elif len(pose.turn) > 1 and shape.kind != "ball":
            tip = np.array(shape.axis) * _BEYOND * shape.reach
            place = pose.place + _rotations.applied(pose.turn, tip)
            yield Trace("axis", f"axis of {body.name}", place)

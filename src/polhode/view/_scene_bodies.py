"""Bodies of the scene: their poses, what holds them, and the arrows at them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from polhode.algebra import Expr, ExprLike, Symbol, Vector
from polhode.derive import Equations
from polhode.model import Action, Body, BodyPoint
from polhode.simulate import Trajectory
from polhode.view._quantities import Array, equations_of
from polhode.view._scene import NOWHERE, Arrow, Link, Pose, SceneBody, Triple
from polhode.view._scene_along import along, attitudes, collapsed, constants, rolled, vectors
from polhode.view._shapes import reach_of, shape_of

_POINT = 0.07  # radius of a particle against the reach of the whole
_NONE = 1e-9  # of the largest of its kind: an arrow that is not drawn
_USUAL = 0.9


def bodies_of(run: Trajectory, links: Sequence[Link], t: Array) -> tuple[SceneBody, ...]:
    """Every body with its pose at the given instants; `links` tell the size of the whole."""
    bodies = [_body(run, body.name, t) for body in run.equations.system.bodies]
    lengths = [reach_of(b.shape) for b in bodies]
    lengths += [float(np.linalg.norm(arm)) for b in bodies for arm in b.arms]
    lengths += [float(np.max(np.linalg.norm(x.start - x.end, axis=1))) for x in links]
    return tuple(_visible(body, max(lengths) or 1.0) for body in bodies)


def _body(run: Trajectory, name: str, t: Array) -> SceneBody:
    body = equations_of(run).system.body(name)
    return SceneBody(name, shape_of(body, run), _pose(run, body, t), tuple(_arms(run, body)))


def _visible(body: SceneBody, size: float) -> SceneBody:
    """A particle gets a radius that can be seen."""
    if any(body.shape.size):
        return body
    return replace(body, shape=replace(body.shape, size=(_POINT * size,)))


def _pose(run: Trajectory, body: Body, t: Array) -> Pose:
    place = vectors(run, lambda equations: equations.kinetics.places[body], t)
    fixed = body.fixed_axes
    if fixed is None:
        turning = vectors(run, lambda equations: equations.kinetics.velocities[body][1], t)
        carried = vectors(run, lambda equations: equations.system.root.angular_velocity, t)
        turn = rolled(turning - carried, float(t[1] - t[0]))
        return Pose(collapsed(place), collapsed(turn), np.zeros(0), (0.0, 0.0, 1.0))
    turn = attitudes(run, lambda equations: body.axes, t)
    spin, axis = np.zeros(0), (0.0, 0.0, 1.0)
    if fixed != body.axes:
        spin = along(run, lambda equations: [fixed.angle], 1, t)[:, 0]
        axis = _triple(constants(run, fixed.axis))
    return Pose(collapsed(place), collapsed(turn), spin, axis)


def _arms(run: Trajectory, body: Body) -> Iterator[Triple]:
    """From the centre of mass to where joints hold it."""
    for element in run.equations.system.elements:
        for owner, offset in _held(element):
            arm = offset.express(body.axes).components
            if owner == body and not any(s.kind.varies for e in arm for s in e.symbols()):
                yield _triple(constants(run, arm))


def _held(element: object) -> Iterator[tuple[Body, Vector]]:
    """Points of bodies that a pivot or a hand holds."""
    at, to = getattr(element, "at", None), getattr(element, "to", None)
    if isinstance(at, Vector):
        yield element.body, at  # type: ignore[attr-defined]
    if isinstance(to, BodyPoint):
        yield to.body, to.offset


def arrows_of(run: Trajectory, t: Array) -> tuple[Arrow, ...]:
    """Forces of contacts and joints, loads, torques, angular velocities and momenta."""
    found = [*_forces(run, t), *_loads(run, t), *_of_bodies(run, t)]
    largest = {kind: max(a.largest for a in found if a.kind == kind) for kind in _kinds(found)}
    return tuple(a for a in found if a.largest > _NONE * largest[a.kind])


def _kinds(arrows: list[Arrow]) -> dict[str, None]:
    return dict.fromkeys(arrow.kind for arrow in arrows)


def _arrow(
    kind: str, name: str, body: int, unit: str, values: Array, foot: Array = NOWHERE
) -> Arrow:
    shown = np.nan_to_num(values, posinf=0.0, neginf=0.0)
    sizes = np.linalg.norm(shown, axis=1)
    usual, largest = float(np.quantile(sizes, _USUAL)), float(np.max(sizes))
    return Arrow(kind, name, body, unit, foot, collapsed(shown), usual, largest)


def _forces(run: Trajectory, t: Array) -> Iterator[Arrow]:
    bodies = list(run.equations.system.bodies)
    names: dict[str, Body] = {}
    for equations in _modes(run):
        for name, reaction in equations.reactions.items():
            names.setdefault(name, reaction.body)
    for name, body in names.items():
        values = vectors(run, _force(name), t)
        foot = collapsed(vectors(run, _foot(name, body), t))
        yield _arrow("force", f"force at {name}", bodies.index(body), "N", values, foot)


def _modes(run: Trajectory) -> Iterator[Equations]:
    for segment in run.segments:
        yield segment.dynamics.equations  # type: ignore[misc]


def _force(name: str) -> Callable[[Equations], Vector | None]:
    def force(equations: Equations) -> Vector | None:
        reaction = equations.reactions.get(name)
        return None if reaction is None else reaction.force.subs(_chosen(equations))

    return force


def _foot(name: str, body: Body) -> Callable[[Equations], Vector | None]:
    def foot(equations: Equations) -> Vector | None:
        reaction = equations.reactions.get(name)
        place = equations.kinetics.places[body]
        return place if reaction is None else place + reaction.arm

    return foot


def _chosen(equations: Equations) -> dict[Expr, ExprLike]:
    """The least values of reactions that Newton's laws leave open."""
    open_ = (Symbol(name) for name in equations.undetermined)
    return {Expr.generator(s): equations.least[s.name] for s in open_}


def _loads(run: Trajectory, t: Array) -> Iterator[Arrow]:
    bodies = list(run.equations.system.bodies)
    for load in run.equations.system.loads:
        for i, body in enumerate(bodies):
            values = vectors(run, _load(load.name, body), t)
            yield _arrow("load", f"{load.name} on {body.name}", i, "N", values)


def _load(name: str, body: Body) -> Callable[[Equations], Vector]:
    def force(equations: Equations) -> Vector:
        actions = _actions(equations, body, name)
        return sum((a.force for a in actions), start=equations.system.root.zero)

    return force


def _actions(equations: Equations, body: Body, only: str = "") -> list[Action]:
    """What loads do to a body."""
    motion, bodies = equations.kinetics, equations.system.bodies
    loads = [load for load in equations.system.loads if only in ("", load.name)]
    acting = [load.actions(bodies, motion.places, motion.velocities) for load in loads]
    return [action for actions in acting for action in actions if action.body == body]


def _of_bodies(run: Trajectory, t: Array) -> Iterator[Arrow]:
    for i, body in enumerate(run.equations.system.bodies):
        wanted: Mapping[str, tuple[str, str, Callable[[Equations], Vector]]] = {
            "torque": ("torque about the centre of", "N m", _torque(body)),
            "omega": ("angular velocity of", "rad/s", _omega(body)),
            "momentum": ("angular momentum of", "kg m²/s", _momentum(body)),
        }
        for kind, (words, unit, vector) in wanted.items():
            yield _arrow(kind, f"{words} {body.name}", i, unit, vectors(run, vector, t))


def _omega(body: Body) -> Callable[[Equations], Vector]:
    return lambda equations: equations.kinetics.velocities[body][1]


def _momentum(body: Body) -> Callable[[Equations], Vector]:
    def momentum(equations: Equations) -> Vector:
        angular = equations.kinetics.velocities[body][1].express(body.axes)
        return Vector(body.inertia.times(angular.components), body.axes)

    return momentum


def _torque(body: Body) -> Callable[[Equations], Vector]:
    """Of everything that acts, about the centre of mass."""

    def torque(equations: Equations) -> Vector:
        total = equations.system.root.zero
        for line in equations.lines:
            wrench = line.on(body)
            if wrench is not None:
                total = total + wrench.couple * equations.least[line.name]
        for action in _actions(equations, body):
            total = total + action.couple + action.arm.cross(action.force)
        return total

    return torque


def _triple(values: tuple[float, ...]) -> Triple:
    x, y, z = values
    return x, y, z

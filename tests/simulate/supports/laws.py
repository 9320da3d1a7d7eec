"""What Newton, Euler, Coulomb and geometry demand of a motion on a support, from numbers alone.

Nothing here knows how polhode describes a contact. Of a motion only these are read: the place of
the centre of mass, the attitude, the angular velocity, the point of contact and the force there,
along the laboratory's axes. Derivatives are differences.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import polhode as ph

_STEP = 2e-4  # s: errors of differences are some 1e-10 of the largest value


@dataclass
class Seen:
    """A motion along the laboratory's axes, each array with the instants first."""

    centre: np.ndarray
    turn: np.ndarray  # matrices from the body's axes to the laboratory's
    angular: np.ndarray
    point: np.ndarray
    force: np.ndarray


def seen(run: ph.Trajectory, times: np.ndarray) -> Seen:
    """A motion at some instants, all within one contact mode."""
    middle = float(times[len(times) // 2])
    segment = next(s for s in run.segments if s.begin <= middle <= s.end)
    equations = segment.dynamics.equations
    system = equations.system
    (body,) = system.bodies
    root = system.root
    (contact,) = system.elements
    touching = getattr(contact, "contact", contact)
    centre = equations.kinetics.places[body]
    angular = equations.kinetics.resolve(body.angular_velocity)
    names = [touching.component(x) for x in touching.on.axes.labels]
    held = [equations.components.get(n, 0) for n in names]
    force = touching.on.axes.vector(*held)
    wanted = [
        *centre.express(root).components,
        *angular.express(root).components,
        *(centre + touching.arm).express(root).components,
        *force.express(root).components,
        *(e for row in body.axes.rotation_to(root).rows for e in row),
    ]
    values = np.array(segment.values(wanted, times)).T
    return Seen(
        values[:, :3],
        values[:, 12:].reshape(-1, 3, 3),
        values[:, 3:6],
        values[:, 6:9],
        values[:, 9:12],
    )


def derivative(values: np.ndarray, step: float) -> np.ndarray:
    """First derivative at the inner instants, to sixth order."""
    weights = np.array([-1, 9, -45, 0, 45, -9, 1]) / 60
    return _weighted(values, weights) / step


def second_derivative(values: np.ndarray, step: float) -> np.ndarray:
    """Second derivative at the inner instants, to sixth order."""
    weights = np.array([2, -27, 270, -490, 270, -27, 2]) / 180
    return _weighted(values, weights) / step**2


def _weighted(values: np.ndarray, weights: np.ndarray) -> np.ndarray:
    size = len(values) - 6
    return sum(w * values[k : k + size] for k, w in enumerate(weights))


@dataclass
class Errors:
    """Largest violations, each relative to the terms of its law."""

    force: float
    couple: float
    gap: float
    slip: np.ndarray  # velocity of the material point of contact, m/s, shape (instants, 3)
    normal: np.ndarray  # normal force, N
    rubbed: np.ndarray  # force along the surface, N, shape (instants, 3)


def errors(
    run: ph.Trajectory,
    begin: float,
    mass: float,
    moments: tuple[float, float, float],
    surface: Callable[[np.ndarray, float], tuple[np.ndarray, np.ndarray]],
    support: Callable[[np.ndarray, float], np.ndarray] | None = None,
    g: float = 9.81,
) -> Errors:
    """How far a motion is off the laws over forty instants from `begin` on.

    Args:
        surface: distance of points from the support and its normals there, at a time.
        support: velocity of the support's material at points, at a time; at rest by default.
    """
    times = begin + _STEP * np.arange(46)
    here = seen(run, times)
    inner = slice(3, -3)
    weight = np.array([0, 0, -mass * g])
    acceleration = second_derivative(here.centre, _STEP)
    off = mass * acceleration - weight - here.force[inner]
    size = np.max(np.abs(mass * acceleration)) + mass * g
    inertia = here.turn @ np.diag(moments) @ here.turn.transpose(0, 2, 1)
    momentum = np.einsum("tij,tj->ti", inertia, here.angular)
    arm = here.point - here.centre
    couple = np.cross(arm, here.force)[inner]
    change = derivative(momentum, _STEP)
    largest = np.max(np.abs(change)) + np.max(np.abs(couple)) + mass * g * np.max(np.abs(arm))
    at = [surface(p[None], t) for p, t in zip(here.point, times, strict=True)]
    gaps = np.array([d[0] for d, _ in at])
    normals = np.array([n[0] for _, n in at])
    velocity = derivative(here.centre, _STEP)
    slip = velocity + np.cross(here.angular, arm)[inner]
    if support is not None:
        moving = [support(p, t) for p, t in zip(here.point[inner], times[inner], strict=True)]
        slip = slip - np.array(moving)
    normal = np.sum(here.force * normals, axis=1)
    rubbed = here.force - normal[:, None] * normals
    return Errors(
        float(np.max(np.abs(off)) / size),
        float(np.max(np.abs(change - couple)) / largest),
        float(np.max(np.abs(gaps))),
        slip,
        normal[inner],
        rubbed[inner],
    )

"""Herpolhode: what the angular velocity of a free body draws on the invariable plane."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from polhode.simulate import Trajectory
from polhode.view._quantities import Array, instants
from polhode.view.figures._drawn import Drawn
from polhode.view.figures._polhodes import free_body, moments_of, rates_of
from polhode.view.figures._style import COLOURS, MUTED, axes_or_new, house_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_NODES = 8  # of a quadrature, between two instants
_CIRCLE = np.linspace(0, 2 * np.pi, 241)


@house_style()
def herpolhode(run: Trajectory, *, ax: Axes | None = None) -> Drawn:
    """Path of the tip of ω on the plane square to the constant angular momentum, rad/s.

    Dashed circles are the least and greatest distance from the angular momentum (the cross); a
    dot marks the start, which is drawn to the right (Poinsot 1834).

    Raises:
        DeclarationError: where no body turns freely with its principal axes.
    """
    axes = axes_or_new(ax, 3.8)
    path = invariable_path(run)
    (line,) = axes.plot(*path, color=COLOURS[0], linewidth=1.1)
    axes.plot(*path[:, 0], "o", color=COLOURS[0], markersize=4.5, zorder=3)
    distances = np.hypot(*path)
    for radius in (float(np.min(distances)), float(np.max(distances))):
        circle = radius * np.array([np.cos(_CIRCLE), np.sin(_CIRCLE)])
        axes.plot(*circle, color=MUTED, linewidth=0.8, linestyle=(0, (4, 3)))
    axes.plot(0, 0, "+", color=MUTED, markersize=8)
    axes.set_aspect("equal")
    axes.margins(0.05)
    axes.set_xlabel(r"$\omega_\xi$ (rad/s)")
    axes.set_ylabel(r"$\omega_\eta$ (rad/s)")
    return Drawn(axes, [line])


def invariable_path(run: Trajectory) -> Array:
    """The angular velocity square to the angular momentum, along fixed directions, shape (2, n).

    With w that part of ω, it turns about the angular momentum at the rate n·(w × dw/dt)/w²,
    dw/dt being taken in space.
    """
    t = instants(run)
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    half = np.diff(t)[:, None] / 2
    within = (t[:-1, None] + half * (1 + nodes)).ravel()
    turned = np.sum(half * weights * _swept(run, within).reshape(-1, _NODES), axis=1)
    angle = np.concatenate([[0.0], np.cumsum(turned)])
    across, _ = _across(run, t)
    path: Array = np.linalg.norm(across, axis=0) * np.array([np.cos(angle), np.sin(angle)])
    return path


def _across(run: Trajectory, t: Array) -> tuple[Array, Array]:
    """What of ω is square to the angular momentum, along the body's axes, and the normal."""
    body = free_body(run)
    rates = rates_of(run, body, t)
    momentum = moments_of(run, body)[:, None] * rates
    normal = momentum / np.linalg.norm(momentum, axis=0)
    return rates - normal * np.sum(normal * rates, axis=0), normal


def _swept(run: Trajectory, t: Array) -> Array:
    """Rate at which ω turns about the angular momentum, rad/s."""
    body = free_body(run)
    moments, rates = moments_of(run, body)[:, None], rates_of(run, body, t)
    across, normal = _across(run, t)
    gained = -np.cross(rates, moments * rates, axis=0) / moments  # Euler's equations
    drift = gained - normal * np.sum(normal * gained, axis=0)
    swept = np.sum(normal * np.cross(across, drift, axis=0), axis=0)
    distance = np.sum(across**2, axis=0)
    rate: Array = np.divide(swept, distance, out=np.zeros_like(t), where=distance > 0)
    return rate

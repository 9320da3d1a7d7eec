"""Polhodes: where the angular velocity pierces the inertia ellipsoid."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from polhode.base import DeclarationError
from polhode.model import Body, Components
from polhode.simulate import Trajectory
from polhode.view._quantities import Array, equations_of, instants
from polhode.view.figures._drawn import Drawn
from polhode.view.figures._globe import View, arrow, bare, draw_on
from polhode.view.figures._style import COLOURS, FAINT, MUTED, axes_or_new, house_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

_VIEW = View(azimuth=38, elevation=24)
_ROUND = np.linspace(0, 2 * np.pi, 241)
_FAMILY = 4  # polhodes drawn about each stable axis


@house_style()
def polhodes(run: Trajectory, *, ax: Axes | None = None) -> Drawn:
    """Polhodes of a free body on its inertia ellipsoid, I₁ω₁² + I₂ω₂² + I₃ω₃² = 2T.

    Those of other angular momenta are thin, the separatrix is dashed, and the run's own is bold.
    The ellipsoid is drawn to scale along the principal axes (Poinsot 1834).

    Raises:
        DeclarationError: where no body turns freely with its principal axes, or two of its
            principal moments are equal.
    """
    axes = axes_or_new(ax, 3.8)
    body = free_body(run)
    moments = moments_of(run, body)
    rates = rates_of(run, body, instants(run))
    unit = rates * np.sqrt(moments)[:, None]  # on a ball, 2T its radius squared
    unit = unit / np.sqrt(np.sum(unit**2, axis=0))
    stretch = np.sqrt(np.min(moments) / moments)[:, None]
    for curve in _family(moments):
        _on_ellipsoid(axes, curve, stretch, color=MUTED, linewidth=0.6)
    for curve in _separatrices(moments):
        style = {"color": COLOURS[1], "linewidth": 1.1, "linestyle": (0, (4, 2))}
        _on_ellipsoid(axes, curve, stretch, **style)
    own = _on_ellipsoid(axes, unit, stretch, color=COLOURS[0], linewidth=2.0, alpha=1.0)
    _outline(axes, stretch)
    _principal_axes(axes, stretch, body.axes.labels)
    bare(axes)
    return Drawn(axes, own)


def free_body(run: Trajectory) -> Body:
    """The body whose angular velocity is told along its own axes."""
    for body in equations_of(run).system.bodies:
        if isinstance(body.spin, Components):
            return body
    raise DeclarationError(
        f"the polhodes of {run.equations.system.name}",
        expected="a body whose speeds are the components of its angular velocity (Components)",
    )


def rates_of(run: Trajectory, body: Body, t: Array) -> Array:
    """Angular velocity along the body's axes, rad/s, shape (3, instants)."""
    return np.array([run.evaluate(c, t) for c in body.angular_velocity.components])


def moments_of(run: Trajectory, body: Body) -> Array:
    """Principal moments of inertia, three different ones, kg m²."""
    inertia = np.array([[run.evaluate(e, 0.0) for e in row] for row in body.inertia.rows])
    moments = np.diag(inertia)
    if np.any(inertia - np.diag(moments)) or len(set(moments)) < 3:
        raise DeclarationError(
            f"polhodes of {body.name}",
            expected="three different moments of inertia along principal axes",
        )
    return moments


def _family(moments: Array) -> list[Array]:
    least, middle, greatest = np.sort(moments)
    share = (np.arange(_FAMILY) + 0.5) / _FAMILY
    ratios = [*(least + (middle - least) * share**2), *(greatest + (middle - greatest) * share**2)]
    return [
        sign * curve for ratio in ratios for curve in [_polhode(moments, ratio)] for sign in _SIGNS
    ]


_SIGNS = (-1, 1)


def _polhode(moments: Array, ratio: float) -> Array:
    """One of the two closed curves with L²/2T equal to `ratio`, on the unit ball, shape (3, n).

    With e_i the share of the energy of each axis, Σ e_i = 1 and Σ I_i e_i = ratio.
    """
    order = np.argsort(moments)
    around, others = (order[0], order[1:]) if ratio < np.median(moments) else (order[2], order[:2])
    widths = np.sqrt((ratio - moments[around]) / (moments[others] - moments[around]))
    curve = np.empty((3, len(_ROUND)))
    curve[others[0]], curve[others[1]] = widths[0] * np.cos(_ROUND), widths[1] * np.sin(_ROUND)
    curve[around] = np.sqrt(np.maximum(0.0, 1 - np.sum(curve[others] ** 2, axis=0)))
    return curve


def _separatrices(moments: Array) -> list[Array]:
    """The two great ellipses through the middle axis."""
    least, middle, greatest = np.argsort(moments)
    low, mid, high = np.sort(moments)
    tilt = np.arctan2(np.sqrt(mid - low), np.sqrt(high - mid))
    curves = []
    for sign in _SIGNS:
        curve = np.empty((3, len(_ROUND)))
        curve[middle] = np.cos(_ROUND)
        curve[least], curve[greatest] = (
            np.sin(_ROUND) * np.cos(tilt),
            sign * np.sin(_ROUND) * np.sin(tilt),
        )
        curves.append(curve)
    return curves


def _on_ellipsoid(
    axes: Axes, ball: Array, stretch: Array, **style: object
) -> tuple[Line2D, Line2D]:
    return draw_on(axes, _VIEW, ball * stretch, ball / stretch, **style)


def _outline(axes: Axes, stretch: Array) -> None:
    """The rim of the ellipsoid as seen: where its normal is square to the line of sight."""
    normal = _VIEW.towards[:, None] / stretch
    normal = (normal / np.linalg.norm(normal)).ravel()
    first = np.cross(normal, [0.0, 0.0, 1.0])
    first = first / np.linalg.norm(first)
    second = np.cross(normal, first)
    rim = first[:, None] * np.cos(_ROUND) + second[:, None] * np.sin(_ROUND)
    axes.fill(*_VIEW.project(rim * stretch), facecolor=FAINT, edgecolor=MUTED, alpha=0.35, zorder=0)
    axes.plot(*_VIEW.project(rim * stretch), color=MUTED, linewidth=0.8)


def _principal_axes(axes: Axes, stretch: Array, labels: tuple[str, ...]) -> None:
    for i, name in enumerate(labels):
        along = np.zeros((3, 2))
        along[i] = stretch[i, 0], stretch[i, 0] + 0.22
        arrow(axes, _VIEW, along, name)

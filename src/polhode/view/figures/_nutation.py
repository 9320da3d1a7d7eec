"""Where the axis of a top points: its trace on the unit sphere."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from polhode.algebra import Vector
from polhode.base import DeclarationError
from polhode.model import About, Relative
from polhode.simulate import Trajectory
from polhode.view._quantities import Array, equations_of, instants
from polhode.view.figures._drawn import Drawn
from polhode.view.figures._globe import View, arrow, bare, draw_on
from polhode.view.figures._style import COLOURS, FAINT, MUTED, axes_or_new, house_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

_VIEW = View(azimuth=-60, elevation=28)
_CIRCLE = np.linspace(0, 2 * np.pi, 361)


@house_style()
def nutation(run: Trajectory, *, axis: Vector | None = None, ax: Axes | None = None) -> Drawn:
    """Trace of a body's axis on the unit sphere, the third direction of the laboratory up.

    Dashed circles are the least and greatest inclination reached; a dot marks the start.

    Args:
        run: the motion.
        axis: unit vector; by default the axis the first body spins about.
        ax: axes to draw in.

    Raises:
        DeclarationError: where no axis is given and no body spins about one.
    """
    axes = axes_or_new(ax, 3.8)
    root = equations_of(run).system.root
    direction = (axis or _spin_axis(run)).express(root)
    t = instants(run)
    points = np.array([run.evaluate(component, t) for component in direction.components])
    _globe(axes, root.labels[2])
    for height in (float(np.min(points[2])), float(np.max(points[2]))):
        _draw(axes, _parallel(height), color=MUTED, linewidth=0.8, linestyle=(0, (4, 3)))
    trace = _draw(axes, points, color=COLOURS[0], linewidth=1.4)
    start = _VIEW.project(points[:, :1])
    axes.plot(*start, "o", color=COLOURS[0], markersize=4.5, zorder=3)
    bare(axes)
    return Drawn(axes, trace)


def _spin_axis(run: Trajectory) -> Vector:
    for body in equations_of(run).system.bodies:
        if isinstance(body.spin, About | Relative):
            return body.axes[body.spin.axis]
    raise DeclarationError(
        f"the axis of {run.system.name}",
        expected="a body that spins about one of its axes",
        advice="say which axis to follow, as axis=body.axes['3']",
    )


def _globe(axes: Axes, vertical: str) -> None:
    for height in np.sin(np.radians([-60, -30, 0, 30, 60])):
        _draw(axes, _parallel(height), color=FAINT, linewidth=0.6)
    for turn in np.radians(np.arange(0, 180, 30)):
        meridian = np.array(
            [np.cos(turn) * np.sin(_CIRCLE), np.sin(turn) * np.sin(_CIRCLE), np.cos(_CIRCLE)]
        )
        _draw(axes, meridian, color=FAINT, linewidth=0.6)
    axes.plot(np.cos(_CIRCLE), np.sin(_CIRCLE), color=MUTED, linewidth=0.8)
    arrow(axes, _VIEW, np.array([[0.0, 0.0], [0.0, 0.0], [1.0, 1.25]]), f"${vertical}$")


def _parallel(height: float) -> Array:
    radius = np.sqrt(max(0.0, 1 - height**2))
    return np.array([radius * np.cos(_CIRCLE), radius * np.sin(_CIRCLE), 0 * _CIRCLE + height])


def _draw(axes: Axes, points: Array, **style: object) -> tuple[Line2D, Line2D]:
    return draw_on(axes, _VIEW, points, points, **style)

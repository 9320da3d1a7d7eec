"""Paths on the support: of the centre of mass, of the contact, and of the trace it leaves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.integrate import cumulative_simpson

from polhode.algebra import Vector
from polhode.base import DeclarationError
from polhode.model import Contact, Plane
from polhode.simulate import Trajectory
from polhode.view._history import legend_above
from polhode.view._quantities import Array, equations_of, label, largest, scale_for
from polhode.view._style import COLOURS, axes_or_new, line_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

_SAME = 1e-9  # relative distance of paths that are drawn as one


def floor_path(run: Trajectory, *, ax: Axes | None = None) -> list[Line2D]:
    """Paths of the centre of mass and of the point of contact, seen from above the support.

    Along the two directions of the first support that a body touches, m; a dot marks the start.

    Raises:
        DeclarationError: for a system in which nothing touches a support.
    """
    contact = _contact(run)
    place = equations_of(run).kinetics.places[contact.body]
    centre = _on_plane(run, contact.on, place)
    touched = _on_plane(run, contact.on, place + contact.arm)
    paths = {"centre": centre, "contact": touched}
    if largest(centre - touched) <= _SAME * largest(centre):
        paths = {"centre and contact": centre}
    return _drawn(axes_or_new(ax, 3.4), paths, contact.on.tangents)


def support_trace(run: Trajectory, *, ax: Axes | None = None) -> list[Line2D]:
    """The trace that the contact leaves on a turntable or a sheet, in the support's own axes, m.

    Raises:
        DeclarationError: for a system in which nothing touches a support.
    """
    contact = _contact(run)
    support = contact.on
    place = equations_of(run).kinetics.places[contact.body]
    x, y = _on_plane(run, support, place + contact.arm - support.origin)
    turned = _angle(run, support)
    trace = np.array(
        [
            np.cos(turned) * x + np.sin(turned) * y,
            np.cos(turned) * y - np.sin(turned) * x,
        ]
    )
    return _drawn(axes_or_new(ax, 3.4), {"trace on the support": trace}, support.tangents)


def _contact(run: Trajectory) -> Contact:
    for element in equations_of(run).system.elements:
        if isinstance(element, Contact):
            return element
    raise DeclarationError(
        f"a path on the support of {run.equations.system.name}",
        expected="a system with a Rolling, Smooth or Coulomb contact",
    )


def _on_plane(run: Trajectory, plane: Plane, place: Vector) -> Array:
    """Components along the two directions of a plane, shape (2, samples)."""
    return np.array([run.evaluate(place.dot(plane.axes[label])) for label in plane.tangents])


def _angle(run: Trajectory, support: Plane) -> Array:
    """Angle by which a support has turned since the start, rad."""
    turned: Array = cumulative_simpson(run.evaluate(support.turning), x=run.t, initial=0.0)
    return turned


def _drawn(axes: Axes, paths: dict[str, Array], directions: tuple[str, str]) -> list[Line2D]:
    scale = scale_for("m", largest(*paths.values()))
    lines = [
        axes.plot(*(path * scale.factor), label=name, **line_style(i))[0]
        for i, (name, path) in enumerate(paths.items())
    ]
    for i, path in enumerate(paths.values()):
        axes.plot(*(path[:, 0] * scale.factor), "o", markersize=4, color=COLOURS[i], zorder=3)
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.06)
    for axis, name in zip((axes.xaxis, axes.yaxis), directions, strict=True):
        axis.set_label_text(label(f"${name}$" if name.isalpha() else f"$x_{name}$", scale))
    legend_above(axes)
    return lines

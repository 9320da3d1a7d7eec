"""Paths on the support: of the centre of mass, of the contact, and its trace on the support."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from polhode.algebra import Expr, Vector
from polhode.base import DeclarationError
from polhode.derive import Equations
from polhode.model import Contact, Support
from polhode.simulate import Trajectory
from polhode.view._quantities import Array, accumulated, instants, label, largest, scale_for
from polhode.view._scene_along import along
from polhode.view.figures._figure import Drawn, axes_or_new
from polhode.view.figures._history import legend_above
from polhode.view.figures._style import COLOURS, WIDTH, house_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_SAME = 1e-9  # relative distance of paths that are drawn as one
_MARGIN = 0.9  # of labels and legend, inches


@house_style()
def floor_path(run: Trajectory, *, ax: Axes | None = None) -> Drawn:
    """Paths of the centre of mass and of the point of contact, seen from above the support.

    Along the first two directions of the first support that a body touches, m; a dot marks the
    start.
    On a slope, up the slope is up the page.

    Raises:
        DeclarationError: for a system in which nothing touches a support.
    """
    contact = touching(run)
    centre = _on_plane(run, contact.on, lambda equations: _centre(equations, contact))
    touched = _on_plane(run, contact.on, lambda equations: _touched(equations, contact))
    paths = {"centre of mass": centre, "contact": touched}
    if largest(centre - touched) <= _SAME * largest(centre):
        paths = {"centre of mass and contact": centre}
    return _drawn(ax, paths, contact.on)


@house_style()
def support_trace(run: Trajectory, *, ax: Axes | None = None) -> Drawn:
    """The trace that the contact leaves on a turntable or a sheet, in the support's own axes, m.

    Raises:
        DeclarationError: for a system in which nothing touches a support.
    """
    contact = touching(run)
    support = contact.on
    x, y = _on_plane(run, support, lambda equations: _touched(equations, contact) - support.origin)
    t = instants(run)
    # Angle by which the support has turned since the start, rad.
    turned = accumulated(run.evaluate(support.turning, t), t)
    along, across = np.cos(turned), np.sin(turned)
    trace = np.array([along * x + across * y, along * y - across * x])
    return _drawn(ax, {"trace on the support": trace}, support)


def centre_on_support(run: Trajectory) -> Array:
    """Where the centre of mass is along the first two directions of a support, (2, instants), m."""
    contact = touching(run)
    return _on_plane(run, contact.on, lambda equations: _centre(equations, contact))


def touching(run: Trajectory) -> Contact:
    """The first contact of a system.

    Raises:
        DeclarationError: for a system in which nothing touches a support.
    """
    for element in run.system.elements:
        if isinstance(element, Contact):
            return element
    raise DeclarationError(
        f"no body of {run.system.name} touches a support",
        expected="a system with a Rolling, Smooth or Coulomb contact",
    )


def _centre(equations: Equations, contact: Contact) -> Vector:
    return equations.kinetics.places[contact.body]


def _touched(equations: Equations, contact: Contact) -> Vector:
    """The lowest point of the body, whether it touches or not."""
    return _centre(equations, contact) + contact.arm


def _on_plane(run: Trajectory, support: Support, place: Callable[[Equations], Vector]) -> Array:
    """Components along the first two directions of a support, shape (2, instants)."""

    def components(equations: Equations) -> list[Expr]:
        return [place(equations).dot(direction) for direction in support.directions[:2]]

    return along(run, components, 2, instants(run)).T


def _drawn(ax: Axes | None, paths: dict[str, Array], support: Support) -> Drawn:
    root = support.axes.root
    vertical = root[root.labels[2]]
    first, second = (bool(d.dot(vertical)) for d in support.directions[:2])
    # Where the first direction alone points up a slope, it points up the page.
    across, up = (1, 0) if first and not second else (0, 1)
    scale = scale_for("m", largest(*paths.values()))
    together = np.concatenate(list(paths.values()), axis=1)[[across, up]]
    wide, high = (float(extent) for extent in np.ptp(together, axis=1))
    height = _MARGIN + (WIDTH - _MARGIN) * high / (wide or 1.0)  # for equal scales
    axes = axes_or_new(ax, min(3.5, max(1.7, height)))
    lines = []
    for i, (name, path) in enumerate(paths.items()):
        shown = path[[across, up]] * scale.factor
        width = 1.4 - 0.5 * i
        lines += axes.plot(*shown, label=name, color=COLOURS[i], linewidth=width)
        axes.plot(*shown[:, 0], "o", markersize=4, color=COLOURS[i], zorder=3)
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.06)
    axes.set_xlabel(label(_symbol(support.labels[across]), scale))
    axes.set_ylabel(label(_symbol(support.labels[up]), scale))
    if across > up and not axes.xaxis_inverted():
        axes.invert_xaxis()
    legend_above(axes)
    figure = axes.get_figure(root=True)
    if ax is None and figure is not None:
        figure.draw_without_rendering()  # equal scales may need wider labels
    return Drawn(axes, lines)


def _symbol(direction: str) -> str:
    return f"${direction}$" if direction.isalpha() else f"$x_{direction}$"

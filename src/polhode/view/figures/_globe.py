"""A transparent ball seen from a little above: what is behind shows faintly."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from polhode.view._quantities import Array
from polhode.view.figures._style import INK

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

Mask = NDArray[np.bool_]

_BEHIND = 0.28  # opacity of what is hidden


@dataclass(frozen=True)
class View:
    """Parallel projection: the eye looks along minus `towards`; the third axis points up.

    Attributes:
        azimuth: of the eye, from the first axis, degrees.
        elevation: of the eye above the plane of the first two axes, degrees.
    """

    azimuth: float
    elevation: float

    @property
    def towards(self) -> Array:
        """Unit vector towards the eye."""
        turn, rise = np.radians([self.azimuth, self.elevation])
        return np.array([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)])

    def project(self, points: Array) -> Array:
        """Places on the page, shape (2, n), of points of shape (3, n)."""
        turn = np.radians(self.azimuth)
        right = np.array([-np.sin(turn), np.cos(turn), 0.0])
        return np.array([right @ points, np.cross(self.towards, right) @ points])


def draw_on(
    axes: Axes, view: View, points: Array, outward: Array, **style: Any
) -> tuple[Line2D, Line2D]:
    """A curve on a closed surface, bold in front and faint behind.

    Args:
        axes: to draw in.
        view: how it is seen.
        points: of the curve, shape (3, n).
        outward: normals of the surface there, shape (3, n).
        style: of the line.
    """
    page = view.project(points)
    seen = view.towards @ outward >= 0
    front, behind = (np.where(shown, page, np.nan) for shown in (_grown(seen), _grown(~seen)))
    hidden = {**style, "alpha": _BEHIND * style.get("alpha", 1.0), "zorder": 1, "label": None}
    return axes.plot(*front, **style)[0], axes.plot(*behind, **hidden)[0]


def _grown(mask: Mask) -> Mask:
    """One sample longer at each end, so that front and back meet."""
    grown: Mask = mask | np.roll(mask, 1)
    grown[0] = mask[0]
    return grown


def arrow(axes: Axes, view: View, along: Array, name: str) -> None:
    """A labelled arrow out of a surface, from the first point of `along` to the second."""
    foot, tip = view.project(along).T
    style = {"arrowstyle": "-|>", "color": INK, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", tip, foot, arrowprops=style)
    beyond = tip + 0.07 * (tip - foot) / np.linalg.norm(tip - foot)
    axes.annotate(name, beyond, color=INK, ha="center", va="center")
    axes.update_datalim([tip, beyond])


def bare(axes: Axes) -> None:
    """No frame, no ticks, equal scales."""
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.margins(0.04)
    axes.autoscale_view()

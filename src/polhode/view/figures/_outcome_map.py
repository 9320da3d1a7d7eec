"""What becomes of motions over two quantities, with exact thresholds of stability."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from polhode.study import Found
from polhode.view._quantities import Array
from polhode.view.figures._style import COLOURS, axes_or_new, house_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import QuadMesh
    from matplotlib.contour import QuadContourSet

_POINTS = 201


@dataclass(frozen=True)
class OutcomeMap:
    """What `outcome_map` drew.

    Attributes:
        mesh: the outcomes.
        thresholds: lines on which exact conditions of stability change sign.
    """

    mesh: QuadMesh
    thresholds: tuple[QuadContourSet, ...]


@house_style()
def outcome_map(found: Found, *, ax: Axes | None = None) -> OutcomeMap:
    """An output of a sweep over its two axes; lines are exact thresholds of steady motions.

    Args:
        found: from `ph.study.found_in`.
        ax: axes to draw in.
    """
    axes = axes_or_new(ax, 3.4)
    (first, across), (second, up) = found.axes.items()
    mesh = axes.pcolormesh(across, up, found.values.T, shading="nearest", rasterized=True)
    if found.labels:
        _codes(found, mesh, axes)
    else:
        axes.figure.colorbar(mesh, ax=axes, label=found.output, pad=0.03)
    grid = np.array(np.meshgrid(_fine(across), _fine(up)))
    lines = []
    for threshold in found.thresholds:
        values = threshold.values((first, second), found.numbers, grid)
        if np.min(values) < 0 < np.max(values):
            lines.append(axes.contour(*grid, values, [0.0], colors="black", linewidths=1.6))
    axes.grid(visible=False)
    axes.set_xlabel(first)
    axes.set_ylabel(second)
    return OutcomeMap(mesh, tuple(lines))


def _codes(found: Found, mesh: QuadMesh, axes: Axes) -> None:
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.patches import Patch

    colours = [COLOURS[k % len(COLOURS)] for k in range(len(found.labels))]
    mesh.set_cmap(ListedColormap(colours))
    mesh.set_norm(BoundaryNorm(np.arange(len(colours) + 1) - 0.5, len(colours)))
    present = np.unique(found.values[np.isfinite(found.values)]).astype(int)
    handles = [Patch(color=colours[code], label=found.labels[code]) for code in present]
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1.0), frameon=False)


def _fine(values: Array) -> Array:
    return np.linspace(float(np.min(values)), float(np.max(values)), _POINTS)

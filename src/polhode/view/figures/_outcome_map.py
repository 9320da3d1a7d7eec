"""What becomes of motions over two quantities, with exact thresholds of stability."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np

from polhode.algebra import Expr
from polhode.study import Found, Threshold
from polhode.view._quantities import Array, Scale, label, largest, math, scale_for, si_unit
from polhode.view.figures._drawn import InFigure
from polhode.view.figures._map_marks import gap, legend, threshold_key, threshold_line
from polhode.view.figures._style import COLOURS, INK, axes_or_new, house_style, worded

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import QuadMesh
    from matplotlib.contour import QuadContourSet
    from matplotlib.patches import Patch

_POINTS = 201
_WORDS = {"duration": "duration (s)"}  # outputs that are no quantity of the system


@dataclass(frozen=True)
class OutcomeMap(InFigure):
    """What `outcome_map` drew.

    Attributes:
        mesh: the outcomes.
        thresholds: lines on which exact conditions of stability change sign.
        conditions: what each of these lines is the threshold of.
    """

    mesh: QuadMesh
    thresholds: tuple[QuadContourSet, ...]
    conditions: tuple[Threshold, ...]

    @property
    def axes(self) -> Axes:
        """The axes it is drawn in."""
        return cast("Axes", self.mesh.axes)


@house_style()
def outcome_map(found: Found, *, ax: Axes | None = None) -> OutcomeMap:
    """An output of a sweep over its two axes; lines are exact thresholds of steady motions.

    Angles are in degrees. Motions that could not be followed are hatched.

    Args:
        found: from `ph.study.found_in`.
        ax: axes to draw in.
    """
    axes = axes_or_new(ax, 3.4)
    names = tuple(found.axes)
    scales = [_scale(found, name, values) for name, values in found.axes.items()]
    sides = [values * s.factor for values, s in zip(found.axes.values(), scales, strict=True)]
    across, up = sides
    scale = _scale(found, found.output, found.values)
    shown = found.values.T * scale.factor
    mesh = axes.pcolormesh(across, up, shown, shading="nearest", rasterized=True)
    keys = [*(_codes(found, mesh) if found.labels else ())]
    empty = ~np.isfinite(shown)
    failed = empty & (found.failed.T if found.failed is not None else False)
    keys += gap(axes, (across, up), failed, "////", "could not be followed")
    keys += gap(axes, (across, up), empty & ~failed, "....", "no result")
    if not found.labels:
        axes.figure.colorbar(mesh, ax=axes, label=_label(found, found.output, scale), pad=0.03)
    lines, conditions = _thresholds(axes, found, scales)
    keys_of_lines = [threshold_key(c.condition, i, INK) for i, c in enumerate(conditions)]
    legend(axes, [*keys, *keys_of_lines])
    axes.grid(visible=False)
    axes.set_xlabel(_label(found, names[0], scales[0]))
    axes.set_ylabel(_label(found, names[1], scales[1]))
    return OutcomeMap(mesh, lines, conditions)


def _thresholds(
    axes: Axes, found: Found, scales: list[Scale]
) -> tuple[tuple[QuadContourSet, ...], tuple[Threshold, ...]]:
    """Those that run through the map."""
    (first, across), (second, up) = found.axes.items()
    grid = np.array(np.meshgrid(_fine(across), _fine(up)))
    shown = (grid[0] * scales[0].factor, grid[1] * scales[1].factor)
    heights = {t: t.values((first, second), found.numbers, grid) for t in found.thresholds}
    met = {t: h for t, h in heights.items() if np.min(h) < 0 < np.max(h)}
    lines = (threshold_line(axes, shown, h, i, INK) for i, h in enumerate(met.values()))
    return tuple(lines), tuple(met)


def _scale(found: Found, name: str, values: Array) -> Scale:
    """The unit in which a quantity of the system is shown; others are as they are."""
    known = found.measured.get(name)
    if known is None:
        return Scale("", 1.0)
    return scale_for(si_unit(known.dimension, angle=known.is_angle), largest(_finite(values)))


def _label(found: Found, name: str, scale: Scale) -> str:
    known = found.measured.get(name)
    if known is None:
        return _WORDS.get(name, worded(name))
    return label(math(Expr.generator(known.symbol)), scale)


def _codes(found: Found, mesh: QuadMesh) -> list[Patch]:
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.patches import Patch

    colours = [COLOURS[k % len(COLOURS)] for k in range(len(found.labels))]
    mesh.set_cmap(ListedColormap(colours))
    mesh.set_norm(BoundaryNorm(np.arange(len(colours) + 1) - 0.5, len(colours)))
    present = np.unique(_finite(found.values)).astype(int)
    return [Patch(color=colours[code], label=worded(found.labels[code])) for code in present]


def _finite(values: Array) -> Array:
    return values[np.isfinite(values)]


def _fine(values: Array) -> Array:
    return np.linspace(float(np.min(values)), float(np.max(values)), _POINTS)

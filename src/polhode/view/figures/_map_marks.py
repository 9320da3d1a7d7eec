"""What every map over two quantities has besides its shades: exact thresholds, and its gaps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr
from polhode.view._quantities import Array
from polhode.view.figures._style import DASHES, FAINT, MUTED

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.contour import QuadContourSet
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

_LONGEST = 70  # letters of LaTeX that a legend has room for


def threshold_line(
    axes: Axes, grid: tuple[Array, Array], values: Array, number: int, colour: str
) -> QuadContourSet:
    """Where a condition changes sign; lines are told apart by dashes."""
    dashes = [DASHES[number % len(DASHES)]]
    style: dict[str, Any] = {"colors": [colour], "linewidths": 1.7, "linestyles": dashes}
    return axes.contour(*grid, values, [0.0], **style)


def threshold_key(condition: Expr, number: int, colour: str) -> Line2D:
    """The entry of such a line in the legend."""
    from matplotlib.lines import Line2D

    formula = f"${condition.latex()} = 0$"
    label = f"threshold: {formula}" if _is_legible(formula) else "threshold of stability"
    return Line2D([], [], color=colour, linestyle=DASHES[number % len(DASHES)], label=label)


def gap(
    axes: Axes, grid: tuple[Array, Array], where: NDArray[np.bool_], hatch: str, label: str
) -> list[Patch]:
    """Hatch what has no value, shape (up, across); its entry in the legend, if there is any."""
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    if not np.any(where):
        return []
    style: dict[str, Any] = {"hatch": hatch, "edgecolor": MUTED, "linewidth": 0}
    shown = np.ma.masked_where(~where, np.zeros(where.shape))
    cells = axes.pcolor(*grid, shown, cmap=ListedColormap([FAINT]), shading="nearest", zorder=0)
    cells.set(**style)
    return [Patch(facecolor=FAINT, label=label, **style)]


def legend(axes: Axes, handles: Sequence[Line2D | Patch]) -> None:
    """A legend above the axes, in two columns where there is more than one entry."""
    if handles:
        columns = min(len(handles), 2)
        axes.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns)


def _is_legible(formula: str) -> bool:
    from matplotlib.mathtext import MathTextParser

    if len(formula) > _LONGEST:
        return False
    try:
        MathTextParser("path").parse(formula)
    except ValueError:  # LaTeX that matplotlib does not have
        return False
    return True

"""Quantities against time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from polhode.simulate import Trajectory
from polhode.view._quantities import (
    Array,
    Named,
    PlottedQuantity,
    common_unit,
    instants,
    label,
    largest,
    quantity,
    scale_for,
)
from polhode.view.figures._drawn import Drawn
from polhode.view.figures._style import axes_or_new, house_style, line_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.legend import Legend

_SHARED = {
    "rad": "angle",
    "m": "position",
    "m/s": "velocity",
    "rad/s": "rate",
    "N": "force",
    "N m": "torque",
}
_ROUNDING = 1e-11  # relative spread below which a quantity counts as constant
_SLIGHT = 1e-3  # relative spread below which only the change is worth showing
_ROOM = 1.1  # widths of the axes that a legend may take
_DISPARATE = 25.0  # ratio of sizes that do not share an axis


@house_style()
def history(run: Trajectory, *names: Named, ax: Axes | None = None) -> Drawn:
    """Named quantities of one unit against time; angles in degrees, or turns where many.

    Of a single quantity that hardly changes only the change since the start is shown.

    Raises:
        DeclarationError: for a name the run does not have, or for none.
        UnitError: for quantities of different units.
    """
    quantities = [quantity(run, name) for name in names]
    unit = common_unit(quantities)
    axes = axes_or_new(ax)
    t = instants(run)
    values = [run.evaluate(q.name, t) for q in quantities]
    shown = _SHARED.get(unit, ", ".join(q.symbol for q in quantities))
    if len(values) == 1:
        shown = quantities[0].symbol
        if _hardly_changes(values[0]):
            values = [values[0] - values[0][0]]
            shown = f"${shown.strip('$')} - {shown.strip('$')}(0)$"
    scale = scale_for(unit, largest(*values))
    lines = [
        axes.plot(t, value * scale.factor, label=q.symbol, **line_style(i))[0]
        for i, (q, value) in enumerate(zip(quantities, values, strict=True))
    ]
    widen(axes, np.concatenate(values) * scale.factor)
    time_axis(axes, t)
    axes.set_ylabel(label(shown, scale))
    if len(lines) > 1:
        legend_above(axes)
    return Drawn(axes, lines)


def time_axis(axes: Axes, t: Array) -> None:
    """Time from the first instant to the last."""
    axes.set_xlim(t[0], t[-1])
    axes.set_xlabel("$t$ (s)")


def legend_above(axes: Axes) -> None:
    """A legend above the axes, out of the way of the lines; in two rows where one is too wide."""
    handles, _ = axes.get_legend_handles_labels()
    legend = _legend(axes, len(handles))
    if len(handles) > 1 and legend.get_window_extent().width > _ROOM * axes.bbox.width:
        _legend(axes, (len(handles) + 1) // 2)


def _legend(axes: Axes, columns: int) -> Legend:
    return axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=columns)


def panels(run: Trajectory, names: Sequence[str]) -> list[list[str]]:
    """A group of names split into what can share an axis: one unit, sizes that compare."""
    found: list[list[tuple[PlottedQuantity, float, str]]] = []
    for name in names:
        one, size = quantity(run, name), largest(run.evaluate(name, instants(run)))
        home = next((group for group in found if _fits(one, size, group)), None)
        if home is None:
            found.append([(one, size, name)])
        else:
            home.append((one, size, name))
    return [[name for _, _, name in group] for group in found]


def _fits(
    one: PlottedQuantity, size: float, group: list[tuple[PlottedQuantity, float, str]]
) -> bool:
    sizes = [other for _, other, _ in group if other]
    comparable = not size or all(1 / _DISPARATE < size / s < _DISPARATE for s in sizes)
    return comparable and one.unit == group[0][0].unit


def _hardly_changes(values: Array) -> bool:
    spread, size = float(np.ptp(values)), largest(values)
    return _ROUNDING * size < spread < _SLIGHT * size


def widen(axes: Axes, values: Array) -> None:
    """Limits about a constant that do not blow rounding up to the height of the panel."""
    size = largest(values)
    if float(np.ptp(values)) <= _ROUNDING * size or not size:
        middle, room = float(np.mean(values)), 0.2 * size or 1.0
        axes.set_ylim(middle - room, middle + room)

"""Quantities against time, by themselves and stacked; phase portraits; shades of modes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode.base import DeclarationError
from polhode.simulate import Trajectory
from polhode.view._magnitudes import magnitudes_of, panels
from polhode.view._quantities import (
    Array,
    Named,
    common_unit,
    everything,
    grouped,
    instants,
    label,
    largest,
    quantity,
    scale_for,
)
from polhode.view.figures._figure import Drawn, axes_or_new, new_figure
from polhode.view.figures._style import COLOURS, INK, SHADES, house_style, line_style, worded

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, FigureBase
    from matplotlib.legend import Legend
    from matplotlib.patches import Polygon, Rectangle


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
_PALE: dict[str, Any] = {"edgecolor": INK, "alpha": 0.28, "linewidth": 0, "zorder": 0}
_HATCHES = ("", "////", "....", "xxxx")
_PANEL, _FOOT, _LEAST = 1.35, 0.45, 2.3  # heights in inches: of a panel, below them, of a figure
_PICTURE = 2.6  # height of pictures beneath, inches
_ROOM = 1.1  # widths of the axes that a legend may take


@house_style()
def history(run: Trajectory, *names: Named, ax: Axes | None = None) -> Drawn:
    """Named quantities of one unit against time; angles in degrees, or turns where many.

    Of a single quantity that hardly changes only the change since the start is shown. What is only
    rounding is zero.

    Raises:
        DeclarationError: for a name the run does not have, or for none.
        UnitError: for quantities of different units.
    """
    quantities = [quantity(run, name) for name in names]
    unit = common_unit(quantities)
    axes = axes_or_new(ax)
    t = instants(run)
    sizes = magnitudes_of(run)
    values = [sizes.without_rounding(run.evaluate(q.name, t), q.unit) for q in quantities]
    shown = _SHARED.get(unit, ", ".join(q.symbol for q in quantities))
    if len(values) == 1:
        shown = quantities[0].symbol
        if _ROUNDING * largest(values[0]) < np.ptp(values[0]) < _SLIGHT * largest(values[0]):
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


def _count_in(axes: Axes, period: float) -> None:
    """Label time in multiples of a period T, s."""
    from matplotlib.ticker import MaxNLocator

    left, right = axes.get_xlim()
    ticks = MaxNLocator(8, steps=[1, 2, 5, 10]).tick_values(left / period, right / period)
    shown = [tick for tick in ticks if left <= tick * period <= right]
    axes.set_xticks([tick * period for tick in shown], [f"{tick:g}" for tick in shown])
    axes.set_xlabel("$t/T$")


def legend_above(axes: Axes) -> None:
    """A legend above the axes, out of the way of the lines; in two rows where one is too wide."""
    handles, _ = axes.get_legend_handles_labels()
    legend = _legend(axes, len(handles))
    if len(handles) > 1 and legend.get_window_extent().width > _ROOM * axes.bbox.width:
        _legend(axes, (len(handles) + 1) // 2)


def _legend(axes: Axes, columns: int) -> Legend:
    return axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=columns)


def widen(axes: Axes, values: Array) -> None:
    """Limits about a constant that do not blow rounding up to the height of the panel."""
    size = largest(values)
    if float(np.ptp(values)) <= _ROUNDING * size or not size:
        middle, room = float(np.mean(values)), 0.2 * size or 1.0
        axes.set_ylim(middle - room, middle + room)


@house_style()
def phase_portrait(run: Trajectory, name: Named, *, ax: Axes | None = None) -> Drawn:
    """The rate of a coordinate against the coordinate; a dot marks the start.

    Raises:
        DeclarationError: for a name that is no coordinate of the run.
    """
    coordinate = quantity(run, name)
    rate = f"{coordinate.name}_dot"
    if rate not in run.quantities:
        raise DeclarationError(
            f"{coordinate.name} has no rate among the quantities",
            expected="a coordinate or a speed",
        )
    axes = axes_or_new(ax, 3.0)
    shown = []
    for side, plotted in (("x", coordinate), ("y", quantity(run, rate))):
        values = run.evaluate(plotted.name, instants(run))
        scale = scale_for(plotted.unit, largest(values))
        axes.set(**{f"{side}label": plotted.label(scale)})
        shown.append(values * scale.factor)
    (line,) = axes.plot(*shown, color=COLOURS[0])
    axes.plot(shown[0][0], shown[1][0], "o", color=COLOURS[0], markersize=4.5)
    axes.margins(0.06)
    return Drawn(axes, [line])


@house_style()
def modes(run: Trajectory, *, ax: Axes) -> Drawn:
    """Shade the time that a motion spends in each contact mode; nothing where there is only one.

    Modes are told apart by shade and hatching, and named in the legend of the axes.
    """
    stays = [list(group) for _, group in groupby(run.segments, lambda segment: segment.mode)]
    names = list(dict.fromkeys(segment.mode for segment in run.segments))
    if len(names) < 2:
        return Drawn(ax, [])
    drawn: list[Polygon | Rectangle] = []
    for i, name in enumerate(names):
        spans = [(s[0].begin, s[-1].end) for s in stays if s[0].mode == name]
        style = {
            **_PALE,
            "facecolor": SHADES[i % len(SHADES)],
            "hatch": _HATCHES[i % len(_HATCHES)],
        }
        labels = [worded(name), *["_"] * (len(spans) - 1)]
        drawn += [
            ax.axvspan(*span, label=label, **style)
            for span, label in zip(spans, labels, strict=True)
        ]
    return Drawn(ax, drawn)


def plot(run: Trajectory, *quantities: Named | Sequence[Named]) -> Figure:
    """A figure of quantities against time: a panel for each name, or for each group of names.

    `plot(run, "theta", ("F_x", "F_z"), "energy")`; `.savefig("run.pdf")` writes it. Without
    names it shows coordinates, speeds and reactions.

    Raises:
        DeclarationError: for a name the run does not have.
    """
    return figure_of_run(run, grouped(quantities))


@house_style()
def figure_of_run(
    run: Trajectory,
    groups: Sequence[Sequence[str]],
    *,
    period: float | None = None,
    beneath: Sequence[Callable[..., Drawn]] = (),
) -> Figure:
    """Named quantities against time, one panel for each group; by default those of `plot`.

    A group is split where its quantities have different units or sizes that do not compare.

    Args:
        run: the motion.
        groups: names of quantities.
        period: T, s, where time is to be shown as t/T.
        beneath: pictures of the motion, such as `nutation`, to be drawn below, side by side.

    Raises:
        DeclarationError: for a name the run does not have.
    """
    sizes = magnitudes_of(run)
    stacked = [panel for group in groups or everything(run) for panel in panels(run, group, sizes)]
    height = max(_LEAST, _FOOT + _PANEL * len(stacked))
    figure = new_figure(height + _PICTURE * bool(beneath))
    above: FigureBase = figure
    if beneath:
        parts: Any = figure.subfigures(2, 1, height_ratios=(height, _PICTURE))
        above, below = parts
        row = below.subplots(1, len(beneath), squeeze=False)[0]
        for draw, axes in zip(beneath, row, strict=True):
            draw(run, ax=axes)
    column = above.subplots(len(stacked), 1, sharex=True, squeeze=False)[:, 0]
    for axes, names in zip(column, stacked, strict=True):
        history(run, *names, ax=axes)
        if period is not None:
            _count_in(axes, period)
        axes.label_outer()
    above.align_ylabels(column)
    return figure

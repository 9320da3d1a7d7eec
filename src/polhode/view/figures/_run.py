"""One figure of a whole run: panels of histories above one another."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from polhode.simulate import Trajectory
from polhode.view._quantities import Named, grouped
from polhode.view._scene_text import everything
from polhode.view.figures._history import history, panels
from polhode.view.figures._style import house_style, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_PANEL = 1.35  # height in inches
_FOOT = 0.45
_LEAST = 2.3


def plot(run: Trajectory, *quantities: Named | Sequence[Named]) -> Figure:
    """A figure of quantities against time: a panel for each name, or for each group of names.

    `plot(run, "theta", ("F_x", "F_z"), "energy")`; `.savefig("run.pdf")` writes it. Without
    names it shows coordinates, speeds and reactions.

    Raises:
        DeclarationError: for a name the run does not have.
    """
    return figure_of_run(run, grouped(quantities) or everything(run))


@house_style()
def figure_of_run(run: Trajectory, groups: Sequence[Sequence[str]]) -> Figure:
    """Named quantities against time, one panel for each group.

    A group is split where its quantities have different units or sizes that do not compare.

    Raises:
        DeclarationError: for a name the run does not have.
    """
    stacked = [panel for group in groups for panel in panels(run, group)]
    figure = new_figure(max(_LEAST, _FOOT + _PANEL * len(stacked)))
    column = figure.subplots(len(stacked), 1, sharex=True, squeeze=False)[:, 0]
    for axes, names in zip(column, stacked, strict=True):
        history(run, *names, ax=axes)
        axes.label_outer()
    figure.align_ylabels(column)
    return figure

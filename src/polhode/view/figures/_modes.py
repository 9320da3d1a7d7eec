"""Which contact mode a motion is in, as shades behind a history."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, Any

from polhode.simulate import Trajectory
from polhode.view.figures._drawn import Drawn
from polhode.view.figures._style import INK, SHADES, house_style, worded

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import Polygon, Rectangle

_PALE: dict[str, Any] = {"edgecolor": INK, "alpha": 0.28, "linewidth": 0, "zorder": 0}
_HATCHES = ("", "////", "....", "xxxx")


@house_style()
def modes(run: Trajectory, *, ax: Axes) -> Drawn:
    """Shade the time that a motion spends in each contact mode; nothing where there is only one.

    Modes are told apart by shade and hatching, and named in the legend of the axes.
    """
    stretches = [list(group) for _, group in groupby(run.segments, lambda segment: segment.mode)]
    names = list(dict.fromkeys(segment.mode for segment in run.segments))
    if len(names) < 2:
        return Drawn(ax, [])
    drawn: list[Polygon | Rectangle] = []
    for i, name in enumerate(names):
        spans = [(s[0].begin, s[-1].end) for s in stretches if s[0].mode == name]
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

"""Phase portraits: a coordinate against its rate."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polhode.base import DeclarationError
from polhode.simulate import Trajectory
from polhode.view._quantities import Named, PlottedQuantity, instants, largest, quantity, scale_for
from polhode.view.figures._drawn import Drawn
from polhode.view.figures._style import COLOURS, axes_or_new, house_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@house_style()
def phase_portrait(run: Trajectory, name: Named, *, ax: Axes | None = None) -> Drawn:
    """The rate of a coordinate against the coordinate; a dot marks the start.

    Raises:
        DeclarationError: for a name that is no coordinate of the run.
    """
    both = _with_rate(run, name)
    axes = axes_or_new(ax, 3.0)
    shown = []
    for place, one in zip("xy", both, strict=True):
        values = run.evaluate(one.name, instants(run))
        scale = scale_for(one.unit, largest(values))
        axes.set(**{f"{place}label": one.label(scale)})
        shown.append(values * scale.factor)
    (line,) = axes.plot(*shown, color=COLOURS[0])
    axes.plot(shown[0][0], shown[1][0], "o", color=COLOURS[0], markersize=4.5)
    axes.margins(0.06)
    return Drawn(axes, [line])


def _with_rate(run: Trajectory, named: Named) -> tuple[PlottedQuantity, PlottedQuantity]:
    one = quantity(run, named)
    rate = f"{one.name}_dot"
    if rate not in run.quantities:
        raise DeclarationError(f"the rate of {one.name}", expected="a coordinate or a speed")
    return one, quantity(run, rate)

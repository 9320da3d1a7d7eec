"""Reactions along a motion, and the range each of them covers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.derive import Equations
from polhode.model import Frame
from polhode.simulate import Trajectory
from polhode.view._quantities import (
    Array,
    Quantity,
    common_unit,
    equations_of,
    instants,
    largest,
    math,
    modes_of,
    quantity,
    scale_for,
)
from polhode.view._scene_along import along
from polhode.view.figures._history import history, legend_above, time_axis, widen
from polhode.view.figures._style import COLOURS, MUTED, axes_or_new, house_style, line_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import LineCollection
    from matplotlib.lines import Line2D


@house_style()
def reactions(
    run: Trajectory, contact: str, triad: Frame | None = None, *, ax: Axes | None = None
) -> list[Line2D]:
    """Components of the force of one contact or joint on its body against time, N.

    Args:
        run: the motion.
        contact: name of the contact or joint.
        triad: directions to resolve the force along, such as the axes of the body; by default
            those of the named components of the reaction.
        ax: axes to draw in.

    Raises:
        DeclarationError: for a contact or joint the system does not have.
        NumericError: where Newton's laws leave a component open.
    """
    element = run.system.element(contact)
    if triad is not None:
        return _along_triad(run, element.name, triad, ax)
    restraints = [r for e in modes_of(run) for r in e.kinetics.restraints.get(element.name, ())]
    names = dict.fromkeys(r.name for r in restraints if not r.is_couple)
    return history(run, *names, ax=ax)


def _along_triad(run: Trajectory, name: str, triad: Frame, ax: Axes | None) -> list[Line2D]:
    axes = axes_or_new(ax)
    t = instants(run)

    def components(equations: Equations) -> Sequence[Expr] | None:
        reaction = equations.reactions.get(name)
        return None if reaction is None else reaction.force.express(triad).components

    values = np.nan_to_num(along(run, components, 3, t)).T
    scale = scale_for("N", largest(values))
    lines = [
        axes.plot(t, value * scale.factor, label=f"along ${label}$", **line_style(i))[0]
        for i, (label, value) in enumerate(zip(triad.labels, values, strict=True))
    ]
    widen(axes, values * scale.factor)
    time_axis(axes, t)
    axes.set_ylabel(f"force at {name} ({scale.unit})")
    legend_above(axes)
    return lines


@house_style()
def reaction_ranges(run: Trajectory, *, ax: Axes | None = None) -> LineCollection:
    """Least to greatest value of every force component along the motion, N; a dot at the start.

    Components that Newton's laws leave open are given by the least-force choice, with a ring.
    """
    forces = _forces(run)
    axes = axes_or_new(ax, 0.7 + 0.32 * len(forces))
    unit = common_unit([one for one, _ in forces])
    scale = scale_for(unit, largest(*(values for _, values in forces)))
    rows = np.arange(len(forces))[::-1]
    shown = [values * scale.factor for _, values in forces]
    bars = axes.hlines(
        rows, [np.min(v) for v in shown], [np.max(v) for v in shown], color=COLOURS[0], linewidth=5
    )
    open_ = run.equations.undetermined
    for row, (one, _), values in zip(rows, forces, shown, strict=True):
        face = "none" if one.name in open_ else COLOURS[0]
        axes.plot(values[0], row, "o", markersize=7, color=COLOURS[0], markerfacecolor=face)
    axes.axvline(0, color=MUTED, linewidth=0.8, zorder=0)
    axes.set_yticks(rows, [one.symbol for one, _ in forces])
    axes.grid(visible=False, axis="y")
    axes.margins(x=0.08, y=0.12)
    axes.set_xlabel(f"force on the body ({scale.unit})")
    return bars


def _forces(run: Trajectory) -> list[tuple[Quantity, Array]]:
    equations = equations_of(run)
    t = instants(run)
    names = [line.name for line in equations.lines if not line.restraint.is_couple]
    return [(_named(run, name), run.evaluate(equations.least[name], t)) for name in names]


def _named(run: Trajectory, name: str) -> Quantity:
    if name in run.equations.undetermined:
        return Quantity(name, math(Expr.generator(Symbol(name))), "N")
    return quantity(run, name)

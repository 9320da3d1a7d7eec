"""Reactions along a motion, and the range each of them covers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.simulate import Trajectory
from polhode.view._history import history
from polhode.view._quantities import (
    Array,
    Quantity,
    common_unit,
    equations_of,
    instants,
    largest,
    math,
    quantity,
    scale_for,
)
from polhode.view._style import COLOURS, MUTED, axes_or_new, house_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import LineCollection
    from matplotlib.lines import Line2D


@house_style()
def reactions(run: Trajectory, contact: str, *, ax: Axes | None = None) -> list[Line2D]:
    """Components of the force of one contact or joint on its body against time, N.

    Raises:
        DeclarationError: for a contact or joint the system does not have.
        NumericError: where Newton's laws leave a component open.
    """
    element = equations_of(run).system.element(contact)
    restraints = equations_of(run).kinetics.restraints[element.name]
    return history(run, [r.name for r in restraints if not r.is_couple], ax=ax)


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

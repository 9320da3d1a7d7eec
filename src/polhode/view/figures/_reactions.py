"""Reactions along a motion, and the range each of them covers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.base import DeclarationError
from polhode.derive import Equations
from polhode.model import Frame
from polhode.simulate import Trajectory
from polhode.view._quantities import (
    Array,
    instants,
    largest,
    math,
    modes_of,
    scale_for,
)
from polhode.view._scene_along import along
from polhode.view.figures._drawn import Drawn
from polhode.view.figures._history import history, legend_above, time_axis, widen
from polhode.view.figures._style import COLOURS, MUTED, axes_or_new, house_style, line_style, worded

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@house_style()
def reactions(
    run: Trajectory, contact: str, triad: Frame | None = None, *, ax: Axes | None = None
) -> Drawn:
    """Components of the force of one contact or joint on its body against time, N.

    Args:
        run: the motion.
        contact: name of the contact or joint.
        triad: directions to resolve the force along, such as the axes of the body; by default
            those of the named components of the reaction.
        ax: axes to draw in.

    Raises:
        DeclarationError: for a contact or joint that the system does not have, or that takes no
            force along the motion.
        NumericError: where Newton's laws leave a component open.
    """
    element = run.system.element(contact)
    if triad is not None:
        return _along_triad(run, element.name, triad, ax)
    restraints = [r for e in modes_of(run) for r in e.kinetics.restraints.get(element.name, ())]
    names = dict.fromkeys(r.name for r in restraints if not r.is_couple)
    if not names:
        raise DeclarationError(
            f"the force of {element.name!r}, which takes none",
            expected="a contact or joint that holds a point",
        )
    return history(run, *names, ax=ax)


def _along_triad(run: Trajectory, name: str, triad: Frame, ax: Axes | None) -> Drawn:
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
    axes.set_ylabel(f"force at {worded(name)} ({scale.unit})")
    legend_above(axes)
    return Drawn(axes, lines)


@house_style()
def reaction_ranges(run: Trajectory, *, ax: Axes | None = None) -> Drawn:
    """Least to greatest value of every force component along the motion, N; a dot at the start.

    Components that Newton's laws leave open are given by the least-force choice, with a ring; a
    contact that is open has none.

    Raises:
        DeclarationError: for a motion on which no contact or joint takes a force.
    """
    forces = _forces(run)
    axes = axes_or_new(ax, 0.7 + 0.32 * len(forces))
    scale = scale_for("N", largest(*forces.values()))
    rows = np.arange(len(forces))[::-1]
    shown = [values * scale.factor for values in forces.values()]
    bars = axes.hlines(
        rows, [np.min(v) for v in shown], [np.max(v) for v in shown], color=COLOURS[0], linewidth=5
    )
    open_ = {name for equations in modes_of(run) for name in equations.undetermined}
    for row, name, values in zip(rows, forces, shown, strict=True):
        face = "none" if name in open_ else COLOURS[0]
        axes.plot(values[0], row, "o", markersize=7, color=COLOURS[0], markerfacecolor=face)
    axes.axvline(0, color=MUTED, linewidth=0.8, zorder=0)
    axes.set_yticks(rows, [math(Expr.generator(Symbol(name))) for name in forces])
    axes.grid(visible=False, axis="y")
    axes.margins(x=0.08, y=0.12)
    axes.set_xlabel(f"force on the body ({scale.unit})")
    return Drawn(axes, [bars])


def _forces(run: Trajectory) -> dict[str, Array]:
    """Components of all contact modes along the motion, by name."""
    names = list(dict.fromkeys(name for e in modes_of(run) for name in _force_names(e)))
    if not names:
        raise DeclarationError(
            f"forces of contacts and joints on {run.system.name}",
            expected="a motion on which something takes a force",
        )
    zero = Expr.of(0)

    def least(equations: Equations) -> list[Expr]:
        return [equations.least.get(name, zero) for name in names]

    return dict(zip(names, along(run, least, len(names), instants(run)).T, strict=True))


def _force_names(equations: Equations) -> list[str]:
    couples = {line.name for line in equations.lines if line.restraint.is_couple}
    return [name for name in equations.least if name not in couples]

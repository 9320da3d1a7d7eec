"""Reactions along a motion, the range each of them covers, and the friction that rolling needs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.base import DeclarationError
from polhode.derive import Equations
from polhode.model import Contact, Coulomb, Frame, Rolling
from polhode.simulate import Trajectory
from polhode.view._quantities import Array, instants, largest, math, modes_of, scale_for
from polhode.view._scene_along import along, constants
from polhode.view.figures._figure import Drawn, axes_or_new
from polhode.view.figures._history import history, legend_above, modes, time_axis, widen
from polhode.view.figures._style import COLOURS, MUTED, house_style, line_style, worded

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_ROOM = 1.15  # height of the axes against the greatest value


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
        NumericError: if Newton's laws leave a component undetermined.
    """
    element = run.system.element(contact)
    if triad is not None:
        return _along_triad(run, element.name, triad, ax)
    restraints = [r for e in modes_of(run) for r in e.kinetics.restraints.get(element.name, ())]
    names = dict.fromkeys(r.name for r in restraints if not r.is_couple)
    if not names:
        raise DeclarationError(
            f"{element.name!r} exerts no force along the motion",
            expected="a contact, or a joint that holds a point",
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

    Components that Newton's laws leave undetermined are those of least sum of squares, with a
    ring; an open contact exerts none.

    Raises:
        DeclarationError: for a motion on which no contact or joint exerts a force.
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
    couples = {name for e in modes_of(run) for name in e.couples}
    names = [
        n for n in dict.fromkeys(n for e in modes_of(run) for n in e.least) if n not in couples
    ]
    if not names:
        raise DeclarationError(
            f"no contact or joint of {run.system.name} exerts a force",
            expected="a motion with a force at a contact or joint",
        )
    zero = Expr.of(0)

    def least(equations: Equations) -> list[Expr]:
        return [equations.least.get(name, zero) for name in names]

    return dict(zip(names, along(run, least, len(names), instants(run)).T, strict=True))


@house_style()
def friction_needed(run: Trajectory, contact: str = "", *, ax: Axes | None = None) -> Drawn:
    """Ratio of friction to normal force at a contact against time, with the available friction.

    The ratio is the least coefficient of static friction that allows this rolling; while the
    contact slides, it is the coefficient of kinetic friction. For a `Coulomb` contact its static
    coefficient is drawn as well (dashed), and the contact modes are shaded.

    Args:
        run: the motion.
        contact: name of the contact; by default the first that rolls or has friction.
        ax: axes to draw in.

    Raises:
        DeclarationError: for a system that has no such contact.
    """
    axes = axes_or_new(ax, 2.2)
    t = instants(run)
    touching = _contact(run, contact)
    components = {id(equations): _components(equations, touching) for equations in modes_of(run)}
    normal, *tangential = along(run, lambda equations: components[id(equations)], 3, t).T
    with np.errstate(divide="ignore", invalid="ignore"):
        needed: Array = np.hypot(*tangential) / np.abs(normal)  # not a number in flight
    lines = axes.plot(t, needed, color=COLOURS[0], label=r"$\mu$ needed")
    greatest = float(np.nanmax(needed))
    if isinstance(touching, Coulomb):
        (available,) = constants(run, [touching.mu_static])
        name, dashes = r"$\mu$ available", (0, (5, 1.6))
        lines.append(axes.axhline(available, color=COLOURS[1], linestyle=dashes, label=name))
        greatest = max(greatest, available)
    shaded = modes(run, ax=axes)
    axes.set_ylim(0, _ROOM * greatest or 1.0)
    time_axis(axes, t)
    axes.set_ylabel("friction / normal force")
    if shaded or len(lines) > 1:
        legend_above(axes)
    return Drawn(axes, lines)


def _contact(run: Trajectory, name: str) -> Contact:
    elements = [run.system.element(name)] if name else run.system.elements
    for element in elements:
        if isinstance(element, Rolling | Coulomb):
            return element
    raise DeclarationError(
        f"{run.system.name} has no contact with friction",
        expected="a system with a Rolling or Coulomb contact",
    )


def _components(equations: Equations, contact: Contact) -> list[Expr] | None:
    """The force along the normal and the two directions of the support; None in flight."""
    support = contact.on
    names = [contact.component(label) for label in (support.normal, *support.tangents)]
    if names[0] not in equations.components:
        return None
    zero = Expr.of(0)
    return [equations.components.get(name, zero) for name in names]

"""How rough a support must be for a body to roll as it does, and how rough it is."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from polhode.algebra import Expr
from polhode.base import DeclarationError
from polhode.derive import Equations
from polhode.model import Contact, Coulomb, Rolling
from polhode.simulate import Trajectory
from polhode.view._quantities import Array, instants, modes_of
from polhode.view._scene_along import along, constants
from polhode.view.figures._drawn import Drawn
from polhode.view.figures._history import legend_above, time_axis
from polhode.view.figures._modes import modes
from polhode.view.figures._style import COLOURS, axes_or_new, house_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_ROOM = 1.15  # height of the axes against the greatest value


@house_style()
def friction_needed(run: Trajectory, contact: str = "", *, ax: Axes | None = None) -> Drawn:
    """Friction over normal force at a contact against time, with what the contact offers.

    The ratio is the least coefficient of static friction with which it would roll so; where the
    contact slides, it is the coefficient of kinetic friction. Of a `Coulomb` contact the static
    coefficient, which is available, is drawn besides (dashed), and the contact modes are shaded.

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
    needed = _ratio(run, touching, t)
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
        f"the friction needed by {run.system.name}",
        expected="a system with a Rolling or Coulomb contact",
    )


def _ratio(run: Trajectory, contact: Contact, t: Array) -> Array:
    """Tangential over normal force; not a number where nothing touches."""
    known = {id(equations): _components(equations, contact) for equations in modes_of(run)}
    normal, *tangential = along(run, lambda equations: known[id(equations)], 3, t).T
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio: Array = np.hypot(*tangential) / np.abs(normal)
    return ratio


def _components(equations: Equations, contact: Contact) -> list[Expr] | None:
    """Along the normal and along the two directions of the support; None in flight."""
    support = contact.on
    names = [contact.component(label) for label in (support.normal, *support.tangents)]
    if names[0] not in equations.components:
        return None
    zero = Expr.of(0)
    return [equations.components.get(name, zero) for name in names]

"""How rough a support must be for a body to roll as it does."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from polhode.base import DeclarationError
from polhode.model import Rolling
from polhode.simulate import Trajectory
from polhode.view._history import time_axis
from polhode.view._quantities import equations_of, instants
from polhode.view._style import COLOURS, axes_or_new, house_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D


@house_style()
def friction_needed(run: Trajectory, *, ax: Axes | None = None) -> Line2D:
    """Least coefficient of static friction that the first rolling contact needs, against time.

    The size of the tangential force over the normal force.

    Raises:
        DeclarationError: for a system in which nothing rolls.
    """
    axes = axes_or_new(ax, 2.0)
    t = instants(run)
    contact = _rolling(run)
    force = equations_of(run).reactions[contact.name].force
    normal = run.evaluate(force.dot(contact.on.up), t)
    along, across = (
        run.evaluate(force.dot(contact.on.axes[name]), t) for name in contact.on.tangents
    )
    needed = np.hypot(along, across) / np.abs(normal)
    (line,) = axes.plot(t, needed, color=COLOURS[0])
    axes.set_ylim(0, 1.15 * float(np.max(needed)) or 1.0)
    time_axis(axes, t)
    axes.set_ylabel(r"$\mu$ needed")
    return line


def _rolling(run: Trajectory) -> Rolling:
    for element in equations_of(run).system.elements:
        if isinstance(element, Rolling):
            return element
    raise DeclarationError(
        f"the friction needed by {run.equations.system.name}",
        expected="a system with a Rolling contact",
    )

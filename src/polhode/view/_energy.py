"""Where the energy of a motion goes, and how well the computation keeps account of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from polhode.simulate import Trajectory
from polhode.view._history import legend_above
from polhode.view._quantities import Array, equations_of, largest, scale_for
from polhode.view._style import COLOURS, MUTED, axes_or_new, line_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import PathCollection
    from matplotlib.lines import Line2D

ROUNDING = float(np.finfo(float).eps)
_FLOOR = ROUNDING / 30  # what is smaller is drawn here


def energies(run: Trajectory, *, ax: Axes | None = None) -> list[Line2D]:
    """Kinetic, potential and total energy against time, with the work done on the system if any.

    All in J, in inertial space.
    """
    axes = axes_or_new(ax)
    shares = _shares(run)
    scale = scale_for("J", largest(*shares.values()))
    lines = [
        axes.plot(run.t, values * scale.factor, label=f"${symbol}$", **line_style(i))[0]
        for i, (symbol, values) in enumerate(shares.items())
    ]
    axes.set_xlim(0, run.duration)
    axes.set_xlabel("$t$ (s)")
    axes.set_ylabel(f"energy ({scale.unit})")
    legend_above(axes)
    return lines


def energy_drift(run: Trajectory, *, ax: Axes | None = None) -> PathCollection:
    """Departure of the energy from what the work done accounts for, relative to its size.

    |E - E₀ - W| over the largest |T| + |V| + |W|, on a logarithmic scale; the dashed line is the
    rounding of one number.
    """
    axes = axes_or_new(ax)
    total, work = run["energy"], run["work"]
    size = np.max(sum(np.abs(part) for name, part in _shares(run).items() if name != "T + V"))
    departure = np.abs(total - total[0] - work) / (size or 1.0)
    dots = axes.scatter(
        run.t, np.maximum(departure, _FLOOR), s=2.5, color=COLOURS[0], linewidths=0, rasterized=False
    )
    axes.axhline(ROUNDING, color=MUTED, linewidth=0.8, linestyle=(0, (4, 3)))
    axes.set_yscale("log")
    axes.set_ylim(_FLOOR / 2, max(1e-13, 5 * float(np.max(departure))))
    axes.set_xlim(0, run.duration)
    axes.set_xlabel("$t$ (s)")
    axes.set_ylabel(r"$|E - E_0 - W|\,/\,E_{\rm max}$")
    return dots


def _shares(run: Trajectory) -> dict[str, Array]:
    equations = equations_of(run)
    kinetic = run.evaluate(equations.kinetic_energy)
    potential = run.evaluate(equations.potential_energy)
    shares = {"T": kinetic}
    if np.any(potential):
        shares |= {"V": potential, "T + V": kinetic + potential}
    work = run["work"]
    return shares | ({"W": work} if np.any(work) else {})

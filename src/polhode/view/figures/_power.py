"""Where power comes from and goes to: loads, contacts and joints against the change of energy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from polhode.algebra import Expr
from polhode.derive import Equations
from polhode.simulate import Trajectory
from polhode.view._quantities import Array, instants, largest, modes_of, scale_for
from polhode.view._scene_along import along
from polhode.view.figures._drawn import Drawn
from polhode.view.figures._history import legend_above, time_axis, widen
from polhode.view.figures._style import INK, axes_or_new, house_style, line_style, worded

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_TINY = 1e-9  # of the largest power: a share that is not drawn


@house_style()
def power_balance(run: Trajectory, *, ax: Axes | None = None) -> Drawn:
    """Power of every load, contact and joint that works, and their sum, W.

    The sum is drawn as a broad pale line; the rate of change of the kinetic energy, which it has
    to equal, is the thin line in it, found separately from the equations of motion.
    """
    axes = axes_or_new(ax)
    t = instants(run)
    shares, rate = _shares(run, t), _rate(run, t)
    total = np.sum(list(shares.values()), axis=0) if shares else 0 * t
    size = largest(rate, *shares.values())
    scale = scale_for("W", size)
    pale: dict[str, Any] = {"color": INK, "alpha": 0.18, "linewidth": 5, "solid_capstyle": "butt"}
    lines = axes.plot(t, total * scale.factor, label="sum", **pale)
    lines += axes.plot(
        t, rate * scale.factor, label=r"${\rm d}T/{\rm d}t$", color=INK, linewidth=0.9
    )
    working = {name: power for name, power in shares.items() if largest(power) > _TINY * size}
    for i, (name, power) in enumerate(working.items()):
        lines += axes.plot(t, power * scale.factor, label=worded(name), **line_style(i))
    widen(axes, np.concatenate([total, *working.values()]) * scale.factor)
    time_axis(axes, t)
    axes.set_ylabel(f"power ({scale.unit})")
    legend_above(axes)
    return Drawn(axes, lines)


def _shares(run: Trajectory, t: Array) -> dict[str, Array]:
    names = list(dict.fromkeys(name for equations in modes_of(run) for name in equations.powers))
    zero = Expr.of(0)

    def powers(equations: Equations) -> list[Expr]:
        return [equations.powers.get(name, zero) for name in names]

    return dict(zip(names, along(run, powers, len(names), t).T, strict=True))


def _rate(run: Trajectory, t: Array) -> Array:
    """Rate of change of the kinetic energy along the motion."""
    return along(run, lambda equations: [equations.rate(equations.kinetic_energy)], 1, t)[:, 0]

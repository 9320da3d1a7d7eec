"""Forms of energy along a motion, the power of each force, and the balance of both."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from polhode.algebra import Expr
from polhode.derive import Equations
from polhode.simulate import Trajectory
from polhode.view._quantities import Array, instants, largest, modes_of, scale_for
from polhode.view._scene_along import along
from polhode.view.figures._figure import Drawn, axes_or_new
from polhode.view.figures._history import legend_above, time_axis, widen
from polhode.view.figures._style import COLOURS, INK, MUTED, house_style, line_style, worded

if TYPE_CHECKING:
    from matplotlib.axes import Axes


ROUNDING = float(np.finfo(float).eps)
_FLOOR = ROUNDING / 30  # smaller values, zero among them, are drawn here on the logarithmic axis
_INTERVALS = 240
_CONSTANT = 1e-12  # relative change below which a quantity is constant to rounding
_TINY = 1e-9  # of the largest power: smaller ones are not drawn


@house_style()
def energies(run: Trajectory, *, ax: Axes | None = None) -> Drawn:
    """Change of kinetic, potential and total energy since the start, and the work done, J.

    Kinetic energy is taken in inertial space. Potential energy and work are drawn only if they
    change.
    """
    axes = axes_or_new(ax, 2.0)
    t = instants(run)
    kinetic, potential, work = _shares(run, t)
    size = _size(kinetic, potential, work)
    changes = {r"\Delta T": kinetic - kinetic[0]}
    if float(np.ptp(potential)):
        changes[r"\Delta V"] = potential - potential[0]
        changes[r"\Delta T + \Delta V"] = kinetic + potential - kinetic[0] - potential[0]
    if largest(work) > _CONSTANT * size:
        changes["W"] = work
    steady = largest(*changes.values()) <= _CONSTANT * size
    scale = scale_for("J", 0.1 * size if steady else largest(*changes.values()))
    lines = [
        axes.plot(t, values * scale.factor, label=f"${symbol}$", **line_style(i))[0]
        for i, (symbol, values) in enumerate(changes.items())
    ]
    if steady:
        axes.set_ylim(-0.1 * size * scale.factor, 0.1 * size * scale.factor)
    time_axis(axes, t)
    axes.set_ylabel(f"energy change ({scale.unit})")
    legend_above(axes)
    return Drawn(axes, lines)


@house_style()
def energy_drift(run: Trajectory, *, ax: Axes | None = None) -> Drawn:
    """Departure of the energy from its start plus the work done, relative to its size.

    Largest |E - E₀ - W| of short intervals over the largest |T| + |V| + |W| of the motion, on a
    logarithmic scale; the dashed line is the rounding of one number.
    """
    axes = axes_or_new(ax, 2.0)
    t = instants(run)
    kinetic, potential, work = _shares(run, t)
    total = kinetic + potential
    departure: Array = np.abs(total - total[0] - work) / _size(kinetic, potential, work)
    parts = [np.max(part) for part in np.array_split(departure, _INTERVALS)]
    middles = [np.mean(part) for part in np.array_split(t, _INTERVALS)]
    tops = np.maximum(parts, _FLOOR)
    (line,) = axes.plot(middles, tops, drawstyle="steps-mid", color=COLOURS[0], linewidth=1.0)
    axes.axhline(ROUNDING, color=MUTED, linewidth=0.9, linestyle=(0, (4, 3)))
    axes.set_yscale("log")
    axes.set_ylim(_FLOOR / 2, max(1e-13, 10 * float(np.max(departure))))
    time_axis(axes, t)
    axes.set_ylabel(r"$|E - E_0 - W|\,/\,E_{\rm max}$")
    axes.get_yticklabels()  # matplotlib makes them on demand: now, while our style is in force
    return Drawn(axes, [line])


def _shares(run: Trajectory, t: Array) -> tuple[Array, Array, Array]:
    """Kinetic and potential energy, and the work done since the start, J."""
    energies = along(
        run, lambda equations: [equations.kinetic_energy, equations.potential_energy], 2, t
    )
    kinetic, potential = energies.T
    return kinetic, potential, run.evaluate("work", t)


def _size(*shares: Array) -> float:
    return float(np.max(sum(map(np.abs, shares)))) or 1.0


@house_style()
def power_balance(run: Trajectory, *, ax: Axes | None = None) -> Drawn:
    """Power of every load, contact and joint that works, and their sum, W.

    The sum is drawn as a broad pale line; the rate of change of the kinetic energy, which must
    equal it, is the thin line inside, computed separately from the equations of motion.
    """
    axes = axes_or_new(ax)
    t = instants(run)
    shares = _powers(run, t)
    rate = along(run, lambda equations: [equations.rate(equations.kinetic_energy)], 1, t)[:, 0]
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


def _powers(run: Trajectory, t: Array) -> dict[str, Array]:
    names = list(dict.fromkeys(name for equations in modes_of(run) for name in equations.powers))
    zero = Expr.of(0)

    def powers(equations: Equations) -> list[Expr]:
        return [equations.powers.get(name, zero) for name in names]

    return dict(zip(names, along(run, powers, len(names), t).T, strict=True))

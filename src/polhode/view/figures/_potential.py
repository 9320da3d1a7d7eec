"""Effective potential of a tilt: the energy with the other speeds eliminated by their integrals."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from polhode.algebra import Expr, Symbol, arrays, compile_program
from polhode.analyse import LinearIntegrals, linear_integrals, reduced
from polhode.base import PURE, DeclarationError, to_si
from polhode.simulate import Trajectory
from polhode.view._quantities import (
    Array,
    Scale,
    equations_of,
    instants,
    largest,
    quantity,
    scale_for,
)
from polhode.view.figures._figure import Drawn, axes_or_new
from polhode.view.figures._history import legend_above
from polhode.view.figures._style import COLOURS, FAINT, MUTED, house_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_POINTS = 241
_BESIDE = 0.6  # how far the curve extends to either side, relative to the range of the motion
_CLEAR = 0.03  # rad kept from singular angles
_STILL = np.radians(5)  # range drawn to either side of a motion that does not swing
_HIGH = 3.0  # height of the axes, relative to the energy of the motion above the bottom


@house_style()
def effective_potential(
    run: Trajectory, *, between: tuple[str, str] | None = None, ax: Axes | None = None
) -> Drawn:
    """Effective potential of the tilt of a motion, with the energy and its turning points, J.

    It is the energy at zero rate of the tilt, with the other speeds given by the tilt through the
    integrals that are linear in the speeds. The tilt swings where the curve is below the energy
    (the line), between the turning points (dots).

    Args:
        run: the motion.
        between: least and greatest tilt to draw; by default a little beyond the motion's own.
        ax: axes to draw in.

    Raises:
        DeclarationError: for a system whose energy changes, or that does not reduce to one tilt.
    """
    axes = axes_or_new(ax, 3.0)
    tilt = tilt_of(run)
    angles = angles_about(run, tilt, between)
    heights, energy = potential(run, angles), float(run["energy"][0])
    scale = scale_for("J", max(abs(energy), float(np.min(np.abs(heights)))))
    along = tilt_scale(run, tilt)
    shown, curve, level = angles * along.factor, heights * scale.factor, energy * scale.factor
    (line,) = axes.plot(shown, curve, color=COLOURS[0], label=r"$V_{\rm eff}$")
    axes.axhline(level, color=COLOURS[1], linestyle=(0, (5, 1.6)), label="energy")
    axes.fill_between(shown, curve, level, where=curve <= level, color=FAINT, zorder=0)
    for turn in turning_points(angles, heights, energy) * along.factor:
        axes.axvline(turn, color=MUTED, linewidth=0.6, linestyle=(0, (2, 2)))
        axes.plot(turn, level, "o", color=COLOURS[1], zorder=3)
    # The axes show the well, not the walls beside it.
    bottom, top = float(np.min(curve)), float(np.max(curve))
    rise = max(level - bottom, 1e-3 * (top - bottom))
    top = min(top, bottom + _HIGH * rise)
    axes.set_ylim(bottom - 0.08 * (top - bottom), top)
    axes.set_xlabel(quantity(run, tilt.published).label(along))
    axes.set_ylabel(f"energy ({scale.unit})")
    legend_above(axes)
    return Drawn(axes, [line])


def potential(run: Trajectory, angles: Array) -> Array:
    """Effective potential at ascending tilts, rad; J."""
    equations, tilt = equations_of(run), tilt_of(run)
    found = linear_integrals(equations)
    moving = found.speeds if found is not None else ()
    still = equations.energy.subs({tilt.derivative(): Expr.of(0)})
    fixed = tuple(s for s in still.symbols() if s not in (tilt, *moving))
    values = [float(run.evaluate(Expr.generator(s), 0.0)) for s in fixed]
    speeds = _speeds(run, found, angles) if found is not None else ()
    energy = compile_program([still], (tilt, *moving, *fixed)).function(arrays())
    return np.broadcast_to(energy(angles, *speeds, *values)[0], angles.shape)


def _speeds(run: Trajectory, found: LinearIntegrals, angles: Array) -> Array:
    """The speeds at every tilt, shape (speeds, tilts).

    Integrals given by differential equations are continued outwards from the start, each tilt
    from its neighbour.
    """
    names = [s.published for s in found.speeds]
    tilt = found.angle.published
    start = {name: float(run.evaluate(name, 0.0)) for name in (tilt, *names)}
    rows = np.empty((len(angles), len(names)))
    first = int(np.argmin(np.abs(angles - start[tilt])))
    for outwards in (range(first, len(angles)), range(first - 1, -1, -1)):
        state = start
        for i in outwards:
            rows[i] = found.values(run.parameters, state, float(angles[i]))
            state = {tilt: float(angles[i]), **dict(zip(names, rows[i], strict=True))}
    return rows.T


def turning_points(angles: Array, heights: Array, energy: float) -> Array:
    """Where the potential crosses the energy, between the angles given, rad."""
    above = heights - energy
    # linear interpolation between the two angles at which the sign differs
    places = np.flatnonzero(np.sign(above[1:]) != np.sign(above[:-1]))
    share = above[places] / (above[places] - above[places + 1])
    crossings: Array = angles[places] + share * (angles[places + 1] - angles[places])
    return crossings


def tilt_of(run: Trajectory) -> Symbol:
    """The one coordinate that the motion reduces to.

    Raises:
        DeclarationError: for a system whose energy changes, or that does not reduce to one tilt.
    """
    equations = equations_of(run)
    if equations.rate(equations.energy):
        raise _refused(run, "a system whose energy is conserved")
    system = reduced(equations)
    found = linear_integrals(equations)
    known = found.speeds if found is not None else ()
    for tilt in system.essential[:1]:
        rate = tilt.derivative()
        others = [s for s in system.speeds if s not in (rate, *known)]
        constant = not any(equations.accelerations[s.derivative()] for s in others)
        if len(system.essential) == 1 and rate in system.speeds and constant:
            return tilt
    raise _refused(run, "a system that reduces to one tilt, such as a top or a rolling disk")


def _refused(run: Trajectory, expected: str) -> DeclarationError:
    return DeclarationError(f"{run.system.name} has no effective potential", expected=expected)


def angles_about(run: Trajectory, tilt: Symbol, between: tuple[str, str] | None = None) -> Array:
    """Tilts to draw: those between two, or a little beyond the motion's own, rad."""
    if between is not None:
        low, high = (to_si(end, PURE, tilt.published) for end in between)
        return np.linspace(low, high, _POINTS)
    own = run.evaluate(tilt.published, instants(run))
    low, high = float(np.min(own)), float(np.max(own))
    is_angle = quantity(run, tilt.published).unit == "rad"
    beside = max(_BESIDE * (high - low), _STILL if is_angle else 0.0)
    low, high = low - beside, high + beside
    # singular where sin θ changes its sign
    if is_angle and linear_integrals(equations_of(run)) is not None:
        below = np.floor((low + beside) / np.pi) * np.pi
        low, high = max(low, below + _CLEAR), min(high, below + np.pi - _CLEAR)
    return np.linspace(low, high, _POINTS)


def tilt_scale(run: Trajectory, tilt: Symbol) -> Scale:
    """What the tilt is shown in: degrees, or metres where it is a distance."""
    named = quantity(run, tilt.published)
    return scale_for(named.unit, largest(run.evaluate(tilt.published, instants(run))))

"""Portraits of the scene: a motion against something other than time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from polhode.algebra import Expr
from polhode.base import PolhodeError
from polhode.simulate import Trajectory
from polhode.view._drawn_portraits import DrawnPortrait, essential_coordinates, portraits_in
from polhode.view._mathml import inline, typeset
from polhode.view._quantities import Array, equations_of, largest, scale_for
from polhode.view._scene import Portrait
from polhode.view._scene_along import along
from polhode.view.figures._potential import (
    angles_about,
    potential,
    tilt_of,
    tilt_scale,
)

_STILL = 1e-6  # of its size: what varies by less makes no curve


def portraits_of(run: Trajectory, points: int) -> tuple[Portrait, ...]:
    """Phase portraits, the effective potential, and paths of directions on the sphere.

    Args:
        run: the motion.
        points: of every curve.
    """
    t = np.linspace(0.0, run.duration, points)
    drawn = [_portrait(run, one, t) for one in portraits_in(equations_of(run))]
    moving = [one for one in drawn if _moves(one)]
    # the directions of an axis are those of its body
    return (*_well(run, t), *(replace(p, columns=()) if p.kind == "axis" else p for p in moving))


def _portrait(run: Trajectory, drawn: DrawnPortrait, t: Array) -> Portrait:
    columns = list(along(run, drawn.values, len(drawn.names), t).T)
    units = []
    for i, unit in enumerate(drawn.units):
        scale = scale_for(unit, largest(columns[i]))
        columns[i] = columns[i] * scale.factor
        units.append(scale.unit)
    found = Portrait(drawn.kind, drawn.title, drawn.names, drawn.symbols, tuple(units))
    return replace(found, columns=tuple(columns), body=drawn.body, axis=drawn.axis)


def _moves(portrait: Portrait) -> bool:
    """Whether there is a curve: in a plane both columns vary, on a sphere the direction does."""
    columns = np.array(portrait.columns)
    if not np.all(np.isfinite(columns)):
        return False
    if portrait.kind != "plane":
        sizes = np.linalg.norm(columns, axis=0)
        return bool(np.all(sizes) and np.any(np.ptp(columns / sizes, axis=1) > _STILL))
    spread = np.ptp(columns, axis=1)
    return bool(np.all(spread > _STILL * np.max(np.abs(columns), axis=1)))


def _well(run: Trajectory, t: Array) -> Iterator[Portrait]:
    """The effective potential of a system that reduces to one tilt."""
    if len(essential_coordinates(equations_of(run))) != 1:
        return
    try:
        tilt = tilt_of(run)
        angles = angles_about(run, tilt)
        heights = potential(run, angles)
    except PolhodeError:
        return
    values = run.evaluate(tilt.published, t)
    if not np.all(np.isfinite(heights)) or np.ptp(values) <= _STILL * largest(values):
        return
    energy = float(run["energy"][0])
    turn, scale = tilt_scale(run, tilt), scale_for("J", max(largest(heights), abs(energy)))
    yield Portrait(
        "well",
        "effective potential",
        (tilt.published, "V_eff"),
        (inline(Expr.generator(tilt)), typeset(r"V_{\mathrm{eff}}")),
        (turn.unit, scale.unit),
        (values * turn.factor,),
        (angles * turn.factor, heights * scale.factor),
        energy * scale.factor,
    )

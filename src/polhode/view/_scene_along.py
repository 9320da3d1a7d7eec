"""Vectors and attitudes along a motion, as arrays over all its contact modes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import cast

import numpy as np

from polhode.algebra import Expr, Vector
from polhode.derive import Equations
from polhode.model import Frame
from polhode.simulate import Trajectory
from polhode.view import _rotations
from polhode.view._quantities import Array

#: Expressions in the equations of one contact mode; None if they are not defined there.
InMode = Callable[[Equations], Sequence[Expr] | None]

_STILL = 1e-9  # relative spread below which an array counts as constant


def along(run: Trajectory, in_mode: InMode, count: int, t: Array) -> Array:
    """Expressions of every contact mode along the motion, shape (instants, count).

    NaN in modes in which they are not defined.
    """
    begins = np.array([segment.begin for segment in run.segments])
    which = np.clip(np.searchsorted(begins, t, "right") - 1, 0, None)
    values = np.full((count, len(t)), np.nan)
    for i in np.unique(which):
        segment, here = run.segments[i], which == i
        expressions = in_mode(cast(Equations, segment.dynamics.equations))
        if expressions is not None:
            values[:, here] = segment.values(expressions, t[here])
    return values.T


def vectors(run: Trajectory, in_mode: Callable[[Equations], Vector | None], t: Array) -> Array:
    """A vector along the directions of the root frame, shape (instants, 3)."""

    def components(equations: Equations) -> Sequence[Expr] | None:
        vector = in_mode(equations)
        return None if vector is None else vector.express(equations.system.root).components

    return along(run, components, 3, t)


def attitudes(run: Trajectory, in_mode: Callable[[Equations], Frame], t: Array) -> Array:
    """Attitude of a frame relative to the root frame, as quaternions, shape (instants, 4)."""

    def entries(equations: Equations) -> Sequence[Expr]:
        matrix = in_mode(equations).rotation_to(equations.system.root)
        return [entry for row in matrix.rows for entry in row]

    return quaternions(along(run, entries, 9, t).reshape(-1, 3, 3))


def constants(run: Trajectory, expressions: Sequence[Expr]) -> tuple[float, ...]:
    """Values of expressions in parameters alone."""
    values = run.segments[0].values(expressions, np.array([0.0]))
    return tuple(float(value) for value in values[:, 0])


def collapsed(rows: Array) -> Array:
    """A single row if all rows are equal to rounding, which keeps pages small."""
    size = float(np.max(np.abs(rows), initial=0.0))
    if len(rows) > 1 and np.all(np.ptp(rows, axis=0) <= _STILL * size):
        return rows[:1]
    return rows


def quaternions(matrices: Array) -> Array:
    """Rotation matrices as unit quaternions (x, y, z, w) that follow each other without a jump."""
    q = _rotations.of_matrices(matrices)
    # q and -q are the same rotation: each sign is chosen to be nearest to the one before, since
    # the page interpolates between frames.
    flips = np.sign(np.sum(q[1:] * q[:-1], axis=1))
    q[1:] *= np.cumprod(np.where(flips < 0, -1.0, 1.0))[:, None]
    return q


def rolled(turning: Array, step: float) -> Array:
    """Attitudes from integrating an angular velocity (rad/s, fixed axes) from the identity.

    Each step is a rotation about the mean angular velocity of its ends, which is accurate to
    second order: enough to draw a ball.
    """
    means = (turning[1:] + turning[:-1]) / 2
    turned = _rotations.about(np.vstack([np.zeros(3), means * step]))
    # Products of all steps so far, by doubling: each is the rotation over the last `reach` steps.
    reach = 1
    while reach < len(turned):
        later = _rotations.product(turned[reach:], turned[:-reach])
        turned, reach = np.concatenate([turned[:reach], later]), 2 * reach
    return turned

"""Vectors and attitudes along a motion, as arrays over all its contact modes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import cast

import numpy as np

from polhode.algebra import Expr, Vector
from polhode.derive import Equations
from polhode.model import Frame
from polhode.simulate import Trajectory
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
    """Rotation matrices as unit quaternions (x, y, z, w) that follow each other without a jump.

    Bar-Itzhack's symmetric 4 × 4 matrix plus the identity is 4 q qᵀ for an exact rotation. Its
    column with the largest diagonal entry gives q without dividing by a small number.
    """
    m = matrices
    xx, yy, zz = m[:, 0, 0], m[:, 1, 1], m[:, 2, 2]
    k = np.empty((len(m), 4, 4))
    k[:, 0, 0], k[:, 1, 1], k[:, 2, 2] = xx - yy - zz, yy - xx - zz, zz - xx - yy
    k[:, 3, 3] = xx + yy + zz
    for i, j in ((0, 1), (0, 2), (1, 2)):
        k[:, i, j] = k[:, j, i] = m[:, i, j] + m[:, j, i]
    for i, (j, l) in enumerate(((2, 1), (0, 2), (1, 0))):
        k[:, i, 3] = k[:, 3, i] = m[:, j, l] - m[:, l, j]
    k += np.eye(4)
    largest = np.argmax(np.einsum("nii->ni", k), axis=1)
    column = k[np.arange(len(k)), :, largest]
    q: Array = column / np.linalg.norm(column, axis=1, keepdims=True)
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
    half = (turning[1:] + turning[:-1]) * (step / 4)
    angle = np.linalg.norm(half, axis=1, keepdims=True)
    turns = np.hstack([half * np.sinc(angle / np.pi), np.cos(angle)])  # (n sin φ/2, cos φ/2)
    q = np.vstack([(0.0, 0.0, 0.0, 1.0), turns])
    # Products of all steps so far, by doubling: q[i] is the rotation over the last `reach` steps.
    reach = 1
    while reach < len(q):
        q[reach:] = _after(q[reach:], q[:-reach])
        reach *= 2
    return q


def _after(second: Array, first: Array) -> Array:
    """Quaternions of one turn after another, both along fixed directions."""
    a, b, c, w = second.T
    x, y, z, s = first.T
    return np.stack(
        [
            w * x + s * a + b * z - c * y,
            w * y + s * b + c * x - a * z,
            w * z + s * c + a * y - b * x,
            w * s - a * x - b * y - c * z,
        ],
        axis=1,
    )

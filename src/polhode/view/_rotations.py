"""Rotations as unit quaternions (x, y, z, w) in rows, as pages have them; shape (rotations, 4)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from polhode.view._quantities import Array


def of_matrices(matrices: Array) -> Array:
    """Rotation matrices, shape (rotations, 3, 3).

    The component of largest size is found from a square root, and the others by it (Shepperd,
    Journal of Guidance and Control 1 (1978) 223).
    """
    m = matrices
    diagonal = np.diagonal(m, axis1=1, axis2=2)
    trace = np.sum(diagonal, axis=1)
    # 4 q qᵀ, from sums and differences of entries
    products = np.empty((len(m), 4, 4))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        products[:, i, i] = 1 + 2 * diagonal[:, i] - trace
        products[:, j, k] = products[:, k, j] = m[:, j, k] + m[:, k, j]
        products[:, i, 3] = products[:, 3, i] = m[:, k, j] - m[:, j, k]
    products[:, 3, 3] = 1 + trace
    largest = np.argmax(np.diagonal(products, axis1=1, axis2=2), axis=1)
    rows: Array = products[np.arange(len(m)), largest]
    return np.asarray(rows / np.linalg.norm(rows, axis=1)[:, None])


def about(vectors: Array) -> Array:
    """Rotations about vectors, by as many radians as these are long, shape (rotations, 3)."""
    halves = np.linalg.norm(vectors, axis=1)[:, None] / 2
    # sin(a/2)/a, with its limit at zero
    return np.hstack([vectors * np.sinc(halves / np.pi) / 2, np.cos(halves)])


def product(after: Array, before: Array) -> Array:
    """The rotation `before`, and then `after`."""
    u, a = after[..., :3], after[..., 3:]
    v, b = before[..., :3], before[..., 3:]
    vector = a * v + b * u + np.cross(u, v)
    return np.concatenate([vector, a * b - np.sum(u * v, axis=-1, keepdims=True)], axis=-1)


def inverse(turns: Array) -> Array:
    """The rotations back."""
    return np.asarray(turns * np.array([-1.0, -1.0, -1.0, 1.0]))


def applied(turns: Array, vectors: ArrayLike) -> Array:
    """Vectors turned, one or a row for each rotation."""
    v = np.asarray(vectors, dtype=float)
    u, w = turns[..., :3], turns[..., 3:]
    across = np.cross(u, v)
    # interpolated quaternions are not quite of length one
    return np.asarray(
        v + 2 * (w * across + np.cross(u, across)) / np.sum(turns**2, axis=-1, keepdims=True)
    )


def matrix(turn: Array) -> Array:
    """The matrix of one rotation, shape (3, 3)."""
    return applied(turn, np.eye(3)).T

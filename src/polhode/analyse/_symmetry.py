"""The axis of symmetry of a body's inertia, in whatever axes the inertia is given."""

from __future__ import annotations

from polhode.algebra import ZERO, Matrix, Vector, principal_root
from polhode.model import Body


def symmetry_axes(body: Body) -> tuple[Vector, ...]:
    """Unit vectors about which the inertia of a body is symmetric; empty if there are none.

    For a ball, for which every direction is one, those of its axes are given.
    """
    inertia, size = body.inertia, range(3)
    principal = [inertia[i, i] for i in size]
    if inertia == Matrix.diagonal(principal):
        labels = body.axes.labels
        alike = (principal[i - 2] == principal[i - 1] for i in size)
        return tuple(body.axes[label] for label, same in zip(labels, alike, strict=True) if same)
    # About an oblique axis of symmetry n, I = A 1 + (C - A) n nᵀ, so that I - A 1 has rank one and
    # its columns are along n. From the products of inertia, I_ij I_ik/I_jk = (C - A) n_i², which
    # gives A = I_ii - I_ij I_ik/I_jk.
    for i in size:
        j, k = (i + 1) % 3, (i + 2) % 3
        across = inertia[i, i]
        if inertia[j, k]:
            across = across - inertia[i, j] * inertia[i, k] / inertia[j, k]
        elif inertia[i, j] or inertia[i, k]:
            continue
        rest = [[inertia[a, b] - (across if a == b else ZERO) for b in size] for a in size]
        column = next((c for c in zip(*rest, strict=True) if any(c)), None)
        pairs = [(0, 1), (0, 2), (1, 2)]
        minors = (
            rest[a][c] * rest[b][d] - rest[a][d] * rest[b][c] for a, b in pairs for c, d in pairs
        )
        if column is not None and not any(minors):
            length = principal_root(sum((c * c for c in column), ZERO))
            return (Vector(tuple(c / length for c in column), body.axes),)
    return ()

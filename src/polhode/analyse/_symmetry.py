"""The axis that a body's inertia is symmetric about, however its axes are laid."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import ZERO, Expr, Matrix, Row, Vector, principal_root
from polhode.model import Body


def symmetry_axes(body: Body) -> tuple[Vector, ...]:
    """Unit vectors along which a body is a symmetric one, along its axes; none where it is not.

    Any direction serves for a ball: those of its axes are given.
    """
    inertia = body.inertia
    principal = [inertia[i, i] for i in range(3)]
    if inertia == Matrix.diagonal(principal):
        labels = body.axes.labels
        alike = (principal[i - 2] == principal[i - 1] for i in range(3))
        return tuple(body.axes[label] for label, same in zip(labels, alike, strict=True) if same)
    return tuple(Vector(_unit(axis), body.axes) for axis in _oblique(inertia))


def _oblique(inertia: Matrix) -> Iterator[Row]:
    """Columns of I - A that are of rank one, for the moment A across the axis."""
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        across = inertia[i, i]
        if inertia[j, k]:
            across = across - inertia[i, j] * inertia[i, k] / inertia[j, k]
        elif inertia[i, j] or inertia[i, k]:
            continue
        rest = [[inertia[a, b] - (across if a == b else ZERO) for b in range(3)] for a in range(3)]
        column = next((c for c in zip(*rest, strict=True) if any(c)), None)
        if column is not None and _is_rank_one(rest):
            yield column
            return


def _is_rank_one(rows: list[list[Expr]]) -> bool:
    pairs = [(0, 1), (0, 2), (1, 2)]
    return not any(
        rows[a][c] * rows[b][d] - rows[a][d] * rows[b][c] for a, b in pairs for c, d in pairs
    )


def _unit(column: Row) -> Row:
    length = principal_root(sum((c * c for c in column), ZERO))
    return tuple(c / length for c in column)

"""Linear equations in numbers of an mpmath context, in NumPy arrays of objects."""

from __future__ import annotations

from typing import Any

import numpy as np


def solution(context: Any, matrix: Any, right: Any) -> Any:
    """Of linear equations, for one right side or the columns of a matrix."""
    columns = [right.tolist()] if np.ndim(right) == 1 else np.transpose(right).tolist()
    found = [_column(context, matrix, column) for column in columns]
    return np.array(found, dtype=object).T.reshape(np.shape(right))


def _column(context: Any, matrix: Any, right: list[Any]) -> list[Any]:
    if not right:
        return []
    return list(context.lu_solve(context.matrix(matrix.tolist()), context.matrix(right)))


def least_solution(context: Any, matrix: Any, right: Any, dependent: Any) -> Any:
    """The least of all vectors that solve linear equations best.

    Args:
        dependent: of the largest singular value: one that is rounding.
    """
    left, sizes, across = context.svd_r(context.matrix(matrix.tolist()))
    felt = [k for k in range(len(sizes)) if sizes[k] > dependent * max(sizes)]
    shares = {k: sum(left[i, k] * right[i] for i in range(len(right))) / sizes[k] for k in felt}
    found = [sum(across[k, j] * shares[k] for k in felt) for j in range(matrix.shape[1])]
    return np.array(found, dtype=object)

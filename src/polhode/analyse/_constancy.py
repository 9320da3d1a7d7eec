"""Whether a quantity keeps its value along every motion, decided without solving for accelerations.

The rate of a quantity is linear in the accelerations u̇, which are the solution of M u̇ = f. At a
random point of a prime field that is a small linear system of numbers, however long the entries of
M and f are, and however much longer the accelerations would be.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from polhode.algebra import (
    Expr,
    FieldPoint,
    NoResidueError,
    Residue,
    has_parts,
    length,
    linear_parts,
    vanishing,
)
from polhode.base import NumericError
from polhode.derive import Equations

#: Terms of the mass matrix above which solving for three or more accelerations is not tried: those
#: of the rattleback would have 74 000.
_LONGEST = 200


def has_closed_accelerations(equations: Equations) -> bool:
    """Whether the accelerations are short enough to be written out."""
    terms = sum(length(entry) for row in equations.mass.rows for entry in row)
    coupled = len(equations.speeds) > 2  # elimination multiplies lengths with every further row
    if equations.motion_in_parts or (coupled and terms > _LONGEST):
        return False
    try:
        return not any(map(has_parts, equations.accelerations.values()))
    except NumericError:  # of too many coupled speeds
        return False


def is_constant(equations: Equations, expression: Expr) -> bool:
    """Whether the rate of an expression vanishes along every motion.

    A wrong answer is less likely than 10⁻²⁰ (`algebra._residues`). Where the rate has no value in
    the field, it is not taken to vanish.
    """
    motion = equations.kinetics
    rate = motion.on_speeds(expression).chain(motion.rate)
    slopes, rest = linear_parts(rate, equations.acceleration_symbols)
    if not any(slopes):
        return rest.is_zero

    def value(point: FieldPoint) -> Residue:
        rows = [_residues(row, point) for row in equations.mass.rows]
        right, along = _residues(equations.forcing, point), _residues(slopes, point)
        last = rest.residue(point)
        every = [*(entry for row in rows for entry in row), *right, *along, last]
        solved = _solution([[e.value for e in row] for row in rows], [e.value for e in right])
        total = last.value
        for slope, acceleration in zip(along, solved, strict=True):
            total = total + slope.value * acceleration
        # by Cramer's rule, each solution is a quotient of determinants of the entries
        degree = 2 * (len(rows) + 1) * sum(entry.degree for entry in every)
        return Residue(total, degree, frozenset().union(*(entry.roots for entry in every)))

    try:
        return vanishing(value, _point).is_zero
    except NoResidueError:
        return False


def _residues(expressions: Sequence[Expr], point: FieldPoint) -> list[Residue]:
    return [expression.residue(point) for expression in expressions]


def _solution(rows: list[list[Any]], right: list[Any]) -> list[Any]:
    """Gauss-Jordan elimination in the field.

    Raises `ZeroDivisionError` where the matrix is singular at the point.
    """
    table = [[*row, value] for row, value in zip(rows, right, strict=True)]
    for j in range(len(table)):
        pivot = next((i for i in range(j, len(table)) if table[i][j] != 0), None)
        if pivot is None:
            raise ZeroDivisionError("the mass matrix is singular at this point")
        table[j], table[pivot] = table[pivot], table[j]
        table[j] = [entry / table[j][j] for entry in table[j]]
        for i, row in enumerate(table):
            if i != j and row[j] != 0:
                table[i] = [a - row[j] * b for a, b in zip(row, table[j], strict=True)]
    return [row[-1] for row in table]


@lru_cache(maxsize=64)
def _point(number: int) -> FieldPoint:
    return FieldPoint(f"motion {number}")

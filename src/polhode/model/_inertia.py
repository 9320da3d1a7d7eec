"""Mass and inertia that a body can have."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import combinations
from typing import Any

from polhode.algebra import ONE, ZERO, Expr, ExprLike, Matrix
from polhode.base import DeclarationError
from polhode.model._checks import constant, is_negative, quantity

InertiaLike = Sequence[ExprLike] | Sequence[Sequence[ExprLike]]

#: Share by which rounded numbers may break an inequality that is sharp for thin bodies.
ROUNDING = 1e-12


def check_mass(name: str, mass: ExprLike) -> Expr:
    """The mass (kg) of a body; it must be positive and constant."""
    what = f"mass of body {name!r}"
    value = constant(quantity(mass, what), what)
    if value.is_zero or is_negative(value):
        raise DeclarationError(f"{what}: {value}", expected="a positive mass in kg")
    return value


def check_inertia(name: str, given: InertiaLike | Matrix) -> Matrix:
    """The inertia of a body about its centre of mass, kg m².

    The second moments ∫ xᵢxⱼ dm = tr(I)/2 δᵢⱼ - Iᵢⱼ form a positive semidefinite matrix, so no
    principal minor of it is negative. For principal moments this is the triangle inequality.

    Args:
        name: of the body.
        given: three principal moments, or the full symmetric 3 × 3 matrix.

    Raises:
        DeclarationError: for anything else, and for what no distribution of mass can have.
    """
    inertia = _matrix(name, given)
    for entry in _entries(inertia):
        constant(entry, f"inertia of body {name!r}")
    trace = _trace(inertia)
    if any(_falls_short(inertia[i, i], trace) for i in range(3)):
        raise DeclarationError(_told(name, inertia), expected="none of them negative")
    if any(_falls_short(minor, trace**size) for size, minor in _minors(_second_moments(inertia))):
        raise DeclarationError(
            _told(name, inertia),
            expected="each at most the sum of the other two (the triangle inequality)",
            advice="check the moments: no body can have these",
        )
    return inertia


def is_symmetric(inertia: Matrix, axis: int) -> bool:
    """Whether it is the same however the body is turned about this one of its axes."""
    first, second = ((axis + 1) % 3, (axis + 2) % 3)
    mixed = (inertia[first, second], inertia[axis, first], inertia[axis, second])
    return not any(mixed) and inertia[first, first] == inertia[second, second]


def _matrix(name: str, given: InertiaLike | Matrix) -> Matrix:
    if isinstance(given, Matrix):
        return given
    rows: list[Any] = list(given) if isinstance(given, Iterable) else []
    what = f"inertia of body {name!r}"
    nested = [list(row) for row in rows if isinstance(row, Iterable)]
    if len(rows) == 3 and not nested:
        return Matrix.diagonal([quantity(moment, what) for moment in rows])
    if len(rows) == 3 and [len(row) for row in nested] == [3, 3, 3]:
        matrix = Matrix.of([[quantity(entry, what) for entry in row] for row in nested])
        if matrix == matrix.T:
            return matrix
    raise DeclarationError(
        f"{what}: {given!r}",
        expected="three principal moments or a symmetric 3 by 3 matrix, in kg m^2",
    )


def _entries(matrix: Matrix) -> Iterator[Expr]:
    return (entry for row in matrix.rows for entry in row)


def _trace(matrix: Matrix) -> Expr:
    return sum((matrix[i, i] for i in range(3)), ZERO)


def _second_moments(inertia: Matrix) -> list[list[Expr]]:
    half = _trace(inertia) / 2
    return [[(half if i == j else ZERO) - inertia[i, j] for j in range(3)] for i in range(3)]


def _minors(rows: list[list[Expr]]) -> Iterator[tuple[int, Expr]]:
    """Principal minors by size."""
    for size in (1, 2, 3):
        for chosen in combinations(range(3), size):
            yield size, _determinant([[rows[i][j] for j in chosen] for i in chosen])


def _determinant(rows: list[list[Expr]]) -> Expr:
    if not rows:
        return ONE
    first, others = rows[0], rows[1:]
    cofactors = (_determinant([row[:j] + row[j + 1 :] for row in others]) for j in range(len(rows)))
    signed = (entry * (-1) ** j for j, entry in enumerate(first))
    return sum((a * b for a, b in zip(signed, cofactors, strict=True)), ZERO)


def _falls_short(value: Expr, scale: Expr) -> bool:
    """Whether it is below zero, by more than rounding if both are numbers."""
    known, size = value.rational, scale.rational
    if known is None or size is None:
        return is_negative(value)
    return known < -Fraction(ROUNDING) * abs(size)


def _told(name: str, inertia: Matrix) -> str:
    diagonal = [inertia[i, i] for i in range(3)]
    principal = inertia == Matrix.diagonal(diagonal)
    told = diagonal if principal else [list(row) for row in inertia.rows]
    return f"moments of inertia {told} of body {name!r}"

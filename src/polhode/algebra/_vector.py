"""Exact matrices, and vectors in space resolved along a triad of unit vectors that may rotate."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from polhode.algebra._expression import ONE, ZERO, Expr, ExprLike, total
from polhode.algebra._parts import named
from polhode.algebra._ring import OutgrownError, Symbol
from polhode.algebra._roots import sqrt
from polhode.base import DeclarationError, Shown

Row = tuple[Expr, ...]

_LONG = 10  # terms of the square of a length: with fewer a division by it is no trouble


def dot(first: Iterable[Expr], second: Iterable[Expr]) -> Expr:
    """Sum of products."""
    return total(a * b for a, b in zip(first, second, strict=True) if a and b)


@dataclass(frozen=True)
class Matrix(Shown):
    """An exact matrix, as a tuple of rows.

    Raises:
        DeclarationError: for rows that are not lists of expressions or numbers, of one length.
    """

    rows: tuple[Row, ...]

    def __post_init__(self) -> None:
        rows = self.rows
        is_read = type(rows) is tuple and all(type(row) is tuple for row in rows)
        if not is_read or not all(isinstance(entry, Expr) for row in rows for entry in row):
            object.__setattr__(self, "rows", _rows(rows))

    @classmethod
    def of(cls, rows: Iterable[Iterable[ExprLike]]) -> Matrix:
        """From anything that reads as rows of expressions."""
        return cls(_rows(rows))

    @classmethod
    def diagonal(cls, entries: Sequence[ExprLike]) -> Matrix:
        """With these entries on the diagonal and zero elsewhere."""
        size = range(len(entries))
        return cls.of([[entries[i] if i == j else 0 for j in size] for i in size])

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)."""
        return len(self.rows), len(self.rows[0]) if self.rows else 0

    @property
    def T(self) -> Matrix:
        """Transpose."""
        return Matrix(tuple(zip(*self.rows, strict=True)))

    @property
    def entries(self) -> Row:
        """All entries, row by row."""
        return tuple(entry for row in self.rows for entry in row)

    @property
    def is_zero(self) -> bool:
        """Whether every entry vanishes identically."""
        return not any(self.entries)

    def __getitem__(self, position: tuple[int, int]) -> Expr:
        return self.rows[position[0]][position[1]]

    def __add__(self, other: Matrix) -> Matrix:
        pairs = zip(self.rows, other.rows, strict=True)
        return Matrix(tuple(tuple(a + b for a, b in zip(*pair, strict=True)) for pair in pairs))

    def __matmul__(self, other: Matrix) -> Matrix:
        columns = other.T.rows
        return Matrix(tuple(tuple(dot(row, col) for col in columns) for row in self.rows))

    def times(self, column: Sequence[Expr]) -> Row:
        """Product with a column."""
        return tuple(dot(row, column) for row in self.rows)

    def __repr__(self) -> str:
        rows = (f"[{', '.join(map(str, row))}]" for row in self.rows)
        return f"[{', '.join(rows)}]"

    def latex(self) -> str:
        """LaTeX of the whole matrix."""
        body = r" \\ ".join(" & ".join(e.latex() for e in row) for row in self.rows)
        return rf"\begin{{bmatrix}} {body} \end{{bmatrix}}"

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex()}$"


def _rows(given: Any) -> tuple[Row, ...]:
    if isinstance(given, Iterable) and not isinstance(given, str):
        listed = tuple(given)
        if all(isinstance(row, Iterable) and not isinstance(row, str) for row in listed):
            rows = tuple(tuple(Expr.of(entry) for entry in row) for row in listed)
            if len({len(row) for row in rows}) <= 1:
                return rows
    raise DeclarationError(
        f"a matrix of {given!r}"[:200],
        expected="rows of the same length, of expressions or numbers",
        advice="as in [[I_1, 0], [0, I_2]]",
    )


def rotation(axis: Sequence[Expr], cosine: Expr, sine: Expr) -> Matrix:
    """Rodrigues' rotation about a unit axis: from components in the rotated axes to the old ones.

    R = cos α 1 + (1 - cos α) n nᵀ + sin α [n]×
    """
    x, y, z = axis
    cross = ((ZERO, -z, y), (z, ZERO, -x), (-y, x, ZERO))
    return Matrix(
        tuple(
            tuple(
                (cosine if i == j else ZERO)
                + (ONE - cosine) * axis[i] * axis[j]
                + sine * cross[i][j]
                for j in range(3)
            )
            for i in range(3)
        )
    )


class Triad(Protocol):
    """Three right-handed orthonormal directions; a frame of `model` is one."""

    def rotation_to(self, other: Any, /) -> Matrix:
        """The matrix from components along these directions to components along the other's."""

    @property
    def turning(self) -> Row:
        """Angular velocity in inertial space, components along these directions, rad/s."""

    @property
    def angular_velocity(self) -> Vector:
        """The same as a vector."""


@dataclass(frozen=True)
class Vector(Shown):
    """A vector by its components along a triad."""

    components: Row
    triad: Triad

    @classmethod
    def along(cls, triad: Triad, components: Iterable[ExprLike]) -> Vector:
        """From three numbers or expressions."""
        x, y, z = (Expr.of(c) for c in components)
        return cls((x, y, z), triad)

    def express(self, triad: Triad) -> Vector:
        """The same vector, resolved along another triad."""
        if triad == self.triad:
            return self
        return Vector(self.triad.rotation_to(triad).times(self.components), triad)

    def component(self, direction: Vector) -> Expr:
        """Component along a unit vector."""
        return self.dot(direction)

    def __repr__(self) -> str:
        return f"({', '.join(map(str, self.components))}) along {self.triad}"

    @property
    def is_zero(self) -> bool:
        """Whether it vanishes identically."""
        return not any(self.components)

    def __add__(self, other: Vector) -> Vector:
        if self.is_zero:
            return other
        added = other.express(self.triad).components
        return Vector(tuple(a + b for a, b in zip(self.components, added, strict=True)), self.triad)

    def __neg__(self) -> Vector:
        return Vector(tuple(-c for c in self.components), self.triad)

    def __sub__(self, other: Vector) -> Vector:
        return self + (-other)

    def __mul__(self, factor: ExprLike) -> Vector:
        return Vector(tuple(c * factor for c in self.components), self.triad)

    __rmul__ = __mul__

    def __truediv__(self, divisor: ExprLike) -> Vector:
        return self * (1 / Expr.of(divisor))

    def dot(self, other: Vector) -> Expr:
        """Scalar product."""
        return dot(self.components, other.express(self.triad).components)

    def cross(self, other: Vector) -> Vector:
        """Vector product."""
        a, b = self.components, other.express(self.triad).components
        product = (
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        )
        return Vector(product, self.triad)

    def norm(self) -> Expr:
        """Length; of a sum that is too long to divide by, the square is under a name."""
        return length_with_square(self.dot(self))

    def dt(self, seen_from: Triad | None = None) -> Vector:
        """Time derivative, in inertial space or as seen from a rotating triad.

        Transport theorem: the components' derivative plus the triad's angular velocity × vector.
        """
        rate = Vector(tuple(c.dt() for c in self.components), self.triad)
        turning = self.triad.angular_velocity
        if seen_from is not None:
            turning = turning - seen_from.angular_velocity
        return rate + turning.cross(self)

    def diff(self, symbol: Expr | Symbol) -> Vector:
        """Derivative of the components with respect to a symbol, the triad held."""
        return self.mapped(lambda component: component.diff(symbol))

    def mapped(self, change: Callable[[Expr], Expr]) -> Vector:
        """With every component changed."""
        return Vector(tuple(map(change, self.components)), self.triad)

    def subs(self, images: Mapping[Any, ExprLike]) -> Vector:
        """With symbols replaced in the components."""
        return self.mapped(lambda component: component.subs(images))


def length_with_square(squared: Expr) -> Expr:
    """A length in normal form; its square is under a name where it is too long to divide by."""
    length = sqrt(squared)
    try:
        if len(squared.num) > _LONG:
            length.reciprocal()
    except OutgrownError:
        return sqrt(named(squared))
    return length


def zero_vector(triad: Triad) -> Vector:
    """The vector of length zero."""
    return Vector((ZERO, ZERO, ZERO), triad)

"""Exact matrices and elimination with pivots chosen to keep expressions small."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from polhode.algebra._expression import ONE, ZERO, Expr, ExprLike, total
from polhode.algebra._generators import Symbol
from polhode.algebra._roots import is_positive
from polhode.base import NumericError, Shown

Row = tuple[Expr, ...]


class OutgrownError(NumericError):
    """An exact solution that has grown too long to be of use."""


LONGEST = 3000  # terms of an entry; the longest of the systems in the tests has half as many


@dataclass(frozen=True)
class Matrix(Shown):
    """An exact matrix, as a tuple of rows."""

    rows: tuple[Row, ...]

    @classmethod
    def of(cls, rows: Iterable[Iterable[ExprLike]]) -> Matrix:
        """From anything that reads as rows of expressions."""
        return cls(tuple(tuple(Expr.of(entry) for entry in row) for row in rows))

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

    def __getitem__(self, position: tuple[int, int]) -> Expr:
        return self.rows[position[0]][position[1]]

    def __matmul__(self, other: Matrix) -> Matrix:
        columns = other.T.rows
        return Matrix(tuple(tuple(dot(row, col) for col in columns) for row in self.rows))

    def times(self, column: Sequence[Expr]) -> Row:
        """Product with a column."""
        return tuple(dot(row, column) for row in self.rows)

    def __repr__(self) -> str:
        return f"[{', '.join(f'[{_listed(row)}]' for row in self.rows)}]"

    def latex(self) -> str:
        """LaTeX of the whole matrix."""
        body = r" \\ ".join(" & ".join(e.latex() for e in row) for row in self.rows)
        return rf"\begin{{bmatrix}} {body} \end{{bmatrix}}"

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex()}$"


def _listed(row: Row) -> str:
    return ", ".join(map(str, row))


def dot(first: Iterable[Expr], second: Iterable[Expr]) -> Expr:
    """Sum of products."""
    return total(a * b for a, b in zip(first, second, strict=True) if a and b)


@dataclass(frozen=True)
class Elimination:
    """Outcome of Gauss–Jordan elimination of A x = b.

    `solved[j]` gives unknown j as (coefficients of the free unknowns, constant). `leftover[i]` is
    what row i still demands to be zero when all unknowns are gone.
    """

    solved: dict[int, tuple[Row, Expr]]
    free: tuple[int, ...]
    leftover: dict[int, Expr]

    @property
    def contradictory(self) -> tuple[int, ...]:
        """Rows that cannot hold together with the others."""
        return tuple(i for i, rest in self.leftover.items() if rest)


def eliminate(
    rows: Sequence[Sequence[Expr]],
    right: Sequence[Expr],
    rank: Sequence[int] | None = None,
) -> Elimination:
    """Solve A x = b for as many unknowns as its rank.

    `rank[j]` says how readily unknown j is solved for (low first); among equals the simplest
    pivot is taken, so that no expression grows without need.

    Raises:
        OutgrownError: where the exact solution grows beyond `LONGEST` terms all the same.
    """
    width = len(rows[0]) if rows else len(rank or ())
    rank = rank or [0] * width
    table = [[*row, value] for row, value in zip(rows, right, strict=True)]
    pending, pivots = set(range(len(table))), dict[int, int]()
    while choice := _pivot(table, pending, rank):
        i, j = choice
        pending.remove(i)
        pivots[j] = i
        _clear(table, i, j)
    free = tuple(j for j in range(width) if j not in pivots)
    solved = {
        j: (tuple(-table[i][k] for k in free), table[i][width]) for j, i in sorted(pivots.items())
    }
    return Elimination(solved, free, {i: table[i][width] for i in sorted(pending)})


def _pivot(
    table: list[list[Expr]], pending: set[int], rank: Sequence[int]
) -> tuple[int, int] | None:
    entries = [
        (rank[j], _complexity(table[i][j]), j, i)
        for i in pending
        for j in range(len(rank))
        if table[i][j]
    ]
    if not entries:
        return None
    *_, j, i = min(entries)
    return i, j


def length(expression: Expr) -> int:
    """Terms above and below the bar."""
    return len(expression.num) + len(expression.den)


def _complexity(pivot: Expr) -> tuple[int, int]:
    """Numbers first, then what cannot vanish, then parameters; short before long."""
    if pivot.rational is not None:
        return (0, 0)
    if is_positive(pivot) or is_positive(-pivot):
        return (1, length(pivot))
    constant = all(not s.kind.varies for s in pivot.symbols())
    return (2 if constant else 3, length(pivot))


def _clear(table: list[list[Expr]], i: int, j: int) -> None:
    scale = ONE / table[i][j]
    table[i] = [entry * scale if entry else entry for entry in table[i]]
    for k, row in enumerate(table):
        factor = row[j]
        if k != i and factor:
            table[k] = [
                entry - factor * base if base else entry
                for entry, base in zip(row, table[i], strict=True)
            ]
    _refuse_long(table)


def _refuse_long(table: list[list[Expr]]) -> None:
    # Elimination multiplies lengths: what has grown this long takes hours two pivots later.
    refuse_long((entry for row in table for entry in row), "linear equations")


def refuse_long(expressions: Iterable[Expr], what: str) -> None:
    """Refuse what is too long to be written out, with `OutgrownError`."""
    longest = max(map(length, expressions), default=0)
    if longest > LONGEST:
        raise OutgrownError(
            f"{what} whose exact solution has grown to {longest} terms",
            expected=f"at most {LONGEST}",
            advice="put in numbers or fewer parameters, or choose coordinates that suit them",
        )


def solve(rows: Sequence[Sequence[Expr]], right: Sequence[Expr]) -> Row:
    """The unique solution of A x = b; `ZeroDivisionError` where there is none or several."""
    outcome = eliminate(rows, right)
    if outcome.free or outcome.contradictory:
        raise ZeroDivisionError("the equations are singular")
    return tuple(outcome.solved[j][1] for j in range(len(outcome.solved)))


def rotation(axis: Sequence[Expr], cosine: Expr, sine: Expr) -> Matrix:
    """Rodrigues' rotation about a unit axis: components in the turned axes → in the old ones."""
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


def variables(expressions: Iterable[Expr]) -> frozenset[Symbol]:
    """Every symbol that occurs."""
    return frozenset().union(*(e.symbols() for e in expressions))

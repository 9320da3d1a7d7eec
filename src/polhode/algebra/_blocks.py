"""Linear equations solved with what is long under names, and divided by nothing that can vanish.

Elimination divides by one entry after the other. Multiplied out, a factor that vanishes somewhere
cancels again; under names it would stay. So only numbers and what is positive serve as pivots, and
the block that remains is made symmetric, AᵀA x = Aᵀb, which is regular wherever A is.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache

from polhode.algebra._balls import Ball, value
from polhode.algebra._expression import ONE, ZERO, Expr
from polhode.algebra._generators import Symbol
from polhode.algebra._linear import Elimination, Row, dot, length
from polhode.algebra._parts import named
from polhode.algebra._roots import is_plainly_positive

Table = list[list[Expr]]

_STATE = 3  # the random state at which entries are compared


def eliminate_in_parts(
    rows: Sequence[Sequence[Expr]],
    right: Sequence[Expr],
    rank: Sequence[int] | None = None,
    visible: Iterable[Symbol] = (),
) -> Elimination:
    """As `eliminate`, with every long entry under a name.

    Args:
        rows: of the matrix.
        right: the column they equal.
        rank: how readily each unknown is solved for, low first.
        visible: symbols in which the right-hand sides are polynomials, and remain so for all to
            see.
    """
    width = len(rows[0]) if rows else len(rank or ())
    table = [[*row, constant] for row, constant in zip(rows, right, strict=True)]
    order = sorted(range(width), key=lambda j: (rank or [0] * width)[j])
    return _BlockElimination(table, width, tuple(visible)).outcome(order)


class _BlockElimination:
    """A table of rows, each with its right-hand side at the end."""

    def __init__(self, table: Table, width: int, visible: tuple[Symbol, ...]) -> None:
        self._table = table
        self._width = width
        self._visible = visible

    def outcome(self, order: Sequence[int]) -> Elimination:
        wanted = list(_independent(self._table, range(len(self._table)), order))
        free = tuple(j for j in range(self._width) if j not in wanted)
        plain = self._cleared(wanted)
        block = [j for j in wanted if j not in plain]
        pending = [i for i in range(len(self._table)) if i not in plain.values()]
        values = self._block(pending, block, (*free, self._width))
        found = values | {j: self._rest(i, values, free) for j, i in plain.items()}
        spare = set(pending) - set(_independent(self._table, pending, block).values())
        return Elimination(
            {j: (tuple(-c for c in found[j][:-1]), found[j][-1]) for j in sorted(found)},
            free,
            {i: self._rest(i, values, free)[-1] for i in sorted(spare)},
        )

    def _named(self, expression: Expr) -> Expr:
        return named(expression, self._visible)

    def _cleared(self, columns: Sequence[int]) -> dict[int, int]:
        """Clear the columns that have a pivot that cannot vanish; the row of each."""
        found = dict[int, int]()
        while places := list(self._pivots(set(columns) - found.keys(), set(found.values()))):
            _, j, i = min(places)
            found[j] = i
            self._clear(i, j)
        return found

    def _pivots(self, columns: set[int], used: set[int]) -> Iterable[tuple[int, int, int]]:
        for i, row in enumerate(self._table):
            for j in columns if i not in used else ():
                entry = row[j]
                if _cannot_vanish(entry):
                    yield length(entry), j, i

    def _clear(self, i: int, j: int) -> None:
        table, scale = self._table, ONE / self._table[i][j]
        table[i] = [self._named(entry * scale) if entry else entry for entry in table[i]]
        for k, row in enumerate(table):
            factor = row[j]
            if k != i and factor:
                table[k] = [
                    self._named(entry - factor * base) if base else entry
                    for entry, base in zip(row, table[i], strict=True)
                ]

    def _block(
        self, rows: Sequence[int], columns: Sequence[int], sides: Sequence[int]
    ) -> dict[int, Row]:
        """Every unknown of a block, for each of the right-hand sides."""
        down = [[self._table[i][j] for i in rows] for j in (*columns, *sides)]
        size = len(columns)
        normal = [
            [self._named(dot(down[r], column)) if k >= r else ZERO for k, column in enumerate(down)]
            for r in range(size)
        ]
        return dict(zip(columns, _solved(normal, self._visible), strict=True))

    def _rest(self, i: int, values: dict[int, Row], free: tuple[int, ...]) -> Row:
        """What is left of the right-hand sides of a row once the unknowns of the block are in."""
        row = self._table[i]
        return tuple(
            self._named(row[k] - dot((row[j] for j in values), (v[side] for v in values.values())))
            for side, k in enumerate((*free, self._width))
        )


@lru_cache(maxsize=4096)
def _cannot_vanish(entry: Expr) -> bool:
    plain = entry.rational is not None or is_plainly_positive(entry) or is_plainly_positive(-entry)
    return plain and not entry.is_zero


def solve_definite(matrix: Sequence[Row], right: Row) -> Row:
    """The solution of A x = b for a positive definite A, with every long step under a name."""
    table = [[*row, constant] for row, constant in zip(matrix, right, strict=True)]
    return tuple(value for (value,) in _solved(table, ()))


def _solved(table: Table, visible: tuple[Symbol, ...]) -> list[Row]:
    """The solution for each of the right-hand sides at the end of the rows; without pivoting.

    What is below the diagonal is not read.
    """
    size = len(table)
    for r, row in enumerate(table):
        for k in range(r + 1, size):
            factor = named(row[k] / row[r])
            lower = zip(table[k][k:], row[k:], strict=True)
            table[k][k:] = [named(entry - factor * base, visible) for entry, base in lower]
    sides = len(table[0]) - size if table else 0
    found: list[Row] = []
    for r in reversed(range(size)):
        row, below = table[r], ONE / table[r][r]
        known = [dot(row[r + 1 : size], (later[s] for later in found)) for s in range(sides)]
        pairs = zip(row[size:], known, strict=True)
        found.insert(0, tuple(named((side - share) * below, visible) for side, share in pairs))
    return found


def _independent(table: Table, rows: Iterable[int], columns: Iterable[int]) -> dict[int, int]:
    """Columns none of which follows from those before it, each with a row of its own.

    Told from the values at a random state.
    """
    wanted = list(columns)
    pending = {i: [value(table[i][j], _STATE) for j in wanted] for i in rows}
    found = dict[int, int]()
    for k, j in enumerate(wanted):
        best = max(pending, key=lambda i: _size(pending[i][k]), default=None)
        if best is None or pending[best][k].contains(0):
            continue
        found[j] = best
        pivot = pending.pop(best)
        for i, row in pending.items():
            factor = row[k] / pivot[k]
            pending[i] = [entry - factor * base for entry, base in zip(row, pivot, strict=True)]
    return found


def _size(ball: Ball) -> float:
    return float(abs(ball).mid())

"""Systems of linear equations solved exactly, with pivots that keep expressions small.

`eliminate` multiplies everything out. `eliminate_in_parts` puts long expressions under names and
never divides by one that can vanish. Both use the same Gauss–Jordan elimination and differ in
their choice of pivots. Compiled programs solve their equations by `programs._tape.solve_on`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from polhode.algebra._expression import ONE, ZERO, Expr, length
from polhode.algebra._parts import named
from polhode.algebra._ring import OutgrownError, Symbol
from polhode.algebra._roots import is_plainly_positive, is_positive
from polhode.algebra._vector import Row, dot

Table = list[list[Expr]]

LONGEST = 3000  # terms of an entry; the longest of the systems in the tests has half as many
_STATE = 3  # random state at which rank is decided; unlike those that decide whether one is zero


def refuse_long(expressions: Iterable[Expr], what: str) -> None:
    """Raise `OutgrownError` if an expression is too long to be of use."""
    longest = max(map(length, expressions), default=0)
    if longest > LONGEST:
        raise OutgrownError(
            f"{what} whose exact solution has grown to {longest} terms",
            expected=f"at most {LONGEST}",
            advice="put in numbers or fewer parameters, or choose coordinates that suit them",
        )


@dataclass(frozen=True)
class Elimination:
    """Outcome of Gauss–Jordan elimination of A x = b.

    `solved[j]` gives unknown j as (coefficients of the free unknowns, constant). `leftover[i]` is
    the right-hand side of row i once no unknown is left in it: the equations need it to be zero.
    """

    solved: dict[int, tuple[Row, Expr]]
    free: tuple[int, ...]
    leftover: dict[int, Expr]

    @property
    def contradictory(self) -> tuple[int, ...]:
        """Rows that cannot hold together with the others."""
        return tuple(i for i, rest in self.leftover.items() if rest)

    def in_free(self, unknowns: Sequence[Symbol]) -> dict[Symbol, Expr]:
        """The unknowns that are solved for, in terms of the free ones."""
        free = [Expr.generator(unknowns[j]) for j in self.free]
        return {unknowns[j]: dot(row, free) + known for j, (row, known) in self.solved.items()}


def eliminate(
    rows: Sequence[Sequence[Expr]],
    right: Sequence[Expr],
    rank: Sequence[int] | None = None,
) -> Elimination:
    """Solve A x = b for as many unknowns as its rank.

    `rank[j]` is the preference for solving for unknown j (low first); among equals the simplest
    pivot is taken, which keeps expressions short.

    Raises:
        OutgrownError: where the exact solution grows beyond `LONGEST` terms nevertheless.
    """
    width = len(rows[0]) if rows else len(rank or ())
    ranks = rank or [0] * width
    table = [[*row, value] for row, value in zip(rows, right, strict=True)]

    complexities: dict[int, tuple[Expr, tuple[int, int]]] = {}  # most entries stay as they are

    def cost(j: int, entry: Expr) -> object:
        place = id(entry)  # of no other entry, since this one is kept
        if place not in complexities:
            complexities[place] = entry, _complexity(entry)
        return ranks[j], complexities[place][1]

    def bounded(entry: Expr) -> Expr:
        # Each step multiplies lengths: entries this long would take hours two pivots later.
        refuse_long((entry,), "linear equations")
        return entry

    pivots = dict(_gauss_jordan(table, range(width), cost, bounded))
    free = tuple(j for j in range(width) if j not in pivots)
    solved = {
        j: (tuple(-table[i][k] for k in free), table[i][width]) for j, i in sorted(pivots.items())
    }
    pending = sorted(set(range(len(table))) - set(pivots.values()))
    return Elimination(solved, free, {i: table[i][width] for i in pending})


def solve(rows: Sequence[Sequence[Expr]], right: Sequence[Expr]) -> Row:
    """The unique solution of A x = b.

    Raises:
        ZeroDivisionError: where A is singular, so that there is no solution or more than one.
    """
    outcome = eliminate(rows, right)
    if outcome.free or outcome.contradictory:
        raise ZeroDivisionError("the equations are singular")
    return tuple(outcome.solved[j][1] for j in range(len(outcome.solved)))


def _gauss_jordan(
    table: Table,
    columns: Iterable[int],
    cost: Callable[[int, Expr], Any],
    written: Callable[[Expr], Expr] = lambda entry: entry,
) -> Iterator[tuple[int, int]]:
    """Clear columns of a table in place, cheapest pivot first; each with the row it is solved by.

    Args:
        table: rows of coefficients with their right-hand sides.
        columns: those that may be cleared.
        cost: of a pivot that is not zero, by its column and value; None for one that must not be
            divided by.
        written: the form in which a new entry is kept.
    """
    left, found = set(columns), dict[int, int]()
    while places := [
        (price, j, i)
        for i, row in enumerate(table)
        if i not in found.values()
        for j in left
        if row[j] and (price := cost(j, row[j])) is not None
    ]:
        # equal prices go to the lowest column, then row: the outcome must not depend on set order
        _, j, i = min(places)
        found[j] = i
        left.remove(j)
        scale = ONE / table[i][j]
        table[i] = [written(entry * scale) if entry else entry for entry in table[i]]
        for k, row in enumerate(table):
            factor = row[j]
            if k != i and factor:
                table[k] = [
                    written(entry - factor * base) if base else entry
                    for entry, base in zip(row, table[i], strict=True)
                ]
        yield j, i


def _complexity(pivot: Expr) -> tuple[int, int]:
    """Numbers first, then positive or negative definite ones, then parameters; short before long.

    A pivot that vanishes in some configuration, such as sin θ, would make the solution singular
    there although the equations are not.
    """
    if pivot.rational is not None:
        return (0, 0)
    if is_positive(pivot) or is_positive(-pivot):
        return (1, length(pivot))
    return (3 if pivot.varies else 2, length(pivot))


# -- with long expressions under names -------------------------------------------------------------
#
# Elimination divides by one entry after the other. Multiplied out, a factor that vanishes somewhere
# cancels again; under names it would stay. So only numbers and definite expressions serve as
# pivots, and the remaining block is solved by its normal equations AᵀA x = Aᵀb, which are regular
# wherever A has full column rank. As AᵀA is positive definite, LDLᵀ needs no pivoting and no pivot
# can vanish (Golub and Van Loan, Matrix Computations, section 4.2). Squaring the condition number
# costs nothing in exact arithmetic, but digits when the result is evaluated in doubles.


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
        rank: the preference for solving for each unknown, low first.
        visible: symbols in which the right-hand sides are polynomials, and remain so explicitly.
    """
    width, shown = len(rows[0]) if rows else len(rank or ()), tuple(visible)
    table = [[*row, constant] for row, constant in zip(rows, right, strict=True)]
    order = sorted(range(width), key=lambda j: (rank or [0] * width)[j])
    wanted = list(_independent(table, range(len(table)), order))
    free = tuple(j for j in range(width) if j not in wanted)
    sides = (*free, width)

    def written(entry: Expr) -> Expr:
        return named(entry, shown)

    def cost(_: int, entry: Expr) -> int | None:
        return length(entry) if _cannot_vanish(entry) else None

    cleared = dict(_gauss_jordan(table, wanted, cost, written))
    block = [j for j in wanted if j not in cleared]
    pending = [i for i in range(len(table)) if i not in cleared.values()]
    down = [[table[i][j] for i in pending] for j in (*block, *sides)]
    normal = [
        [written(dot(down[r], column)) if k >= r else ZERO for k, column in enumerate(down)]
        for r in range(len(block))
    ]
    values = dict(zip(block, _solved_definite(normal, shown), strict=True))

    def rest(i: int) -> Row:
        """The right-hand sides of a row less the terms of the block's unknowns."""
        row = table[i]
        return tuple(
            written(row[k] - dot((row[j] for j in values), (v[side] for v in values.values())))
            for side, k in enumerate(sides)
        )

    found = values | {j: rest(i) for j, i in cleared.items()}
    # rows that the block's unknowns do not use up are conditions on the right-hand side
    spare = set(pending) - set(_independent(table, pending, block).values())
    return Elimination(
        {j: (tuple(-c for c in found[j][:-1]), found[j][-1]) for j in sorted(found)},
        free,
        {i: rest(i)[-1] for i in sorted(spare)},
    )


@lru_cache(maxsize=4096)
def _cannot_vanish(entry: Expr) -> bool:
    return entry.rational is not None or is_plainly_positive(entry) or is_plainly_positive(-entry)


def solve_definite(matrix: Sequence[Row], right: Row) -> Row:
    """The solution of A x = b for a positive definite A, with every long step under a name."""
    table = [[*row, constant] for row, constant in zip(matrix, right, strict=True)]
    return tuple(value for (value,) in _solved_definite(table, ()))


def _solved_definite(table: Table, visible: tuple[Symbol, ...]) -> list[Row]:
    """The solution for each of the right-hand sides at the end of the rows, by LDLᵀ.

    Entries below the diagonal are not read.
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


def dependent_columns(rows: Sequence[Row]) -> tuple[int, ...]:
    """Columns of a matrix that are combinations of those before them, at almost every state."""
    columns = range(len(rows[0]) if rows else 0)
    found = _independent([list(row) for row in rows], range(len(rows)), columns)
    return tuple(j for j in columns if j not in found)


def _independent(table: Table, rows: Iterable[int], columns: Iterable[int]) -> dict[int, int]:
    """Linearly independent columns, the first ones preferred, each with a pivot row.

    Decided by enclosures of their values at a random state, with partial pivoting: a ball that
    excludes zero proves independence there, and hence at almost every state.
    """
    wanted = list(columns)
    pending = {i: [table[i][j].ball(_STATE) for j in wanted] for i in rows}
    found = dict[int, int]()
    for k, j in enumerate(wanted):
        best = max(pending, key=lambda i: float(abs(pending[i][k]).mid()), default=None)
        if best is None or pending[best][k].contains(0):
            continue
        found[j] = best
        pivot = pending.pop(best)
        for i, row in pending.items():
            factor = row[k] / pivot[k]
            pending[i] = [entry - factor * base for entry, base in zip(row, pivot, strict=True)]
    return found

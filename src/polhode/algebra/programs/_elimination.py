"""Linear equations solved step by step on a tape; zeros known beforehand cost nothing."""

from __future__ import annotations

from polhode.algebra.programs._tape import Tape, Value
from polhode.base import NumericError


def solve_on(
    tape: Tape, rows: list[list[Value]], right: list[Value], *, symmetric: bool
) -> list[Value]:
    """The unknowns of `rows` @ unknowns = `right`, by Gaussian elimination.

    Of a symmetric matrix only one triangle is worked on (LDLᵀ); its pivots lie on the diagonal.
    """
    return _Elimination(tape, rows, right, symmetric).solution()


class _Elimination:
    def __init__(
        self, tape: Tape, rows: list[list[Value]], right: list[Value], symmetric: bool
    ) -> None:
        self._tape = tape
        self._rows = [list(row) for row in rows]
        self._right = list(right)
        self._symmetric = symmetric
        self._pending = set(range(len(rows)))
        self._columns = set(self._pending)

    def solution(self) -> list[Value]:
        order = []
        while self._pending:
            pivot = self._pivot()
            self._eliminate(*pivot)
            order.append(pivot)
        return self._substituted_back(order)

    def _pivot(self) -> tuple[int, int]:
        """The place that fills in least."""
        places = [
            (self._filled(i), i, j)
            for i in self._pending
            for j in (self._columns & {i} if self._symmetric else self._columns)
            if self._occurs(i, j)
        ]
        if not places:
            raise NumericError(
                "linear equations that are singular whatever the values",
                expected="as many independent equations as unknowns",
                advice="check for masses and inertias that are zero",
            )
        _, i, j = min(places)
        return i, j

    def _filled(self, i: int) -> int:
        return sum(self._occurs(i, j) for j in self._columns)

    def _occurs(self, i: int, j: int) -> bool:
        return self._rows[i][j].step != self._tape.zero.step

    def _eliminate(self, i: int, j: int) -> None:
        rows, right = self._rows, self._right
        self._pending.remove(i)
        self._columns.remove(j)
        for k in sorted(self._pending):
            if self._occurs(k, j):
                factor = self._tape.divide(rows[k][j], rows[i][j])
                right[k] = self._less(right[k], factor, right[i])
                self._combine(k, i, factor)

    def _combine(self, k: int, i: int, factor: Value) -> None:
        rows = self._rows
        for c in sorted(self._columns):
            if not self._symmetric:
                rows[k][c] = self._less(rows[k][c], factor, rows[i][c])
            elif c >= k:
                rows[k][c] = rows[c][k] = self._less(rows[k][c], factor, rows[i][c])

    def _substituted_back(self, order: list[tuple[int, int]]) -> list[Value]:
        found: dict[int, Value] = {}
        for i, j in reversed(order):
            value = self._right[i]
            for k, known in found.items():
                value = self._less(value, self._rows[i][k], known)
            found[j] = self._tape.divide(value, self._rows[i][j])
        return [found[j] for j in range(len(found))]

    def _less(self, value: Value, a: Value, b: Value) -> Value:
        return self._tape.add(value, -self._tape.multiply(a, b))

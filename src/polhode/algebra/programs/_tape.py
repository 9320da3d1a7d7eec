"""A tape on which arithmetic is recorded, each distinct step once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import reduce
from typing import NamedTuple

from polhode.algebra._ring import Symbol
from polhode.algebra.programs._program import Instruction, Op, Program
from polhode.base import NumericError


class Value(NamedTuple):
    """The result of a step, or its negative: signs cost nothing until one must be written."""

    step: int
    sign: int = 1

    def __neg__(self) -> Value:
        return Value(self.step, -self.sign)


_COMMUTES = (Op.ADD, Op.MUL)
_ODD = (Op.SIN, Op.SINH)
_EVEN = (Op.COS, Op.COSH)


class Tape:
    """Records steps, folds constants, and reuses steps recorded before."""

    def __init__(self) -> None:
        self._steps: list[Instruction] = []
        self._index: dict[Instruction, int] = {}
        self.zero = self.constant(0)
        self.one = self.constant(1)

    def __len__(self) -> int:
        return len(self._steps)

    def rewind(self, length: int) -> None:
        """Forget every step after the first `length`."""
        for step in self._steps[length:]:
            del self._index[step]
        del self._steps[length:]

    def constant(self, number: Fraction | int) -> Value:
        """An exact number."""
        sign = -1 if number < 0 else 1
        return Value(self._record(Op.CONST, value=number * sign), sign)

    def pi(self) -> Value:
        """The number π."""
        return Value(self._record(Op.PI))

    def argument(self, position: int) -> Value:
        """One argument of the program."""
        return Value(self._record(Op.ARG, value=position))

    def add(self, a: Value, b: Value) -> Value:
        """a + b."""
        if self._number(a) == 0:
            return b
        if self._number(b) == 0:
            return a
        if a == -b:
            return self.zero
        x, y = self._number(a), self._number(b)
        if x is not None and y is not None:
            return self.constant(x + y)
        if a.sign == b.sign:
            return Value(self._record(Op.ADD, (a.step, b.step)), a.sign)
        # a - b and b - a share one step: the earlier operand comes first, and the sign goes outside
        first, second = sorted((a, b))
        return Value(self._record(Op.SUB, (first.step, second.step)), first.sign)

    def multiply(self, a: Value, b: Value) -> Value:
        """a b."""
        x, y = self._number(a), self._number(b)
        if x is not None and y is not None:
            return self.constant(x * y)
        sign = a.sign * b.sign
        if x is not None and x in (1, -1, 0):
            return Value(b.step, sign) if x else self.zero
        if y is not None and y in (1, -1, 0):
            return Value(a.step, sign) if y else self.zero
        return Value(self._record(Op.MUL, (a.step, b.step)), sign)

    def divide(self, a: Value, b: Value) -> Value:
        """a / b; `ZeroDivisionError` where b is the number zero."""
        divisor = self._number(b)
        if divisor is not None:
            return self.multiply(a, self.constant(Fraction(1) / divisor))
        sign = a.sign * b.sign
        if self._number(a) == 0:
            return a
        if a.step == b.step:
            return Value(self.one.step, sign)
        return Value(self._record(Op.DIV, (a.step, b.step)), sign)

    def power(self, base: Value, exponent: int) -> Value:
        """base^exponent for a positive exponent, by as few products as halving gives."""
        if exponent == 1:
            return base
        half = self.power(base, exponent // 2)
        return self.multiply(self.power(base, exponent - exponent // 2), half)

    def product(self, values: Sequence[Value]) -> Value:
        """Of any number of values, those of the earliest steps first."""
        return reduce(self.multiply, sorted(values)) if values else self.one

    def total(self, values: Sequence[Value]) -> Value:
        """The sum of any number of values, those of the earliest steps first."""
        return reduce(self.add, sorted(values)) if values else self.zero

    def call(self, op: Op, x: Value) -> Value:
        """A function of x."""
        if op in _ODD:
            return Value(self._record(op, (x.step,)), x.sign)
        return Value(self._record(op, (x.step if op in _EVEN else self._signed(x),)))

    def replay(self, program: Program, values: Sequence[Value]) -> Value:
        """The one output of a program, its arguments having these values."""
        results: list[Value] = []
        for step in program.instructions:
            results.append(self.replayed(step, [results[i] for i in step.operands], values))
        return results[program.outputs[0]]

    def replayed(self, step: Instruction, operands: list[Value], values: Sequence[Value]) -> Value:
        """The result of one step of a program whose arguments have these values."""
        match step:
            case (Op.MUL, _, _):  # the most frequent first
                return self.multiply(*operands)
            case (Op.ADD, _, _):
                return self.add(*operands)
            case (Op.ARG, _, position):
                return values[int(position or 0)]
            case (Op.SUB, _, _):
                return self.add(operands[0], -operands[1])
            case (Op.CONST, _, number):
                return self.constant(number or 0)
            case (Op.DIV, _, _):
                return self.divide(*operands)
            case (Op.NEG, _, _):
                return -operands[0]
        return self.call(step.op, operands[0])

    def program(self, arguments: tuple[Symbol, ...], outputs: Iterable[Value]) -> Program:
        """The steps that the outputs need, and no others."""
        ends = [self._signed(value) for value in outputs]
        needed = set(ends)
        for i in reversed(range(len(self._steps))):
            if i in needed:
                needed.update(self._steps[i].operands)
        places = {old: new for new, old in enumerate(sorted(needed))}
        steps = (self._steps[i] for i in places)
        return Program(
            arguments,
            tuple(
                Instruction(op, tuple([places[i] for i in operands]), number)
                for op, operands, number in steps
            ),
            tuple(places[i] for i in ends),
        )

    def _number(self, value: Value) -> Fraction | int | None:
        op, _, number = self._steps[value.step]
        if op is not Op.CONST or number is None:
            return None
        return number if value.sign > 0 else -number

    def _signed(self, value: Value) -> int:
        """A step whose result is the value with its sign."""
        op, operands, number = self._steps[value.step]
        if value.sign > 0:
            return value.step
        if op is Op.SUB:
            return self._record(Op.SUB, operands[::-1])
        if op is Op.CONST:
            return self._record(Op.CONST, value=-(number or 0))
        return self._record(Op.NEG, (value.step,))

    def _record(
        self, op: Op, operands: tuple[int, ...] = (), value: Fraction | int | None = None
    ) -> int:
        step = Instruction(op, tuple(sorted(operands)) if op in _COMMUTES else operands, value)
        place = self._index.setdefault(step, len(self._steps))
        if place == len(self._steps):
            self._steps.append(step)
        return place


# -- linear equations ------------------------------------------------------------------------------


def solve_on(
    tape: Tape, rows: list[list[Value]], right: list[Value], *, symmetric: bool
) -> list[Value]:
    """The unknowns of `rows` @ unknowns = `right`, by Gaussian elimination.

    For a symmetric matrix only one triangle is computed (LDLᵀ); its pivots lie on the diagonal.
    Structural zeros cost nothing, and among the rows with an entry on the diagonal the one with
    fewest entries provides the next pivot, which keeps fill-in low (minimum degree).
    `algebra._elimination` cannot serve: it chooses pivots by their expressions and clears above the
    diagonal too, which would take more steps.
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
        found: dict[int, Value] = {}
        for i, j in reversed(order):
            value = self._right[i]
            for k, known in found.items():
                value = self._less(value, self._rows[i][k], known)
            found[j] = self._tape.divide(value, self._rows[i][j])
        return [found[j] for j in range(len(found))]

    def _pivot(self) -> tuple[int, int]:
        """The position of the next pivot: on the diagonal, in the row with fewest entries.

        Sliding friction and loads in proportion to reactions add unsymmetric terms to a positive
        definite matrix. As long as its symmetric part stays definite, no pivot on the diagonal
        can vanish (Golub and Van Loan, Matrix Computations, section 4.1), while entries beside it
        may pass through zero on any motion.
        """
        places = [
            (i != j, sum(self._occurs(i, j) for j in self._columns), i, j)
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
        *_, i, j = min(places)
        return i, j

    def _occurs(self, i: int, j: int) -> bool:
        return self._rows[i][j].step != self._tape.zero.step

    def _eliminate(self, i: int, j: int) -> None:
        """Clear the column of a pivot in the pending rows, in one triangle if symmetric."""
        rows, right = self._rows, self._right
        self._pending.remove(i)
        self._columns.remove(j)
        for k in sorted(self._pending):
            if not self._occurs(k, j):
                continue
            factor = self._tape.divide(rows[k][j], rows[i][j])
            right[k] = self._less(right[k], factor, right[i])
            for c in sorted(self._columns):
                if not self._symmetric:
                    rows[k][c] = self._less(rows[k][c], factor, rows[i][c])
                elif c >= k:
                    rows[k][c] = rows[c][k] = self._less(rows[k][c], factor, rows[i][c])

    def _less(self, value: Value, a: Value, b: Value) -> Value:
        return self._tape.add(value, -self._tape.multiply(a, b))

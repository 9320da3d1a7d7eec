"""The tape that the kernel reads: a program as recurrences between rows of Taylor coefficients."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import IntEnum
from math import pi

from polhode.algebra import Instruction, Op, Program, SymbolKind


class Recurrence(IntEnum):
    """What one step of the tape does to rows of Taylor coefficients."""

    ADD = 0
    SUBTRACT = 1
    NEGATE = 2
    MULTIPLY = 3
    SQUARE = 4
    SCALE = 5  # a series times a constant
    DIVIDE = 6
    REDUCE = 7  # a series divided by a constant
    ROOT = 8
    EXPONENTIAL = 9  # and, in the next row, the derivative of its operand
    CIRCULAR = 10  # sine, cosine, and the derivative of the operand, in three rows
    HYPERBOLIC = 11  # likewise


@dataclass(frozen=True)
class Step:
    """One step: the row of its result, and those of its operands."""

    kind: Recurrence
    target: int
    first: int
    second: int = 0


@dataclass(frozen=True)
class Tape:
    """A program on rows of Taylor coefficients.

    The first rows are the states, the time and the parameters, in this order.

    Attributes:
        states: how many there are.
        parameters: how many there are.
        rows: how many rows there are.
        numbers: values of the rows that hold numbers.
        constant: steps whose results depend on parameters and numbers alone.
        varying: the others.
        outputs: rows of the outputs of the program, of which the first are the rates of the states.
    """

    states: int
    parameters: int
    rows: int
    numbers: dict[int, float]
    constant: tuple[Step, ...]
    varying: tuple[Step, ...]
    outputs: tuple[int, ...]


def tape_of(program: Program, states: int) -> Tape:
    """The tape of a program whose first arguments and outputs are the states and their rates.

    Its other arguments are parameters, the time, and symbols that it does not use.
    """
    builder = _Builder(program, states)
    for instruction in program.instructions:
        builder.add(instruction)
    return Tape(
        states,
        builder.parameters,
        builder.rows,
        builder.numbers,
        tuple(builder.constant),
        tuple(builder.varying),
        tuple(builder.places[i] for i in program.outputs),
    )


_PLAIN = {
    Op.ADD: Recurrence.ADD,
    Op.SUB: Recurrence.SUBTRACT,
    Op.NEG: Recurrence.NEGATE,
    Op.MUL: Recurrence.MULTIPLY,
    Op.DIV: Recurrence.DIVIDE,
    Op.SQRT: Recurrence.ROOT,
    Op.EXP: Recurrence.EXPONENTIAL,
}
# the kind, and which of its rows is meant
_PAIRED = {
    Op.SIN: (Recurrence.CIRCULAR, 0),
    Op.COS: (Recurrence.CIRCULAR, 1),
    Op.SINH: (Recurrence.HYPERBOLIC, 0),
    Op.COSH: (Recurrence.HYPERBOLIC, 1),
}
_ROWS = {Recurrence.EXPONENTIAL: 2, Recurrence.CIRCULAR: 3, Recurrence.HYPERBOLIC: 3}
# of a constant second operand
_BY_CONSTANT = {Recurrence.MULTIPLY: Recurrence.SCALE, Recurrence.DIVIDE: Recurrence.REDUCE}


@dataclass
class _Builder:
    program: Program
    states: int
    numbers: dict[int, float] = field(default_factory=dict)
    constant: list[Step] = field(default_factory=list)
    varying: list[Step] = field(default_factory=list)
    places: list[int] = field(default_factory=list)  # the row of each instruction

    def __post_init__(self) -> None:
        kinds = [symbol.kind for symbol in self.program.arguments[self.states :]]
        self.parameters = kinds.count(SymbolKind.PARAMETER)
        self.rows = self.states + 1 + self.parameters
        self._fixed = set(range(self.states + 1, self.rows))  # rows that do not change with time
        self._arguments = list(self._rows_of_arguments(kinds))
        self._paired: dict[tuple[Recurrence, int], int] = {}

    def add(self, instruction: Instruction) -> None:
        """Append what an instruction does."""
        op, operands, value = instruction
        rows = [self.places[i] for i in operands]
        if op is Op.ARG:
            row = self._arguments[int(value or 0)]
            assert row is not None, "a symbol that the kernel has no value for"
            self.places.append(row)
        elif op is Op.CONST or op is Op.PI:
            self.places.append(self._number(pi if op is Op.PI else float(value or 0)))
        elif op in _PAIRED:
            kind, which = _PAIRED[op]
            key = (kind, rows[0])
            if key not in self._paired:
                self._paired[key] = self._step(kind, rows)
            self.places.append(self._paired[key] + which)
        else:
            self.places.append(self._step(_PLAIN[op], rows))

    def _step(self, kind: Recurrence, operands: list[int]) -> int:
        fixed = [row in self._fixed for row in operands]
        if kind is Recurrence.MULTIPLY and fixed[0]:
            operands, fixed = operands[::-1], fixed[::-1]
        if kind in _BY_CONSTANT and fixed[1]:
            kind = _BY_CONSTANT[kind]
        elif kind is Recurrence.MULTIPLY and operands[0] == operands[1]:
            kind = Recurrence.SQUARE
        target = self._new_rows(_ROWS.get(kind, 1), fixed=all(fixed))
        (self.constant if all(fixed) else self.varying).append(Step(kind, target, *operands))
        return target

    def _number(self, value: float) -> int:
        target = self._new_rows(1, fixed=True)
        self.numbers[target] = value
        return target

    def _new_rows(self, count: int, *, fixed: bool) -> int:
        target = self.rows
        self.rows += count
        if fixed:
            self._fixed.update(range(target, self.rows))
        return target

    def _rows_of_arguments(self, kinds: list[SymbolKind]) -> Iterator[int | None]:
        """The row of every argument; None for symbols that are neither known nor used."""
        yield from range(self.states)
        parameters = iter(range(self.states + 1, self.rows))
        for kind in kinds:
            if kind is SymbolKind.PARAMETER:
                yield next(parameters)
            else:
                yield self.states if kind is SymbolKind.TIME else None

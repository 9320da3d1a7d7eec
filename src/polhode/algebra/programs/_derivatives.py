"""The derivatives of a program as further outputs of it (forward differentiation)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from polhode.algebra._ring import Symbol
from polhode.algebra.programs._program import Instruction, Op, Program
from polhode.algebra.programs._tape import Tape, Value


def differentiated(
    program: Program,
    arguments: tuple[Symbol, ...],
    changes: Mapping[Symbol, Sequence[Symbol | int]],
) -> Program:
    """The outputs of a program, followed by their derivatives in several directions.

    The derivatives of the first output come first.

    Args:
        arguments: of the program that is made: those of the given one, in any order, and others.
        changes: how arguments change in each direction: as a further argument says, or by a
            number. Others do not change.
    """
    derivation = _Derivation(program, arguments, changes)
    for step in program.instructions:
        derivation.follow(step)
    values = [derivation.values[i] for i in program.outputs]
    slopes = [slope for i in program.outputs for slope in derivation.slopes[i]]
    return derivation.tape.program(arguments, [*values, *slopes])


def with_jacobian(program: Program, count: int) -> Program:
    """The outputs of a program, followed by their derivatives by so many of its first arguments."""
    varied = program.arguments[:count]
    changes = {symbol: [int(symbol == other) for other in varied] for symbol in varied}
    return differentiated(program, program.arguments, changes)


class _Derivation:
    """The result of every step, and its derivatives."""

    def __init__(
        self,
        program: Program,
        arguments: tuple[Symbol, ...],
        changes: Mapping[Symbol, Sequence[Symbol | int]],
    ) -> None:
        self.tape = Tape()
        self.values: list[Value] = []
        self.slopes: list[list[Value]] = []
        places = {symbol: i for i, symbol in enumerate(arguments)}
        self._given = [self.tape.argument(places[symbol]) for symbol in program.arguments]
        count = max(map(len, changes.values()), default=0)
        still = [self.tape.zero] * count
        self._changes = [
            [
                self.tape.argument(places[c]) if isinstance(c, Symbol) else self.tape.constant(c)
                for c in changes[symbol]
            ]
            if symbol in changes
            else still
            for symbol in program.arguments
        ]
        self._still = still

    def follow(self, step: Instruction) -> None:
        """Record one step and the derivatives of its result."""
        operands = [self.values[i] for i in step.operands]
        result = self.tape.replayed(step, operands, self._given)
        self.values.append(result)
        if step.op is Op.ARG:
            self.slopes.append(self._changes[int(step.value or 0)])
        elif not operands:
            self.slopes.append(self._still)
        else:
            rows = zip(*(self.slopes[i] for i in step.operands), strict=True)
            partial = _PARTIAL[step.op](self.tape, operands[0], operands[-1], result)
            self.slopes.append([self._total(partial, row) for row in rows])

    def _total(self, partial: Sequence[Value], changes: Sequence[Value]) -> Value:
        """Σ ∂f/∂x δx over the operands x of a step."""
        t = self.tape
        total = t.zero
        for slope, change in zip(partial, changes, strict=True):
            total = t.add(total, t.multiply(slope, change))
        return total


# The derivatives of a step by its operands, from the first of them, the last and the result.
_PARTIAL: Mapping[Op, Callable[[Tape, Value, Value, Value], tuple[Value, ...]]] = {
    Op.ADD: lambda t, a, b, result: (t.one, t.one),
    Op.SUB: lambda t, a, b, result: (t.one, -t.one),
    Op.MUL: lambda t, a, b, result: (b, a),
    Op.DIV: lambda t, a, b, result: (t.divide(t.one, b), -t.divide(result, b)),
    Op.NEG: lambda t, a, b, result: (-t.one,),
    Op.SQRT: lambda t, a, b, result: (t.divide(t.one, t.add(result, result)),),
    Op.SIN: lambda t, a, b, result: (t.call(Op.COS, a),),
    Op.COS: lambda t, a, b, result: (-t.call(Op.SIN, a),),
    Op.EXP: lambda t, a, b, result: (result,),
    Op.SINH: lambda t, a, b, result: (t.call(Op.COSH, a),),
    Op.COSH: lambda t, a, b, result: (t.call(Op.SINH, a),),
}

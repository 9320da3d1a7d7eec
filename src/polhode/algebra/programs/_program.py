"""Straight-line programs: many expressions as one list of arithmetic steps.

A program is data. It becomes a Python function over floats, arrays or any other numbers by being
given the arithmetic of those numbers.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from functools import cached_property
from types import CodeType, FunctionType
from typing import Any, NamedTuple, TypeAlias

from polhode.algebra._ring import Symbol
from polhode.base import NumericError


class Op(StrEnum):
    """What one step does."""

    CONST = "const"
    PI = "pi"
    ARG = "arg"
    ADD = "add"
    SUB = "sub"
    MUL = "mul"
    DIV = "div"
    NEG = "neg"
    SQRT = "sqrt"
    SIN = "sin"
    COS = "cos"
    EXP = "exp"
    SINH = "sinh"
    COSH = "cosh"


_GIVEN = (Op.CONST, Op.PI, Op.ARG)
_SIGNS: Mapping[Op, str] = {Op.ADD: "+", Op.SUB: "-", Op.MUL: "*", Op.DIV: "/"}


class Instruction(NamedTuple):
    """One step: an operation on the results of earlier steps.

    `value` is the exact number of a constant, or the position of an argument.
    """

    op: Op
    operands: tuple[int, ...] = ()
    value: Fraction | int | None = None


@dataclass(frozen=True)
class Arithmetic:
    """How steps are done on one type of number; + - * / are its operators."""

    number: Callable[[Fraction], Any]
    pi: Any
    functions: Mapping[Op, Callable[[Any], Any]]

    @classmethod
    def of(cls, library: Any, number: Callable[[Fraction], Any] = float) -> Arithmetic:
        """The arithmetic of a module with sqrt, sin, cos, exp, sinh, cosh and pi."""
        calls = (Op.SQRT, Op.SIN, Op.COS, Op.EXP, Op.SINH, Op.COSH)
        return cls(number, library.pi, {op: getattr(library, op.value) for op in calls})


#: Python's floats, one value at a time.
FLOATS = Arithmetic.of(math)

Compiled: TypeAlias = Callable[..., tuple[Any, ...]]


@dataclass(frozen=True)
class Program:
    """Steps that compute `outputs` from `arguments`, every common part done once."""

    arguments: tuple[Symbol, ...]
    instructions: tuple[Instruction, ...]
    outputs: tuple[int, ...]

    @property
    def operations(self) -> int:
        """How many sums, products, quotients, signs and function calls one evaluation takes."""
        return sum(step.op not in _GIVEN for step in self.instructions)

    @property
    def reads(self) -> frozenset[int]:
        """Positions of the arguments that the outputs depend on."""
        return frozenset(int(s.value or 0) for s in self.instructions if s.op is Op.ARG)

    @cached_property
    def _code(self) -> CodeType:
        return _code(self)

    def function(self, arithmetic: Arithmetic = FLOATS) -> Compiled:
        """A function of the arguments, by position, that returns the outputs as a tuple.

        Numbers are rounded once to the arithmetic's nearest. An output that depends on no
        argument comes as a single number whatever the shape of the arguments.

        Raises:
            NumericError: for a coefficient beyond the arithmetic's numbers.
        """
        names = {f"_{op.value}": call for op, call in arithmetic.functions.items()}
        names |= {
            f"c{i}": _rounded(Fraction(step.value or 0), arithmetic)
            for i, step in enumerate(self.instructions)
            if step.op is Op.CONST
        }
        names["pi"] = arithmetic.pi
        # no builtins: the code can reach nothing but these names
        return FunctionType(self._code, {"__builtins__": {}, **names})


def arrays() -> Arithmetic:
    """NumPy's arrays, elementwise."""
    import numpy

    return Arithmetic.of(numpy)


def _rounded(value: Fraction, arithmetic: Arithmetic) -> Any:
    try:
        return arithmetic.number(value)
    except OverflowError as error:
        power = round(math.log10(abs(value.numerator)) - math.log10(value.denominator))
        raise NumericError(
            f"a coefficient of about 1e{power} in an expression",
            expected="coefficients within the range of the numbers that it is computed in",
            advice="check the units and powers in the declaration",
        ) from error


def _code(program: Program) -> CodeType:
    """The steps as Python code, whose names are all generated here and never the user's."""
    slots = _Slots(program)
    lines = []
    for i, (op, operands, _) in enumerate(program.instructions):
        if op in _GIVEN:
            continue
        parts = [_operand(program, slots, operand) for operand in operands]
        slots.release(operands)
        if op in _SIGNS:
            step = _SIGNS[op].join(parts)
        else:
            step = f"-{parts[0]}" if op is Op.NEG else f"_{op.value}({parts[0]})"
        lines.append(f"{slots.taken(i)} = {step}")
    results = "".join(f"{_operand(program, slots, i)}, " for i in program.outputs)
    arguments = ", ".join(f"a{i}" for i in range(len(program.arguments)))
    body = "\n ".join([*lines, f"return ({results})"])
    compiled = compile(f"def program({arguments}):\n {body}", "<program>", "exec")
    return next(code for code in compiled.co_consts if isinstance(code, CodeType))


def _operand(program: Program, slots: _Slots, i: int) -> str:
    op, _, position = program.instructions[i]
    match op:
        case Op.CONST:
            return f"c{i}"
        case Op.PI:
            return "pi"
        case Op.ARG:
            return f"a{position}"
        case _:
            return slots.name(i)


class _Slots:
    """Local names for results, used again once a result is no longer needed.

    Arrays are thus freed as early as they can be.
    """

    def __init__(self, program: Program) -> None:
        self._uses = Counter(i for step in program.instructions for i in step.operands)
        self._uses.update(program.outputs)
        self._names: dict[int, str] = {}
        self._free: list[str] = []
        self._made = 0

    def taken(self, i: int) -> str:
        """A name for the result of step i."""
        if not self._free:
            self._free.append(f"v{self._made}")
            self._made += 1
        self._names[i] = self._free.pop()
        return self._names[i]

    def name(self, i: int) -> str:
        """The name that holds the result of step i."""
        return self._names[i]

    def release(self, operands: Iterable[int]) -> None:
        """Count one use of each operand."""
        for i in operands:
            self._uses[i] -= 1
            if i in self._names and not self._uses[i]:
                self._free.append(self._names[i])

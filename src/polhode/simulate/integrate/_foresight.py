"""What of a driven motion can be seen coming: polynomials can, pulses cannot."""

from __future__ import annotations

from math import inf

from polhode.algebra import Op, Program, Symbol


def degree_in(program: Program, argument: Symbol) -> float:
    """The highest degree to which any step of a program is a polynomial of an argument.

    Zero where the argument does not occur; infinite where a step is no polynomial of it.
    """
    place = program.arguments.index(argument)
    degrees = list[float]()
    for step in program.instructions:
        own = [degrees[operand] for operand in step.operands]
        degrees.append(1.0 if (step.op, step.value) == (Op.ARG, place) else _degree(step.op, own))
    return max(degrees, default=0.0)


def _degree(op: Op, own: list[float]) -> float:
    match op:
        case Op.MUL:
            return sum(own)
        case Op.DIV:
            return inf if own[1] else own[0]
        case Op.ADD | Op.SUB | Op.NEG:
            return max(own)
        case _:
            return inf if any(own) else 0.0

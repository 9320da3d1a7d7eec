"""Random tapes, and their Taylor series in many digits by python-flint."""

from fractions import Fraction

import flint
import numpy as np

from polhode.algebra import Arithmetic, Instruction, Op, Program, Symbol, SymbolKind
from polhode.simulate.kernel._layout import Layout, order_of
from polhode.simulate.kernel._tape import tape_of

TIME = Symbol("t", SymbolKind.TIME)
EPSILON = float(np.finfo(float).eps)
_BINARY = (Op.ADD, Op.SUB, Op.MUL, Op.DIV)
_UNARY = (Op.NEG, Op.SQRT, Op.SIN, Op.COS, Op.EXP, Op.SINH, Op.COSH)


def symbols(states, parameters):
    """The arguments of a program: states, parameters, time."""
    return (
        *(Symbol(f"q{i}", SymbolKind.COORDINATE) for i in range(states)),
        *(Symbol(f"p{i}", SymbolKind.PARAMETER) for i in range(parameters)),
        TIME,
    )


def written(arguments, steps, outputs):
    """A program from (operation, operands) or (operation, value), its arguments given first."""
    given = [Instruction(Op.ARG, (), i) for i in range(len(arguments))]
    rest = [
        Instruction(op, (), what) if op is Op.CONST else Instruction(op, tuple(what))
        for op, what in steps
    ]
    return Program(tuple(arguments), tuple(given + rest), tuple(outputs))


def drawn_program(drawn, length):
    """A random program whose steps have moderate values for moderate arguments."""
    states, parameters = drawn.randrange(1, 5), drawn.randrange(0, 3)
    arguments = symbols(states, parameters)
    known = len(arguments)
    steps = [(Op.CONST, Fraction(drawn.randrange(1, 40), 7)), (Op.PI, ())]
    while len(steps) < length:
        last = known + len(steps)
        if drawn.random() < 0.6:
            op, what = drawn.choice(_BINARY), [drawn.randrange(last), drawn.randrange(last)]
        else:
            op, what = drawn.choice(_UNARY), [drawn.randrange(last)]
        steps.append((op, what))
    last = known + len(steps)
    return written(arguments, steps, [drawn.randrange(known, last) for _ in range(states)])


def moderate(program, values):
    """Whether every step of a program has a moderate value, as an independent evaluation finds."""
    everything = Program(
        program.arguments, program.instructions, tuple(range(len(program.instructions)))
    )
    try:
        found = everything.function()(*values)
    except (ArithmeticError, ValueError):
        return False
    return all(1e-3 < abs(value) < 30 for value in found)


def layout_of(program, states, steps=64, tolerance=EPSILON):
    """The memory of a kernel that integrates a program."""
    guards = len(program.outputs) - states
    return Layout(tape_of(program, states), order_of(tolerance), steps, guards)


def _series_arithmetic():
    def number(value):
        return flint.arb_series([flint.arb(flint.fmpq(value.numerator, value.denominator))])

    return Arithmetic(
        number,
        flint.arb_series([flint.arb.pi()]),
        {
            Op.SQRT: lambda x: x.sqrt(),
            Op.SIN: lambda x: x.sin(),
            Op.COS: lambda x: x.cos(),
            Op.EXP: lambda x: x.exp(),
            Op.SINH: lambda x: (x.exp() - (-x).exp()) / 2,
            Op.COSH: lambda x: (x.exp() + (-x).exp()) / 2,
        },
    )


def series(program, state, parameters, time, order, bits=1200):
    """Taylor coefficients of the states, in balls of so many bits, as lists by rising power."""
    with flint.ctx.workprec(bits):
        cap = flint.ctx.cap
        rows = [[flint.arb(x)] for x in state]
        try:
            flint.ctx.cap = order + 1  # of the constants
            rates = program.function(_series_arithmetic())
            for known in range(1, order + 1):
                flint.ctx.cap = known
                given = [*(flint.arb_series(row) for row in rows)]
                given += [flint.arb_series([flint.arb(p)]) for p in parameters]
                given.append(flint.arb_series([flint.arb(time), 1]))
                for row, rate in zip(rows, rates(*given), strict=True):
                    row.append(rate[known - 1] / known)
        finally:
            flint.ctx.cap = cap
    return rows


def value(row, step, bits=1200):
    """Of a series, after a step: the middle of a ball, and its radius."""
    with flint.ctx.workprec(bits):
        total = flint.arb(0)
        for coefficient in reversed(row):
            total = total * flint.arb(step) + coefficient
        return float(total), float(total.rad())


def reached(program, state, parameters, time, step):
    """The states after a step, to all digits of a double."""
    rows = series(program, state, parameters, time, 60)
    found = [value(row, step) for row in rows]
    assert all(radius < 1e-20 for _, radius in found)
    return np.array([middle for middle, _ in found])


def rounding(program, state, parameters, time, step):
    """What roundings to 53 bits can do to the states after a step, by interval arithmetic.

    It is large where the series of a step of the tape converges over less than the step, although
    those of the states converge over more: the digits of a singularity that cancels are lost.
    """
    rows = series(program, state, parameters, time, order_of(EPSILON), bits=53)
    return max(value(row, step, bits=53)[1] for row in rows)

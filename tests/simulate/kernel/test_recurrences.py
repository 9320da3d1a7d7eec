"""Recurrences of Taylor coefficients: random tapes against many digits, each operation alone."""

import math
import random

import numpy as np
import pytest

from polhode.algebra import Op
from polhode.simulate.kernel._host import Kernel
from simulate.kernel.tapes import (
    drawn_program,
    layout_of,
    moderate,
    reached,
    symbols,
    written,
)


def first_step(program, state, parameters=(), time=0.0, longest=5.0):
    """One step of the kernel."""
    kernel = Kernel(layout_of(program, len(state)))
    kernel.start(np.array(parameters, dtype=float), time, np.array(state))
    return kernel.advance(math.inf, longest, 1)


def drawn_case(drawn):
    """A program with arguments at which all its steps have moderate values."""
    while True:
        program = drawn_program(drawn, drawn.randrange(4, 16))
        states = len(program.outputs)
        state = [drawn.uniform(-2, 2) for _ in range(states)]
        parameters = [drawn.uniform(0.2, 2) for _ in program.arguments[states:-1]]
        time = drawn.uniform(0.1, 1)
        if moderate(program, [*state, *parameters, time]):
            return program, state, parameters, time


@pytest.mark.parametrize("seed", range(150))
def test_a_step_of_a_random_tape(seed):
    """Against series in 1200 bits; the largest difference of 600 tapes was 1.3e-15."""
    program, state, parameters, time = drawn_case(random.Random(seed))
    steps = first_step(program, state, parameters, time)
    expected = reached(program, state, parameters, time, steps.lengths[0])
    assert np.max(np.abs(steps.state - expected) / np.maximum(1, np.abs(expected))) < 1e-14


# With x' = 1 from x = 0.3, y' = f(x): the coefficients of y are those of the integral of f.
FUNCTIONS = {
    Op.NEG: lambda x: -x * x / 2,
    Op.SIN: lambda x: -math.cos(x),
    Op.COS: math.sin,
    Op.EXP: math.exp,
    Op.SINH: math.cosh,
    Op.COSH: math.sinh,
    Op.SQRT: lambda x: 2 / 3 * x**1.5,
}


@pytest.mark.parametrize("op", FUNCTIONS)
def test_each_function(op):
    arguments = symbols(2, 0)
    program = written(arguments, [(Op.CONST, 1), (op, [0])], [3, 4])
    steps = first_step(program, [0.3, 0.0], longest=0.1)
    integral = FUNCTIONS[op](0.4) - FUNCTIONS[op](0.3)
    assert steps.lengths[0] <= 0.1
    if steps.lengths[0] == 0.1:
        assert steps.state[1] == pytest.approx(integral, rel=1e-14)
    shares = steps.shares[0, 1]
    assert shares.sum() == pytest.approx(
        FUNCTIONS[op](0.3 + steps.lengths[0]) - FUNCTIONS[op](0.3), rel=1e-13
    )


def test_a_square_and_a_product_have_the_same_coefficients():
    """x' = sin x; y' = x², z' = x (x + 0 y): one is done by the rule for squares."""
    arguments = symbols(3, 1)
    steps = [(Op.SIN, [0]), (Op.MUL, [0, 0]), (Op.MUL, [1, 3]), (Op.ADD, [0, 7]), (Op.MUL, [0, 8])]
    program = written(arguments, steps, [5, 6, 9])
    found = first_step(program, [0.7, 0.0, 0.0], [0.0]).shares[0]
    assert np.allclose(found[1], found[2], rtol=1e-14, atol=1e-18)


def test_steps_of_parameters_alone_are_done_once():
    """x' = √(p² + 1) x: the root belongs to the steps that do not change."""
    arguments = symbols(1, 1)
    steps = [(Op.MUL, [1, 1]), (Op.CONST, 1), (Op.ADD, [3, 4]), (Op.SQRT, [5]), (Op.MUL, [6, 0])]
    program = written(arguments, steps, [7])
    tape = layout_of(program, 1).tape
    assert (len(tape.constant), len(tape.varying)) == (3, 1)
    found = first_step(program, [1.0], [2.0])
    assert found.state[0] == pytest.approx(math.exp(math.sqrt(5) * found.lengths[0]), rel=1e-14)

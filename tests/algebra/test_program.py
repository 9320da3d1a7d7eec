import math
import operator
import pickle
import random
from fractions import Fraction
from functools import reduce

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from polhode.algebra import (
    FLOATS,
    Arithmetic,
    Expr,
    LinearSolve,
    Matrix,
    Op,
    Symbol,
    arrays,
    as_symbol,
    compile_program,
    coordinates,
    cos,
    cosh,
    exp,
    pi,
    sin,
    sinh,
    sqrt,
    symbol,
    symbols,
    time,
)
from polhode.base import DeclarationError, NumericError

EXACT = Arithmetic(number=Fraction, pi=Fraction(22, 7), functions={})
X, Y, Z, W = symbols("x y z w")
LETTERS = tuple(as_symbol(letter) for letter in (X, Y, Z, W))

numbers = st.fractions(min_value=-4, max_value=4, max_denominator=6)
monomials = st.tuples(numbers, *[st.integers(0, 3)] * 4)
polynomials = st.lists(monomials, min_size=1, max_size=6)


def polynomial(terms) -> Expr:
    products = (c * X**i * Y**j * Z**k * W**n for c, i, j, k, n in terms)
    return reduce(operator.add, products, Expr.constant(0))


def value_of(expression: Expr, point: dict[Symbol, Fraction]) -> Fraction:
    value = expression.subs(point).rational
    assert value is not None
    return value


@given(polynomials, polynomials, st.tuples(*[numbers] * 4))
def test_a_program_computes_exactly_what_the_expressions_say(above, below, values):
    point = dict(zip(LETTERS, values, strict=True))
    num, den = polynomial(above), polynomial(below)
    if not den or not value_of(den, point):
        return
    ratio = num / den
    program = compile_program([ratio, num, -num, num + den], LETTERS)
    expected = (value_of(ratio, point), value_of(num, point), -value_of(num, point))
    assert program.function(EXACT)(*values)[:3] == expected


def test_every_function_agrees_with_the_library():
    (t,) = symbols("t_1", positive=True)
    (u,) = coordinates("u")
    expressions = [sin(2 * u), cos(u - t), exp(-u), sinh(u) * cosh(t), sqrt(t + 1), pi * u, sin(-u)]
    program = compile_program(expressions, (as_symbol(u), as_symbol(t)))
    a, b = 0.7, 1.3
    expected = (
        math.sin(2 * a),
        math.cos(a - b),
        math.exp(-a),
        math.sinh(a) * math.cosh(b),
        math.sqrt(b + 1),
        math.pi * a,
        -math.sin(a),
    )
    assert program.function()(a, b) == pytest.approx(expected, rel=1e-15)
    column = np.linspace(-1, 1, 5)
    found = program.function(arrays())(column, b)
    assert found[0] == pytest.approx(np.sin(2 * column), rel=1e-15)


def test_common_parts_are_done_once_across_outputs():
    (u,) = coordinates("u")
    program = compile_program(
        [sin(u) * X, sin(u) * X + 1, (sin(u) * X + 1) ** 2], (LETTERS[0], as_symbol(u))
    )
    assert program.operations == 4  # sin, a product, a sum, a square


def test_a_sign_is_taken_up_by_a_difference():
    assert compile_program([X - Y, Y - X], LETTERS).operations == 2
    ops = {step.op for step in compile_program([-X * Y + Z], LETTERS).instructions}
    assert Op.NEG not in ops


def test_powers_share_their_products():
    assert compile_program([X**2, X**3, X**6], LETTERS).operations == 3


def test_factors_come_out():
    program = compile_program([(X + Y) ** 3 * (Z - W)], LETTERS)
    assert program.operations == 5


def test_the_shorter_of_sine_and_cosine_is_written():
    (u,) = coordinates("u")
    program = compile_program([1 / cos(u), 1 - sin(u) ** 2], (as_symbol(u),))
    assert program.operations == 3  # cos, a reciprocal, a square
    assert Op.SIN not in {step.op for step in program.instructions}


def test_the_accelerations_of_the_rolling_disk_are_short():
    """The three accelerations of a thin disk that rolls: the aim was 52 operations."""
    m, a, g = symbols("m a g", positive=True)
    (theta,) = coordinates("theta")
    p, q, w = symbols("theta_rate phi_rate omega")
    accelerations = LinearSolve(
        tuple(as_symbol(s) for s in symbols("A B C")),
        Matrix.diagonal([m * a**2 * 5 / 4, m * a**2 * sin(theta) / 4, m * a**2 * 3 / 2]),
        (
            m * a**2 * q * sin(theta) * (q * cos(theta) - 6 * w) / 4 - m * g * a * cos(theta),
            m * a**2 * p * (w - q * cos(theta)) / 2,
            m * a**2 * p * q * sin(theta),
        ),
    )
    given_ones = [as_symbol(s) for s in (theta, p, q, w, m, a, g)]
    program = compile_program(accelerations.solution, given_ones, solves=[accelerations])
    assert program.operations <= 24


def draw_system(
    size: int, symmetric: bool, gap: int = 2
) -> tuple[LinearSolve, list[list[Fraction]]]:
    entries = symbols(" ".join(f"m_{i}_{j}" for i in range(size) for j in range(size)))
    rows = [list(entries[i * size : (i + 1) * size]) for i in range(size)]
    for i in range(size):
        for j in range(size):
            if symmetric and j < i:
                rows[i][j] = rows[j][i]
            if (i - j) % size == gap:
                rows[i][j] = rows[j][i] = Expr.constant(0)
    right = symbols(" ".join(f"f_{i}" for i in range(size)))
    unknowns = tuple(as_symbol(s) for s in symbols(" ".join(f"u_{i}" for i in range(size))))
    return LinearSolve(unknowns, Matrix.of(rows), tuple(right)), rows


@pytest.mark.parametrize("symmetric", [True, False])
@pytest.mark.parametrize("size", [1, 2, 3, 5])
def test_linear_equations_are_solved_exactly(size, symmetric):
    generator = random.Random(size)
    solve, rows = draw_system(size, symmetric)
    symbols_in = sorted(
        {s for row in (*rows, solve.right) for e in row for s in e.symbols()},
        key=lambda s: s.published,
    )
    point = {s: Fraction(generator.randint(1, 99), 7) for s in symbols_in}
    program = compile_program(solve.solution, symbols_in, solves=[solve])
    found = program.function(EXACT)(*point.values())
    for row, right in zip(rows, solve.right, strict=True):
        left = sum(value_of(e, point) * u for e, u in zip(row, found, strict=True) if e)
        assert left == value_of(right, point)


def test_of_a_symmetric_matrix_one_triangle_is_worked_on():
    symmetric, _ = draw_system(6, True, gap=-1)
    general, _ = draw_system(6, False, gap=-1)

    def operations(solve: LinearSolve) -> int:
        given_ones = {s for e in (*solve.right, *sum(solve.matrix.rows, ())) for s in e.symbols()}
        return compile_program(solve.solution, list(given_ones), solves=[solve]).operations

    assert operations(general) == 15 + 110 + 30 + 36  # factors, updates, forward, back
    assert operations(symmetric) == 15 + 70 + 30 + 36


def test_a_zero_on_the_diagonal_is_no_obstacle_without_symmetry():
    a, b = symbols("u_0 u_1")
    solve = LinearSolve((as_symbol(a), as_symbol(b)), Matrix.of([[0, X], [Y, Z]]), (W, W))
    program = compile_program([a, b], LETTERS, solves=[solve])
    x, y, z, w = (Fraction(n) for n in (2, 3, 5, 7))
    assert program.function(EXACT)(x, y, z, w) == ((w - z * w / x) / y, w / x)


def test_equations_without_a_solution_are_refused():
    a, b = symbols("u_0 u_1")
    solve = LinearSolve((as_symbol(a), as_symbol(b)), Matrix.of([[X, 0], [Y, 0]]), (Z, W))
    with pytest.raises(NumericError, match="singular"):
        compile_program([a], LETTERS, solves=[solve])


def test_definitions_are_followed_and_unknown_symbols_named():
    table = {LETTERS[2]: X + Y, LETTERS[3]: Z**2}
    program = compile_program([W], LETTERS[:2], table.get)
    assert program.function(EXACT)(Fraction(1), Fraction(2)) == (9,)
    with pytest.raises(DeclarationError, match="w has no value"):
        compile_program([W], LETTERS[:2])


def test_a_coefficient_beyond_the_numbers_is_named():
    program = compile_program([X * 10**400], LETTERS[:1])
    with pytest.raises(NumericError, match="coefficient of about 1e400"):
        program.function()
    assert compile_program([X / 10**400], LETTERS[:1]).function()(1.0) == (0.0,)


def test_results_that_are_no_longer_needed_are_let_go():
    program = compile_program([sum(((X + n) ** 2 for n in range(50)), Expr.constant(0))], LETTERS)
    code = program.function(FLOATS).__code__
    assert code.co_nlocals - code.co_argcount < 5


def test_a_program_can_be_sent_to_another_process():
    program = compile_program([X / Y + sqrt(2)], LETTERS)
    again = pickle.loads(pickle.dumps(program))
    assert again == program
    assert again.function()(1.0, 2.0, 0.0, 0.0) == (0.5 + math.sqrt(2),)


def test_sines_of_large_angles_are_taken_less_whole_turns():
    (u,) = coordinates("u")
    turn, within = as_symbol(u), as_symbol(Z)
    program = compile_program([sin(u) + u, cos(u / 2)], (turn, within), turned={turn: within})
    assert program.function()(1e9, 0.5) == (math.sin(0.5) + 1e9, math.cos(5e8))


# -- bells ---------------------------------------------------------------------------------------


def mpfs(numbers):
    return [mpmath.mpf(n.numerator) / n.denominator for n in numbers]


def bells(t, heights, middles, widths, exp):
    return sum(
        h * exp(-(((t - c) / w) ** 2)) for h, c, w in zip(heights, middles, widths, strict=True)
    )


@pytest.mark.parametrize("named", [True, False], ids=["symbols", "numbers"])
@pytest.mark.parametrize("count", [1, 2])
def test_derivatives_of_narrow_bells_keep_their_digits(named, count):
    """Far from zero, 2(t − c)² − w² multiplied out would lose those of t²/w²."""
    shapes = [[0.125, 0.25], [13.0, 13.5], [0.0625, 0.09375]]
    given = [tuple(map(Fraction, row[:count])) for row in shapes]
    names = [symbols(" ".join(f"{letter}{i}" for i in range(count))) for letter in "hcw"]
    names = [name if isinstance(name, tuple) else (name,) for name in names]
    moving = bells(time, *(names if named else given), exp)
    rates = [moving, moving.dt(), moving.dt().dt()]
    known = dict(zip(sum(names, ()), sum(given, ()), strict=True)) if named else {}
    program = compile_program(rates, (as_symbol(time), *map(as_symbol, known)))
    for t in np.linspace(12.8, 13.8, 41).tolist():
        found = program.function()(t, *map(float, known.values()))
        with mpmath.workdps(40):
            for order, value in enumerate(found):
                at = mpmath.mpf(t)
                truth = mpmath.diff(lambda t: bells(t, *map(mpfs, given), mpmath.exp), at, order)
                size = 0.5 / 0.0625**order
                assert abs(value - truth) < 2e-15 * size, (t, order)


def test_exponentials_may_occur_within_roots_alone():
    """x + √(2 + eˣ) is no sum of factors times exponentials; it was taken for one without end."""
    x = symbol("x")
    program = compile_program([x + sqrt(2 + exp(x))], tuple(x.symbols()))
    assert program.function()(0.5) == pytest.approx(
        (0.5 + math.sqrt(2 + math.exp(0.5)),), rel=1e-15
    )

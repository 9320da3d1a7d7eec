"""Matrices, elimination and rotation."""

from itertools import pairwise

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from algebra.backends import a, b, phi, theta, x, y
from polhode.algebra import (
    ONE,
    ZERO,
    Expr,
    Matrix,
    cos,
    dot,
    eliminate,
    rotation,
    sin,
    solve,
    sqrt,
    variables,
)

UNIT = Matrix.diagonal([1, 1, 1])

entries = st.sampled_from([ZERO, ZERO, ONE, -ONE, Expr.of(2) / 3, a, x, sin(theta), cos(theta)])


def square(size: int) -> st.SearchStrategy:
    return st.lists(st.lists(entries, min_size=size, max_size=size), min_size=size, max_size=size)


@settings(max_examples=40)
@given(square(3), st.lists(entries, min_size=3, max_size=3))
def test_elimination_gives_solutions_and_says_what_is_free(rows, right):
    outcome = eliminate(rows, right)
    assert sorted([*outcome.solved, *outcome.free]) == [0, 1, 2]
    assume(not outcome.contradictory)
    free = {j: Expr.of(7 + j) for j in outcome.free}
    found = dict(free)
    for j, (coefficients, constant) in outcome.solved.items():
        found[j] = constant + dot(coefficients, free.values())
    for row, value in zip(rows, right, strict=True):
        assert dot(row, [found[j] for j in range(3)]) == value


def test_rows_that_say_nothing_new_and_rows_that_contradict():
    rows = [[ONE, a], [a, a**2], [Expr.of(2), 2 * a]]
    outcome = eliminate(rows, [x, a * x, y])
    assert outcome.free == (1,)
    assert outcome.leftover == {1: 0, 2: y - 2 * x}
    assert outcome.contradictory == (2,)


def test_unknowns_are_solved_for_in_the_order_of_their_rank():
    rows, right = [[ONE, ONE]], [x]
    assert eliminate(rows, right, rank=[1, 0]).free == (0,)
    assert eliminate(rows, right, rank=[0, 1]).free == (1,)


def test_pivots_that_cannot_vanish_are_preferred():
    outcome = eliminate([[sin(theta), a]], [x])
    assert outcome.free == (0,)


@settings(max_examples=25)
@given(square(2))
def test_a_regular_system_has_its_one_solution(rows):
    determinant = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]
    right = [x, y]
    if determinant.is_zero:
        with pytest.raises(ZeroDivisionError):
            solve(rows, right)
        return
    found = solve(rows, right)
    assert Matrix.of(rows).times(found) == (x, y)


def test_solving_with_cosines_and_roots():
    rows = [[cos(theta), -sin(theta)], [sin(theta), cos(theta)]]
    assert solve(rows, [ONE, ZERO]) == (cos(theta), -sin(theta))
    assert solve([[sqrt(a)]], [a]) == (sqrt(a),)


def test_matrices():
    matrix = Matrix.of([[1, x], [sin(theta), 0], [2, 3]])
    assert matrix.shape == (3, 2)
    assert matrix == matrix.T.T
    assert matrix.T[1, 0] == x
    assert matrix.T @ matrix == (matrix.T @ matrix).T
    assert matrix.times([y, ONE]) == (y + x, y * sin(theta), 2 * y + 3)
    assert Matrix.of([]).shape == (0, 0)
    assert matrix.latex() == (r"\begin{bmatrix} 1 & x \\ \sin\theta & 0 \\ 2 & 3 \end{bmatrix}")
    assert variables([*matrix.rows[0], *matrix.rows[1]]) == {x.symbol, theta.symbol}


AXES = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (sin(phi), 0, cos(phi)), (2, 2, 1)]


@pytest.mark.parametrize("axis", AXES)
def test_rotations_are_orthogonal_and_keep_their_axis(axis):
    length = sqrt(sum((Expr.of(c) ** 2 for c in axis), ZERO))
    axis = [c / length for c in map(Expr.of, axis)]
    turn = rotation(axis, cos(theta), sin(theta))
    assert turn @ turn.T == UNIT
    assert turn.times(axis) == tuple(axis)
    twice = rotation(axis, cos(2 * theta), sin(2 * theta))
    assert turn @ turn == twice
    assert turn @ rotation(axis, cos(theta), -sin(theta)) == UNIT


def test_a_quarter_turn_about_z_carries_x_to_y():
    turn = rotation((ZERO, ZERO, ONE), ZERO, ONE)
    assert turn.times((ONE, ZERO, ZERO)) == (ZERO, ONE, ZERO)


def test_rotations_about_one_axis_add_their_angles():
    angles = [theta, phi, theta + phi]
    first, second, both = (rotation((ZERO, ONE, ZERO), cos(t), sin(t)) for t in angles)
    assert first @ second == second @ first == both
    assert all(p != q for p, q in pairwise([first, second, both]))


def test_products_of_mixed_make():
    assert dot([a, b], [ONE, ONE]) == a + b
    assert dot([], []) == 0
    with pytest.raises(ValueError, match="zip"):
        dot([a], [a, b])

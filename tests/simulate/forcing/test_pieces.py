"""Polynomials between knots."""

import math

import numpy as np
import pytest

from polhode.base import NumericError
from polhode.simulate.forcing._pieces import Pieces

PARABOLAS = Pieces(np.array([1.0, 3.0, 4.0]), np.array([[2.0, 0.0, 0.5], [4.0, -1.0, 3.0]]), (1,))


def test_rest_before_and_after():
    times = np.array([-5.0, 0.0, 1.0, 2.0, 3.0, 3.5, 4.0, 9.0])
    assert PARABOLAS.value(times).tolist() == [2.0, 2.0, 2.0, 2.5, 4.0, 4.25, 6.0, 6.0]
    assert PARABOLAS.velocity(times).tolist() == [0.0, 0.0, 0.0, 1.0, -1.0, 2.0, 0.0, 0.0]
    assert PARABOLAS.acceleration(times).tolist() == [0.0, 0.0, 1.0, 1.0, 6.0, 6.0, 0.0, 0.0]


def test_jumps_are_where_the_rate_jumps():
    middle, last = PARABOLAS.jumps
    assert (middle.time, middle.value, middle.velocity) == (3.0, (4.0, 4.0), (2.0, -1.0))
    assert (last.time, last.value, last.velocity) == (4.0, (6.0, 6.0), (5.0, 0.0))


@pytest.mark.parametrize("time", [0.0, 1.0, 2.0, 3.0, 3.9, 4.0, 7.0])
def test_the_polynomial_of_a_piece_is_the_function(time):
    since, coefficients = PARABOLAS.polynomial(PARABOLAS.piece(time))
    value = np.polynomial.polynomial.polyval(time - since, coefficients)
    assert value == PARABOLAS.value(time)


def test_constants_between_knots_step():
    steps = Pieces(np.array([0.0, 1.0, 2.0]), np.array([[1.0], [3.0]]), (1,))
    assert [(jump.time, jump.value) for jump in steps.jumps] == [(1.0, (1.0, 3.0))]
    assert steps.velocity(np.array([0.5, 1.5])).tolist() == [0.0, 0.0]


def test_times_of_any_shape():
    assert PARABOLAS.value(np.full((2, 3), 2.0)).shape == (2, 3)
    assert PARABOLAS.value(2.0).shape == ()


@pytest.mark.parametrize(
    ("knots", "table"),
    [
        ([0.0, 1.0], [[1.0], [2.0]]),
        ([1.0, 0.0], [[1.0]]),
        ([0.0, 1.0], [[math.nan]]),
        ([0.0, math.inf], [[1.0]]),
    ],
)
def test_invalid_pieces_are_refused(knots, table):
    with pytest.raises(NumericError):
        Pieces(np.array(knots), np.array(table))

"""Factors with which residuals vanish, against residuals whose roots are known."""

import numpy as np
import pytest

from polhode.judge.repair._multiplier import Response, _by_division

STATES = np.array([0.5, 1.0, 2.0])


def response(*rows) -> Response:
    """The response of residuals given as functions of the factor at every state."""

    def changing(factors):
        return np.array([row(factors) for row in rows])

    return Response(changing, tuple(range(len(rows))), changing(np.ones((1, 3)))[:, 0])


@pytest.mark.parametrize("root", [0.3, 3.0, 17.0])
def test_division_finds_the_root_of_a_steep_residual_to_rounding(root):
    found = _by_division(response(lambda x: STATES * np.arctan(40 * (x - root))), 0)

    assert found == pytest.approx(np.full(3, root), rel=1e-14)


def test_division_finds_the_root_of_each_state():
    found = _by_division(response(lambda x: np.exp(x) - np.exp(STATES)), 0)

    assert found == pytest.approx(STATES, rel=1e-14)


def test_no_factor_corrects_a_place_beside_a_residual_that_it_does_not_move():
    moved = response(lambda x: STATES * (x**3 - 8))
    beside = response(lambda x: STATES * (x**3 - 8), lambda x: 0 * x + 0.01)

    assert moved.multiplier == pytest.approx(np.full(3, 2.0))
    assert beside.multiplier is None

"""Integration by extrapolation against closed forms, and what it refuses."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import ellipj, ellipk

from polhode.base import NumericError, integrated


@pytest.mark.parametrize("tolerance", [1e-6, 1e-10, 1e-13])
def test_a_pendulum_follows_jacobi(tolerance):
    modulus, t = np.sin(1.0) ** 2, 20.0
    sn = ellipj(ellipk(modulus) - t, modulus)[0]
    found = integrated(lambda _, y: np.array([y[1], -np.sin(y[0])]), 0, t, [2.0, 0.0], tolerance)
    assert found[0] == pytest.approx(2 * np.arcsin(np.sqrt(modulus) * sn), abs=2e3 * tolerance)


@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(0.1, 3))
def test_forwards_and_back(begin, end, rate):
    """y' = k cos(t) y + t, from zero."""

    def slope(t, y):
        return rate * np.cos(t) * y + t

    there = integrated(slope, begin, end, [0.0], 1e-12)
    assert integrated(slope, end, begin, there, 1e-12) == pytest.approx(
        [0.0], abs=1e-9 * (1 + abs(there[0]))
    )


def test_a_pole_is_not_passed():
    """y' = y² from 1 is 1/(1 − t)."""
    assert integrated(lambda _, y: y * y, 0.0, 0.75, [1.0], 1e-13) == pytest.approx(
        [4.0], rel=1e-12
    )
    with pytest.raises(NumericError, match="between 0 and 2, followed to 1;"):
        integrated(lambda _, y: y * y, 0.0, 2.0, [1.0], 1e-10)

"""Splines against SciPy's, and against the functional that a smoothing spline makes least."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.interpolate import CubicSpline, PPoly, make_smoothing_spline

from polhode.simulate.forcing._splines import spline_near, spline_through

ENDS = {True: (1, 0.0), False: "not-a-knot"}


@st.composite
def samples(draw, least):
    count = draw(st.integers(least, 12))
    steps = draw(st.lists(st.floats(0.1, 3.0), min_size=count - 1, max_size=count - 1))
    values = draw(st.lists(st.floats(-2.0, 2.0), min_size=count, max_size=count))
    return np.concatenate([[0.0], np.cumsum(steps)]), np.array(values)


@given(samples(3), st.booleans(), st.booleans())
def test_it_is_scipys(given_samples, first, last):
    t, x = given_samples
    expected = CubicSpline(t, x, bc_type=(ENDS[first], ENDS[last])).c[::-1].T
    found = spline_through(t, x, (first, last))
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-9 * np.max(np.abs(expected)))


def test_two_samples_at_rest():
    assert spline_through(
        np.array([0.0, 2.0]), np.array([0.0, 4.0]), (True, True)
    ) == pytest.approx(np.array([[0.0, 0.0, 3.0, -1.0]]))


@given(samples(5), st.floats(-4, 4))
def test_a_smooth_one_is_scipys(given_samples, power):
    t, x = given_samples
    table, values = spline_near(t, x, 10.0**power)
    expected = make_smoothing_spline(t, x, lam=10.0**power)
    assert values == pytest.approx(expected(t), abs=1e-8)
    assert 2 * table[:, 2] == pytest.approx(expected(t, 2)[:-1], abs=1e-7)
    assert table[:, 0] == pytest.approx(values[:-1], abs=1e-12)


def test_a_smooth_one_makes_its_functional_least():
    t, x = np.array([0.0, 1.0, 1.5, 3.0]), np.array([0.0, 2.0, -1.0, 1.0])
    stiffness = 0.3

    def functional(table):
        curve = PPoly(table[:, ::-1].T, t)
        bent = sum(quad(lambda s: curve(s, 2) ** 2, a, b)[0] for a, b in pairwise(t))
        return np.sum((curve(t) - x) ** 2) + stiffness * bent

    table, _ = spline_near(t, x, stiffness)
    least = functional(table)
    for place in range(len(t)):
        moved = x.copy()
        moved[place] += 1e-3
        # another natural spline, near the least one
        assert functional(spline_near(t, moved, stiffness)[0]) > least


@pytest.mark.parametrize("stiffness", [1e-6, 1.0, 1e3])
def test_many_samples(stiffness):
    rng = np.random.default_rng(5)
    t = np.cumsum(rng.uniform(0.2, 2.0, 200))
    x = np.sin(t / 20) + 0.1 * rng.standard_normal(200)
    table, values = spline_near(t, x, stiffness)
    expected = make_smoothing_spline(t, x, lam=stiffness)
    assert values == pytest.approx(expected(t), abs=1e-10)
    assert 2 * table[:, 2] == pytest.approx(expected(t, 2)[:-1], abs=1e-10)

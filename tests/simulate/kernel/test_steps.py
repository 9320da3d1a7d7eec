"""The loop over steps, by motions with closed forms."""

import math

import numpy as np
import pytest

from polhode.algebra import Op
from polhode.simulate.kernel._host import Kernel
from polhode.simulate.kernel._layout import order_of
from polhode.simulate.kernel._steps import Status
from simulate.kernel.tapes import EPSILON, layout_of, symbols, written


def growth():
    """x' = x."""
    return written(symbols(1, 0), [], [0])


def blow_up():
    """x' = x², x = 1/(1 − t) from x = 1."""
    return written(symbols(1, 0), [(Op.MUL, [0, 0])], [2])


def oscillator():
    """x' = y, y' = −x."""
    return written(symbols(2, 0), [(Op.NEG, [0])], [1, 3])


def orbit():
    """Kepler's ellipse: x'' = −x/r³, y'' = −y/r³, with the states x, y, x', y'."""
    steps = [
        (Op.MUL, [0, 0]), (Op.MUL, [1, 1]), (Op.ADD, [5, 6]), (Op.SQRT, [7]),
        (Op.MUL, [7, 8]), (Op.DIV, [0, 9]), (Op.NEG, [10]), (Op.DIV, [1, 9]), (Op.NEG, [12]),
    ]  # fmt: skip
    return written(symbols(4, 0), steps, [2, 3, 11, 13])


def followed(program, state, goal, longest=math.inf, tolerance=EPSILON, begin=0.0):
    """All calls until the motion ends."""
    kernel = Kernel(layout_of(program, len(state), tolerance=tolerance))
    kernel.start(np.empty(0), begin, np.array(state))
    calls = [kernel.advance(goal, longest, 8)]
    while calls[-1].status is Status.GOING:
        calls.append(kernel.advance(goal, longest, 8))
    return calls


def test_growth_by_a_factor_of_e_to_the_twenty():
    last = followed(growth(), [1.0], 20.0)[-1]
    assert (last.status, last.end) == (Status.GOAL, (20.0, 0.0))
    assert last.state[0] == pytest.approx(math.exp(20), rel=4e-15)


def test_a_hundred_turns_of_an_oscillator():
    """The phase is that of the time to rounding: steps and sums are compensated."""
    goal = 200 * math.pi
    last = followed(oscillator(), [1.0, 0.0], goal)[-1]
    assert last.state[0] == pytest.approx(1, abs=2e-15)
    assert last.state[1] == pytest.approx(-math.sin(goal), abs=5e-14)


@pytest.mark.parametrize("eccentricity", [0.1, 0.5, 0.9])
def test_ten_orbits_of_an_ellipse(eccentricity):
    """Energy and angular momentum to rounding, and the same place after ten periods of 2π."""
    near = 1 - eccentricity
    start = [near, 0.0, 0.0, math.sqrt((1 + eccentricity) / near)]
    calls = followed(orbit(), start, 20 * math.pi)
    x, y, u, v = calls[-1].state
    assert (u * u + v * v) / 2 - 1 / math.hypot(x, y) == pytest.approx(-0.5, abs=1e-14)
    assert x * v - y * u == pytest.approx(math.sqrt(1 - eccentricity**2), abs=1e-14)
    # a phase of 1e-14 of the time, where the acceleration is up to 1/(1 - e)²
    assert calls[-1].state == pytest.approx(start, abs=1e-12 / near**2)


def test_towards_a_singularity():
    last = followed(blow_up(), [1.0], 0.999)[-1]
    assert last.state[0] == pytest.approx(1000, rel=1e-11)


def test_beyond_a_singularity_the_steps_shrink():
    kernel = Kernel(layout_of(blow_up(), 1))
    kernel.start(np.empty(0), 0.0, np.array([1.0]))
    found = kernel.advance(2.0, math.inf, 64)
    assert found.status is Status.GOING
    assert found.end[0] < 1
    assert found.lengths[-1] < 1e-3 * found.lengths[0]


@pytest.mark.parametrize("value", [math.nan, math.inf, 1e300])
def test_coefficients_that_are_not_finite(value):
    (only,) = followed(blow_up(), [value], 1.0)
    assert only.status is Status.BROKEN
    assert len(only.lengths) == 0
    assert only.end == (0.0, 0.0)


def test_a_polynomial_takes_the_longest_step():
    """x' = t: one step however long, without powers beyond those of the polynomial."""
    program = written(symbols(1, 0), [], [1])
    (only,) = followed(program, [0.0], 1e6)
    assert only.status is Status.GOAL
    assert only.lengths.tolist() == [1e6]
    assert only.state[0] == 5e11
    assert np.all(only.shares[0, 0, 3:] == 0)
    assert [len(call.lengths) for call in followed(program, [0.0], 1.0, longest=0.125)] == [8]


def test_a_call_takes_no_more_steps_than_asked():
    kernel = Kernel(layout_of(oscillator(), 2, steps=5))
    kernel.start(np.empty(0), 0.0, np.array([1.0, 0.0]))
    assert len(kernel.advance(100.0, math.inf, 3).lengths) == 3
    assert len(kernel.advance(100.0, math.inf, 100).lengths) == 5  # as many as its memory holds


def test_at_the_goal_there_is_nothing_to_do():
    kernel = Kernel(layout_of(oscillator(), 2))
    kernel.start(np.empty(0), 1.0, np.array([1.0, 0.0]))
    found = kernel.advance(1.0, math.inf, 8)
    assert (found.status, len(found.lengths), found.end) == (Status.GOAL, 0, (1.0, 0.0))


def test_steps_join_and_end_exactly():
    calls = followed(oscillator(), [1.0, 0.0], 0.1 + 10.0, begin=0.1)
    begins = np.concatenate([call.begins for call in calls])
    lengths = np.concatenate([call.lengths for call in calls])
    ends = np.concatenate([begins[1:], [calls[-1].end]])
    # as sums of two doubles, the ends of steps are known beyond the last digit of the time
    gaps = (ends[:, 0] - begins[:, 0]) - lengths + (ends[:, 1] - begins[:, 1])
    assert np.max(np.abs(gaps)) < 1e-15
    shares = np.concatenate([call.shares for call in calls])
    reached = shares.sum(axis=2)[:-1]
    assert np.allclose(reached, shares[1:, :, 0], rtol=0, atol=4e-16)


@pytest.mark.parametrize("tolerance", [1e-6, 1e-9, 1e-12, EPSILON])
def test_the_tolerance_determines_order_and_error(tolerance):
    """x = cos t after ten turns; the order is 1 − ½ ln ε."""
    assert order_of(tolerance) == math.ceil(1 - math.log(tolerance) / 2)
    last = followed(oscillator(), [1.0, 0.0], 20 * math.pi, tolerance=tolerance)[-1]
    assert np.max(np.abs(last.state - [1, 0])) < 30 * tolerance + 1e-14


def test_small_states_have_steps_of_their_own_where_they_are_weighted():
    """x' = y, y' = −x + x³ with x of 1e-6: scaled to one, its steps are those of large states."""
    steps = [(Op.MUL, [0, 0]), (Op.MUL, [0, 3]), (Op.SUB, [4, 0])]
    kernel = Kernel(layout_of(written(symbols(2, 0), steps, [1, 5]), 2))
    found = []
    for size, weight in ((1e-6, 1.0), (1e-6, 2.0**20), (1.0, 1.0)):
        kernel.start(np.empty(0), 0.0, np.array([size, 0.0]), weight)
        found.append(kernel.advance(10.0, math.inf, 1).lengths[0])
    assert found[0] > 1.8 * found[1]
    assert found[1] == pytest.approx(1.0, rel=0.3)


def test_a_second_motion_begins_anew():
    kernel = Kernel(layout_of(oscillator(), 2))
    results = []
    for _ in range(2):
        kernel.start(np.empty(0), 0.0, np.array([1.0, 0.5]))
        results.append(kernel.advance(3.0, math.inf, 64))
    assert np.array_equal(results[0].state, results[1].state)
    assert np.array_equal(results[0].shares, results[1].shares)

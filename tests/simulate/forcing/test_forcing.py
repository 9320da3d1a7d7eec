"""Prescribed motions: through samples, near noisy ones, and in place of Python functions."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import make_smoothing_spline

from polhode.base import NumericError
from polhode.simulate.forcing._approximation import approximated
from polhode.simulate.forcing._pieces import Pieces
from polhode.simulate.forcing._samples import _smoothed, sampled

PARABOLAS = Pieces(np.array([1.0, 3.0, 4.0]), np.array([[2.0, 0.0, 0.5], [4.0, -1.0, 3.0]]), (1,))


# -- polynomials between knots ---------------------------------------------------------------------


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


# -- samples ---------------------------------------------------------------------------------------


@st.composite
def samples(draw):
    steps = draw(st.lists(st.floats(0.01, 1.0), min_size=1, max_size=20))
    values = draw(st.lists(st.floats(-1, 1), min_size=len(steps) + 1, max_size=len(steps) + 1))
    return np.cumsum([draw(st.floats(-5, 5)), *steps]), np.array(values)


@given(samples())
@settings(derandomize=True, max_examples=60)
def test_a_curve_through_samples(drawn):
    times, values = drawn
    curve = sampled(times, values)
    assert curve.value(times) == pytest.approx(values, abs=1e-9)
    assert curve.velocity(times[0]) == 0.0
    assert {jump.time for jump in curve.jumps} <= {times[-1]}
    reach = np.diff(curve.knots)[:-1]
    for order in range(3):
        slopes = _derivatives(curve.coefficients[:-1], reach, order)
        scale = 1 + np.max(np.abs(curve.coefficients)) * 10
        assert slopes == pytest.approx(curve.coefficients[1:, order], abs=1e-9 * scale)


def _derivatives(table, reach, order):
    """Taylor coefficients at the ends of pieces."""
    found = []
    for row, h in zip(table, reach, strict=True):
        shifted = np.polynomial.Polynomial(row)(np.polynomial.Polynomial([h, 1.0]))
        found.append(np.pad(shifted.coef, (0, 4))[order])
    return found


def test_polynomials_of_low_degree_are_found_exactly():
    times = np.array([0.0, 0.3, 0.7, 1.1, 2.0])
    cubic = sampled(times, times**3 - 2 * times**2)
    dense = np.linspace(0, 1.99, 50)
    assert cubic.value(dense) == pytest.approx(dense**3 - 2 * dense**2, abs=1e-13)
    assert sampled([0, 2], [1, 5]).value(1.0) == 2.0  # half the time, a quarter of the way


def test_error_falls_with_the_fourth_power_of_the_step():
    def error(count):
        times = np.linspace(0, 2, count)
        dense = np.linspace(0, 1.999, 500)
        curve = sampled(times, 1 - np.cos(3 * times))
        return np.max(np.abs(curve.value(dense) - 1 + np.cos(3 * dense)))

    assert 10 < error(41) / error(81) < 25


def test_the_rate_jumps_between_segments():
    first, second = np.linspace(0, 1, 11), np.linspace(1, 2, 11)
    times = np.concatenate([first, second])
    values = np.concatenate([first**2, 1 - 3 * (second - 1)])
    jerk, stop = sampled(times, values, starts=[11]).jumps
    assert jerk.time == 1.0
    assert jerk.value == pytest.approx((1.0, 1.0))
    assert jerk.velocity == pytest.approx((2.0, -3.0))
    assert stop.velocity == pytest.approx((-3.0, 0.0))


def test_a_segment_starts_where_the_last_one_ended():
    jerk, _ = sampled([0, 1, 2, 3], [0, 1, 0, -1], starts=[2]).jumps
    assert (jerk.time, jerk.value) == (1.0, (1.0, 1.0))
    assert jerk.velocity == pytest.approx((2.0, -1.0))


def test_a_repeated_time_with_another_value_is_a_shift():
    shift, _ = sampled([0, 1, 1, 2], [0, 1, 4, 5], starts=[2]).jumps
    assert (shift.time, shift.value) == (1.0, (1.0, 4.0))


def test_noise_is_smoothed_away():
    rng = np.random.default_rng(6)
    times = np.linspace(0, 3, 301)
    true = 1 - np.cos(2 * times)
    noisy = true + 0.01 * rng.standard_normal(len(times))
    smooth, rough = sampled(times, noisy, noise=0.01), sampled(times, noisy)
    within = times[20:-20]
    assert np.max(np.abs(smooth.value(within) - true[20:-20])) < 0.01
    speeds = 2 * np.sin(2 * within)
    assert np.max(np.abs(smooth.velocity(within) - speeds)) < 0.2
    assert np.max(np.abs(rough.velocity(within) - speeds)) > 1.0
    distance = smooth.value(times[1:-1]) - noisy[1:-1]
    assert np.sqrt(np.mean(distance**2)) == pytest.approx(0.01, rel=0.05)
    assert smooth.velocity(0.0) == 0.0


def test_smoothing_agrees_with_scipy():
    rng = np.random.default_rng(9)
    times = np.cumsum(rng.uniform(0.2, 2.0, 200))
    values = np.sin(times / 20) + 0.1 * rng.standard_normal(200)
    for stiffness in (1e-6, 1.0, 1e3):
        ours, bend = _smoothed(times, values, stiffness)
        theirs = make_smoothing_spline(times, values, lam=stiffness)
        assert ours == pytest.approx(theirs(times), abs=1e-10)
        assert bend == pytest.approx(theirs(times, 2), abs=1e-10)


def test_smoothed_segments_stay_together():
    rng = np.random.default_rng(7)
    times = np.concatenate([np.linspace(0, 1, 51), np.linspace(1, 2, 51)])
    values = np.minimum(times**2, 2 - times) + 0.001 * rng.standard_normal(len(times))
    jerk, _ = sampled(times, values, starts=[51], noise=0.001).jumps
    assert jerk.value[0] == pytest.approx(jerk.value[1], abs=1e-12)
    assert jerk.velocity == pytest.approx((2.0, -1.0), abs=0.3)


def test_noise_larger_than_the_motion_leaves_rest():
    rng = np.random.default_rng(8)
    still = sampled(np.linspace(0, 1, 50), 1e-3 * rng.standard_normal(50), noise=1e-2)
    assert np.max(np.abs(still.velocity(np.linspace(0, 1, 99)))) < 1e-4


def test_noise_too_small_to_tell_leaves_the_samples():
    times = np.linspace(0, 1, 20)
    curve = sampled(times, np.sin(9 * times) ** 2, noise=1e-14)
    assert curve.value(times) == pytest.approx(np.sin(9 * times) ** 2, abs=1e-6)


@pytest.mark.parametrize(
    ("times", "values", "more", "message"),
    [
        ([0, 1], [0, 1, 2], {}, "one value for each time"),
        ([0, 1, 1], [0, 1, 2], {}, "times that increase"),
        ([0, 2, 1], [0, 1, 2], {}, "times that increase"),
        ([0, 1, 0.5, 2], [0, 1, 2, 3], {"starts": [2]}, "times that increase"),
        ([0], [0], {}, "at least 2"),
        ([], [], {}, "at least 2"),
        ([0, 1, 2], [0, 1, 2], {"starts": [2]}, "at least 2"),
        ([0, 1], [0, 1], {"noise": 0.1}, "at least 3"),
        ([0, 1], [0, math.nan], {}, "numbers"),
        ([0, math.inf], [0, 1], {}, "numbers"),
        ([0, 1], [0, 1], {"noise": -1.0}, "standard deviation"),
        ([0, 1], [0, 1], {"noise": math.nan}, "standard deviation"),
        ([0, 1e-200], [0, 1e200], {}, "moderate size"),
    ],
)
def test_invalid_samples_are_refused(times, values, more, message):
    with pytest.raises(NumericError, match=message):
        sampled(times, values, **more)


# -- Python functions ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("function", "rate"),
    [
        (lambda t: math.sin(3 * t) / 20, lambda t: 3 * math.cos(3 * t) / 20),
        (lambda t: math.exp(-t) * math.sin(9 * t) + 5, None),
        (lambda t: 1 / (1 + (t - 2) ** 2), lambda t: -2 * (t - 2) / (1 + (t - 2) ** 2) ** 2),
        (lambda t: 0.25, lambda t: 0.0),
        (lambda t: 0, None),
    ],
)
def test_a_function_to_rounding(function, rate):
    curve = approximated(function, 0.0, 6.0)
    times = np.linspace(0, 5.999, 700)
    assert curve.value(times) == pytest.approx([function(t) for t in times], abs=1e-12)
    assert all(jump.time in (0.0, 6.0) for jump in curve.jumps)
    if rate is not None:
        assert curve.velocity(times) == pytest.approx([rate(t) for t in times], abs=1e-10)


def test_large_terms_may_cancel():
    """Where they do, the function's own rounding is larger than its values tell."""
    random = np.random.default_rng(1)
    for _ in range(60):
        a, b, w, p = *random.normal(size=2), *random.uniform(0.1, 6.0, 2)
        offset = 10 ** random.uniform(-2, 1)

        def function(t, a=a, b=b, w=w, p=p, offset=offset):
            return offset + a * math.sin(w * t + p) + b * math.exp(-t) * math.tanh(3 * (t - 1))

        curve = approximated(function, 0.0, 6.0)
        times = np.linspace(0, 5.999, 100)
        assert curve.value(times) == pytest.approx([function(t) for t in times], abs=1e-12)


def test_pieces_of_a_function_meet_with_equal_rates():
    curve = approximated(lambda t: math.sin(5 * t), 0.0, 4.0)
    reach = np.diff(curve.knots)[:-1]
    for order in range(2):
        ends = _derivatives(curve.coefficients[:-1], reach, order)
        assert ends == pytest.approx(curve.coefficients[1:, order], abs=2e-14)


def test_given_corners_are_jumps():
    curve = approximated(lambda t: abs(t - 1) + (t >= 2), 0.0, 3.0, corners=[2, 1])
    jerks = {jump.time: jump for jump in curve.jumps}
    assert jerks[1.0].velocity == pytest.approx((-1.0, 1.0))
    assert jerks[1.0].value == pytest.approx((0.0, 0.0), abs=1e-14)
    assert jerks[2.0].value == pytest.approx((1.0, 2.0))


def _fails(t):
    raise KeyError("no such time")


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (lambda t: abs(t - 1), r"not smooth near t = 1 s.*corner"),
        (lambda t: abs(t - 1.5), r"not smooth near t = 1.5 s"),
        (lambda t: t if t < 0.75 else 0.1 + t, r"not smooth near t = 0.75 s"),
        (lambda t: math.sin(t) + (t >= 0.75) * 1e-9, r"not smooth near t = 0.75 s"),
        (math.sqrt, "not smooth near t = 0"),
        (lambda t: float(int(t * 1e6) % 7), "not smooth"),
        (lambda t: 1 / (t - 1), "not smooth near t = 1|not smooth near t = 0.99"),
        (lambda t: math.nan, "not finite at t"),
        (lambda t: math.inf if t > 1 else 0.0, "not finite at t"),
        (lambda t: "fast", "fails between"),
        (lambda t: 1j, "fails between"),
        (_fails, "no such time"),
    ],
)
def test_invalid_functions_are_refused(function, message):
    with pytest.raises(NumericError, match=message):
        approximated(function, 0.0, 3.0)


@pytest.mark.parametrize("span", [(0.0, 0.0), (1.0, 0.0), (0.0, math.inf), (math.nan, 1.0)])
def test_spans_without_length(span):
    with pytest.raises(NumericError, match="span"):
        approximated(math.sin, *span)

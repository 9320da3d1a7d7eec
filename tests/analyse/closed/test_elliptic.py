"""Elliptic functions by their complementary parameter, and phases after many turns."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import ellipkm1

from polhode.analyse.closed._elliptic import (
    EllipticPhase,
    first_kind,
    jacobi,
    quarter_period,
    third_kind,
    third_kind_complete,
)
from polhode.analyse.closed._reals import Digits, DoubleReals

DOUBLES = DoubleReals()
CONTEXT = mpmath.MPContext()
CONTEXT.dps = 60
PARAMETERS = [1.0, 0.5, 1e-3, 1e-12, 1e-30]

complementary = st.floats(-40, 0).map(lambda exponent: 10.0**exponent)
fractions = st.floats(-0.999, 0.999)


@given(complementary, fractions)
def test_jacobi_functions(m1, fraction):
    u = fraction * ellipkm1(m1)
    exact = [
        CONTEXT.ellipfun(name, CONTEXT.mpf(u), m=1 - CONTEXT.mpf(m1)) for name in ("sn", "cn", "dn")
    ]
    for value, reference in zip(jacobi(DOUBLES, np.array(u), m1), exact, strict=True):
        assert float(value) == pytest.approx(float(reference), rel=1e-12, abs=1e-15)


@pytest.mark.parametrize("m1", PARAMETERS)
def test_digits_are_all_there(m1):
    u = CONTEXT.mpf("1.234567")
    found = jacobi(Digits(CONTEXT), u, CONTEXT.mpf(m1))
    for name, value in zip(("sn", "cn", "dn"), found, strict=True):
        assert abs(value - CONTEXT.ellipfun(name, u, m=1 - CONTEXT.mpf(m1))) < 1e-55


def test_on_the_separatrix():
    u = np.linspace(-20, 20, 41)
    sn, cn, dn = jacobi(DOUBLES, u, 0.0)
    np.testing.assert_allclose(sn, np.tanh(u), rtol=1e-15)
    np.testing.assert_allclose(cn, 1 / np.cosh(u), rtol=1e-15)
    np.testing.assert_array_equal(cn, dn)


@given(complementary)
def test_quarter_period_keeps_every_digit(m1):
    assert float(quarter_period(CONTEXT, CONTEXT.mpf(m1))) == pytest.approx(ellipkm1(m1), rel=1e-15)


@given(complementary, st.floats(-2, 2))
def test_first_kind_is_the_inverse(m1, fraction):
    m1 = CONTEXT.mpf(m1)
    u = fraction * 0.999 * quarter_period(CONTEXT, m1)
    sn, cn, _ = jacobi(Digits(CONTEXT), u, m1)
    assert abs(first_kind(CONTEXT, sn, cn, m1) - u) < 1e-30


@given(st.floats(-12, 0), st.floats(-3, 3), fractions)
def test_third_kind(exponent, lean, fraction):
    m1, n1 = CONTEXT.mpf(10.0**exponent), CONTEXT.mpf(10.0**lean)
    u = fraction * quarter_period(CONTEXT, m1)
    sn, cn, _ = jacobi(Digits(CONTEXT), u, m1)
    exact = CONTEXT.ellippi(1 - n1, CONTEXT.atan2(sn, cn), 1 - m1)
    assert abs(third_kind(Digits(CONTEXT), u, sn, cn, n1, m1) - exact) < 1e-45 * (1 + abs(exact))
    found = third_kind(DOUBLES, *map(float, (u, sn, cn, n1, m1)))
    assert found == pytest.approx(float(exact), rel=1e-13, abs=1e-15 * (1 + abs(float(u))))


def test_complete_third_kind():
    m1, n1 = CONTEXT.mpf("0.3"), CONTEXT.mpf("0.7")
    exact = CONTEXT.ellippi(1 - n1, 1 - m1)
    assert abs(third_kind_complete(CONTEXT, n1, m1) - exact) < 1e-55


@given(st.floats(-1e9, 1e9), st.integers(1, 10**9), st.integers(-(10**9), 10**9))
def test_whole_turns_are_taken_off_without_rounding(time, above, offset):
    frequency, start = Fraction(above, 987654321), Fraction(offset, 10**8)
    found = DOUBLES.turns(
        np.array(time), CONTEXT.mpf(above) / 987654321, CONTEXT.mpf(offset) / 10**8
    )
    exact = Fraction(time) * frequency + start
    assert abs(found.fraction) <= 0.5
    error = exact - (Fraction(float(found.whole)) + Fraction(float(found.fraction)))
    assert abs(error) < Fraction(1, 10**15)


def test_a_phase_is_as_exact_after_many_turns():
    phase = EllipticPhase(CONTEXT, CONTEXT.mpf("1.7"), CONTEXT.mpf("0.3"), CONTEXT.mpf("1e-9"))
    times = np.array([0.0, 1.0, 12345.678, 1e6, 123456789.1])
    doubles = phase.at(DOUBLES, times)
    digits = phase.at(Digits(CONTEXT), Digits(CONTEXT).array(times))
    for found, exact in zip(doubles[2:], digits[2:], strict=True):
        np.testing.assert_allclose(found, exact.astype(float), rtol=0, atol=5e-15)
    grown = phase.third_kind(DOUBLES, times, 0.2)
    exact = phase.third_kind(Digits(CONTEXT), Digits(CONTEXT).array(times), CONTEXT.mpf(0.2))
    np.testing.assert_allclose(grown, exact.astype(float), rtol=1e-14)

"""Pendulum and gyrocompass, in every case of the swing, against their equations."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.special import ellipk

from analyse.systems import equations
from analyse.textbook import assert_obeys, gyrocompass, integrated
from polhode.algebra import Expr, pi, sqrt
from polhode.analyse.closed._closed_form import ClosedForm, closed_form
from polhode.base import NumericError

#: I₂ + M a² = 2 and M g a = 2: θ̈ = sin θ.
GYROSCOPE = {"M": 1, "a": 1, "I_1": 1, "I_2": 1, "g": 2}


def fall(digits=None, **start) -> ClosedForm:
    return closed_form(equations("gyroscope/vertical-plane"), GYROSCOPE, start, digits)


def seek(ratio, Omega, colatitude, digits=None, **start) -> ClosedForm:
    """A free rotor with I₃/I₁ = ratio."""
    numbers = {"I_1": 1, "I_3": ratio, "Omega": Omega, "lambda_": colatitude}
    return closed_form(equations("gyrocompass"), numbers, start, digits)


def driven(ratio, Omega, omega_0, digits=None, **start) -> ClosedForm:
    """A rotor at the equator kept at the rate ω₀ by a motor."""
    numbers = {"I_1": 1, "I_3": ratio, "Omega": Omega, "lambda_": pi / 2, "omega_0": omega_0}
    return closed_form(equations("gyrocompass/motor"), numbers, start, digits)


@settings(max_examples=30, deadline=None)
@given(st.floats(-4.0, 4.0), st.floats(-3.0, 3.0))
def test_pendulum_obeys_its_equation(theta, theta_dot):
    assume(theta_dot or np.sin(theta))
    motion = fall(50, theta=theta, theta_dot=theta_dot, omega_1=2)
    sin = motion.data.context.sin
    assert_obeys(motion, lambda t, y: (y[1], sin(y[0])), ("theta", "theta_dot"), at="5.5")
    assert float(motion.at("5.5")["psi"]) == 11.0


def test_beside_an_integration():
    times = np.linspace(0, 6, 25)
    exact = integrated(lambda t, y: (y[1], np.sin(y[0])), (0.3, 0.5), times)
    found = fall(theta=0.3, theta_dot=0.5).at(times)
    np.testing.assert_allclose(found["theta"], exact[:, 0], rtol=0, atol=1e-11)
    np.testing.assert_allclose(found["theta_dot"], exact[:, 1], rtol=0, atol=1e-11)


def test_fall_from_a_tenth_of_a_radian():
    """ "The time for the gyro to fall to θ = π is about 0.7T", T of a small swing (after 141)."""
    motion = fall(theta=0.1)
    ratio = motion.figures["time_to_lowest"] / (2 * np.pi)
    assert round(ratio, 1) == 0.7
    assert ratio == pytest.approx(ellipk(np.cos(0.05) ** 2) / (2 * np.pi), rel=1e-14)
    at_lowest = motion.at(motion.figures["time_to_lowest"])
    assert at_lowest["theta"] == pytest.approx(np.pi, rel=1e-15)
    assert at_lowest["theta_dot"] == pytest.approx(2 * np.cos(0.05), rel=1e-14)
    assert motion.at(motion.figures["time_to_horizontal"])["theta"] == pytest.approx(np.pi / 2)


@pytest.mark.parametrize("theta", [1e-3, 1e-8, 1e-16, 1e-100])
def test_release_near_the_upright(theta):
    """The fall takes ln(8/θ) to leading order, and no digit is lost to cos θ = 1."""
    motion = fall(theta=theta)
    assert motion.figures["time_to_lowest"] == pytest.approx(np.log(8 / theta), rel=theta)
    assert motion.at(0.0)["theta"] == pytest.approx(theta, rel=1e-13)
    finer = fall(theta=theta, digits=120)
    assert motion.period == pytest.approx(float(finer.period), rel=2e-16)


@pytest.mark.parametrize("sign", [1, -1])
def test_pendulum_on_its_separatrix(sign):
    """From the lowest point with just enough to reach the top: ϑ = 2 atan sinh t."""
    motion = fall(theta=pi, theta_dot=2 * sign)
    times = np.linspace(-12, 12, 25)
    found = motion.at(times)["theta"]
    exact = np.pi + sign * 2 * np.arctan(np.sinh(times))
    np.testing.assert_allclose(found, exact, rtol=0, atol=2e-15)
    assert motion.kind == "separatrix"
    assert "time_to_horizontal" in motion.figures
    with pytest.raises(NumericError, match="separatrix"):
        _ = motion.period


def test_pendulum_turning_over_counts_its_turns():
    motion = fall(theta=0.3, theta_dot=2.5)
    after = motion.at(motion.period * np.array([0, 1, 10, 1000]))
    np.testing.assert_allclose(
        after["theta"], 0.3 + 2 * np.pi * np.array([0, 1, 10, 1000]), rtol=1e-14
    )
    np.testing.assert_allclose(after["theta_dot"], 2.5, rtol=1e-12)


def test_upright_pendulum_is_steady():
    with pytest.raises(NumericError, match="steady motion"):
        _ = fall(theta=0, omega_1=5).period


@settings(max_examples=40, deadline=None)
@given(
    st.floats(0.4, 1.9),
    st.floats(0.2, 2.0),
    st.floats(0.3, 2.8),
    st.floats(-3.0, 3.0),
    st.floats(-2.0, 2.0),
    st.floats(-2.5, 2.5),
)
def test_free_gyrocompass_is_exact_in_the_earths_rate(
    ratio, Omega, colatitude, theta, theta_dot, omega
):
    """Rates as large as the spin: swings across north and south, beside them, and turning over."""
    assume(theta_dot or np.sin(theta))
    start = {"theta": theta, "theta_dot": theta_dot, "omega": omega}
    motion = seek(ratio, Omega, colatitude, digits=50, **start)
    rates = gyrocompass(*map(motion.data.context.mpf, (ratio, Omega, colatitude)))
    assert_obeys(motion, rates, tuple(start), at="4.25")


CASES = [
    (0.5, 0.1, "swing"),
    (0.5, 3.0, "turning over"),
    (3.0, 0.2, "swing"),
    (-3.0, 0.2, "swing"),
    (0.1, 0.05, "swing on one side"),
    (0.1, 1.5, "turning over"),
]


@pytest.mark.parametrize(("omega", "theta_dot", "kind"), CASES)
def test_cases_of_a_free_rotor(omega, theta_dot, kind):
    motion = seek(1.0, 1.0, pi / 2, theta=1.4, theta_dot=theta_dot, omega=omega)
    assert motion.kind == kind
    period = motion.period
    again = motion.at([0.0, period, 7 * period])
    turns = (again["theta"] - 1.4) / (2 * np.pi)
    np.testing.assert_allclose(turns, np.rint(turns), rtol=0, atol=1e-14)
    np.testing.assert_allclose(again["theta_dot"], theta_dot, rtol=0, atol=1e-13)


@settings(max_examples=40, deadline=None)
@given(st.floats(0.4, 1.9), st.floats(-1.5, 1.5), st.floats(-3.0, 3.0), st.floats(-2.0, 2.0))
def test_motor_driven_gyrocompass(ratio, omega_0, theta, theta_dot):
    """With a slow motor and I₃ > I₁ north and south are both wells."""
    assume(theta_dot or np.sin(theta))
    motion = driven(ratio, 1.25, omega_0, 50, theta=theta, theta_dot=theta_dot)
    context = motion.data.context
    third, Omega, kept = map(context.mpf, (ratio, 1.25, omega_0))

    def rates(t, y):
        pull = (1 - third) * Omega * context.cos(y[0]) - third * kept
        return y[1], Omega * context.sin(y[0]) * pull

    assert_obeys(motion, rates, ("theta", "theta_dot"), at="4.25")


@pytest.mark.parametrize(("theta", "origin"), [(0.2, 0), (np.pi - 0.2, np.pi)])
def test_two_wells_of_a_motor_at_rest(theta, origin):
    """ω₀ = 0 and I₃ > I₁: the rotor settles either way; small swings at Ω √(I₃/I₁-1)."""
    motion = driven(1.5, 2.0, 0, theta=theta)
    assert motion.kind == "swing"
    assert motion.figures["origin"] == pytest.approx(origin)
    assert motion.figures["amplitude"] == pytest.approx(0.2, rel=1e-13)
    assert motion.figures["small_swing_frequency"] == pytest.approx(2 * np.sqrt(0.5), rel=1e-15)


def test_separatrix_between_two_wells():
    """2ẋ² has a double root where θ̇ = Ω √(I₃/I₁-1) cos θ: ϑ tends to π/2."""
    motion = driven(1.5, 2, 0, theta=0, theta_dot=sqrt(Expr.of(2)))
    assert motion.kind == "separatrix"
    assert motion.at(40.0)["theta"] == pytest.approx(np.pi / 2, rel=1e-15)
    assert motion.at(1.0)["theta"] == pytest.approx(np.arcsin(np.tanh(np.sqrt(2))), rel=1e-14)


def test_separatrix_beside_an_unstable_north():
    """A bead on a fast hoop: θ leaves 0, turns at cos θ = 2A/B - 1, and comes back.

    Here A = n = ω - cos θ... with B = 1: energy -A, from the turning point.
    """
    motion = seek(1, 1, pi / 2, theta=pi / 2, theta_dot=0, omega=Expr.of(1) / 2)
    assert motion.kind == "separatrix"
    assert motion.at(50.0)["theta"] < 1e-14
    with pytest.raises(NumericError, match="separatrix"):
        _ = motion.period


EARTH = {"Omega": 7.2921159e-5, "colatitude": np.radians(50)}


def test_small_swings_of_the_hoop():
    """Frequency √(2ωΩ sin λ) to the first order in Ω (equations 68 and 74)."""
    omega = 100 * np.pi
    motion = seek(2, **EARTH, theta=1e-6, omega=omega)
    first = np.sqrt(2 * omega * EARTH["Omega"] * np.sin(EARTH["colatitude"]))
    found = 2 * np.pi / motion.period
    assert found == pytest.approx(first, rel=EARTH["Omega"] / omega)
    assert found != pytest.approx(first, rel=1e-9)
    assert motion.figures["small_swing_frequency"] == pytest.approx(found, rel=1e-11)
    assert motion.figures["first_order_period"] == pytest.approx(2 * np.pi / first, rel=1e-12)


def test_large_swing_to_the_first_order_is_a_pendulum():
    omega, amplitude = 100 * np.pi, 2.0
    motion = seek(2, **EARTH, theta=amplitude, omega=omega)
    first = np.sqrt(2 * omega * EARTH["Omega"] * np.sin(EARTH["colatitude"]))
    expected = 4 * ellipk(np.sin(amplitude / 2) ** 2) / first
    assert motion.figures["first_order_period"] == pytest.approx(expected, rel=1e-14)
    assert motion.period == pytest.approx(expected, rel=EARTH["Omega"] / omega)


def test_first_order_beside_the_exact_motion():
    """Equation 68, in which the spin is constant: a pendulum, off by the order of Ω/ω."""
    motion = seek(2, **EARTH, theta=1.0, omega=100 * np.pi)
    times = np.linspace(0, 2 * motion.period, 9)
    first = motion.besides(times)
    squared = 2 * 100 * np.pi * EARTH["Omega"] * np.sin(EARTH["colatitude"])
    pendulum = integrated(lambda t, y: (y[1], -squared * np.sin(y[0])), (1.0, 0.0), times)
    np.testing.assert_allclose(first["first_order_theta"], pendulum[:, 0], rtol=0, atol=1e-11)
    np.testing.assert_allclose(first["first_order_theta_dot"], pendulum[:, 1], rtol=0, atol=1e-11)
    difference = np.max(np.abs(motion.at(times)["theta"] - first["first_order_theta"]))
    assert 1e-9 < difference < 1e-5


def test_pointing_north_is_steady():
    assert seek(2, **EARTH, theta=0, omega=300).kind == "steady motion"

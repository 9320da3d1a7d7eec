"""The free body against Euler's equations, its integrals, and the classical limits."""

from itertools import permutations, product

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.special import ellipkm1

import polhode as ph
from analyse.systems import equations
from analyse.textbook import assert_obeys, euler, integrated
from polhode.algebra import Expr, sqrt
from polhode.analyse.closed._closed_form import ClosedForm, closed_form
from polhode.base import NumericError
from polhode.derive import derive

SPEEDS = ("omega_1", "omega_2", "omega_3")


def free(moments, omega, digits=None) -> ClosedForm:
    names = ("I_1", "I_2", "I_3")
    return closed_form(
        equations("tennis-racquet"),
        dict(zip(names, moments, strict=True)),
        dict(zip(SPEEDS, omega, strict=True)),
        digits,
    )


def values(motion: ClosedForm, times) -> np.ndarray:
    found = motion.at(times)
    return np.stack([found[name] for name in SPEEDS], axis=-1)


moment = st.floats(0.5, 2.0)
component = st.floats(-3.0, 3.0).filter(lambda w: abs(w) > 1e-3)


@settings(max_examples=40, deadline=None)
@given(moment, moment, st.floats(0.01, 0.99), component, component, component)
def test_every_branch_obeys_eulers_equations(I_1, I_2, share, w1, w2, w3):
    """Any order of the moments, any signs, either axis circled."""
    moments = np.array([I_1, I_2, abs(I_1 - I_2) + share * 2 * min(I_1, I_2)])
    moments[2] = min(moments[2], 0.999 * (I_1 + I_2))
    assume(min(abs(moments - np.roll(moments, 1))) > 0.01)
    motion = free(moments, (w1, w2, w3), digits=50)
    exact = map(motion.data.context.mpf, moments)
    assert_obeys(motion, euler(*exact), SPEEDS, at="3.75")


@pytest.mark.parametrize("omega", [(0.3, -1.1, 2.7), (2.0, 0.4, -0.3), (-0.2, 1.0, 0.1)])
def test_beside_an_integration(omega):
    motion, times = free((1.0, 2.0, 3.0), omega), np.linspace(0, 5, 21)
    exact = integrated(euler(1.0, 2.0, 3.0), omega, times)
    np.testing.assert_allclose(values(motion, times), exact, rtol=0, atol=1e-11)


@pytest.mark.parametrize("moments", list(permutations((1.0, 1.4, 2.1))))
def test_integrals_are_kept_to_rounding(moments):
    motion = free(moments, (0.3, -1.1, 0.7))
    omega = values(motion, np.linspace(0, 1e6 * motion.period, 1001))
    energy = omega**2 @ np.array(moments)
    momentum = omega**2 @ np.array(moments) ** 2
    np.testing.assert_allclose(energy, energy[0], rtol=3e-15)
    np.testing.assert_allclose(momentum, momentum[0], rtol=3e-15)


@pytest.mark.parametrize("turns", [1, 1000, 10**6])
def test_doubles_stay_exact_for_a_million_rotations(turns):
    moments, omega = (1.0, 2.0, 3.0), (0.1, 2.0, 0.3)
    doubles, digits = free(moments, omega), free(moments, omega, digits=30)
    times = doubles.period * (turns + np.linspace(0, 1, 25))
    np.testing.assert_allclose(
        values(doubles, times), values(digits, times).astype(float), rtol=0, atol=2e-14
    )


@pytest.mark.parametrize("signs", list(product((1, -1), repeat=3)))
def test_separatrix_in_all_branches_of_sign(signs):
    """Equations 12 to 14: T = L²/2I₂ holds exactly, as 1·(2-1)·3 = 3·(3-2)·1."""
    s1, s2, s3 = signs
    motion = free((1, 2, 3), (s1 * sqrt(Expr.of(3)), s2, s3))
    assert motion.kind == "separatrix"
    L = np.sqrt(3 + 4 + 9)
    largest, k = L / 2, np.sqrt(1 / 3)
    t = np.linspace(-10, 10, 41)
    found = values(motion, t)
    sense = s1 * s3
    u = k * largest * sense * t + np.arctanh(s2 / largest)
    np.testing.assert_allclose(found[:, 1], largest * np.tanh(u), rtol=1e-13, atol=1e-15)
    np.testing.assert_allclose(found[:, 0], s1 * largest / np.cosh(u), rtol=1e-13)
    third = s3 * largest * np.sqrt(2 / 3 * 1 / 2) / np.cosh(u)
    np.testing.assert_allclose(found[:, 2], third, rtol=1e-13)
    with pytest.raises(NumericError, match="separatrix"):
        _ = motion.period
    assert motion.conditioning is None


@pytest.mark.parametrize("perturbation", [1e-3, 1e-8, 1e-20])
def test_period_near_the_separatrix_loses_nothing(perturbation):
    """From rotation about the middle axis, disturbed: m₁ goes as the square of the disturbance."""
    A, B, C, w = 1.0, 2.0, 3.0, 5.0
    motion = free((A, B, C), (perturbation, w, 0))
    excess = A * (A - B) * perturbation**2
    above = excess + B * (B - C) * w**2 + A * (A - C) * perturbation**2 - excess
    m1 = (A - C) * excess / ((A - B) * above)
    expected = 4 * ellipkm1(m1) / np.sqrt((A - B) * above / (A * B * C))
    assert motion.period == pytest.approx(expected, rel=1e-15)
    finer = free((A, B, C), (perturbation, w, 0), digits=60)
    assert motion.period == pytest.approx(float(finer.period), rel=2e-16)


def test_period_diverges_as_the_logarithm():
    periods = [free((1, 2, 3), (d, 5, 0)).period for d in (1e-5, 1e-10, 1e-15)]
    steps = np.diff(periods)
    assert steps[0] == pytest.approx(steps[1], rel=1e-8)
    growth = np.sqrt((3 - 2) * (2 - 1) / (1 * 3)) * 5
    assert steps[0] == pytest.approx(4 * np.log(1e5) / growth, rel=1e-8)


def test_conditioning_grows_near_the_separatrix():
    calm, delicate = free((1, 2, 3), (0.1, 0.2, 5)), free((1, 2, 3), (1e-6, 5, 1e-6))
    assert calm.conditioning < 10
    assert delicate.conditioning < 10
    assert calm.stepwise_conditioning < 10
    assert delicate.stepwise_conditioning > 1e9


@given(st.floats(0.3, 1.9).filter(lambda r: abs(r - 1) > 0.01), component, component, component)
@settings(max_examples=30, deadline=None)
def test_symmetric_body_precesses_in_itself(ratio, w1, w2, w3):
    """ω turns about the symmetry axis at (I₃/I₁ - 1) ω₃ (Goldstein, 5.6)."""
    motion = free((1, 1, ratio), (w1, w2, w3))
    rate = (ratio - 1) * w3
    t = np.linspace(0, 3, 7)
    turned = (w1 + 1j * w2) * np.exp(1j * rate * t)
    found = values(motion, t)
    np.testing.assert_allclose(found[:, 0] + 1j * found[:, 1], turned, rtol=0, atol=1e-13)
    np.testing.assert_allclose(found[:, 2], w3, rtol=1e-15)
    assert motion.period == pytest.approx(2 * np.pi / abs(rate), rel=1e-14)


STARTS = [(0.3, -1.1, 2.7), (2.0, 0.4, -0.3), (0.2, 1.0, -0.1), (sqrt(Expr.of(3)), 1, 1)]


@pytest.mark.parametrize("start", STARTS)
def test_attitude_by_integration(start):
    """Directions at rest in space turn at -ω in the body; L is one of them."""
    motion = free((1, 2, 3), start)
    times = np.linspace(0, 4, 9)
    found = motion.besides(times)
    attitude, omega = found["attitude"], values(motion, times)

    def rates(t, y):
        w, axes = y[:3], y[3:].reshape(3, 3)
        return np.concatenate([euler(1, 2, 3)(t, w), np.cross(axes, w).ravel()])

    begin = np.concatenate([omega[0], attitude[0].ravel()])
    exact = solve_ivp(rates, (0, 4), begin, "DOP853", times, rtol=1e-13, atol=1e-13).y.T
    np.testing.assert_allclose(attitude.reshape(9, 9), exact[:, 3:], rtol=0, atol=1e-10)
    momentum = np.einsum("tij,tj->ti", attitude, omega * np.array([1, 2, 3]))
    length = motion.figures["momentum"]
    np.testing.assert_allclose(momentum, np.tile([0, 0, length], (9, 1)), rtol=0, atol=1e-14 * 10)
    seen = np.einsum("tij,tj->ti", attitude, omega)
    np.testing.assert_allclose(seen[:, 0], found["herpolhode_1"], rtol=0, atol=1e-13)
    np.testing.assert_allclose(seen[:, 1], found["herpolhode_2"], rtol=0, atol=1e-13)
    twice_energy = omega[0] ** 2 @ np.array([1, 2, 3])
    np.testing.assert_allclose(seen[:, 2], twice_energy / length, rtol=1e-14)


def test_turn_about_the_momentum_in_a_period():
    motion = free((1.0, 1.7, 2.2), (0.6, 0.9, 1.3))
    turned = motion.besides([0.0, motion.period])["precession"]
    assert turned[0] == 0
    assert turned[1] == pytest.approx(motion.figures["precession_per_period"], rel=1e-14)


def test_rotation_about_an_axis_has_no_period():
    motion = free((1, 2, 3), (0, 5, 0))
    assert motion.kind == "steady motion"
    np.testing.assert_array_equal(motion.at([0.0, 9.0])["omega_2"], [5, 5])
    with pytest.raises(NumericError, match="the period of free body: steady motion"):
        _ = motion.period


def test_a_body_of_other_names_is_the_same():
    A, B, C, m = ph.symbols("A B C m", positive=True)
    alpha, beta, gamma = ph.coordinates("alpha beta gamma")
    axes = ph.Frame("space").rotated(alpha, "z").rotated(beta, "x").rotated(gamma, "z")
    stone = ph.Body(
        "stone",
        mass=m,
        inertia=(C, A, B),
        axes=axes,
        spin=ph.Components(("alpha", "beta", "gamma")),
    )
    thrown = derive(ph.System(ph.Pivot(stone, name="centre"), name="stone"))
    speeds = [s.published for s in thrown.speeds]
    start = dict(zip(speeds, (0.3, -1.1, 0.7), strict=True))
    motion = closed_form(thrown, {"A": 2.0, "B": 3.0, "C": 1.5}, start)
    same = values(free((1.5, 2.0, 3.0), (0.3, -1.1, 0.7)), 7.0)
    np.testing.assert_array_equal([motion.at(7.0)[name] for name in speeds], same)

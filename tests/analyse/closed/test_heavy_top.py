"""The symmetric top against Lagrange's equations, and what texts say of its nutation."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import polhode as ph
from analyse.systems import equations
from analyse.textbook import assert_obeys, integrated, top
from polhode.algebra import Expr, sqrt
from polhode.analyse.closed._closed_form import ClosedForm, closed_form
from polhode.base import NumericError
from polhode.derive import derive

#: I₂ + M a² = 2 and M g a = 2, so that κ = I₁/2 and μ = 1.
NUMBERS = {"M": 1, "a": 1, "I_1": 1, "I_2": 1, "g": 2}
KAPPA, MU = 0.5, 1.0
NAMES = ("theta", "theta_dot", "phi", "phi_dot", "psi")


def spun(digits=None, numbers=NUMBERS, **start) -> ClosedForm:
    return closed_form(equations("gyroscope"), numbers, start, digits)


def values(motion: ClosedForm, times) -> np.ndarray:
    found = motion.at(times)
    return np.stack([found[name] for name in NAMES], axis=-1)


leaning = st.floats(0.3, 2.8)
turning = st.floats(-2.0, 2.0)


@settings(max_examples=6, deadline=None)
@given(leaning, turning, st.floats(-2.0, 2.0), st.floats(-12.0, 12.0), st.booleans())
def test_motion_obeys_lagranges_equations(theta, theta_dot, phi_dot, n, hanging):
    """Any spin of either sign, any start; above the pivot and below it."""
    assume(abs(phi_dot) + abs(n) > 1e-3)
    start = {"theta": theta, "theta_dot": theta_dot, "phi_dot": phi_dot, "omega_1": n}
    if hanging:
        begun = {BELOW[name]: value for name, value in start.items()}
        motion = closed_form(HANGING, NUMBERS, begun, 50)
    else:
        motion = spun(50, **start)
    assume(np.sin(float(motion.figures["theta_1"])) > 0.02)
    assume(np.sin(float(motion.figures["theta_2"])) > 0.02)
    mpf = motion.data.context.mpf
    rates = top(mpf(KAPPA), mpf(-MU if hanging else MU), mpf(n))
    names = tuple(BELOW[name] for name in NAMES) if hanging else NAMES
    assert_obeys(motion, rates, names, at="2.75")


STARTS = [(0.7, 0.3, 0.2, 6.0), (1.2, -1.0, 1.5, -3.0), (2.5, 0.0, -0.5, 9.0)]


@pytest.mark.parametrize(("theta", "theta_dot", "phi_dot", "n"), STARTS)
def test_beside_an_integration(theta, theta_dot, phi_dot, n):
    motion = spun(theta=theta, theta_dot=theta_dot, phi_dot=phi_dot, omega_1=n)
    times = np.linspace(0, 4, 17)
    exact = integrated(top(KAPPA, MU, n), (theta, theta_dot, 0.0, phi_dot, 0.0), times)
    np.testing.assert_allclose(values(motion, times), exact, rtol=0, atol=1e-10)


#: Names of the same in a top below its pivot.
BELOW = {
    "theta": "beta",
    "theta_dot": "beta_dot",
    "phi": "alpha",
    "phi_dot": "alpha_dot",
    "psi": "gamma",
    "omega_1": "omega_z",
}


def _hanging() -> ph.System:
    """A top below its pivot, with other names and θ from the upward vertical of another frame."""
    M, a, A, C, g = ph.symbols("M a I_2 I_1 g", positive=True)
    alpha, beta = ph.coordinates("alpha beta")
    axes = ph.Frame("space").rotated(alpha, "z").rotated(beta, "x")
    body = ph.Body("bob", mass=M, inertia=(A, A, C), axes=axes, spin=ph.About("z", "gamma"))
    return ph.System(body, ph.Pivot(body, at=axes["z"] * a), ph.Gravity(g), name="bob")


HANGING = derive(_hanging())


def test_release_from_rest():
    """Cusps at the start; at the lowest sin² θ₂ = 2λ (cos θ₁ - cos θ₂) (Goldstein, 5.7)."""
    n, theta = 6.0, np.pi / 3
    motion = spun(theta=theta, omega_1=n)
    assert motion.kind == "cusps"
    figures = motion.figures
    assert figures["theta_1"] == pytest.approx(theta, rel=1e-15)
    steepness = (KAPPA * n) ** 2 / (2 * MU)
    cos = np.cos(figures["theta_2"])
    assert np.sin(figures["theta_2"]) ** 2 == pytest.approx(steepness * (0.5 - cos), rel=1e-13)
    assert figures["phi_dot_least"] == 0
    at_lowest = KAPPA * n * (0.5 - cos) / np.sin(figures["theta_2"]) ** 2
    assert figures["phi_dot_greatest"] == pytest.approx(at_lowest, rel=1e-13)
    halfway = motion.at(motion.period / 2)
    assert halfway["theta"] == pytest.approx(figures["theta_2"], rel=1e-14)


def test_fast_top():
    """Nutation at κn, mean precession μ/κn, amplitude μ sin θ/(κn)² (Goldstein 5.7), to O(1/n²)."""
    n = 1e4
    beta, theta = KAPPA * n, 1.0
    figures = spun(theta=theta, omega_1=n).figures
    motion = spun(theta=theta, omega_1=n)
    assert motion.period == pytest.approx(2 * np.pi / beta, rel=10 / beta**2)
    assert figures["mean_precession"] == pytest.approx(MU / beta, rel=10 / beta**2)
    depth = figures["theta_2"] - figures["theta_1"]
    assert depth == pytest.approx(2 * MU * np.sin(theta) / beta**2, rel=10 / beta**2)


@pytest.mark.parametrize(
    ("phi_dot", "pattern"),
    [(-0.05, "loops"), (0, "cusps"), (0.05, "waves"), (0.2, "waves"), (1.0, "loops")],
)
def test_three_patterns(phi_dot, pattern):
    """By the azimuthal velocity at the highest point (figure 11-17 of Marion and Thornton)."""
    motion = spun(theta="60 deg", phi_dot=phi_dot, omega_1=6)
    assert motion.kind == pattern
    rates = motion.at(np.linspace(0, motion.period, 2001))["phi_dot"]
    assert rates.min() == pytest.approx(motion.figures["phi_dot_least"], abs=1e-14)
    assert rates.max() == pytest.approx(motion.figures["phi_dot_greatest"], rel=1e-14)
    assert (rates.min() < -1e-3) == (pattern == "loops")


@settings(max_examples=12, deadline=None)
@given(leaning, turning, turning, st.floats(1.0, 12.0))
def test_figures_by_sampling(theta, theta_dot, phi_dot, n):
    motion = spun(theta=theta, theta_dot=theta_dot, phi_dot=phi_dot, omega_1=n)
    figures, sample = motion.figures, motion.at(np.linspace(0, motion.period, 4001))
    assume(np.sin(sample["theta"]).min() > 0.2)
    assert sample["theta"].min() == pytest.approx(figures["theta_1"], abs=1e-5)
    assert sample["theta"].max() == pytest.approx(figures["theta_2"], abs=1e-5)
    spread = figures["phi_dot_greatest"] - figures["phi_dot_least"]
    assert sample["phi_dot"].min() == pytest.approx(figures["phi_dot_least"], abs=1e-4 * spread)
    assert sample["phi_dot"].max() == pytest.approx(figures["phi_dot_greatest"], abs=1e-4 * spread)
    turn = sample["phi"][-1] - sample["phi"][0]
    assert turn == pytest.approx(figures["precession_per_nutation"], abs=1e-12 * (1 + spread))
    assert sample["theta"][-1] == pytest.approx(theta, abs=1e-13)


def test_a_million_nutations_from_rest():
    doubles, digits = spun(theta=1.0, omega_1=6), spun(theta=1.0, omega_1=6, digits=30)
    times = doubles.period * np.array([0.25, 1000.5, 1e6])
    found, exact = values(doubles, times), values(digits, times).astype(float)
    np.testing.assert_allclose(found[:, :2], exact[:, :2], rtol=0, atol=1e-14)
    np.testing.assert_allclose(found[:, 2:], exact[:, 2:], rtol=3e-15, atol=1e-14)


@given(leaning, turning, turning.filter(lambda p: abs(p) > 0.1), st.floats(0.5, 9.0))
@settings(max_examples=12, deadline=None)
def test_without_gravity_the_axle_goes_round_a_cone(theta, theta_dot, phi_dot, n):
    """A free symmetric body precesses about L at L/I (Landau and Lifshitz, § 33)."""
    motion = closed_form(
        WEIGHTLESS,
        {"I_1": 1, "I_2": 2},
        {"theta": theta, "theta_dot": theta_dot, "phi_dot": phi_dot, "omega_3": n},
    )
    across = np.array([theta_dot, phi_dot * np.sin(theta)])
    momentum = np.hypot(np.hypot(*across), KAPPA * n)
    assert motion.period == pytest.approx(2 * np.pi / momentum, rel=1e-13)
    axle = _axle(motion, np.linspace(0, motion.period, 5))
    np.testing.assert_allclose(axle[0], axle[-1], rtol=0, atol=1e-11)
    np.testing.assert_allclose(axle[0] + axle[2], axle[1] + axle[3], rtol=0, atol=1e-11)


def _axle(motion: ClosedForm, times) -> np.ndarray:
    found = motion.at(times)
    theta, phi = found["theta"], found["phi"]
    flat = np.sin(theta)
    return np.stack([flat * np.cos(phi), flat * np.sin(phi), np.cos(theta)], axis=-1)


def _weightless() -> ph.System:
    m, first, third = ph.symbols("m I_2 I_1", positive=True)
    theta, phi = ph.coordinates("theta phi")
    axes = ph.Frame("space").rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    moments = (first, first, third)
    body = ph.Body("body", mass=m, inertia=moments, axes=axes, spin_about="3")
    return ph.System(ph.Pivot(body, name="centre"), name="free symmetric body")


WEIGHTLESS = derive(_weightless())


def test_rising_to_the_vertical_takes_for_ever():
    """Below the threshold of sleeping, with α = β and the energy of the sleeping top."""
    motion = spun(
        theta="60 deg",
        phi_dot=Expr.of(2) / 3,
        theta_dot=-sqrt(Expr.of(2) / 3),
        omega_1=2,
    )
    assert motion.kind == "separatrix"
    assert motion.figures["theta_1"] == 0
    exact = integrated(top(KAPPA, MU, 2.0), values(motion, 0.0), np.linspace(0, 6, 13))
    np.testing.assert_allclose(values(motion, np.linspace(0, 6, 13)), exact, rtol=0, atol=1e-6)
    assert motion.at(60.0)["theta"] < 1e-15
    with pytest.raises(NumericError, match="separatrix"):
        _ = motion.period


def test_sleeping_top_is_refused():
    with pytest.raises(NumericError, match="a sleeping top: theta is vertical at the start"):
        spun(omega_1=6)


def test_through_the_vertical_is_refused():
    with pytest.raises(NumericError, match="passes through the vertical, where phi jumps"):
        spun(theta=1, theta_dot=-3)


def test_steady_precession_has_no_period():
    """φ̇² cos θ - κ n φ̇ + μ = 0 with φ̇ = 1, cos θ = 1/2, κn = 3/2."""
    motion = spun(theta="60 deg", phi_dot=1, omega_1=3)
    assert motion.kind == "steady motion"
    found = motion.at(np.array([0.0, 10.0]))
    np.testing.assert_allclose(found["phi"], [0, 10], rtol=1e-15)
    np.testing.assert_allclose(found["psi"], [0, 25], rtol=1e-15)
    with pytest.raises(NumericError, match="expected a motion that repeats"):
        _ = motion.period


def test_spherical_pendulum():
    """A top without a spin: published turning angles of a conical swing with no constant of n."""
    m, l, g = ph.symbols("m l g", positive=True)
    theta, phi = ph.coordinates("theta phi")
    axes = ph.Frame("space").rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    bob = ph.Body("bob", mass=m, inertia=(0, 0, 0), axes=axes)
    pendulum = ph.System(bob, ph.Pivot(bob, at=axes["3"] * -l), ph.Gravity(g), name="pendulum")
    start = {"theta": 2.0, "theta_dot": 0.3, "phi_dot": 1.1}
    motion = closed_form(derive(pendulum), {"l": 1, "g": 1}, start)
    times = np.linspace(0, 5, 11)
    exact = integrated(top(0.0, 1.0, 0.0), (2.0, 0.3, 0.0, 1.1, 0.0), times)
    for name, column in zip(NAMES[:4], exact.T, strict=False):
        np.testing.assert_allclose(motion.at(times)[name], column, rtol=0, atol=1e-11)

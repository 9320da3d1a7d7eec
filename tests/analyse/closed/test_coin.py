"""The spinning coin by quadrature, against Lagrange's equations and what is said of it."""

import numpy as np
import pytest

from analyse.systems import equations
from analyse.textbook import coin, integrated
from polhode.algebra import pi
from polhode.analyse import ClosedForm, closed_form
from polhode.base import ConstraintError, NumericError

NUMBERS = {"m": 1, "a": 1, "g": 1}
NAMES = ("theta", "theta_dot", "phi", "phi_dot", "psi")


def spun(digits=None, **start) -> ClosedForm:
    return closed_form(equations("spinning-coin"), NUMBERS, start, digits)


STARTS = [(1.2, 0.0, 4.5, 1.0), (0.6, -0.4, 5.0, 2.0), (2.0, 0.3, 4.0, -1.5)]


@pytest.mark.parametrize(("theta", "theta_dot", "phi_dot", "n"), STARTS)
def test_beside_an_integration(theta, theta_dot, phi_dot, n):
    motion = spun(theta=theta, theta_dot=theta_dot, phi_dot=phi_dot, omega_3=n)
    times = np.linspace(0, 5, 21)
    exact = integrated(coin(1.0, 1.0, n), (theta, theta_dot, 0.0, phi_dot, 0.0), times)
    found = motion.at(times)
    for name, column in zip(NAMES, exact.T, strict=True):
        np.testing.assert_allclose(found[name], column, rtol=0, atol=1e-10)


def test_more_digits_agree():
    """To 25 digits, of which doubles are the rounded ones."""
    start = {"theta": 1.25, "theta_dot": 0.25, "phi_dot": 4.5, "omega_3": 1}
    doubles, digits = spun(**start), spun(25, **start)
    finer = digits.at(3.5)
    assert abs(finer["theta"] - spun(30, **start).at(3.5)["theta"]) < 1e-24
    for name, value in doubles.at(3.5).items():
        assert value == pytest.approx(float(finer[name]), rel=1e-14)


def test_figures_by_sampling():
    motion = spun(theta=1.2, phi_dot=4.5, omega_3=1)
    sample = motion.at(np.linspace(0, motion.period, 4001))
    figures = motion.figures
    assert sample["theta"].min() == pytest.approx(figures["theta_1"], abs=1e-5)
    assert sample["theta"].max() == pytest.approx(figures["theta_2"], abs=1e-5)
    turn = sample["phi"][-1] - sample["phi"][0]
    assert turn == pytest.approx(figures["precession_per_nutation"], rel=1e-13)
    assert sample["theta"][-1] == pytest.approx(1.2, abs=1e-13)


def test_energy_after_many_nutations():
    motion = spun(theta=1.2, phi_dot=4.5, omega_3=1)
    now = motion.at(motion.period * np.linspace(0, 1e6, 101))
    sin, cos = np.sin(now["theta"]), np.cos(now["theta"])
    swing = (1 + 4 * cos**2) * now["theta_dot"] ** 2
    energy = swing + (now["phi_dot"] * sin) ** 2 + 8 * sin
    momentum = now["phi_dot"] * sin**2 + 2 * cos
    np.testing.assert_allclose(energy, energy[0], rtol=1e-13)
    np.testing.assert_allclose(momentum, momentum[0], rtol=1e-13)


@pytest.mark.parametrize(("speed", "turned"), [("phi_dot", "phi"), ("omega_3", "psi")])
def test_both_classes_on_edge_are_steady(speed, turned):
    """Equations 26 and 27: spinning about the vertical diameter, and at rest about it."""
    motion = spun(theta=pi / 2, **{speed: 2.5})
    assert motion.kind == "steady motion"
    assert motion.at(4.0)[turned] == 10.0
    assert motion.conditioning is None


@pytest.mark.parametrize("above", [1e-3, 1e-6])
def test_small_nutation_on_edge(above):
    """θ̈ = -(Ω² - 4g/a) (θ - π/2) for spinning about the vertical diameter (after 26)."""
    motion = spun(theta=np.pi / 2 - above, phi_dot=3)
    assert motion.period == pytest.approx(2 * np.pi / np.sqrt(9 - 4), rel=10 * above**2)


def test_falling_flat_is_refused():
    with pytest.raises(NumericError, match="a coin that falls flat on the table"):
        spun(theta=0.8)


def test_near_an_unstable_equilibrium_the_quadrature_gives_up():
    with pytest.raises(NumericError, match="too sharply peaked for a series"):
        _ = spun(theta=np.pi / 2, phi_dot=1).period


def test_flat_at_the_start_is_refused():
    with pytest.raises(ConstraintError, match="at the start; expected a positive value"):
        spun(theta=0, phi_dot=1)

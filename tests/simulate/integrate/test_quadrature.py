import numpy as np
import pytest

from polhode.simulate.integrate._quadrature import integral


def test_integrals_are_exact_everywhere_however_coarse_the_first_guess():
    found = integral(
        lambda t: np.array([np.cos(200 * t), np.exp(-t), 1 / (1e-4 + (t - 3) ** 2)]),
        np.array([0.0, 10.0]),
    )
    t = np.linspace(0, 10, 3001)
    expected = np.array(
        [
            np.sin(200 * t) / 200,
            1 - np.exp(-t),
            100 * (np.arctan(100 * (t - 3)) - np.arctan(-300)),
        ]
    )
    assert found.at(t) == pytest.approx(expected, rel=1e-13, abs=1e-13)


def test_noise_is_not_refined_for_ever():
    generator = np.random.default_rng(1)

    def rough(t):
        return np.array([1 + 1e-10 * generator.standard_normal(t.shape)])

    found = integral(rough, np.array([0.0, 1.0]))
    assert len(found.knots) < 100
    assert found.at(np.array([1.0]))[0] == pytest.approx(1, abs=1e-9)


def test_pure_noise_ends():
    generator = np.random.default_rng(1)
    found = integral(lambda t: generator.standard_normal((1, *t.shape)), np.array([0.0, 1.0]))
    assert np.all(np.diff(found.knots) > 0)

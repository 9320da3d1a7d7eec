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


def test_values_that_are_rounded_with_their_times_are_not_refined_for_ever():
    """Within a microsecond a function changes by as much as it is, and so with the last digits."""
    begin, length = 0.58, 1e-6

    def steep(t):
        return np.array([1e-5 * np.exp(-(t - begin) / length)])

    found = integral(steep, np.array([begin, begin + length]))
    assert len(found.knots) < 10
    exact = 1e-5 * length * (1 - np.exp(-1))
    assert found.totals[0, -1] == pytest.approx(exact, rel=1e-8)


def test_what_is_below_the_rounding_of_the_sum_is_not_refined():
    generator = np.random.default_rng(2)

    def tiny(t):
        return np.array([1e-14 * (1 + 1e-6 * generator.standard_normal(t.shape))])

    knots = np.array([0.0, 1e-3])
    assert len(integral(tiny, knots, start=np.array([0.2])).knots) == 2
    assert len(integral(tiny, knots).knots) > 2

"""Falls of guards through zero, against those of functions whose zeros are known."""

import numpy as np
import pytest

from polhode.simulate.integrate._crossing import first_fall


@pytest.mark.parametrize("begin", 4.0 + 0.00317 * np.arange(12))
def test_a_guard_that_begins_within_the_rounding_of_the_time_has_not_fallen(begin):
    """At t = 4 s, rounding of the time moves v sin ωt by 4e-15: a beginning at -3e-15 is zero."""
    omega, speed = 1000.0, 4.43

    def guard(times):
        return speed / omega * np.sin(omega * (np.asarray(times) - begin))[None] - 3e-15

    crossing = first_fall(guard, np.linspace(begin, begin + 0.004, 4))
    assert crossing is not None
    assert crossing.time == pytest.approx(begin + np.pi / omega, abs=1e-14)


def test_a_dip_that_is_deeper_is_a_fall():
    """The same, 1e-12 below zero at the beginning, and a narrow dip in the middle."""
    begin = 4.0

    def fallen(times):
        return np.sin(np.asarray(times) - begin)[None] - 1e-12

    def dips(times):
        return ((np.asarray(times) - 4.5) ** 2)[None] - 1e-10

    assert first_fall(fallen, np.array([begin, 5.0])).time == begin
    assert first_fall(dips, np.array([begin, 5.0])).time == pytest.approx(4.5 - 1e-5, abs=1e-9)


def test_near_a_singular_position_noise_is_neither_a_fall_nor_refined():
    """A force over a vanishing lever: its rounding grows, and one guard falls all the same."""
    generator = np.random.default_rng(3)

    def uncertainty(t):
        return np.tile(1e-15 / (1 - t) ** 2, (2, 1))

    def guards(t):
        noise = uncertainty(t) * generator.uniform(-1, 1, (2, len(t)))
        return np.array([1e-9 + 0 * t, 0.99 - t]) + noise

    fall = first_fall(guards, np.array([0.0, 0.5, 0.9, 1 - 1e-6]), uncertainty)
    assert fall.guard == 1
    assert fall.time == pytest.approx(0.99, abs=1e-9)

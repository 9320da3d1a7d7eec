"""The marble on a level and on a tilted turntable, against the text and by integration."""

import numpy as np
import pytest

from analyse.systems import equations
from analyse.textbook import integrated
from polhode.analyse import closed_form
from polhode.base import NumericError

#: A uniform sphere: I = 2 m a²/5, so that the circle is run round at 2Ω/7.
NUMBERS = {"m": 1, "a": 1, "I": "2/5", "Omega": 3.5}
START = {"x": 0.3, "y": -0.2, "v_x": 0.1, "v_y": 0.4, "omega_z": 5.0}


def test_level_table():
    """Equations 47 to 50: the circle is run round at 2Ω/7, about the centre given by the start."""
    motion = closed_form(equations("marble-on-turntable"), NUMBERS, START)
    assert motion.kind == "circle"
    assert motion.figures["angular_rate"] == pytest.approx(1.0, rel=1e-15)
    assert motion.period == pytest.approx(2 * np.pi, rel=1e-15)
    assert motion.figures["radius"] == pytest.approx(np.hypot(0.1, 0.4), rel=1e-15)
    assert motion.figures["centre_1"] == pytest.approx(0.3 - 0.4, rel=1e-14)
    assert motion.figures["centre_2"] == pytest.approx(-0.2 + 0.1, rel=1e-14)
    times = np.linspace(0, 20, 41)

    def rates(t, y):
        return y[2], y[3], -y[3], y[2]

    exact = integrated(rates, (0.3, -0.2, 0.1, 0.4), times)
    found = motion.at(times)
    for name, column in zip(("x", "y", "v_x", "v_y"), exact.T, strict=True):
        np.testing.assert_allclose(found[name], column, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(found["omega_z"], 5.0)


def test_tilted_table_drifts_sideways():
    """Equation 62: the circle's centre drifts across the slope at 5 g sin α/2Ω."""
    numbers = NUMBERS | {"alpha": 0.1, "g": 9.81}
    start = {"x_2": 0.3, "x_3": -0.2, "v_2": 0.1, "v_3": 0.4}
    motion = closed_form(equations("marble-on-turntable/tilted"), numbers, start)
    assert motion.kind == "circle with drift"
    figures = motion.figures
    drift = np.hypot(figures["drift_1"], figures["drift_2"])
    assert drift == pytest.approx(5 * 9.81 * np.sin(0.1) / (2 * 3.5), rel=1e-14)
    pull = -5 / 7 * 9.81 * np.sin(0.1)
    times = np.linspace(0, 20, 41)

    def rates(t, y):
        return y[2], y[3], pull - y[3], y[2]

    exact = integrated(rates, tuple(start.values()), times)
    found = motion.at(times)
    for name, column in zip(start, exact.T, strict=True):
        np.testing.assert_allclose(found[name], column, rtol=0, atol=1e-11)


def test_after_a_million_circles_the_place_is_exact():
    doubles = closed_form(equations("marble-on-turntable"), NUMBERS, START)
    digits = closed_form(equations("marble-on-turntable"), NUMBERS, START, digits=30)
    times = 2 * np.pi * 1e6 + np.linspace(0, 6, 7)
    for name, values in digits.at(times).items():
        np.testing.assert_allclose(doubles.at(times)[name], values.astype(float), atol=1e-15)


def test_a_table_at_rest_has_no_circle():
    with pytest.raises(NumericError, match="the marble does not circle; expected a turntable that"):
        closed_form(equations("marble-on-turntable"), NUMBERS | {"Omega": 0}, START)

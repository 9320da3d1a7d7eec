"""Modes along a parameter: published speeds of the bicycle, thresholds in closed form."""

from math import sqrt

import numpy as np
import pytest

import polhode as ph
from analyse.systems import equations
from derive.bicycles import BENCHMARK, bicycle
from polhode.base import DeclarationError, NumericError, UnitError
from polhode.study._modes import _followed

DISK = {"m": 1.0, "a": 0.5, "g": 9.81}
TOP = {"M": 0.5, "a": 0.06, "I_1": 6.25e-4, "I_2": 3.5e-4, "g": 9.81}


def test_the_bicycle_weaves_and_capsizes_at_the_published_speeds():
    """Meijaard, Papadopoulos, Ruina and Schwab, Proc. R. Soc. A 463 (2007) 1955."""
    v = ph.symbol("v")
    upright = {"phi": 0, "delta": 0, "omega_y_R": v / BENCHMARK["r_R"]}
    found = ph.modes(bicycle(), BENCHMARK, upright, along=v, between=("3 m/s", 7), count=5)
    weave, capsize = found.changes
    assert weave.value == pytest.approx(4.29238253634111, abs=2e-13)
    assert capsize.value == pytest.approx(6.02426201538837, abs=2e-13)
    assert weave.unstable == (2, 0)
    assert capsize.unstable == (0, 1)
    assert weave.frequency == pytest.approx(3.43503384866144, abs=1e-10)
    assert capsize.frequency == 0
    assert found.stable == ((weave.value, capsize.value),)
    for change in found.changes:
        assert change.low < change.value < change.high < change.low + 1e-12
    # each column is one mode: weave, its conjugate, capsize, caster
    assert np.all(found.exponents[:, 0].imag > 1)
    assert np.all(np.diff(found.exponents[:, 0].real) < 0)
    assert np.all(found.exponents[:, 2:].imag == 0)
    assert found.growth[2] < 0 < found.growth[0]


def test_a_disk_stops_falling_at_the_speed_in_closed_form():
    """ω₃² = g/(3a) for a uniform disk that rolls straight; also where that is one of the values."""
    threshold = sqrt(DISK["g"] / (3 * DISK["a"]))
    disk = equations("rolling-disk")
    for between, count in (((1.0, 5.0), 4), ((threshold - 1, threshold + 1), 3)):
        at = {"theta": np.pi / 2, "omega_3": 0.0}
        found = ph.modes(disk, DISK, at, along="omega_3", between=between, count=count)
        (change,) = found.changes
        assert change.value == pytest.approx(threshold, rel=1e-12)
        assert change.unstable == (1, 0)
        assert change.frequency == 0
        assert found.stable == ((change.value, between[1]),)


def test_a_top_goes_to_sleep_where_its_frequencies_part():
    """(I₁ω₁)² = 4 M g a (I₂ + M a²): two pairs ±iω meet and leave the axis."""
    m, a, i1, i2, g = (TOP[name] for name in ("M", "a", "I_1", "I_2", "g"))
    threshold = sqrt(4 * m * g * a * (i2 + m * a**2)) / i1
    between = (0.5 * threshold, 2 * threshold)
    top = equations("gyroscope/upright")
    found = ph.modes(top, TOP, {}, along="omega_1", between=between, count=6)
    (change,) = found.changes
    assert change.value == pytest.approx(threshold, rel=1e-10)
    assert change.unstable == (2, 0)
    assert change.frequency == pytest.approx(i1 * threshold / (2 * (i2 + m * a**2)), rel=1e-6)


def pendulum() -> ph.System:
    theta = ph.coordinate("theta")
    m, length, g, k = ph.symbols("m l g k")
    axes = ph.Frame("lab").rotated(theta, "x")
    bob = ph.Body("bob", mass=m, axes=axes)
    drive = ph.Torque(bob, axes["x"] * (-k * theta.dt()))
    return ph.System(ph.Pivot(bob, at=axes["z"] * length), drive, ph.Gravity(g), name="driven")


def test_flutter_sets_in_where_the_damping_changes_sign():
    numbers = {"m": 2.0, "l": 0.5, "g": 9.81, "k": 0.0}
    found = ph.modes(pendulum(), numbers, {"theta": 0}, along="k", between=(-0.3, 0.5), count=9)
    (change,) = found.changes
    assert change.value == pytest.approx(0, abs=1e-14)
    assert change.frequency == pytest.approx(sqrt(9.81 / 0.5), rel=1e-12)
    assert change.unstable == (2, 0)


def test_without_a_change_the_whole_range_is_stable():
    numbers = {"m": 2.0, "l": 0.5, "g": 9.81, "k": 0.1}
    found = ph.modes(pendulum(), numbers, {"theta": 0}, along="l", between=("20 cm", 1), count=4)
    assert found.changes == ()
    assert found.stable == ((0.2, 1.0),)
    assert found.along == "l"


def test_columns_go_on_where_they_would_be_exchanged_by_order():
    rows = [np.array([1 - x, x - 1, 5.0], complex) for x in (0.0, 0.6, 1.2, 1.8)]
    orders = ([0, 1, 2], [2, 0, 1], [1, 2, 0], [2, 1, 0])
    shuffled = [row[order] for row, order in zip(rows, orders, strict=True)]
    assert _followed(shuffled) == pytest.approx(np.array(rows))


@pytest.mark.parametrize(
    ("changes", "error", "said"),
    [
        ({"along": "speed"}, DeclarationError, "on which nothing depends"),
        ({"between": (1, 0.5)}, DeclarationError, "the smaller value first"),
        ({"between": ("1 kg", "2 kg")}, UnitError, "l"),
        ({"count": 1}, DeclarationError, "from 2"),
        ({"at": {"theta": 1.0}}, NumericError, "not steady"),
    ],
)
def test_what_cannot_be_followed_is_refused(changes, error, said):
    numbers = {"m": 2.0, "l": 0.5, "g": 9.81, "k": 0.1}
    options = {"along": "l", "between": (0.2, 1), "at": {"theta": 0}} | changes
    with pytest.raises(error, match=said):
        ph.modes(pendulum(), numbers, options.pop("at"), **options)

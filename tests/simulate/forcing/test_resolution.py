"""Python functions of time: what they do for longer than the resolution is never missed."""

import math
import pickle
import random

import numpy as np
import pytest

import polhode as ph
from polhode.base import NumericError
from polhode.simulate.forcing._approximation import approximated, sampling_times


def box(begin, width):
    return lambda t: 1.0 if begin <= t < begin + width else 0.0


def bump(middle, half):
    """Smooth everywhere, and zero but for two half widths."""

    def function(t):
        place = (t - middle) / half
        return math.exp(1 - 1 / (1 - place**2)) if abs(place) < 1 else 0.0

    return function


@pytest.mark.parametrize("width", [0.05, 0.01, 0.002, 0.0006])
def test_a_box_is_never_missed(width):
    """Of 5 % of the span 19 in 200 used to be, of 1 % 178."""
    rng = random.Random(round(width * 1e5))
    for _ in range(30):
        begin = rng.uniform(0, 1 - width)
        with pytest.raises(NumericError, match="not smooth near t") as refusal:
            approximated(box(begin, width), 0.0, 1.0)
        reported = float(str(refusal.value).split("t = ")[1].split(" s")[0])
        assert min(abs(reported - begin), abs(reported - begin - width)) < 1e-5


@pytest.mark.parametrize("half", [0.02, 0.005, 0.001])
def test_a_smooth_bump_is_resolved(half):
    """Of those with a half width of 2 % of the span 43 in 200 used to be missed."""
    rng = random.Random(round(half * 1e5))
    for _ in range(20):
        middle = rng.uniform(half, 1 - half)
        function = bump(middle, half)
        try:
            curve = approximated(function, 0.0, 1.0)
        except NumericError:  # two in a hundred: refused, but not missed
            continue
        times = np.linspace(middle - half, middle + half, 101)[:-1]
        assert curve.value(times) == pytest.approx([function(t) for t in times], abs=1e-10)


def test_what_is_shorter_than_the_resolution_may_be_missed_and_the_resolution_says_so():
    times = sampling_times(0.0, 1.0, 1 / 2000)
    before = int(np.argmax(np.diff(times) > 4e-4))
    function = box(times[before] + 1e-4, 2e-4)
    curve = approximated(function, 0.0, 1.0)
    assert curve.value(times[before] + 2e-4) == 0.0
    assert curve.resolution == pytest.approx(1 / 2000)
    assert "less than 0.0005 s may have been missed" in repr(curve)
    with pytest.raises(NumericError, match="not smooth near"):
        approximated(function, 0.0, 1.0, resolution=1e-4)


def test_the_times_at_which_it_is_evaluated():
    """No further apart than the resolution, corners included, and about 1.6 in each."""
    rng = random.Random(4)
    for _ in range(200):
        left, span = rng.uniform(-5, 5), 10 ** rng.uniform(-6, 6)
        resolution = span / rng.uniform(0.1, 3000)
        times = sampling_times(left, left + span, resolution)
        gaps = np.diff([left, *times, left + span])
        assert np.all(gaps > 0)
        assert np.max(gaps) <= resolution * (1 + 1e-9)
        assert len(times) <= span / resolution * 1.62 + 1


@pytest.mark.parametrize("count", [100, 618, 1000, 1618, 2000, 3236, 3237, 4000])
@pytest.mark.parametrize("phase", [0.0, 0.3, 0.7])
def test_periodic_pulses_are_not_missed(count, phase):
    """Each is a fifth of its period wide, and less than half of the resolution."""

    def pulses(t):
        return 1.0 if (t * count + phase) % 1 < 0.2 else 0.0

    with pytest.raises(NumericError, match="not smooth"):
        approximated(pulses, 0.0, 1.0)


@pytest.mark.parametrize("count", [500, 1000, 2000, 3236])
def test_waves_that_evenly_spaced_times_would_not_see(count):
    """More of them than there are pieces: refused, where evenly spaced times see nothing."""
    with pytest.raises(NumericError, match="not smooth"):
        approximated(lambda t: math.sin(2e6 * math.pi * count * t), 0.0, 1.0)


def test_it_costs_few_calls():
    calls = []

    def counted(t):
        calls.append(t)
        return math.sin(5 * t)

    approximated(counted, 0.0, 4.0)
    assert len(calls) < 4200
    calls.clear()
    approximated(counted, 0.0, 4.0, resolution=0.1)
    assert len(calls) < 900


@pytest.mark.parametrize("resolution", [0.0, -1.0, math.nan, math.inf, 1e-12])
def test_an_invalid_resolution_is_refused(resolution):
    with pytest.raises(NumericError, match="a resolution of"):
        approximated(math.sin, 0.0, 3.0, resolution=resolution)


# -- along the motion ------------------------------------------------------------------------------

M, R, K, G, MU = ph.symbols("m r k g mu", positive=True)
X, Y = ph.functions("X Y")
LAB = ph.Frame("lab")
BALL = ph.sphere("ball", mass=M, radius=R, inertia=K * M * R**2, axes=LAB)
NUMBERS = {"m": "50 g", "r": "20 mm", "k": 0.4, "g": 9.81}
RUBBED = {**NUMBERS, "mu": 0.5}
SHEET = ph.Sheet(LAB, motion=(X, Y))
SLIPPING = ph.System(ph.Coulomb(BALL, on=SHEET, mu=MU, name="sheet"), ph.Gravity(G))
ROLLING = ph.System(ph.Rolling(BALL, on=SHEET, name="sheet"), ph.Gravity(G))


class Shaken:
    """Waves, with a pulse that may be switched on."""

    def __init__(self):
        self.times = []
        self.pulse = 0.0

    def __call__(self, t):
        self.times.append(t)
        return 0.05 * math.sin(9 * t) + self.pulse * math.exp(-(((t - 0.8) / 0.1) ** 2))


@pytest.mark.parametrize(
    ("subject", "numbers"), [(SLIPPING, RUBBED), (ROLLING, NUMBERS), (ph.derive(ROLLING), NUMBERS)]
)
def test_a_motion_evaluates_the_function_again(subject, numbers):
    shaken = Shaken()
    curve = approximated(shaken, 0.0, 1.5)
    before = set(shaken.times)
    shaken.times.clear()
    run = ph.simulate(subject, numbers, {}, 1.5, forcing={X: curve, Y: 0})
    assert shaken.times
    assert not before & set(shaken.times)
    assert len(shaken.times) <= 1000
    assert run.resolution == {"X": curve.resolution}
    assert "X resolved to 0.00075 s" in repr(run)


@pytest.mark.parametrize(("subject", "numbers"), [(SLIPPING, RUBBED), (ROLLING, NUMBERS)])
def test_a_motion_of_something_else_is_an_error_that_names_the_time(subject, numbers):
    shaken = Shaken()
    curve = approximated(shaken, 0.0, 1.5)
    shaken.pulse = 1e-9
    with pytest.raises(NumericError, match=r"X = .* at t = 0\.\d+ s, where the motion was"):
        ph.simulate(subject, numbers, {}, 1.5, forcing={X: curve, Y: 0})


def test_named_corners_are_not_sampling_times_from_the_wrong_side():
    corners = [math.pi / 3 * n for n in (1, 2)]
    curve = approximated(lambda t: 0.05 * abs(math.sin(3 * t)), 0.0, 2.5, corners=corners)
    run = ph.simulate(SLIPPING, RUBBED, {"v_x": 0.2}, 3.0, forcing={X: curve, Y: lambda t: 0.0})
    assert run.resolution == {"X": 2.5 / 2000, "Y": 3.0 / 2000}


def test_motions_by_expressions_and_samples_have_no_resolution():
    samples = ph.sampled([0.0, 0.5, 1.0], [0.0, 0.1, 0.1])
    run = ph.simulate(SLIPPING, RUBBED, {}, 1.0, forcing={X: samples, Y: ph.sin(ph.time)})
    assert run.resolution == {}
    assert "resolved" not in repr(run)


def test_the_resolution_is_kept_with_the_motion(tmp_path):
    run = ph.simulate(ROLLING, NUMBERS, {}, 1.0, forcing={X: math.sin, Y: 0})
    run.save(tmp_path / "run.h5")
    assert ph.load(tmp_path / "run.h5").resolution == {"X": 1 / 2000}
    run.to_csv(tmp_path / "run.csv")
    assert '"resolution": {"X": 0.0005}' in (tmp_path / "run.csv").read_text()


def test_a_copy_in_another_process_is_the_same_motion():
    curve = approximated(lambda t: math.sin(3 * t), 0.0, 2.0)
    again = pickle.loads(pickle.dumps(curve))
    times = np.linspace(-1, 3, 50)
    assert np.array_equal(again.value(times), curve.value(times))
    assert again.resolution == curve.resolution
    assert [j.time for j in again.jumps] == [j.time for j in curve.jumps]
    again.confirm("X", times)

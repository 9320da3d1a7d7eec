"""Prescribed motions through samples, near noisy ones, and read from files."""

import math
import random
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polhode.base import NumericError, PolhodeError, StoreError
from polhode.simulate.forcing._samples import read_sheet, sampled
from simulate.forcing.taylor import derivatives_at_ends

PLAIN = "t,x,y\n0,0,0\n1,0.5,0\n2,2,-1\n"


@st.composite
def samples(draw):
    steps = draw(st.lists(st.floats(0.01, 1.0), min_size=1, max_size=20))
    values = draw(st.lists(st.floats(-1, 1), min_size=len(steps) + 1, max_size=len(steps) + 1))
    return np.cumsum([draw(st.floats(-5, 5)), *steps]), np.array(values)


@given(samples())
@settings(derandomize=True, max_examples=60)
def test_a_curve_through_samples(drawn):
    times, values = drawn
    curve = sampled(times, values)
    assert curve.value(times) == pytest.approx(values, abs=1e-9)
    assert curve.velocity(times[0]) == 0.0
    assert {jump.time for jump in curve.jumps} <= {times[-1]}
    reach = np.diff(curve.knots)[:-1]
    for order in range(3):
        slopes = derivatives_at_ends(curve.coefficients[:-1], reach, order)
        scale = 1 + np.max(np.abs(curve.coefficients)) * 10
        assert slopes == pytest.approx(curve.coefficients[1:, order], abs=1e-9 * scale)


def test_polynomials_of_low_degree_are_found_exactly():
    times = np.array([0.0, 0.3, 0.7, 1.1, 2.0])
    cubic = sampled(times, times**3 - 2 * times**2)
    dense = np.linspace(0, 1.99, 50)
    assert cubic.value(dense) == pytest.approx(dense**3 - 2 * dense**2, abs=1e-13)
    assert sampled([0, 2], [1, 5]).value(1.0) == 2.0  # half the time, a quarter of the way


def test_error_falls_with_the_fourth_power_of_the_step():
    def error(count):
        times = np.linspace(0, 2, count)
        dense = np.linspace(0, 1.999, 500)
        curve = sampled(times, 1 - np.cos(3 * times))
        return np.max(np.abs(curve.value(dense) - 1 + np.cos(3 * dense)))

    assert 10 < error(41) / error(81) < 25


def test_the_rate_jumps_between_segments():
    first, second = np.linspace(0, 1, 11), np.linspace(1, 2, 11)
    times = np.concatenate([first, second])
    values = np.concatenate([first**2, 1 - 3 * (second - 1)])
    jerk, stop = sampled(times, values, starts=[11]).jumps
    assert jerk.time == 1.0
    assert jerk.value == pytest.approx((1.0, 1.0))
    assert jerk.velocity == pytest.approx((2.0, -3.0))
    assert stop.velocity == pytest.approx((-3.0, 0.0))


def test_a_segment_starts_where_the_last_one_ended():
    jerk, _ = sampled([0, 1, 2, 3], [0, 1, 0, -1], starts=[2]).jumps
    assert (jerk.time, jerk.value) == (1.0, (1.0, 1.0))
    assert jerk.velocity == pytest.approx((2.0, -1.0))


def test_a_repeated_time_with_another_value_is_a_shift():
    shift, _ = sampled([0, 1, 1, 2], [0, 1, 4, 5], starts=[2]).jumps
    assert (shift.time, shift.value) == (1.0, (1.0, 4.0))


def test_noise_is_smoothed_away():
    rng = np.random.default_rng(6)
    times = np.linspace(0, 3, 301)
    true = 1 - np.cos(2 * times)
    noisy = true + 0.01 * rng.standard_normal(len(times))
    smooth, rough = sampled(times, noisy, noise=0.01), sampled(times, noisy)
    within = times[20:-20]
    assert np.max(np.abs(smooth.value(within) - true[20:-20])) < 0.01
    speeds = 2 * np.sin(2 * within)
    assert np.max(np.abs(smooth.velocity(within) - speeds)) < 0.2
    assert np.max(np.abs(rough.velocity(within) - speeds)) > 1.0
    distance = smooth.value(times[1:-1]) - noisy[1:-1]
    assert np.sqrt(np.mean(distance**2)) == pytest.approx(0.01, rel=0.05)
    assert smooth.velocity(0.0) == 0.0


def test_smoothed_segments_stay_together():
    rng = np.random.default_rng(7)
    times = np.concatenate([np.linspace(0, 1, 51), np.linspace(1, 2, 51)])
    values = np.minimum(times**2, 2 - times) + 0.001 * rng.standard_normal(len(times))
    jerk, _ = sampled(times, values, starts=[51], noise=0.001).jumps
    assert jerk.value[0] == pytest.approx(jerk.value[1], abs=1e-12)
    assert jerk.velocity == pytest.approx((2.0, -1.0), abs=0.3)


def test_noise_larger_than_the_motion_leaves_rest():
    rng = np.random.default_rng(8)
    still = sampled(np.linspace(0, 1, 50), 1e-3 * rng.standard_normal(50), noise=1e-2)
    assert np.max(np.abs(still.velocity(np.linspace(0, 1, 99)))) < 1e-4


def test_noise_too_small_to_matter_leaves_the_samples():
    times = np.linspace(0, 1, 20)
    curve = sampled(times, np.sin(9 * times) ** 2, noise=1e-14)
    assert curve.value(times) == pytest.approx(np.sin(9 * times) ** 2, abs=1e-6)


@pytest.mark.parametrize(
    ("times", "values", "more", "message"),
    [
        ([0, 1], [0, 1, 2], {}, "one value for each time"),
        ([0, 1, 1], [0, 1, 2], {}, "times that increase"),
        ([0, 2, 1], [0, 1, 2], {}, "times that increase"),
        ([0, 1, 0.5, 2], [0, 1, 2, 3], {"starts": [2]}, "times that increase"),
        ([0], [0], {}, "at least 2"),
        ([], [], {}, "at least 2"),
        ([0, 1, 2], [0, 1, 2], {"starts": [2]}, "at least 2"),
        ([0, 1], [0, 1], {"noise": 0.1}, "at least 3"),
        ([0, 1], [0, math.nan], {}, "numbers"),
        ([0, math.inf], [0, 1], {}, "numbers"),
        ([0, 1], [0, 1], {"noise": -1.0}, "standard deviation"),
        ([0, 1], [0, 1], {"noise": math.nan}, "standard deviation"),
        ([0, 1e-200], [0, 1e200], {}, "moderate size"),
    ],
)
def test_invalid_samples_are_refused(times, values, more, message):
    with pytest.raises(NumericError, match=message):
        sampled(times, values, **more)


# -- sheets read from files ------------------------------------------------------------------------


@pytest.fixture
def written(tmp_path):
    def write(content: str | bytes):
        path = tmp_path / "sheet.csv"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write


def test_a_plain_sheet(written):
    sheet = read_sheet(written(PLAIN))
    times = np.array([-1.0, 0.0, 1.0, 2.0, 5.0])
    assert sheet.X.value(times).tolist() == pytest.approx([0, 0, 0.5, 2, 2])
    assert sheet.Y.value(times).tolist() == pytest.approx([0, 0, 0, -1, -1])
    assert not np.any(sheet.angle.value(times))
    assert sheet.X.velocity(0.0) == 0.0
    assert [jump.time for jump in sheet.X.jumps] == [2.0]
    assert not sheet.angle.jumps


@pytest.mark.parametrize(
    "text",
    [
        PLAIN.replace("\n", "\r\n"),
        PLAIN.replace("\n", "\r"),
        PLAIN + "\n\n  \n",
        "\ufeff" + PLAIN,
        "# made by hand\n" + PLAIN,
        " t , x , y \n 0 , 0 , 0 \n 1 , 0.5 , 0 \n2,2,-1",
        "y,t,x\n0,0,0\n0,1,0.5\n-1,2,2",
        "segment,t,x,y\n0,0,0,0\n0,1,0.5,0\n0,2,2,-1",
        '"t","x","y"\n"0","0",0\n1,5e-1,0\n2,2.000,-1',
    ],
)
def test_other_ways_to_write_the_same(written, text):
    sheet, plain = read_sheet(written(text)), read_sheet(written(PLAIN))
    assert np.array_equal(sheet.X.coefficients, plain.X.coefficients)
    assert np.array_equal(sheet.Y.coefficients, plain.Y.coefficients)


def test_segments_and_the_angle(written):
    rows = "t,x,y,angle,segment\n0,0,0,0,a\n1,1,0,0.1,a\n2,4,0,0.4,a\n2,4,0,0.4,b\n3,3,5,0.4,b\n"
    sheet = read_sheet(written(rows))
    jerk, stop = sheet.X.jumps
    assert (jerk.time, stop.time) == (2.0, 3.0)
    assert jerk.velocity == pytest.approx((4.0, -1.0))
    assert stop.velocity == pytest.approx((-1.0, 0.0))
    assert [jump.velocity for jump in sheet.Y.jumps] == [(0.0, 5.0), (5.0, 0.0)]
    assert sheet.angle.velocity(1.0) == pytest.approx(0.2)
    assert sheet.angle.velocity(2.5) == 0.0


def test_segments_that_share_no_row(written):
    rows = "t,x,y,segment\n0,0,0,1\n1,1,0,1\n2,0,0,2\n3,-1,0,2\n"
    jerk, _ = read_sheet(written(rows)).X.jumps
    assert jerk.time == 1.0
    assert jerk.velocity == pytest.approx((2.0, -1.0))


def test_noise_is_taken_out(written):
    rng = random.Random(3)
    rows = [f"{i / 100},{(i / 100) ** 2 + rng.gauss(0, 1e-3)},0" for i in range(200)]
    path = written("\n".join(["t,x,y", *rows]))
    times = np.linspace(0.2, 1.8, 50)
    smooth = read_sheet(path, noise=1e-3).X.velocity(times) - 2 * times
    rough = read_sheet(path).X.velocity(times) - 2 * times
    assert np.max(np.abs(smooth)) < 0.05 < 0.2 < np.max(np.abs(rough))


HEADER = "t,x,y\n"
NAMED = "t,x,y,segment\n"
BAD = {
    "empty": ("", "line 1 of the sheet: the header"),
    "blank": ("\n \n\n", "line 1 of the sheet: the header"),
    "no header": ("0,0,0\n1,1,1\n", "line 1 of the sheet: the header '0,0,0'"),
    "missing column": ("t,x\n0,0\n1,1\n", "header 't,x'; expected t,x,y"),
    "unknown column": ("t,x,y,z\n0,0,0,0\n", "header 't,x,y,z'"),
    "column twice": ("t,x,y,x\n0,0,0,0\n", "header 't,x,y,x'"),
    "other separator": ("t;x;y\n0;0;0\n", "header 't;x;y'"),
    "header alone": (HEADER, "0 rows; expected at least two"),
    "one row": (HEADER + "0,0,0\n", "1 rows; expected at least two"),
    "missing cell": (HEADER + "0,0,0\n1,,0\n", "line 3 of the sheet: no x"),
    "one row as good as twice": (
        HEADER + "0,0,0\n1e-12,1,0\n1,0,0\n",
        "t = 9.9999999999999998e-13",
    ),
    "no time at all": (HEADER + "0,0,0\n1e-300,1,0\n1,0,0\n", "right after 0"),
    "short row": (HEADER + "0,0,0\n1,1\n", "line 3 of the sheet: 2 cells"),
    "long row": (HEADER + "0,0,0\n1,1,1,1\n", "line 3 of the sheet: 4 cells"),
    "empty line": (HEADER + "0,0,0\n\n1,1,1\n", "line 3 of the sheet: an empty line"),
    "repeated time": (HEADER + "0,0,0\n1,1,1\n1,2,1\n", "line 4 of the sheet: t = 1 after 1"),
    "unordered time": (HEADER + "0,0,0\n2,1,1\n1,2,1\n", "line 4 of the sheet: t = 1 after 2"),
    "nan": (HEADER + "0,0,0\n1,nan,1\n", "line 3 of the sheet: x = 'nan'"),
    "infinite": (HEADER + "0,0,0\n1,1,-inf\n", "line 3 of the sheet: y = '-inf'"),
    "overflow": (HEADER + "0,0,0\n1e999,1,1\n", "line 3 of the sheet: t = '1e999'"),
    "huge": (HEADER + "0,0,0\n1,1e30,1\n", "line 3 of the sheet: x = '1e30'"),
    "no number": (HEADER + "0,0,0\n1,far,1\n", "line 3 of the sheet: x = 'far'"),
    "underscore": (HEADER + "0,0,0\n1,1_0,1\n", "line 3 of the sheet: x = '1_0'"),
    "unit": (HEADER + "0,0,0\n1,3 mm,1\n", "line 3 of the sheet: x = '3 mm'; expected a number"),
    "formula": (HEADER + "0,0,0\n1,=1+1,1\n", "line 3 of the sheet: x = '=1\\+1'"),
    "segment again": (
        NAMED + "0,0,0,1\n1,0,0,1\n2,0,0,2\n3,0,0,2\n4,0,0,1\n5,0,0,1\n",
        "line 6 of the sheet: segment '1' again",
    ),
    "one-row segment": (NAMED + "0,0,0,1\n1,0,0,1\n2,0,0,2\n", "line 4 of the sheet: segment '2'"),
    "nameless segment": (NAMED + "0,0,0,1\n1,0,0,\n", "line 3 of the sheet: no segment"),
    "overlapping segments": (
        NAMED + "0,0,0,1\n1,0,0,1\n0.5,0,0,2\n3,0,0,2\n",
        "line 4 of the sheet: t = 0.5 after 1",
    ),
    "gap between segments": (
        NAMED + "0,0,0,1\n1,0,0,1\n5,0,0,2\n6,0,0,2\n",
        "line 4 of the sheet: 4 s without a row",
    ),
    "open quote": (HEADER + '0,0,0\n1,"1,1\n', "of the sheet: a malformed row"),
    "binary": (b"\x89PNG\r\n\x1a\n\xff\x00", "line 1 of the sheet: bytes that are not UTF-8 text"),
    "binary below": (HEADER.encode() + b"0,0,0\n1,\xff,0\n", "line 3 of the sheet: bytes"),
    "zeros": (b"\x00" * 1000, "line 1 of the sheet"),
    "junk in one line": ("x" * 1_000_000, "line 1 of the sheet"),
    "junk in one cell": (
        HEADER + "0,0,0\n1," + "9" * 100_000 + ",1",
        "line 3 of the sheet: x = '99",
    ),
    "junk in lines": ("~#;\n" * 250_000, "line 1 of the sheet: the header '~#;'"),
    "too close": (HEADER + "0,0,0\n1e-300,1,1\n", "moderate size"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_sheets_are_refused_in_a_few_words(written, name):
    content, message = BAD[name]
    with pytest.raises(PolhodeError, match=message) as refused:
        read_sheet(written(content))
    assert len(str(refused.value)) < 300


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(StoreError, match=r"none\.csv cannot be read"):
        read_sheet(tmp_path / "none.csv")
    with pytest.raises(StoreError, match="cannot be read"):
        read_sheet(tmp_path)


def test_junk_is_a_sheet_or_refused(written):
    rng = random.Random(11)
    letters = "0123456789.,-+e\n\"' #txysegmentnaif\0é"
    for _ in range(300):
        body = "".join(rng.choices(letters, k=rng.randrange(60)))
        with suppress(PolhodeError):
            sheet = read_sheet(written(rng.choice(["", HEADER, PLAIN, NAMED]) + body))
            assert np.all(np.isfinite(sheet.X.value(np.linspace(-1, 10, 50))))

"""Sheets read from files, and files that are no sheets."""

import random
from contextlib import suppress

import numpy as np
import pytest

from polhode.base import PolhodeError, StoreError
from polhode.simulate.forcing._samples import read_sheet

PLAIN = "t,x,y\n0,0,0\n1,0.5,0\n2,2,-1\n"


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

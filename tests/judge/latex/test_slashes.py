"""Slashes of which writers differ are read in each way."""

import pytest

from polhode.base import ParseError
from polhode.judge.latex import read_latex, slash_readings


@pytest.mark.parametrize(
    ("printed", "readings"),
    [
        (r"\frac g{3a}", [r"\frac g{3a}"]),
        ("g/3a", ["g/3a"]),
        (r"1/2mv^2", [r"\frac{1}{2}mv^2", r"\frac{1}{2mv^2}"]),
        (r"1/2m v^2", [r"\frac{1}{2}m v^2", r"\frac{1}{2m} v^2", r"\frac{1}{2m v^2}"]),
        (
            r"1/2 mv^2 + 3/2 Iw^2",
            [
                r"\frac{1}{2} mv^2 + \frac{3}{2} Iw^2",
                r"\frac{1}{2 mv^2} + \frac{3}{2 Iw^2}",
            ],
        ),
        (r"g/l\sin\theta", [r"\frac{g}{l\sin\theta}", r"\frac{g}{l}\sin\theta"]),
        (r"\sin\theta_{1}/2", [r"\sin\frac{\theta_{1}}{2}", r"\frac{\sin\theta_{1}}{2}"]),
        (r"\sin{\theta}/2", [r"\sin{\theta}/2"]),
        (
            r"\left(a+b\right)/\left(c+d\right) e",
            [
                r"\frac{\left(a+b\right)}{\left(c+d\right) e}",
                r"\frac{\left(a+b\right)}{\left(c+d\right)} e",
            ],
        ),
        (
            r"\cos\theta/2 b",
            [r"\cos\frac{\theta}{2} b", r"\frac{\cos\theta}{2 b}", r"\frac{\cos\theta}{2} b"],
        ),
    ],
)
def test_every_reading_is_a_fraction_in_place_of_the_slash(
    printed: str, readings: list[str]
) -> None:
    found = slash_readings(f"x = {printed}")
    assert list(found) == [f"x = {reading}" for reading in readings]
    assert len({str(read_latex(way).relations) for way in found}) == len(readings)


def test_more_readings_than_are_tried_are_refused() -> None:
    with pytest.raises(ParseError, match="more than 16 ways"):
        slash_readings(r"x = a/b c + d/e f + g/h k + m/n q + r/s t")

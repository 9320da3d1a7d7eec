"""The worked examples of the documentation: what is said of every line of them."""

from functools import cache
from pathlib import Path

import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.cli._systems import entry_of

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
HERE = EXAMPLES / "review"

T, ERROR, FOLLOWS = ph.Mark.TRUE, ph.Mark.ERROR, ph.Mark.FOLLOWS
UNLINKED, STATED = ph.Mark.UNLINKED, ph.Mark.NOT_JUDGED


@cache
def reviewed(file: str, system: str) -> ph.Review:
    entry = PROBLEM_SET[system] if system in PROBLEM_SET else entry_of(str(EXAMPLES / system))
    return ph.review_files([HERE / file], ph.derive(entry.build()))


@pytest.mark.parametrize(
    ("file", "system", "marks"),
    [
        ("coin.tex", "spinning-coin", [T, T, T, T, STATED, STATED, T, T, T, T, T]),
        ("marble.md", "marble-on-turntable", [T] * 10),
        ("disk.tex", "rolling-disk", [T, T, T, T, ERROR, T, FOLLOWS, T]),
        ("top.tex", "top.py:top", [STATED, T, T, ERROR, FOLLOWS, FOLLOWS, FOLLOWS, T]),
        (
            "slope.md",
            "review/slope.py:system",
            [T, T, T, ERROR, FOLLOWS, FOLLOWS, FOLLOWS, UNLINKED],
        ),
        ("gyrocompass.tex", "gyrocompass", [ph.Mark.DOUBT, T, T]),
    ],
)
def test_every_line_has_its_mark(file: str, system: str, marks: list[ph.Mark]) -> None:
    assert [line.mark for line in reviewed(file, system).lines] == marks


def test_a_first_error_comes_with_a_correction_and_a_state_that_refutes_it() -> None:
    (error,) = reviewed("disk.tex", "rolling-disk").errors
    assert (error.line, error.column) == (10, 3)
    assert error.verdict is not None
    assert error.verdict.counterexample is not None
    assert error.verdict.correction is not None
    assert r"6\omega_3^2" in error.verdict.correction.latex


def test_lines_that_follow_name_the_line_that_is_wrong_by_itself() -> None:
    review = reviewed("top.tex", "top.py:top")
    assert [line.of for line in review.lines] == [None, None, None, None, 3, 3, 3, None]


def test_the_boxed_answer_is_the_final_one() -> None:
    review = reviewed("slope.md", "review/slope.py:system")
    assert review.final is review.lines[-1]
    assert review.final.mark is UNLINKED
    assert review.final.of == 3
    assert review.to_json()["final"] == len(review.lines) - 1


def test_texts_of_the_files_are_kept() -> None:
    review = reviewed("disk.tex", "rolling-disk")
    (text,) = review.texts.values()
    assert text.splitlines()[9].lstrip().startswith(r"T &= \frac{ma^2}{8}")

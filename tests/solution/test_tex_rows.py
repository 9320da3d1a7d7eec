"""Long formulas in rows, and words in Unicode, for LaTeX."""

import re

import pytest

from polhode.solution._tex_rows import WIDE, rows_of, width
from polhode.solution._tex_words import text_tex

SUM = " + ".join(rf"I_{k} \dot{{\omega}}_{k}^2 \sin\theta" for k in range(1, 20))


def test_a_short_formula_stays_in_one_row():
    assert rows_of(r"\theta = \frac{a}{b}") == [r"\theta = \frac{a}{b}"]


@pytest.mark.parametrize(
    "latex",
    [f"T = {SUM}", rf"T = m \left({SUM}\right) = 0", rf"T = \frac{{m \left({SUM}\right)}}{{2}}"],
)
def test_rows_fit_and_keep_every_term(latex):
    rows = rows_of(latex)
    assert len(rows) > 1
    assert all(width(row) <= WIDE + 2 for row in rows)
    assert all(row.count(r"\left") == row.count(r"\right") for row in rows)
    assert all(row.count("{") == row.count("}") for row in rows)
    whole = "".join(rows).replace(r"\right.", "").replace(r"\left.", "")
    assert SUM in whole
    assert len(re.findall("I_", "".join(rows))) == 19


def test_what_cannot_be_broken_stays_whole():
    latex = rf"\sqrt{{{SUM}}}"
    assert rows_of(latex) == [latex]


@pytest.mark.parametrize(
    ("text", "latex"),
    [
        ("50% of a_1 & b", r"50\% of a\_1 \& b"),
        (
            "“φ̈” and Poincaré’s θ",
            r"``\ensuremath{\ddot{\phi }}'' and Poincaré's \ensuremath{\theta }",
        ),
        (
            "ω₃ ≥ 90°",
            r"\ensuremath{\omega }\ensuremath{_{3}} \ensuremath{\ge } 90\ensuremath{^{\circ}}",
        ),
        ("Λ, Α, −2", r"\ensuremath{\Lambda }, \ensuremath{\mathrm{A}}, \ensuremath{-}2"),
    ],
)
def test_words_in_unicode(text, latex):
    assert text_tex(text) == latex
    assert text_tex(text).isascii() or "é" in text

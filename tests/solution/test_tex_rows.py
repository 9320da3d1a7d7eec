"""Long formulas in rows and in sentences, and words in Unicode, for LaTeX."""

import re
import shutil
import subprocess

import pytest

from polhode.solution import Solution, Step
from polhode.solution._tex import tex_of_solution
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


def sentence(formula, after=", if it is real."):
    """LaTeX of a solution that is one sentence with a formula in it."""
    words = f"They stay small and oscillate at the angular frequency ${formula}${after}"
    return tex_of_solution(Solution("it", "It", "", (Step("Words", words),)))


def test_a_short_formula_stays_in_its_sentence():
    assert r"frequency $\sqrt{\frac{k}{m}}$, if it" in sentence(r"\sqrt{\frac{k}{m}}")


@pytest.mark.parametrize("formula", [r"\sqrt{a + 2 b + 3 c + 4 d + 5 e + 6 f}", SUM])
def test_a_long_formula_is_displayed_with_the_mark_that_follows(formula):
    shown, _, after = sentence(formula).partition("angular frequency")[2].partition("\\end{")
    assert shown.lstrip().startswith((r"\begin{equation*}", r"\begin{multline*}"))
    assert shown.endswith(",\n")
    assert after.partition("\n")[2].startswith("if it is real.")


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="LaTeX is not installed")
def test_formulas_of_any_length_keep_within_the_page(tmp_path):
    sums = [" + ".join(rf"I_{k} \sin\theta" for k in range(terms)) for terms in range(1, 12)]
    shapes = ["{}", r"\sqrt{{{}}}", r"\left({}\right) \omega", r"x = \sqrt{{\frac{{{}}}{{A}}}}"]
    words = tuple(
        Step("Words", f"{'Oscillations ' * before}are at the frequency ${shape.format(one)}$ if so")
        for one in sums
        for shape in shapes
        for before in range(4)
    )
    source = tmp_path / "it.tex"
    source.write_text(tex_of_solution(Solution("it", "It", "", words)), "utf-8")
    options = ["-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape"]
    done = ["pdflatex", *options, source.name]
    subprocess.run(done, cwd=tmp_path, check=True, capture_output=True, timeout=120)
    assert "Overfull" not in source.with_suffix(".log").read_text("latin-1")


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
            r"\ensuremath{\omega }\ensuremath{_{3}} \ensuremath{\ge } 90\textdegree{}",
        ),
        ("Λ, Α, −2", r"\ensuremath{\Lambda }, \ensuremath{\mathrm{A}}, \ensuremath{-}2"),
    ],
)
def test_words_in_unicode(text, latex):
    assert text_tex(text) == latex
    assert text_tex(text).isascii() or "é" in text

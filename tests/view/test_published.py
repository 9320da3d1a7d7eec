"""Expressions as they are typed, and LaTeX that is announced, within words."""

import re

import pytest

from polhode.view import typeset_in_pieces, words_with_formulas, words_with_published


def plain(html: str) -> str:
    return re.sub("<[^>]+>", "", html)


@pytest.mark.parametrize(
    ("words", "shown"),
    [
        ("it holds where theta_dot = 0", "it holds where θ˙=0"),
        (
            "2 of 2 roots of a*phi_dot**2 - 4*g = 0 are covered",
            "2 of 2 roots of aϕ˙2−4g=0 are covered",
        ),
        ("(0, x_2, x_3) along slope", "(0,x2,x3) along slope"),
        (r"under the condition \theta_0 < \pi/2", "under the condition θ0&lt;π/2"),
        ("defines vector F_Cor; not judged", "defines vector FCor; not judged"),
    ],
)
def test_what_is_typed_is_set(words, shown):
    html = words_with_published(words)
    assert plain(html) == shown
    assert html.count("<math") == 1


@pytest.mark.parametrize(
    "words", ["velocity of cm", "axis z of lab", "a term (of it, as said) in a", "scales as ε^3.00"]
)
def test_words_stay_words(words):
    assert words_with_published(words) == words


def test_markup_in_words_is_escaped():
    assert "<b>" not in words_with_published("<b> where phi_dot = 0 <b>")


def test_no_line_breaks_within_short_brackets():
    pieces = typeset_in_pieces(r"x = \text{sech}[k (t - t_0)] + c - (d - e)")
    assert [plain(piece) for piece in pieces] == ["x", "=sech[k(t−t0)]", "+c", "−(d−e)"]


def test_a_long_formula_between_words_may_break():
    html = words_with_formulas(
        r"It has $\tau = m a^2\omega\Omega\sin\lambda - m a^2\Omega^2\cos\lambda + k$, where $a=b$."
    )
    lines = [plain(piece) for piece in html.split("\u200b")]
    assert lines == ["It has τ", "=ma2ωΩsinλ", "−ma2Ω2cosλ", "+k, where a=b."]

"""Answers without LaTeX: what they are as LaTeX, and that they are marked as such."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polhode as ph
from polhode.catalogue import CATALOGUE
from polhode.claims import read_latex, write_latex
from polhode.review.service._answer import AnswerTask, marked_answer
from polhode.review.service._keyboard import keyboard_latex

PRINTED = {
    "3*g/(2*l)": r"\frac{3 g}{2 l}",
    "sqrt(g/l)": r"\sqrt{g/l}",
    "a/b*c": r"\frac{a}{b} c",
    "g/2l": r"\frac{g}{2 l}",
    "mgl(1-cos(theta))": r"mgl(1-\cos\theta)",
    "1/2*m*v**2": r"\frac12 m v^2",
    "theta_ddot = -g/l*sin(theta)": r"\ddot\theta = -\frac{g}{l}\sin\theta",
    "sin(2*theta)^2*3": r"(\sin 2\theta)^2 3",
    "x^-2": "x^{-2}",
    "asin(x)": r"\arcsin(x)",
    "2*atan(varphi/2)": r"2\arctan(\varphi/2)",
    "Upsilon + arcosh(x)^2": r"\Upsilon + (\operatorname{arcosh} x)^2",
    "m_1*v_cm": "m_1 v_{cm}",
    r"\frac{g}{l}": r"\frac{g}{l}",
}


@pytest.mark.parametrize("typed", PRINTED)
def test_what_keyboards_have_is_latex(typed: str) -> None:
    found, meant = (read_latex(x).relations for x in (keyboard_latex(typed), PRINTED[typed]))
    assert list(map(write_latex, found)) == list(map(write_latex, meant))


@pytest.mark.parametrize("typed", ["2*(3 + 4", "3)", "x^(2", "a*(b]]"])
def test_brackets_that_do_not_match_are_refused(typed: str) -> None:
    with pytest.raises(ph.ParseError):
        read_latex(keyboard_latex(typed))


@given(st.text("abgmtheta_dotsqrt(cos)[]^*/+-=<> 0123.\\$'", max_size=40))
@settings(max_examples=60, deadline=None)
def test_every_text_is_written(typed: str) -> None:
    assert isinstance(keyboard_latex(typed), str)


@pytest.mark.parametrize(
    ("typed", "is_correct"),
    [("m*g*a*sin(theta)", True), ("m g a cos(theta)", False), ("V = sin(theta) mga", True)],
)
def test_typed_answers_are_marked(typed: str, is_correct: bool) -> None:
    equations = ph.derive(CATALOGUE["rolling-disk"].build())
    found = marked_answer(
        AnswerTask(typed, asked="V", letters=("m", "g", "a", r"\theta")), equations
    )
    assert found.is_judged
    assert found.is_correct is is_correct

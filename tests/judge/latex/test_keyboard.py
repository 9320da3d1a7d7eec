"""Formulas without LaTeX: what they are as LaTeX, and that they are checked and marked as such."""

import runpy
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.cli import main
from polhode.judge import read_latex, write_latex
from polhode.judge.latex import as_latex
from polhode.judge.latex._keyboard import keyboard_latex
from polhode.judge.service._answer import AnswerTask, marked_answer

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
    "θ̈ = −(g/l) sinθ": r"\ddot\theta = -(g/l) \sin\theta",
    "½ (I₂ + m l²) φ̇²": r"(1/2)(I_2 + m l^2)\dot\phi^2",
    "ω̇₂ᵣ - vₓₗ": r"\dot\omega_{2,r} - v_{x,l}",
    "x'' + 2 x' = 0": r"\ddot x + 2\dot x = 0",
    "F'_z = F_z": "F'_z = F_z",
    "Fprime_rho": r"F'_\rho",
    "thetaddot + xdot*costheta": r"\ddot\theta + \dot x\cos\theta",
    "d^2 theta/dt^2 = dx_1/dt": r"\ddot\theta = \dot x_1",
    "d/dt (T + V) = 0": r"\frac{d}{dt}(T + V) = 0",
    "I2 + m1*a": "I_2 + m_1 a",
    "√(g/l) · 2": r"\sqrt{g/l}\,2",
    "sin²θ": r"\sin^2\theta",
    "cosϑ + Ω": r"\cos\theta + \Omega",
}


@pytest.mark.parametrize("typed", PRINTED)
def test_what_keyboards_have_is_latex(typed: str) -> None:
    found, meant = (read_latex(x).relations for x in (keyboard_latex(typed), PRINTED[typed]))
    assert list(map(write_latex, found)) == list(map(write_latex, meant))


PENDULUM = Path(__file__).parents[3] / "docs/examples/solutions/physical_pendulum.py"


@pytest.mark.parametrize(
    "typed",
    [
        "(I_2 + m l^2) θ̈ + m g l sin θ = 0",
        "(I_2 + m*l**2)*theta_ddot + m*g*l*sin(theta) = 0",
        "(I_2 + m l^2) theta'' = -m g l sin theta",
        "thetaddot = - m g l sintheta/(I_2 + m l^2)",
        "d^2 theta/dt^2 = -m g l sin(theta)/(I_2 + m l^2)",
        "E = 1/2 (I_2 + m l^2) thetadot^2 - m g l costheta",
        "T = (I2 + m l²) θ̇²/2",
    ],
)
def test_equations_are_checked_as_they_are_typed(typed: str) -> None:
    equations = ph.derive(runpy.run_path(str(PENDULUM))["physical_pendulum"])
    assert ph.check(typed, equations).holds
    wrong = ph.check(typed.replace("l", "2 l", 1), equations)
    assert not wrong.holds


@pytest.mark.parametrize(
    "name", ["rolling-disk", "gyroscope", "marble-on-turntable", "gyroscope/upright", "gyrocompass"]
)
def test_what_derive_prints_is_read_and_holds(name: str, capsys: pytest.CaptureFixture) -> None:
    equations = ph.derive(PROBLEM_SET[name].build())
    main(["derive", name])
    lines = [
        line
        for line in capsys.readouterr().out.splitlines()
        if line.startswith("  ") and " = " in line
    ]
    assert len(lines) > 3
    for line in lines:
        assert ph.check(line.strip(), equations).holds, line


@pytest.mark.parametrize(
    "latex",
    [
        *("E = T + V", "F_z = m g", "v' = a", "a/b c = 1", r"\theta_ddot*2", "x_{cm}^2 = 1"),
        *("V''(0) = k + mgl", "E = E_0 + m_1gl_1"),
    ],
)
def test_what_latex_reads_is_left_alone(latex: str) -> None:
    assert as_latex(latex) == latex


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
    equations = ph.derive(PROBLEM_SET["rolling-disk"].build())
    found = marked_answer(
        AnswerTask(typed, asked="V", letters=("m", "g", "a", r"\theta")), equations
    )
    assert found.is_judged
    assert found.is_correct is is_correct

"""Corrections of claims about small quantities and of printed numbers, each of which must hold."""

import pytest

import polhode as ph
from judge.test_false_passes import equations
from judge.text_mutation import says_the_same
from polhode.judge import Answer

SWING = {"context": "limit", "small": ["theta:1", "theta_dot:1"]}
CUBIC = {"context": "limit", "small": ["theta:3", "theta_dot:3"]}
SQUARE = {"context": "limit", "small": ["theta:2", "theta_dot:2"]}
FAST = {"context": "limit", "small": ["1/omega_3"]}
NUMBER = {"context": "number", "given": ["g = 9.81", "l = 0.5"]}
OF_THE_TOP = r"\dot\phi \approx \frac{Mgh}{C\omega_3}"
CUBED = r"\ddot\theta \approx -\frac{g}{l}\left(\theta - \frac{\theta^3}{6}\right)"


@pytest.mark.parametrize(
    ("system", "printed", "right", "options"),
    [
        ("plane", r"l\ddot\theta \approx 0", r"l\ddot\theta + g\theta \approx 0", SWING),
        ("plane", r"l\ddot\theta + \theta \approx 0", r"l\ddot\theta + g\theta \approx 0", SWING),
        ("plane", r"l\ddot\theta + g \approx 0", r"l\ddot\theta + g\theta \approx 0", SWING),
        ("plane", CUBED.replace("^3", ""), CUBED, CUBIC),
        ("plane", CUBED.replace(r"\theta -", "-"), CUBED, CUBIC),
        ("plane", r"V \approx -mgl", r"V \approx -mgl + \frac12 mgl\theta^2", SQUARE),
        ("top", r"\phi \approx \frac{Mgh}{C\omega_3}", OF_THE_TOP, FAST),
        ("top", r"\dot\phi \approx \frac{C\omega_3}{Mgh}", OF_THE_TOP, FAST),
        ("plane", r"\sqrt{\frac{l}{g}} = 4.43", r"\sqrt{\frac{g}{l}} = 4.43", NUMBER),
        ("plane", r"\frac{3}{2l} = 29.4", r"\frac{3g}{2l} = 29.4", NUMBER),
        ("plane", r"\frac{3g}{2l} = 2.94", r"\frac{3g}{2l} = 29.4", NUMBER),
        ("plane", r"\frac{3g}{2l} = 24.9", r"\frac{3g}{2l} = 29.4", NUMBER),
        ("plane", r"\frac{3g}{2l} = 71.3", r"\frac{3g}{2l} = 29.4", NUMBER),
    ],
)
def test_what_is_missing_is_put_in(system, printed, right, options):
    verdict = ph.check(printed, equations(system), **options)
    assert verdict.answer is Answer.FAILS
    assert verdict.correction is not None
    proposed = [c.latex for c in (verdict.correction, *verdict.alternatives)]
    assert any(says_the_same(latex, right) for latex in proposed), proposed
    for latex in proposed:
        assert ph.check(latex, equations(system), **options).holds


def test_a_text_that_expands_is_given_no_function_of_what_is_small():
    verdict = ph.check(r"V \approx -mgl", equations("plane"), **SQUARE)
    assert verdict.correction is not None
    proposed = (verdict.correction, *verdict.alternatives)
    assert not any(r"\cos" in c.latex for c in proposed)


def test_no_power_of_a_quantity_is_compared_with_zero():
    verdict = ph.check(
        r"\dot\theta^2 < 0",
        equations("plane"),
        context="launch",
        given=["theta = 1", "theta_dot = 0"],
    )
    proposed = [c for c in (verdict.correction, *verdict.alternatives) if c is not None]
    assert not any("^" in c.latex for c in proposed)


def test_a_claim_on_an_azimuth_that_is_not_given_is_refuted():
    start = ["theta = 1", "theta_dot = 0", "phi_dot = 1"]
    verdict = ph.check(r"\phi > 0", equations("spherical"), context="launch", given=start)
    assert verdict.answer is Answer.FAILS

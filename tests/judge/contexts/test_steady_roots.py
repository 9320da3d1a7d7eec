r"""Roots on steady motions, whose signs follow from what the motions require.

A spherical pendulum that circles at an angle $\theta$ obeys $g = l\dot\phi^2\cos\theta$, and small
oscillations about this have $\omega^2 = \dot\phi^2(1 + 3\cos^2\theta)$ (Landau and Lifshitz,
Mechanics, § 23, from the effective potential).
"""

import pytest

from judge.judged import uncorrected
from judge.test_false_passes import equations
from polhode.judge import Answer

HOLD = [
    r"T = \frac{2\pi}{|\dot\phi|\sqrt{1+3\cos^2\theta}}",
    r"T_0 = 2\pi\sqrt{\frac{l\cos\theta}{g(1+3\cos^2\theta)}}",
    r"\omega_0 = \sqrt{\frac{g}{l\cos\theta}(1+3\cos^2\theta)}",
    r"\omega_0 = \frac{\sqrt{g\cos\theta(1+3\cos^2\theta)}}{\sqrt{l}\cos\theta}",
]
FAIL = [
    r"T = \frac{2\pi}{|\dot\phi|\sqrt{1+\cos^2\theta}}",
    r"T_0 = 2\pi\sqrt{\frac{l}{g\cos\theta(1+3\cos^2\theta)}}",
    r"\omega_0 = \sqrt{\frac{g}{l}(1+3\cos^2\theta)}",
]


@pytest.mark.parametrize("latex", HOLD)
def test_periods_of_oscillations_about_circling(latex: str) -> None:
    assert uncorrected(latex, equations("spherical"), context="steady").answer is Answer.HOLDS


@pytest.mark.parametrize("latex", FAIL)
def test_what_differs_comes_with_a_state(latex: str) -> None:
    verdict = uncorrected(latex, equations("spherical"), context="steady")
    assert verdict.answer is Answer.FAILS
    assert verdict.counterexample is not None


def test_a_sign_decides() -> None:
    latex = r"T = \frac{2\pi}{\dot\phi\sqrt{1+3\cos^2\theta}}"
    verdict = uncorrected(latex, equations("spherical"), context="steady")
    assert verdict.answer is Answer.FAILS
    assert "it holds where phi_dot > 0" in verdict.remarks
    positive = {"context": "steady", "positive": [r"\dot\phi"]}
    assert uncorrected(latex, equations("spherical"), **positive).answer is Answer.HOLDS


@pytest.mark.parametrize("latex", [r"\dot\phi = 17", r"I_3\omega_3 = 5\dot\phi"])
def test_nothing_holds_where_the_coordinates_are_singular(latex: str) -> None:
    """Of an upright axis the rates of two angles cannot be told apart: no family is left."""
    verdict = uncorrected(latex, equations("top"), context="steady", given=[r"\theta = 0"])
    assert verdict.answer is Answer.UNREAD
    assert "singular" in verdict.reason

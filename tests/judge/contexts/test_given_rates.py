r"""Given rates and accelerations restrict the motion (Goldstein, Classical Mechanics, 5.7).

A heavy top whose axis keeps its angle precesses steadily, with
$M g a = I_1 \omega_1 \dot\phi - (I_2 + M a^2) \dot\phi^2 \cos\theta$.
"""

import pytest

import polhode as ph
from judge.judged import uncorrected
from polhode.catalogue import PROBLEM_SET
from polhode.judge import Answer

STEADY = r"M g a = I_1\omega_1\dot\phi - (I_2 + M a^2)\dot\phi^2\cos\theta"
TRUE = [
    (STEADY, r"\ddot\theta = 0"),
    (STEADY, r"\theta = \text{const}"),
    (r"\ddot\theta = 0", r"\theta = \text{const}"),
    (r"\ddot\phi = 0", r"\theta = \text{const}"),
    (r"\ddot\phi = 0", r"\dot\phi = \text{const}"),
]
FALSE = [
    (STEADY.replace("-", "+"), r"\ddot\theta = 0"),
    (STEADY.replace("^2\\cos", "\\cos"), r"\theta = \text{const}"),
    (STEADY, r"\dot\theta = 0"),  # at one instant only
    (r"\ddot\theta = 0", r"\dot\theta = 0"),
    (r"\dot\phi = 0", r"\theta = \text{const}"),
]


@pytest.mark.parametrize(("latex", "given"), TRUE)
def test_what_follows_holds(latex: str, given: str) -> None:
    assert judged(latex, given) is Answer.HOLDS


@pytest.mark.parametrize(("latex", "given"), FALSE)
def test_what_does_not_follow_fails(latex: str, given: str) -> None:
    assert judged(latex, given) is Answer.FAILS


def judged(latex: str, given: str) -> Answer:
    return uncorrected(latex, ph.derive(PROBLEM_SET["gyroscope"].build()), given=[given]).answer


def test_a_wrong_equation_of_motion_that_is_given_does_not_prove_itself() -> None:
    wrong = r"\ddot\theta = \sin\theta\cos\theta\dot\phi^2"
    assert judged(wrong, wrong) is Answer.FAILS


@pytest.mark.parametrize(
    ("latex", "answer"),
    [
        (rf"{STEADY} \quad\text{{if }} \theta = \text{{const}}", Answer.HOLDS),
        (rf"{STEADY} \quad\text{{for }} \theta = \text{{const}}", Answer.HOLDS),
        (rf"{STEADY.replace('-', '+')} \quad\text{{for }} \theta = \text{{const}}", Answer.FAILS),
        (rf"{STEADY} \quad\text{{if }} \dot\theta = 0", Answer.FAILS),  # at one instant only
        (r"V = \frac12 Mga \text{ at } \theta = \frac{\pi}{3}", Answer.HOLDS),
        (r"V = Mga \text{ at } \theta = \frac{\pi}{3}", Answer.FAILS),
    ],
)
def test_words_in_a_display_restrict_it(latex: str, answer: Answer) -> None:
    equations = ph.derive(PROBLEM_SET["gyroscope"].build())
    assert uncorrected(latex, equations).answer is answer


@pytest.mark.parametrize(("factor", "answer"), [("", Answer.HOLDS), ("2", Answer.FAILS)])
def test_an_index_behind_for_is_no_condition(factor: str, answer: Answer) -> None:
    latex = rf"L_i = {factor} I_i\omega_i \quad\text{{for }} i = 1, 2, 3"
    equations = ph.derive(PROBLEM_SET["tennis-racquet"].build())
    assert uncorrected(latex, equations).answer is answer

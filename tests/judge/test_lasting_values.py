r"""Whether a value that a text gives to an angle or a rate is of one instant or lasts.

Of a top, $I\ddot\theta = I\dot\phi^2\sin\theta\cos\theta - I_1\omega_1\dot\phi\sin\theta
+ Mga\sin\theta$ with $I = I_2 + Ma^2$ (Goldstein, Classical Mechanics, 5.7).
"""

import pytest

import polhode as ph
from judge.marking import blamed
from polhode.catalogue import PROBLEM_SET

MARKS = {"T": "true", "E": "error", "!": "needs", "-": "not-judged"}
RIGHT = r"M g a = I_1\omega_1\dot\phi - (I_2+Ma^2)\dot\phi^2\cos\theta"
WRONG = RIGHT.replace("-", "+")
TURNING = r"(I_2+Ma^2)(\ddot\theta - \dot\phi^2\sin\theta\cos\theta)"
TEXTS = {
    "said to be constant": (
        rf"Assume $\theta = \text{{const}}$. Then $\dot\theta = 0$ and $\ddot\theta = 0$, so that"
        rf" ${RIGHT}$. Thus $\ddot\phi = 0$, and not ${WRONG}$.",
        "- T T T T E",
    ),
    "a turning point": (r"At the turning point $\dot\theta = 0$, hence $\ddot\theta = 0$.", "- E"),
    "an acceleration assumed": (
        r"Suppose that the top precesses at a constant rate, $\dot\phi = \text{const}$."
        r" Then $\ddot\phi = 0$.",
        "- T",
    ),
    "a rate claimed to be constant": (r"The rate obeys $\dot\phi = \text{const}$.", "E"),
    "constant in words": (
        rf"If $\theta$ is constant, ${RIGHT}$ and not ${WRONG}$."
        rf" Hence ${RIGHT}$ at constant $\theta$. A later line: $\ddot\theta = 0$.",
        "T E T !",
    ),
    "drawn by an arrow": (r"In steady motion $\dot\theta = 0 \to \ddot\theta = 0$.", "T T"),
}


@pytest.mark.parametrize("said", TEXTS)
def test_values_that_last(said: str) -> None:
    text, expected = TEXTS[said]
    equations = ph.derive(PROBLEM_SET["gyroscope"].build())
    lines = ph.review(text, equations, seconds=0.0).lines
    assert [blamed(line).value for line in lines] == [MARKS[sign] for sign in expected.split()]

"""≫ and ≪ are statements about a limit."""

import pytest

from judge.judged import uncorrected
from judge.test_false_passes import equations
from polhode.judge import Answer

JUDGED = [
    (r"I_2 \ll Ma^2", ["I_2"], Answer.HOLDS),
    (r"Ma^2 \gg I_2", ["I_2"], Answer.HOLDS),
    (r"I_2 \gg Ma^2", ["I_2"], Answer.FAILS),
    (r"I_1 \ll Ma^2", ["I_2"], Answer.FAILS),
    (r"\dot\phi \ll \omega_1", ["1/omega_1"], Answer.HOLDS),
    (r"\dot\phi \gg \omega_1", ["1/omega_1"], Answer.FAILS),
    (r"\omega_1 \gg g", ["1/omega_1"], Answer.FAILS),
    (r"I_2 \ll 2I_2", [], Answer.FAILS),
    (r"I_2 + Ma^2 \ll I_2", [], Answer.FAILS),
    (r"I_2 \ll Ma^2", [], Answer.UNREAD),
]


@pytest.mark.parametrize(("latex", "small", "answer"), JUDGED)
@pytest.mark.parametrize("context", ["identity", "motion", "limit"])
def test_the_ratio_has_to_vanish_with_what_is_small(latex, small, answer, context):
    verdict = uncorrected(latex, equations("gyroscope"), context=context, small=small)
    assert verdict.answer is answer
    assert verdict.reason


def test_what_to_state_is_said():
    verdict = uncorrected(r"I_2 + Ma^2 \gg I_2", equations("gyroscope"))
    assert verdict.option == "small"
    assert "state what is small among I_2, M, a" in verdict.reason


@pytest.mark.parametrize(("sign", "answer"), [("-", Answer.APPROXIMATE), ("", Answer.FAILS)])
def test_other_members_are_judged_beside_it(sign, answer):
    latex = rf"\theta \ll 1,\quad \ddot\theta \approx {sign}\frac gl\theta"
    options = {"context": "limit", "small": ["theta"]}
    assert uncorrected(latex, equations("plane"), **options).answer is answer

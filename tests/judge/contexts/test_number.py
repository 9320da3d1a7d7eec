"""Numbers compared: 2 m = 1.7658 kg for a mass of 0.8829 kg."""

import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.judge import Answer

EQUATIONS = ph.derive(PROBLEM_SET["rolling-disk"].build())
HOLDS, FAILS = Answer.HOLDS, Answer.FAILS


@pytest.mark.parametrize(
    ("claim", "answer"),
    [
        (r"2m < 1.8\,\mathrm{kg}", HOLDS),
        (r"2m < 1.77\,\mathrm{kg}", HOLDS),
        (r"2m > 1.77\,\mathrm{kg}", FAILS),  # though it is 1.77 to the digits printed
        (r"2m > 1.8\,\mathrm{kg}", FAILS),
        (r"2m \ge 1.7658\,\mathrm{kg}", HOLDS),
        (r"2m > 1.7658\,\mathrm{kg}", FAILS),
        (r"1.7\,\mathrm{kg} < 2m < 1765\,\mathrm{g}", FAILS),
        (r"2m \ne 1.77\,\mathrm{kg}", FAILS),
        (r"2m \ne 1.9\,\mathrm{kg}", HOLDS),
        (r"2m = 1.8\,\mathrm{kg}", HOLDS),
    ],
)
def test_an_inequality_compares_with_the_number_as_printed(claim: str, answer: Answer) -> None:
    given = [r"m = 0.8829"]
    assert ph.check(claim, EQUATIONS, context="number", given=given).answer is answer


def test_a_number_that_depends_on_what_is_not_given_is_not_compared() -> None:
    verdict = ph.check(r"m a < 3", EQUATIONS, context="number", given=["m = 1"])
    assert verdict.answer is Answer.UNREAD
    assert "a number that depends on a" in verdict.reason

"""A fixed sample of the mutation test of texts; all of it is a campaign of tests/proof."""

import pytest

from judge.text_evaluator import Formula
from judge.text_mutants import text_mutants
from judge.text_mutation import own_lines, says_the_same, tried

SAMPLE = 4  # every fourth line of our own


def test_slips_of_the_text_do_not_pass(capsys):
    tallies = tried(list(own_lines(corrected=False))[::SAMPLE], most=4, seed=2)
    with capsys.disabled():
        for context, tally in tallies.items():
            print(f"\n{context}: {tally}", end="")
    for tally in tallies.values():
        assert tally.lines.get("missed", []) == []
        assert tally.lines.get("alarm", []) == []
        assert tally.lines.get("refused", []) == []
    assert sum(tally.false for tally in tallies.values()) >= 40


@pytest.mark.parametrize(
    ("printed", "slip"),
    [
        (r"\ddot\theta = -\frac gl\sin^2\theta", r"\ddot\theta = -\frac gl\cos^2\theta"),
        (r"\ddot\theta = -\frac gl\sin^2\theta", r"\ddot\theta = -\frac {l}{g}\sin^2\theta"),
        (r"E = T + V", r"E = T "),
        (r"I_1\omega_1 > 3", r"I_2\omega_1 > 3"),
        (r"I_1\omega_1 > 3", r"I_1\omega_1 < 3"),
        (r"\frac12mv^2", r"\frac13mv^2"),
        (r"x = \text{const}\dot y", r"x = \text{const}y"),
    ],
)
def test_slips_are_those_of_characters(printed, slip):
    assert slip in [mutant.latex for mutant in text_mutants(printed)]


def test_words_and_numbers_of_equations_are_left_alone():
    every = text_mutants(r"\omega_{2,\text{max}} = \frac{L}{I_2},\tag{13}")
    assert every
    assert all(r"\text{max}" in m.latex and r"\tag{13}" in m.latex for m in every)


def test_the_numbers_of_a_text_are_its_own():
    values = {"g": 10.0, "l": 2.0, "theta": 0.5, "phi_dot": 3.0}
    ((left, sign, right),) = Formula(r"\dot{\phi}^2 > 4g/2l \pm \frac12\theta").sides(values, False)
    assert (float(left), sign, float(right)) == (9.0, ">", 9.75)


def test_the_same_is_the_same_but_for_a_number():
    assert says_the_same("a = b + c", "2a - 2c = 2b")
    assert says_the_same("a > b", "b < a")
    assert not says_the_same("a > b", "a < b")
    assert not says_the_same("a = b", "ac = bc")

"""Derivations with a slip that is carried on: the first wrong line is named, and what follows.

The campaign of `make proof` takes 300 of them.
"""

import pytest
import sympy as sp

from judge.derivations import FAMILIES, Derivation, derivation, shortened
from judge.marking import Marking, marked
from polhode import Mark

SLIPS, SHORTENED, UNTOUCHED = range(8), range(20, 23), range(3)


def test_the_first_wrong_line_is_named_and_lines_drawn_from_it_follow() -> None:
    found = [marked(derivation(seed, with_slip=True)) for seed in SLIPS]
    for each in found:
        assert each.is_named, each.derivation.text
        assert not each.false_marks
    drawn = sum(len(each.drawn) for each in found)
    assert sum(each.following for each in found) >= 0.9 * drawn > 0


@pytest.mark.parametrize("seed", SHORTENED)
def test_the_first_wrong_line_is_named_where_steps_are_skipped(seed: int) -> None:
    found = marked(shortened(derivation(seed, with_slip=True), seed))
    assert found.is_named, found.derivation.text
    assert not found.false_marks


@pytest.mark.parametrize("seed", UNTOUCHED)
def test_no_right_line_is_called_wrong(seed: int) -> None:
    assert not marked(derivation(seed, with_slip=False)).false_marks


def test_the_marking_sees_a_slip_that_is_not_named_and_a_false_mark() -> None:
    text = "We have\n" + r"\[ V = mga\cos\theta . \]" + "\nHence\n" + r"\[ I_3 = ma^2 . \]"
    made = Derivation(FAMILIES["rolling disk"], sp.Integer(1), text, 1, (1,))
    found = marked(made)
    assert not found.is_named
    assert found.false_marks == (0,)
    assert isinstance(found, Marking)
    assert found.review.lines[1].mark is Mark.DOUBT  # no correction was sought
